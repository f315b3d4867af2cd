//! Sphere (A) – polyhedron (B): centre outside, the nearest point of the surface; centre inside, as a point plus
//! the radius (physics contract, 2 and 2.4).
//!
//! Degenerate cases: a centre on a face counts as outside; on an edge or vertex the lowest active face there
//! pushes. Straight above the line where two pieces abut both may push: their springs are shared.

use super::point_polyhedron::point_below_face;
use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::{EdgePush, Polyhedron, PolyhedronEdge, Sphere};

/// The contact of a sphere whose centre is outside: with the feature nearest to the centre, if that may push.
pub fn sphere_outside_polyhedron(sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    let mut over_face = None;
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let height = face.height(&sphere.center);
        if height >= sphere.radius {
            return None;
        }
        // Beside an inner wall both the wall and the face may seem to hold the foot: the face counts.
        let first =
            over_face.is_none_or(|(best, _): (usize, f64)| face.active && !polyhedron.faces[best].active);
        if height >= 0.0 && first && holds_foot(&sphere.center, polyhedron, index) {
            over_face = Some((index, height));
        }
    }
    if let Some((index, height)) = over_face {
        let face = &polyhedron.faces[index];
        return face.active.then(|| Interference {
            depth: sphere.radius - height,
            normal: face.normal,
            point_a: sphere.center - face.normal * sphere.radius,
            feature: Feature::face(index),
        });
    }
    nearest_edge(sphere, polyhedron).or_else(|| nearest_vertex(sphere, polyhedron))
}

/// The contact of a sphere whose centre is inside, under the face that pushes.
pub fn sphere_inside_polyhedron(sphere: &Sphere, polyhedron: &Polyhedron, face: usize) -> Interference {
    let normal = polyhedron.faces[face].normal;
    let below = point_below_face(&sphere.center, polyhedron, face);
    Interference {
        depth: sphere.radius + below.map_or(0.0, |contact| contact.depth),
        normal,
        point_a: sphere.center - normal * sphere.radius,
        feature: Feature::face(face),
    }
}

/// Whether the foot of `p` lies in a face. Where the face goes on in the next piece its outline is widened by
/// rounding: the two pieces work it out from their own normals, and a centre straight above could miss both.
fn holds_foot(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> bool {
    const SEAM_SINE_SLACK: f64 = 1e-12;
    polyhedron.rim(face).iter().all(|rim| {
        let arm = p - rim.anchor;
        let beyond = rim.outward.dot(&arm);
        let at_wall = !polyhedron.faces[rim.neighbor as usize].active;
        beyond <= 0.0 || (at_wall && beyond <= SEAM_SINE_SLACK * arm.norm())
    })
}

fn nearest_edge(sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    let mut best: Option<Interference> = None;
    for (index, edge) in polyhedron.edges.iter().enumerate() {
        let Some(push) = &edge.push else { continue };
        let Some(foot) = foot_on_edge(&sphere.center, polyhedron, edge, push) else { continue };
        let mean = push.normals[0] + push.normals[1];
        let contact = ball_over_point(sphere, &foot, &mean, Feature::edge(index));
        best = deeper(best, contact);
    }
    best
}

/// The foot of a point on an edge, if the point lies strictly between the edge's two faces.
fn foot_on_edge(p: &Vec3, polyhedron: &Polyhedron, edge: &PolyhedronEdge, push: &EdgePush) -> Option<Vec3> {
    let [first, second] = edge.vertices.map(|v| polyhedron.vertices[v as usize].position);
    let (from_first, from_second) = (p - first, p - second);
    let between = push.outwards.iter().all(|outward| outward.dot(&from_first) > 0.0);
    let along = second - first;
    let within = from_first.dot(&along) >= 0.0 && from_second.dot(&along) <= 0.0;
    (between && within).then(|| first + along * (from_first.dot(&along) / along.norm_squared()))
}

fn nearest_vertex(sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    // Rounding in a product of a unit direction and a unit edge: a centre straight above a vertex in the middle
    // of a straight edge would otherwise fall between the two halves of that edge.
    const CONE_COSINE_SLACK: f64 = 1e-12;
    let mut best: Option<Interference> = None;
    for (index, vertex) in polyhedron.vertices.iter().enumerate().filter(|(_, vertex)| vertex.pushes) {
        let direction = sphere.center - vertex.position;
        if direction.norm_squared() >= sphere.radius * sphere.radius {
            continue;
        }
        let slack = CONE_COSINE_SLACK * direction.norm();
        let cone = polyhedron.cone(index);
        if cone.iter().all(|edge| edge.dot(&direction) <= slack) {
            let mean = -cone.iter().sum::<Vec3>();
            best = deeper(best, ball_over_point(sphere, &vertex.position, &mean, Feature::vertex(index)));
        }
    }
    best
}

fn deeper(best: Option<Interference>, candidate: Option<Interference>) -> Option<Interference> {
    match (best, candidate) {
        (Some(best), Some(candidate)) if candidate.depth > best.depth => Some(candidate),
        (None, candidate) => candidate,
        (best, _) => best,
    }
}
