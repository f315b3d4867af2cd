//! A ray into a sphere, an ellipsoid, a capsule, a cylinder or a cone.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::ray_plane::{RayHit, ray_contact};
use pong_geometry::interference::ray_round::{ray_capsule, ray_ellipsoid, ray_frustum, ray_sphere};
use pong_geometry::primitive::Ray;

pub(crate) fn test_sphere(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    emit(pair, ray, ray_sphere(ray, &pair.body_b().spheres[pair.item_b.element as usize]), found);
}

pub(crate) fn test_ellipsoid(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    emit(pair, ray, ray_ellipsoid(ray, &pair.body_b().ellipsoids[pair.item_b.element as usize]), found);
}

pub(crate) fn test_capsule(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    emit(pair, ray, ray_capsule(ray, &pair.body_b().capsules[pair.item_b.element as usize]), found);
}

/// Tests against a cylinder or a cone.
pub(crate) fn test_frustum(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    emit(pair, ray, ray_frustum(ray, &pair.body_b().frusta[pair.item_b.element as usize]), found);
}

fn emit(pair: &ElementPair<'_>, ray: &Ray, hit: Option<RayHit>, found: &mut ChunkCandidates<'_>) {
    if let Some(hit) = hit {
        pair.emit(&ray_contact(ray, &hit), found, |out| out.ray_distance = hit.distance);
    }
}
