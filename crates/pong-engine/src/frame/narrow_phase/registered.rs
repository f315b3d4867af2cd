//! Contact tests registered by the host.

use super::element_pair::{ChunkCandidates, ElementPair};
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::primitive::PrimitiveKind::{self, Custom, Plane, Polyhedron, Triangle};
use pong_model::{Item, MovableGroup};

/// Runs the test registered for a pair of kinds, if any.
pub(super) fn test(pair: &ElementPair<'_>, _: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let a = element_ref(pair.body_a(), pair.item_a);
    let b = element_ref(pair.body_b(), pair.item_b);
    let extensions = &pair.context.scene.extensions;
    let (kind_a, kind_b) = (a.kind_name(), b.kind_name());
    if kind_a == kind_b && !pair.context.in_order {
        return;
    }
    let Some(test) = extensions.contact_test(kind_a, kind_b) else { return };
    pair.whole(test(a, b, &pair.motion().x_ba), found);
}

/// View of an element for registered tests.
fn element_ref(body: &MovableGroup, item: Item) -> PrimitiveRef<'_> {
    let i = item.element as usize;
    match body.primitives[item.primitive as usize].kind {
        PrimitiveKind::Point => PrimitiveRef::Point(&body.points[i]),
        PrimitiveKind::LineSegment => PrimitiveRef::LineSegment(&body.segments[i]),
        PrimitiveKind::Ray => PrimitiveRef::Ray(&body.rays[i]),
        PrimitiveKind::Sphere => PrimitiveRef::Sphere(&body.spheres[i]),
        PrimitiveKind::Ellipsoid => PrimitiveRef::Ellipsoid(&body.ellipsoids[i]),
        Triangle => PrimitiveRef::Triangle(&body.triangles, item.element),
        Polyhedron => PrimitiveRef::Polyhedron(&body.polyhedra[i]),
        Plane => PrimitiveRef::Plane(&body.planes[i]),
        PrimitiveKind::Capsule => PrimitiveRef::Capsule(&body.capsules[i]),
        PrimitiveKind::Cylinder => PrimitiveRef::Cylinder(&body.frusta[i]),
        PrimitiveKind::Cone => PrimitiveRef::Cone(&body.frusta[i]),
        PrimitiveKind::Bore => PrimitiveRef::Bore(&body.bores[i]),
        Custom => PrimitiveRef::Custom(&*body.customs[i]),
    }
}
