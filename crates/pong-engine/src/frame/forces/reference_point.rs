//! Reference point of A for the motion of a contact.

use crate::state::ContactKey;
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::MovableGroup;
use std::borrow::Cow;

/// Point o of A whose displacement deflects the bristle, in A's frame, m; borrowed from the model where the
/// model stores it.
pub(crate) fn reference_point<'a>(
    (body_a, kind_a): (&'a MovableGroup, PrimitiveKind),
    key: &ContactKey,
    element_a: u32,
) -> Cow<'a, Vec3> {
    body_a.element(kind_a, element_a).reference_point(key.end)
}
