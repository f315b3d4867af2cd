//! An ellipsoid on a triangle.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use crate::frame::narrow_phase::on_triangle::{Centre, on_triangle, thickness_for_ellipsoid};
use pong_geometry::interference::ellipsoid_triangle::EllipsoidOnTriangles;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Ellipsoid(ellipsoid) = a else { wrong_kind(a) };
    test_ready(pair, &EllipsoidOnTriangles::new(ellipsoid), found);
}

/// Tests with a precomputed ellipsoid.
pub(crate) fn test_ready(
    pair: &ElementPair<'_>,
    ready: &EllipsoidOnTriangles,
    found: &mut ChunkCandidates<'_>,
) {
    let ellipsoid = ready.ellipsoid();
    let local = pair.body_a().ellipsoids[pair.item_a.element as usize].center;
    let thickness = thickness_for_ellipsoid(pair.context, pair.item_b, ellipsoid);
    let center = Centre { center_a: local, center_b: ellipsoid.center, end: None };
    let mut emit = |contact| on_triangle(pair, &center, contact, found);
    ready.test(&pair.body_b().triangles, pair.item_b.element, thickness, &mut emit);
}
