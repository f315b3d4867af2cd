//! A capsule on a piece of a body: the balls at its ends, and the convex edges that its axis crosses between them.

use super::sphere_polyhedron::test_ball;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{Ball, ChunkCandidates, ElementPair, end_spheres, wrong_kind};
use pong_geometry::interference::capsule_edge::{ConvexEdge, capsule_edge};
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::{Capsule, Polyhedron, PolyhedronFace};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Capsule(capsule) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let of_faces = |end: usize| polyhedron.faces.iter().map(move |face| face.height(&capsule.ends[end]));
    let apart = of_faces(0).zip(of_faces(1)).any(|(one, other)| one.min(other) >= capsule.radius);
    if apart {
        return;
    }
    for ball in Ball::at_ends(&end_spheres(capsule)) {
        test_ball(pair, &ball, found);
    }
    for crossing in crossings(capsule, polyhedron) {
        if crossing.depth < capsule.radius || leaves_by(&crossing, capsule, polyhedron) {
            pair.between_ends(&crossing, found);
        }
    }
}

/// What the last few roundings of a depth come to, over the size of what it is computed from.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Whether an axis that has sunk below an edge is in the solid there, and no face and no other edge is a shorter way out, but for
/// rounding: of an axis along a face that face and the edges around it are as short.
fn leaves_by(crossing: &Interference, capsule: &Capsule, polyhedron: &Polyhedron) -> bool {
    let lowest = |face: &PolyhedronFace| face.height(&capsule.ends[0]).min(face.height(&capsule.ends[1]));
    let ways_out = polyhedron.faces.iter().map(|face| capsule.radius - lowest(face));
    let shortest = crossings(capsule, polyhedron)
        .map(|other| other.depth)
        .filter(|depth| *depth >= capsule.radius)
        .chain(ways_out)
        .fold(f64::INFINITY, f64::min);
    let place = crossing.deepest_b + crossing.normal_b * capsule.radius;
    let rounding = ROUNDING * capsule.ends[0].amax().max(capsule.ends[1].amax());
    crossing.depth <= shortest + rounding
        && polyhedron.faces.iter().all(|face| face.height(&place) <= rounding)
}

fn crossings<'p>(
    capsule: &'p Capsule,
    polyhedron: &'p Polyhedron,
) -> impl Iterator<Item = Interference> + use<'p> {
    polyhedron.edges.iter().enumerate().filter_map(move |(index, edge)| {
        let push = edge.push.as_ref()?;
        let edge = ConvexEdge {
            ends_b: edge.vertices.map(|vertex| polyhedron.vertices[vertex as usize].position),
            normals_b: push.normals,
            outwards_b: Some(push.outwards),
            feature: Feature::edge(index),
        };
        capsule_edge(capsule, &edge)
    })
}
