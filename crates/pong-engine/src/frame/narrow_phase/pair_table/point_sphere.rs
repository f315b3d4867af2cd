//! A point in a sphere.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::point_sphere::point_sphere;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Point(point) = a else { wrong_kind(a) };
    pair.whole(point_sphere(point, &pair.body_b().spheres[pair.item_b.element as usize]), found);
}
