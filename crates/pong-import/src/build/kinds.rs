//! Primitives of each kind from placed geometry.

use super::meshes::{Placed, tell_oddities};
use super::names::numbered;
use crate::affine::{Affine, Skew, Stretch};
use crate::findings::Findings;
use crate::marks::Mark;
use crate::mesh::{self, Flaw, Mesh, Polyhedron, area_vector};
use crate::model::{Field, Primitive, field, place};
use crate::number::Grid;
use crate::source::{Look, Shape};
use nalgebra::Vector3;

/// Grid and names of the primitives of a node.
pub(super) struct Naming<'a> {
    pub(super) name: &'a str,
    pub(super) surface: Option<String>,
    /// Path of the node in messages.
    pub(super) path: &'a str,
}

impl Naming<'_> {
    pub(super) fn primitive(
        &self,
        kind: &'static str,
        index: usize,
        count: usize,
        fields: Vec<(String, Field)>,
    ) -> Primitive {
        Primitive { kind, name: numbered(self.name, index, count), surface: self.surface.clone(), fields }
    }
}

pub(super) fn points(naming: &Naming<'_>, places: &[Vector3<f64>]) -> Vec<Primitive> {
    let point =
        |(index, at)| naming.primitive("Point", index, places.len(), vec![field("position", place(at))]);
    places.iter().enumerate().map(point).collect()
}

/// Both ends of each line; a line without length is a fault.
pub(super) fn ends(shape: &Shape, path: &str, findings: &mut Findings) -> Vec<[Vector3<f64>; 2]> {
    let all: Vec<[Vector3<f64>; 2]> =
        shape.lines.iter().map(|line| line.map(|vertex| shape.vertices[vertex as usize])).collect();
    if let Some([at, _]) = all.iter().find(|[a, b]| a == b) {
        let cause = format!("a line at ({}, {}, {}) has no length", at.x, at.y, at.z);
        findings.fault(path, "zero-length", cause, "move one of its ends, or make it a point");
    }
    all
}

pub(super) fn segments(naming: &Naming<'_>, ends: &[[Vector3<f64>; 2]]) -> Vec<Primitive> {
    let segment = |(index, line): (usize, &[Vector3<f64>; 2])| {
        naming.primitive("LineSegment", index, ends.len(), vec![field("ends", Field::Tuples(line.to_vec()))])
    };
    ends.iter().enumerate().map(segment).collect()
}

/// Rays from points along vectors, with the vectors' lengths.
pub(super) fn rays(
    naming: &Naming<'_>,
    mark: &Mark,
    grid: Grid,
    rays: &[[Vector3<f64>; 2]],
) -> Vec<Primitive> {
    let ray = |(index, [origin, along]): (usize, &[Vector3<f64>; 2])| {
        let direction = Grid::of_size(1.0).round_place(&along.normalize());
        let mut fields = vec![
            field("origin", place(origin)),
            field("direction", place(&direction)),
            field("length", Field::Number(grid.round(along.norm()))),
        ];
        fields.extend(mark.reach.map(|reach| field("reach", Field::Number(reach))));
        if mark.response != "Normal" {
            fields.push(field("response", Field::Word(mark.response.clone())));
        }
        naming.primitive("Ray", index, rays.len(), fields)
    };
    rays.iter().enumerate().map(ray).collect()
}

/// A sphere or ellipsoid around the origin of its node; a stretched sphere becomes an ellipsoid.
pub(super) fn ball(
    naming: &Naming<'_>,
    semi_axes: Vector3<f64>,
    to_body: &Affine,
    grid: Grid,
    findings: &mut Findings,
) -> Option<Primitive> {
    let stretch = straight(to_body, naming.path, findings)?;
    let center = field("center", place(&grid.round_place(&to_body.translation)));
    let round = semi_axes.x == semi_axes.y && semi_axes.y == semi_axes.z;
    if let (true, Some(scale)) = (round, stretch.uniform()) {
        let radius = field("radius", Field::Number(grid.round(semi_axes.x * scale)));
        return Some(naming.primitive("Sphere", 0, 1, vec![center, radius]));
    }
    if round {
        let scale = stretch.scale;
        let cause =
            format!("its scale of ({}, {}, {}) makes the sphere an ellipsoid", scale.x, scale.y, scale.z);
        findings.note(naming.path, "sphere-to-ellipsoid", cause, "");
    }
    let axes = grid.round_place(&semi_axes.component_mul(&stretch.scale.abs()));
    let turn = stretch.turn.quaternion();
    let sign = if turn.w < 0.0 { -1.0 } else { 1.0 };
    let orientation: Vec<f64> =
        [turn.w, turn.i, turn.j, turn.k].iter().map(|x| Grid::of_size(1.0).round(sign * x)).collect();
    let mut fields = vec![center, field("semi_axes", place(&axes))];
    if orientation != [1.0, 0.0, 0.0, 0.0] {
        fields.push(field("orientation", Field::Tuple(orientation)));
    }
    Some(naming.primitive("Ellipsoid", 0, 1, fields))
}

pub(super) fn straight(to_body: &Affine, path: &str, findings: &mut Findings) -> Option<Stretch> {
    match to_body.stretch() {
        Ok(stretch) => Some(stretch),
        Err(Skew::Flat) => {
            findings.refuse(path, "flat-shape", "a scale of zero leaves nothing of it", "correct its scale")
        }
        Err(Skew::Sheared(cosine)) => {
            let cause = format!("it is sheared: the cosine between two of its axes is {cosine:.1e}");
            let cure =
                "apply the scale of its parents: a turned child of an unevenly scaled parent is sheared";
            findings.refuse(path, "sheared-shape", cause, cure)
        }
    }
}

/// Half space behind a plane through a point.
pub(super) fn plane(
    naming: &Naming<'_>,
    normal: &Vector3<f64>,
    through: &Vector3<f64>,
    grid: Grid,
) -> Primitive {
    let normal = Grid::of_size(1.0).round_place(&normal.normalize());
    let offset = grid.round(normal.normalize().dot(through));
    naming.primitive(
        "Plane",
        0,
        1,
        vec![field("normal", place(&normal)), field("offset", Field::Number(offset))],
    )
}

/// Normal and centre of the plane that contains all triangles.
pub(super) fn plane_of(mesh: &Mesh, path: &str, findings: &mut Findings) -> Option<[Vector3<f64>; 2]> {
    let area: Vector3<f64> = (0..mesh.triangles.len()).map(|t| area_vector(&mesh.corners(t))).sum();
    let centre = mesh.vertices.iter().sum::<Vector3<f64>>() / mesh.vertices.len().max(1) as f64;
    let normal = area.try_normalize(0.0);
    let height = |normal: &Vector3<f64>| {
        mesh.vertices.iter().map(|place| normal.dot(&(place - centre)).abs()).fold(0.0, f64::max)
    };
    match normal {
        Some(normal) if height(&normal) <= 1e-6 * mesh.size_m() => Some([normal, centre]),
        _ => {
            let cause = "its triangles do not lie in one plane";
            findings.refuse(
                path,
                "no-plane",
                cause,
                "give a plane one flat face, or an empty node without a mesh",
            )
        }
    }
}

/// A convex solid; it takes the surface of its faces if they name exactly one.
pub(super) fn solid(
    naming: &Naming<'_>,
    index: usize,
    count: usize,
    solid: Polyhedron,
    looks: &[Look],
) -> Primitive {
    let look = |face: usize| looks.get(solid.look_of[face] as usize).cloned().unwrap_or_default();
    let inactive: Vec<usize> = (0..solid.faces.len()).filter(|&face| look(face).inactive).collect();
    let mut fields = Vec::new();
    if !inactive.is_empty() {
        fields.push(field("inactive_faces", Field::Indices(inactive)));
    }
    let surface = (0..solid.faces.len()).find_map(|face| look(face).surface);
    fields.push(field("vertices", Field::Vertices(solid.vertices)));
    fields.push(field("faces", Field::Faces(solid.faces)));
    let mut primitive = naming.primitive("Polyhedron", index, count, fields);
    primitive.surface = surface.or(primitive.surface);
    primitive
}

/// Tests whether all triangles have the same surface.
pub(super) fn one_surface(mesh: &Mesh, looks: &[Look]) -> bool {
    let surface = |look: &u16| looks.get(*look as usize).and_then(|look| look.surface.as_ref());
    mesh.look_of.iter().all(|look| surface(look) == surface(&mesh.look_of[0]))
}

/// Triangle surfaces, one for each surface that the faces name.
pub(super) fn surfaces(
    naming: &Naming<'_>,
    placed: &Placed,
    looks: &[Look],
    options: (Option<f64>, bool),
    findings: &mut Findings,
) -> Vec<Primitive> {
    let mesh = &placed.mesh;
    if mesh.look_of.iter().any(|look| looks.get(*look as usize).is_some_and(|look| look.inactive)) {
        let cause = "its material says `inactive`, which only faces of a polyhedron can be";
        findings.fault(
            naming.path,
            "inactive-triangle",
            cause,
            "make it a Polyhedron, or give it another material",
        );
        return Vec::new();
    }
    tell_oddities(mesh, naming.path, findings);
    let surface_of = |look: u16| looks.get(look as usize).and_then(|look| look.surface.clone());
    let mut named: Vec<Option<String>> = mesh.look_of.iter().map(|look| surface_of(*look)).collect();
    named.sort();
    named.dedup();
    let count = named.len();
    let primitive = |(index, surface): (usize, &Option<String>)| {
        let own: Vec<u32> = (0..mesh.triangles.len() as u32)
            .filter(|&triangle| surface_of(mesh.look_of[triangle as usize]) == *surface)
            .collect();
        let part = if count == 1 { mesh.clone() } else { mesh.part(&own) };
        let mut fields = Vec::new();
        fields.extend(options.0.map(|thickness| field("thickness", Field::Number(thickness))));
        if options.1 || placed.two_sided {
            fields.push(field("two_sided", Field::Word("true".to_owned())));
        }
        fields.push(field("vertices", Field::Vertices(part.vertices)));
        fields.push(field("triangles", Field::Triangles(part.triangles)));
        let mut primitive = naming.primitive("TriangleMesh", index, count, fields);
        primitive.surface = surface.clone().or(primitive.surface);
        primitive
    };
    named.iter().enumerate().map(primitive).collect()
}

/// A primitive of a kind registered by the host; its parameters are copied unchanged.
pub(super) fn custom(naming: &Naming<'_>, mark: &Mark) -> Primitive {
    let mut fields = vec![field("kind", Field::Text(mark.custom_kind.clone()))];
    if !mark.parameters.is_empty() {
        fields.push(field("parameters", Field::Numbers(mark.parameters.clone())));
    }
    naming.primitive("Custom", 0, 1, fields)
}

/// One primitive for each triangle.
pub(super) fn triangles(naming: &Naming<'_>, mark: &Mark, placed: &Placed, looks: &[Look]) -> Vec<Primitive> {
    let mesh = &placed.mesh;
    let count = mesh.triangles.len();
    let triangle = |index: usize| {
        let mut fields = Vec::new();
        fields.extend(mark.thickness.map(|thickness| field("thickness", Field::Number(thickness))));
        if mark.two_sided || placed.two_sided {
            fields.push(field("two_sided", Field::Word("true".to_owned())));
        }
        fields.push(field("vertices", Field::Tuples(mesh.corners(index).to_vec())));
        let mut primitive = naming.primitive("Triangle", index, count, fields);
        let look = looks.get(mesh.look_of[index] as usize);
        primitive.surface = look.and_then(|look| look.surface.clone()).or(primitive.surface);
        primitive
    };
    (0..count).map(triangle).collect()
}

/// Polyhedra requested by an author: every connected part must be a convex solid.
pub(super) fn solids(
    naming: &Naming<'_>,
    placed: &Placed,
    looks: &[Look],
    findings: &mut Findings,
) -> Vec<Primitive> {
    let parts = mesh::parts(&placed.mesh);
    let count = parts.len();
    let mut primitives = Vec::new();
    for (index, part) in parts.into_iter().enumerate() {
        if !one_surface(&part, looks) {
            let cause = "its materials name several surfaces, and a polyhedron has one";
            findings.fault(naming.path, "several-surfaces", cause, "give all its faces the same");
            continue;
        }
        match mesh::polyhedron(&part, usize::MAX) {
            Ok(polyhedron) => primitives.push(solid(naming, index, count, polyhedron, looks)),
            Err(flaw) => refuse(&flaw, part.size_m(), &numbered(naming.path, index, count), findings),
        }
    }
    primitives
}

fn refuse(flaw: &Flaw, size_m: f64, path: &str, findings: &mut Findings) {
    let at = |place: &Vector3<f64>| format!("({}, {}, {})", place.x, place.y, place.z);
    let (rule, cause, cure) = match flaw {
        Flaw::Open { edges, at: place } => (
            "open-polyhedron",
            format!(
                "{edges} edges do not join two faces that run along them in opposite directions, one at {}",
                at(place)
            ),
            "close the surface and make its normals consistent",
        ),
        Flaw::InsideOut => ("inside-out", "its normals point inwards".to_owned(), "turn its normals around"),
        Flaw::Thin => (
            "zero-volume",
            "it is thinner than 2e-6 of its size".to_owned(),
            "give it a thickness, or make it a TriangleMesh",
        ),
        Flaw::Dented { at: place, height_m } => (
            "not-convex",
            format!(
                "the vertex {} is {height_m:.1e} m ({:.1e} of its size) in front of a face",
                at(place),
                height_m / size_m
            ),
            "make it convex, or a TriangleMesh; `pong decompose` cuts it into convex pieces",
        ),
        Flaw::Tangled | Flaw::TooManyFaces(_) => (
            "not-convex",
            "its surface has a hole or runs through itself".to_owned(),
            "make it convex, or a TriangleMesh; `pong decompose` cuts it into convex pieces",
        ),
    };
    findings.fault(path, rule, cause, cure);
}
