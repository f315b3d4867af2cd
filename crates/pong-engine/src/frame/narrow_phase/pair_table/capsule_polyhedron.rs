//! A capsule on a piece of a body: the end spheres, and the convex edges that the axis crosses between them.

use super::sphere_polyhedron::test_ball;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{Ball, ChunkCandidates, ElementPair, end_spheres, wrong_kind};
use pong_geometry::interference::capsule_polyhedron::CapsuleAtPiece;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Capsule(capsule) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let Some(at_piece) = CapsuleAtPiece::new(capsule, polyhedron) else { return };
    for ball in Ball::at_ends(&end_spheres(capsule)) {
        test_ball(pair, &ball, found);
    }
    at_piece.each_crossing(|crossing| pair.between_ends(crossing, found));
}
