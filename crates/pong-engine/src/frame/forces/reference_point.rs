//! Which point of A the motion of a contact is reckoned from.

use crate::state::ContactKey;
use pong_geometry::Vec3;
use pong_geometry::primitive::{CustomPrimitive, PrimitiveKind};
use pong_model::MovableGroup;
use std::borrow::Cow;

/// o: the point of A that carries the bristle's reference, in A's frame: the centre of a ball, the point itself,
/// a segment's end, a ray's tip, the end of a round part's axis. Most stand in the model and are not copied: whoever reads a
/// copy that was just written waits for it.
pub(crate) fn reference_point<'a>(
    (body_a, kind_a): (&'a MovableGroup, PrimitiveKind),
    key: &ContactKey,
    element_a: u32,
) -> Cow<'a, Vec3> {
    let element = element_a as usize;
    Cow::Borrowed(match kind_a {
        PrimitiveKind::Point => &body_a.points[element].position,
        PrimitiveKind::LineSegment => return on_axis(&body_a.segments[element].ends, key.end),
        PrimitiveKind::Ray => return Cow::Owned(body_a.rays[element].tip()),
        PrimitiveKind::Sphere => &body_a.spheres[element].center,
        PrimitiveKind::Ellipsoid => &body_a.ellipsoids[element].center,
        PrimitiveKind::Custom => return Cow::Owned(middle(&*body_a.customs[element])),
        PrimitiveKind::Capsule => return on_axis(&body_a.capsules[element].ends, key.end),
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => {
            &body_a.frusta[element].ends[usize::from(!key.end.is_multiple_of(2))]
        }
        PrimitiveKind::Triangle | PrimitiveKind::Polyhedron | PrimitiveKind::Plane | PrimitiveKind::Bore => {
            return Cow::Owned(Vec3::zeros());
        }
    })
}

/// The end of an axis, or its middle for what touches between the ends.
fn on_axis([one, other]: &[Vec3; 2], end: u32) -> Cow<'_, Vec3> {
    match end {
        0 => Cow::Borrowed(one),
        1 => Cow::Borrowed(other),
        _ => Cow::Owned(0.5 * (one + other)),
    }
}

/// Centre of the box around a custom primitive; the frame's origin where the box is unbounded.
fn middle(primitive: &dyn CustomPrimitive) -> Vec3 {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let coordinates = axes.map(|axis| 0.5 * (primitive.support(&axis) - primitive.support(&-axis)));
    let middle = Vec3::from(coordinates);
    if middle.iter().all(|x| x.is_finite()) { middle } else { Vec3::zeros() }
}
