//! Reference point of A for the motion of a contact.

use crate::state::ContactKey;
use pong_geometry::Vec3;
use pong_geometry::primitive::{CustomPrimitive, PrimitiveKind};
use pong_model::MovableGroup;
use std::borrow::Cow;

/// Point o of A whose displacement deflects the bristle, in A's frame: centre of a sphere or ellipsoid, the
/// point itself, end of a segment or of a round part's axis, tip of a ray. Borrowed from the model where
/// possible.
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

/// End of an axis, or its middle for a contact between the ends.
fn on_axis([one, other]: &[Vec3; 2], end: u32) -> Cow<'_, Vec3> {
    match end {
        0 => Cow::Borrowed(one),
        1 => Cow::Borrowed(other),
        _ => Cow::Owned(0.5 * (one + other)),
    }
}

/// Centre of a custom primitive's box; the frame's origin if the box is unbounded.
fn middle(primitive: &dyn CustomPrimitive) -> Vec3 {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let coordinates = axes.map(|axis| 0.5 * (primitive.support(&axis) - primitive.support(&-axis)));
    let middle = Vec3::from(coordinates);
    if middle.iter().all(|x| x.is_finite()) { middle } else { Vec3::zeros() }
}
