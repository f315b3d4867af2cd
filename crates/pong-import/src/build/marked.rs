//! A model from marks: root, groups and primitives as given by `extras.pong`.

use super::building::Building;
use super::frames::body_frame;
use super::kinds::{self, Naming};
use super::meshes;
use super::names::natural;
use super::round;
use crate::affine::Affine;
use crate::findings::Findings;
use crate::marks::Mark;
use crate::model::{Field, Group, Primitive, field};
use crate::number::Grid;
use crate::source::{Node, Shape, Source};
use nalgebra::Vector3;

pub(super) fn read_marks(
    source: &Source,
    building: &Building<'_>,
    findings: &mut Findings,
) -> Vec<Option<Mark>> {
    let read = |node: &Node| {
        let path = format!("{}: {}", building.file, node.path);
        node.mark.as_ref().and_then(|value| Mark::read(value, &path, findings))
    };
    source.nodes.iter().map(read).collect()
}

pub(super) fn tree(
    mut source: Source,
    marks: &[Option<Mark>],
    grid: Grid,
    building: &mut Building<'_>,
    findings: &mut Findings,
) -> Option<Group> {
    let root = root_of(&source.nodes, marks, building, findings)?;
    let mut below: Vec<Vec<usize>> = vec![Vec::new(); source.nodes.len()];
    let mut tops = Vec::new();
    for (index, node) in source.nodes.iter().enumerate() {
        match node.parent {
            Some(parent) => below[parent].push(index),
            None => tops.push(index),
        }
    }
    let mut build =
        Build { nodes: &mut source.nodes, marks, below, grid, building, findings, left_out: Vec::new() };
    let mut group = Group { name: build.building.name.clone(), ..Group::default() };
    match root {
        Some(root) => {
            let path = build.path(root);
            let frame = body_frame(&build.nodes[root].to_top(build.nodes), grid, &path, build.findings)?;
            let mark = marks[root].clone().unwrap_or_default();
            group.name = build.name_of(root);
            group.bound = Some(mark.bound).filter(|bound| !bound.is_empty() && bound != "Aabb");
            group.surface = Some(mark.surface).filter(|surface| !surface.is_empty());
            group.contact = mark.contact;
            let children = std::mem::take(&mut build.below[root]);
            build.fill(&mut group, &children, &frame.rest);
        }
        None => build.fill(&mut group, &tops, &Affine::identity()),
    }
    build.tell_left_out();
    if group.is_empty() && findings.faults.is_empty() {
        let cause = "nothing below the root is marked as a primitive";
        findings.fault(&building.file, "empty-group", cause, "mark something in extras.pong");
    }
    Some(group)
}

/// True if the root that is built leaves its contact to its shapes.
pub(super) fn is_automatic(nodes: &[Node], marks: &[Option<Mark>], root: &Option<String>) -> bool {
    let is_meant = |node: &Node| root.as_ref().is_none_or(|name| node.name == *name);
    nodes
        .iter()
        .zip(marks)
        .any(|(node, mark)| mark.as_ref().is_some_and(|mark| mark.is_automatic) && is_meant(node))
}

/// The node marked as the root; `Some(None)` if none is, which makes the scene the root.
fn root_of(
    nodes: &[Node],
    marks: &[Option<Mark>],
    building: &Building<'_>,
    findings: &mut Findings,
) -> Option<Option<usize>> {
    let is_root = |index: &usize| marks[*index].as_ref().is_some_and(|mark| mark.role == "root");
    let roots: Vec<usize> = (0..nodes.len()).filter(is_root).collect();
    let called: Vec<&str> = roots.iter().map(|&root| nodes[root].name.as_str()).collect();
    if let Some(name) = &building.root {
        let found = roots.iter().zip(&called).find(|(_, called)| *called == name).map(|(root, _)| *root);
        if found.is_none() {
            let cause = format!("no node `{name}` is marked as a root; roots are {called:?}");
            return findings.refuse(&building.file, "no-root", cause, "name one of them with --root");
        }
        return Some(found);
    }
    match roots.as_slice() {
        [] => Some(None),
        [root] => Some(Some(*root)),
        _ => {
            let cause = format!("several nodes are marked as roots: {called:?}");
            findings.refuse(&building.file, "several-roots", cause, "--root chooses one")
        }
    }
}

impl Node {
    /// Product of all transforms from this node to the scene.
    fn to_top(&self, nodes: &[Node]) -> Affine {
        let mut affine = self.local;
        let mut here = self.parent;
        while let Some(parent) = here {
            affine = nodes[parent].local.after(&affine);
            here = nodes[parent].parent;
        }
        affine
    }
}

struct Build<'a, 'p> {
    nodes: &'a mut Vec<Node>,
    marks: &'a [Option<Mark>],
    below: Vec<Vec<usize>>,
    grid: Grid,
    building: &'a mut Building<'p>,
    findings: &'a mut Findings,
    /// Nodes with meshes but without a mark.
    left_out: Vec<String>,
}

impl Build<'_, '_> {
    fn path(&self, node: usize) -> String {
        format!("{}: {}", self.building.file, self.nodes[node].path)
    }

    fn name_of(&self, node: usize) -> String {
        let marked = self.marks[node].as_ref().map(|mark| mark.name.as_str()).filter(|name| !name.is_empty());
        marked.unwrap_or(&self.nodes[node].name).to_owned()
    }

    /// Fills a group from the marks of the node's children and their unmarked descendants.
    fn fill(&mut self, group: &mut Group, children: &[usize], to_body: &Affine) {
        for (node, here) in self.marked_below(children, to_body) {
            let below = std::mem::take(&mut self.below[node]);
            let mark = self.marks[node].clone();
            match mark.as_ref().map(|mark| mark.role.as_str()) {
                Some("group") => {
                    let mark = mark.unwrap_or_default();
                    self.add_group(group, node, &mark, &below, &here);
                }
                Some("primitive") => {
                    let primitives = self.primitives(node, &mark.unwrap_or_default(), &here);
                    group.primitives.extend(primitives);
                }
                Some(_) => {
                    let cause = "a root lies below another one";
                    self.findings.fault(&self.path(node), "several-roots", cause, "mark it as a group");
                }
                None => {}
            }
        }
        self.check_names(group);
        self.refuse_mixed(group);
    }

    /// Marked nodes below a group down to the next groups, in the order of writing, with their transforms.
    fn marked_below(&mut self, children: &[usize], to_body: &Affine) -> Vec<(usize, Affine)> {
        let mut open: Vec<(usize, Affine)> = children.iter().rev().map(|&child| (child, *to_body)).collect();
        let mut found = Vec::new();
        while let Some((node, above)) = open.pop() {
            let here = above.after(&self.nodes[node].local);
            let mark = self.marks[node].as_ref();
            if mark.is_none() && self.nodes[node].mesh.is_some() {
                self.left_out.push(self.nodes[node].name.clone());
            }
            if mark.is_some() {
                found.push((node, here));
            }
            if mark.is_none_or(|mark| mark.role != "group") {
                let below = std::mem::take(&mut self.below[node]);
                open.extend(below.iter().rev().map(|&child| (child, here)));
            }
        }
        found.sort_by_cached_key(|(node, _)| {
            let order = self.marks[*node].as_ref().map_or(0, |mark| mark.order);
            (order == 0, order, natural(&self.name_of(*node)), natural(&self.nodes[*node].name))
        });
        found
    }

    fn add_group(&mut self, parent: &mut Group, node: usize, mark: &Mark, below: &[usize], here: &Affine) {
        let path = self.path(node);
        if self.nodes[node].mesh.is_some() {
            let cause = "it is marked as a group, so its mesh counts for nothing";
            self.findings.note(&path, "mesh-of-group", cause, "mark the mesh of a child as a primitive");
        }
        let mut group = Group {
            name: self.name_of(node),
            movable: mark.movable,
            // A box is the default of movable groups.
            bound: Some(mark.bound.clone())
                .filter(|bound| !(bound.is_empty() || mark.movable && bound == "Aabb")),
            surface: Some(mark.surface.clone()).filter(|surface| !surface.is_empty()),
            contact: mark.contact,
            ..Group::default()
        };
        let mut to_body = *here;
        if mark.movable {
            let Some(frame) = body_frame(here, self.grid, &path, self.findings) else { return };
            (group.position, group.orientation) = (Some(frame.position), Some(frame.orientation));
            to_body = frame.rest;
        }
        let faults = self.findings.faults.len();
        self.fill(&mut group, below, &to_body);
        if group.is_empty() && self.findings.faults.len() == faults {
            let cause = "nothing below this group is marked as a primitive";
            self.findings.fault(&path, "empty-group", cause, "mark something, or unmark the group");
        }
        parent.groups.push(group);
    }

    /// Checks names: unique among siblings, not empty, without `/`.
    fn check_names(&mut self, group: &Group) {
        let path = format!("{}: {}", self.building.file, group.name);
        for list in [
            group.groups.iter().map(|below| &below.name).collect::<Vec<_>>(),
            group.primitives.iter().map(|primitive| &primitive.name).collect(),
        ] {
            let mut seen = std::collections::BTreeSet::new();
            for name in list {
                if name.is_empty() || name.contains('/') {
                    let cause = format!("`{name}` is no name for a model: it is empty or holds `/`");
                    self.findings.fault(&path, "name", cause, "rename it, or give a name in its mark");
                } else if !seen.insert(name) {
                    let cause = format!("two siblings below this group are called `{name}`");
                    self.findings.fault(&path, "repeated-name", cause, "give them names of their own");
                }
            }
        }
    }

    /// Refuses a group that holds both groups and primitives.
    fn refuse_mixed(&mut self, group: &Group) {
        if let (Some(below), Some(primitive)) = (group.groups.first(), group.primitives.first()) {
            let cause = format!("it holds groups (`{}`) and primitives (`{}`)", below.name, primitive.name);
            let path = format!("{}: {}", self.building.file, group.name);
            let cure = "put the primitives into a group of their own";
            self.findings.fault(&path, "groups-and-primitives", cause, cure);
        }
    }

    fn tell_left_out(&mut self) {
        if let Some(first) = self.left_out.first() {
            let cause = format!(
                "{} nodes with meshes have no mark and are left out, `{first}` first",
                self.left_out.len()
            );
            self.findings.note(&self.building.file, "unmarked", cause, "");
        }
    }

    fn primitives(&mut self, node: usize, mark: &Mark, to_body: &Affine) -> Vec<Primitive> {
        let (path, name) = (self.path(node), self.name_of(node));
        let unit = self.building.unit_m;
        let mark = &Mark {
            reach: mark.reach.map(|reach| reach * unit),
            thickness: mark.thickness.map(|thickness| thickness * unit),
            ..mark.clone()
        };
        let surface = Some(mark.surface.clone()).filter(|surface| !surface.is_empty());
        let naming = Naming { name: &name, surface, path: &path };
        if let Some(what) = mark.numbered {
            let cause = format!(
                "`{what}` counts faces or edges of the mesh before the export, and glTF has triangles"
            );
            let cure = match what {
                "parts" => "make each part an object of its own, or export the model file from the toolkit",
                _ => {
                    "give inactive faces a material whose extras.pong is {\"inactive\": true}, or export the model \
                      file from the toolkit"
                }
            };
            self.findings.fault(&path, "numbered-elements", cause, cure);
            return Vec::new();
        }
        (self.building.progress)(&name);
        let shape = self.nodes[node].mesh.take().filter(|shape| !shape.is_empty());
        match (mark.kind.as_str(), shape) {
            ("", _) => {
                let cause = "it is marked as a primitive but names no kind";
                self.findings.fault(&path, "no-kind", cause, "choose a kind for it");
                Vec::new()
            }
            ("Custom", _) => vec![kinds::custom(&naming, mark)],
            ("Sphere" | "Ellipsoid", _) => self.ball(&naming, mark, to_body).into_iter().collect(),
            ("Capsule" | "Cylinder" | "Cone" | "Bore", _) => {
                let round = round::marked(&naming, mark, unit, to_body, self.grid, self.findings);
                round.into_iter().collect()
            }
            (_, None) => self.of_empty(&naming, mark, to_body),
            (_, Some(mut shape)) => {
                meshes::place(&mut shape, to_body, self.grid);
                self.of_mesh(&naming, mark, shape)
            }
        }
    }

    fn ball(&mut self, naming: &Naming<'_>, mark: &Mark, to_body: &Affine) -> Option<Primitive> {
        let unit = self.building.unit_m;
        let (semi_axes, what) = match mark.kind.as_str() {
            "Sphere" => (Vector3::repeat(mark.radius * unit), "radius"),
            _ => (Vector3::from(mark.semi_axes) * unit, "semi_axes"),
        };
        if semi_axes.min() <= 0.0 {
            let cause = format!("its mark gives no {what} above zero");
            return self.findings.refuse(naming.path, "not-positive", cause, "give one in its mark");
        }
        kinds::ball(naming, semi_axes, to_body, self.grid, self.findings)
    }

    /// Primitives of a node without a mesh.
    fn of_empty(&mut self, naming: &Naming<'_>, mark: &Mark, to_body: &Affine) -> Vec<Primitive> {
        let origin = self.grid.round_place(&to_body.translation);
        match mark.kind.as_str() {
            "Point" => kinds::points(naming, &[origin]),
            "Ray" if mark.length > 0.0 => {
                let along = to_body.linear * Vector3::new(0.0, 0.0, mark.length * self.building.unit_m);
                kinds::rays(naming, mark, self.grid, &[[origin, along]])
            }
            "Ray" => {
                let cause = "its mark gives no length above zero";
                self.findings.fault(naming.path, "not-positive", cause, "give one in its mark");
                Vec::new()
            }
            "Plane" => match to_body.linear.try_inverse() {
                Some(inverse) => {
                    vec![kinds::plane(naming, &(inverse.transpose() * Vector3::z()), &origin, self.grid)]
                }
                None => {
                    let cause = "a scale of zero leaves nothing of it";
                    self.findings.fault(naming.path, "flat-shape", cause, "correct its scale");
                    Vec::new()
                }
            },
            kind => {
                let cause = format!("a {kind} needs a mesh, and it has none");
                let cure = "export its mesh, loose vertices and edges too (in Blender: Data > Mesh > Loose Edges, Loose Points)";
                self.findings.fault(naming.path, "no-geometry", cause, cure);
                Vec::new()
            }
        }
    }

    fn of_mesh(&mut self, naming: &Naming<'_>, mark: &Mark, shape: Shape) -> Vec<Primitive> {
        let findings = &mut *self.findings;
        match mark.kind.as_str() {
            "Point" => return kinds::points(naming, &shape.vertices),
            "LineSegment" | "Ray" => {
                if !shape.triangles.is_empty() || shape.lines.is_empty() {
                    let cause = "its edges are those of triangles; which of them were meant is lost";
                    let cure = "export a mesh of edges without faces (in Blender: Data > Mesh > Loose Edges)";
                    findings.fault(naming.path, "edges-of-faces", cause, cure);
                    return Vec::new();
                }
                let ends = kinds::ends(&shape, naming.path, findings);
                if mark.kind == "LineSegment" {
                    return kinds::segments(naming, &ends);
                }
                let rays: Vec<_> = ends.iter().map(|[a, b]| [*a, b - a]).collect();
                return kinds::rays(naming, mark, self.grid, &rays);
            }
            _ => {}
        }
        if shape.triangles.is_empty() {
            let cause = format!("a {} needs faces, and its mesh has none", mark.kind);
            findings.fault(naming.path, "no-geometry", cause, "give its mesh faces, or choose another kind");
            return Vec::new();
        }
        if !shape.points.is_empty() || !shape.lines.is_empty() {
            let cause = "loose vertices and edges of its mesh count for nothing";
            findings.note(naming.path, "loose", cause, "");
        }
        let looks = shape.looks.clone();
        let placed = meshes::triangles(shape, self.building, naming.path, findings);
        let mut primitives = match mark.kind.as_str() {
            "Plane" => match kinds::plane_of(&placed.mesh, naming.path, findings) {
                Some([normal, through]) => vec![kinds::plane(naming, &normal, &through, self.grid)],
                None => Vec::new(),
            },
            "Triangle" => kinds::triangles(naming, mark, &placed, &looks),
            "Polyhedron" => kinds::solids(naming, &placed, &looks, findings),
            _ => kinds::surfaces(naming, &placed, &looks, (mark.thickness, mark.two_sided), findings),
        };
        if !mark.file.is_empty() {
            for primitive in &mut primitives {
                primitive.fields.insert(0, field("file", Field::Text(mark.file.clone())));
                if mark.file_scale != 1.0 {
                    primitive.fields.insert(1, field("scale", Field::Number(mark.file_scale)));
                }
            }
        }
        primitives
    }
}
