//! Which point of A the motion of a contact is reckoned from.

use crate::state::ContactKey;
use pong_geometry::Vec3;
use pong_geometry::primitive::{CustomPrimitive, PrimitiveKind};
use pong_model::MovableGroup;

/// o: the point of A that carries the bristle's reference, in A's frame: the centre of a ball, the point itself,
/// a segment's end, a ray's tip, the end of a round part's axis.
pub(crate) fn reference_point(
    (body_a, kind_a): (&MovableGroup, PrimitiveKind),
    key: &ContactKey,
    element_a: u32,
) -> Vec3 {
    let element = element_a as usize;
    match kind_a {
        PrimitiveKind::Point => body_a.points[element].position,
        PrimitiveKind::LineSegment => on_axis(&body_a.segments[element].ends, key.end),
        PrimitiveKind::Ray => body_a.rays[element].tip(),
        PrimitiveKind::Sphere => body_a.spheres[element].center,
        PrimitiveKind::Ellipsoid => body_a.ellipsoids[element].center,
        PrimitiveKind::Custom => middle(&*body_a.customs[element]),
        PrimitiveKind::Capsule => on_axis(&body_a.capsules[element].ends, key.end),
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => {
            let [one, other] = body_a.frusta[element].ends;
            if key.end.is_multiple_of(2) { one } else { other }
        }
        PrimitiveKind::Triangle | PrimitiveKind::Polyhedron | PrimitiveKind::Plane | PrimitiveKind::Bore => {
            Vec3::zeros()
        }
    }
}

/// The end of an axis, or its middle for what touches between the ends.
fn on_axis([one, other]: &[Vec3; 2], end: u32) -> Vec3 {
    match end {
        0 => *one,
        1 => *other,
        _ => 0.5 * (one + other),
    }
}

/// Centre of the box around a custom primitive; the frame's origin where the box is unbounded.
fn middle(primitive: &dyn CustomPrimitive) -> Vec3 {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let coordinates = axes.map(|axis| 0.5 * (primitive.support(&axis) - primitive.support(&-axis)));
    let middle = Vec3::from(coordinates);
    if middle.iter().all(|x| x.is_finite()) { middle } else { Vec3::zeros() }
}
