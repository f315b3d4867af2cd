//! A model without marks: a group per node, primitives by geometry.

use super::building::Building;
use super::kinds::{self, Naming};
use super::meshes::{self, Placed};
use super::names::Names;
use super::round;
use crate::affine::Affine;
use crate::findings::Findings;
use crate::mesh::{self, Flaw, HullFinder, Mesh, Polyhedron, bounds};
use crate::model::{Group, Primitive};
use crate::number::Grid;
use crate::source::{Look, Node, Shape, Source};

pub(super) fn tree(
    mut source: Source,
    grid: Grid,
    building: &mut Building<'_>,
    findings: &mut Findings,
) -> Option<Group> {
    let wanted = contributing(&source.nodes);
    let count =
        source.nodes.iter().filter(|node| node.mesh.as_ref().is_some_and(|shape| !shape.is_empty())).count();
    if count == 0 {
        let cause = "no node has a mesh";
        return findings.refuse(
            &building.file,
            "empty-mesh",
            cause,
            "export meshes, or mark nodes with extras.pong",
        );
    }
    let mut below: Vec<Vec<usize>> = vec![Vec::new(); source.nodes.len()];
    let mut tops = Vec::new();
    for index in (0..source.nodes.len()).filter(|&index| wanted[index]) {
        match source.nodes[index].parent {
            Some(parent) => below[parent].push(index),
            None => tops.push(index),
        }
    }
    let mut build = Build { nodes: &mut source.nodes, below, grid, building, findings };
    let mut root = Group { name: build.building.name.clone(), ..Group::default() };
    if let ([top], 1) = (tops.as_slice(), count)
        && build.below[*top].is_empty()
    {
        root.primitives = build.primitives(*top, &Affine::identity());
        return Some(root);
    }
    root.groups = build.groups(&tops, &Affine::identity());
    Some(root)
}

/// Marks nodes with a mesh in their subtree.
fn contributing(nodes: &[Node]) -> Vec<bool> {
    let mut wanted: Vec<bool> =
        nodes.iter().map(|node| node.mesh.as_ref().is_some_and(|shape| !shape.is_empty())).collect();
    for index in (0..nodes.len()).rev() {
        if let (true, Some(parent)) = (wanted[index], nodes[index].parent) {
            wanted[parent] = true;
        }
    }
    wanted
}

struct Build<'a, 'p> {
    nodes: &'a mut Vec<Node>,
    below: Vec<Vec<usize>>,
    grid: Grid,
    building: &'a mut Building<'p>,
    findings: &'a mut Findings,
}

impl Build<'_, '_> {
    fn path(&self, node: usize) -> String {
        format!("{}: {}", self.building.file, self.nodes[node].path)
    }

    fn groups(&mut self, nodes: &[usize], to_model: &Affine) -> Vec<Group> {
        let mut names = Names::default();
        let mut groups = Vec::new();
        for &node in nodes {
            let name = names.take(&self.nodes[node].name.clone(), &self.path(node), self.findings);
            let group = self.group(node, name, to_model);
            if !group.is_empty() {
                groups.push(group);
            }
        }
        groups
    }

    fn group(&mut self, node: usize, name: String, to_model: &Affine) -> Group {
        let primitives = self.primitives(node, to_model);
        let below = std::mem::take(&mut self.below[node]);
        let here = to_model.after(&self.nodes[node].local);
        let mut groups = self.groups(&below, &here);
        if groups.is_empty() || primitives.is_empty() {
            return Group { name, groups, primitives, ..Group::default() };
        }
        // A group holds either groups or primitives: the node's own primitives get a group of their own.
        let mut names = Names::default();
        groups.iter().for_each(|group| _ = names.take(&group.name, "", &mut Findings::default()));
        let own = names.take(&format!("{name}_own"), "", &mut Findings::default());
        groups.insert(0, Group { name: own, primitives, ..Group::default() });
        Group { name, groups, ..Group::default() }
    }

    fn primitives(&mut self, node: usize, to_model: &Affine) -> Vec<Primitive> {
        let path = self.path(node);
        let here = to_model.after(&self.nodes[node].local);
        let Some(mut shape) = self.nodes[node].mesh.take() else { return Vec::new() };
        (self.building.progress)(&self.nodes[node].name);
        meshes::place(&mut shape, &here, self.grid);
        let naming = Naming { name: &self.nodes[node].name.replace('/', "_"), surface: None, path: &path };
        let at_points: Vec<_> = shape.points.iter().map(|&vertex| shape.vertices[vertex as usize]).collect();
        let mut primitives = kinds::points(&naming, &at_points);
        let ends = kinds::ends(&shape, &path, self.findings);
        primitives.extend(kinds::segments(&naming, &ends));
        if !shape.triangles.is_empty() {
            primitives.extend(self.of_triangles(&naming, shape));
        }
        unique(&mut primitives);
        primitives
    }

    /// Round parts become round primitives if requested, convex solids polyhedra, and the rest surfaces.
    fn of_triangles(&mut self, naming: &Naming<'_>, shape: Shape) -> Vec<Primitive> {
        let looks = shape.looks.clone();
        let placed = meshes::triangles(shape, self.building, naming.path, self.findings);
        let (mut primitives, placed) =
            round::taken_out(naming, placed, &looks, self.building, self.grid, self.findings);
        if placed.mesh.triangles.is_empty() {
            return primitives;
        }
        let (solids, rest) = self.sorted(naming, &placed, &looks);
        let count = solids.len();
        let solids = solids.into_iter().enumerate();
        primitives.extend(solids.map(|(index, solid)| kinds::solid(naming, index, count, solid, &looks)));
        if !rest.triangles.is_empty() {
            let rest = Placed { mesh: rest, two_sided: placed.two_sided };
            primitives.extend(kinds::surfaces(naming, &rest, &looks, (None, false), self.findings));
        }
        primitives
    }

    /// Convex solids among the parts, and all other triangles.
    fn sorted(&mut self, naming: &Naming<'_>, placed: &Placed, looks: &[Look]) -> (Vec<Polyhedron>, Mesh) {
        if placed.two_sided {
            return (Vec::new(), placed.mesh.clone());
        }
        let parts = mesh::parts(&placed.mesh);
        let mut hulled = Hulled::default();
        let found: Vec<Result<Polyhedron, Flaw>> = parts
            .iter()
            .map(|part| {
                let found = mesh::polyhedron(part, self.building.faces_max);
                match self.building.hull {
                    Some(find) => hulled.instead(find, part, found),
                    None => found,
                }
            })
            .collect();
        hulled.tell(naming, self.findings);
        let cavities: Vec<_> = parts
            .iter()
            .zip(&found)
            .filter(|(part, found)| found.is_err() && mesh::volume_m3(part) < 0.0)
            .map(|(part, _)| bounds(&part.vertices))
            .collect();
        let (mut solids, mut rest) = (Vec::new(), Mesh::default());
        let (mut dented, mut large) = (0, 0);
        let all_rest = found.iter().all(Result::is_err);
        for (part, found) in parts.iter().zip(found) {
            match found {
                Ok(solid) if kinds::one_surface(part, looks) && !is_hollow(part, &cavities) => {
                    solids.push(solid)
                }
                other => {
                    dented += usize::from(matches!(other, Err(Flaw::Dented { .. } | Flaw::Tangled)));
                    large += usize::from(matches!(other, Err(Flaw::TooManyFaces(_))));
                    if !all_rest {
                        rest.append(part);
                    }
                }
            }
        }
        self.tell(naming, dented, large);
        (solids, if all_rest { placed.mesh.clone() } else { rest })
    }

    fn tell(&mut self, naming: &Naming<'_>, dented: usize, large: usize) {
        if dented > 0 {
            let cause = "closed but not convex: a surface of triangles, with nothing behind it";
            let cure = "`pong decompose` makes it a solid of convex pieces, `--hull` its convex hull";
            self.findings.note(naming.path, "not-convex", cause, cure);
        }
        if large > 0 {
            let cause = format!(
                "convex, but of more than {} faces: a surface of triangles, which is quicker",
                self.building.faces_max
            );
            self.findings.note(naming.path, "many-faces", cause, "--faces-max allows more faces");
        }
    }
}

/// Parts that were replaced by their convex hulls.
#[derive(Default)]
struct Hulled {
    parts: usize,
    /// Largest depth of a vertex inside its hull, m.
    deepest_m: f64,
}

impl Hulled {
    /// Convex hull of a part that bounds a volume but is not convex; otherwise `found` unchanged.
    fn instead(
        &mut self,
        find: HullFinder,
        part: &Mesh,
        found: Result<Polyhedron, Flaw>,
    ) -> Result<Polyhedron, Flaw> {
        if !matches!(found, Err(Flaw::Dented { .. } | Flaw::Tangled | Flaw::Open { .. })) {
            return found;
        }
        let Some((hull, deepest_m)) = find(part) else { return found };
        self.parts += 1;
        self.deepest_m = self.deepest_m.max(deepest_m);
        Ok(hull)
    }

    fn tell(&self, naming: &Naming<'_>, findings: &mut Findings) {
        if self.parts > 0 {
            let parts = if self.parts == 1 { "a part".to_owned() } else { format!("{} parts", self.parts) };
            let cause = format!(
                "{parts} became the convex hull: vertices of the mesh lie up to {:.2e} m within it",
                self.deepest_m
            );
            let cure = "`pong decompose` follows the mesh closer";
            findings.note(naming.path, "hull", cause, if self.deepest_m > 0.0 { cure } else { "" });
        }
    }
}

/// Tests whether a cavity lies within the part's box; the part is no solid then.
fn is_hollow(part: &Mesh, cavities: &[(nalgebra::Vector3<f64>, nalgebra::Vector3<f64>)]) -> bool {
    let (low, high) = bounds(&part.vertices);
    cavities.iter().any(|(inner_low, inner_high)| low.inf(inner_low) == low && high.sup(inner_high) == high)
}

/// Makes names unique: points, lines and solids of one node may share a name.
fn unique(primitives: &mut [Primitive]) {
    let mut names = Names::default();
    for primitive in primitives {
        primitive.name = names.take(&primitive.name, "", &mut Findings::default());
    }
}
