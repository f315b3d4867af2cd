//! Contact tests registered by the host.

use super::element_pair::{ChunkCandidates, ElementPair};
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use pong_geometry::extension::PrimitiveRef;
use pong_model::{Item, MovableGroup};

/// Runs the contact test that the host has registered for the kinds of the two elements, if any. Two elements
/// of the same kind are tested in one direction only, so that no contact is reported twice.
pub(super) fn test(pair: &ElementPair<'_>, _: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let (a, b) = (element(pair.body_a(), pair.item_a), element(pair.body_b(), pair.item_b));
    let extensions = &pair.context.scene.extensions;
    let (kind_a, kind_b) = (a.kind_name(), b.kind_name());
    if kind_a == kind_b && !pair.context.in_order {
        return;
    }
    let Some(test) = extensions.contact_test(kind_a, kind_b) else { return };
    if let Some(contact) = test(a, b, &pair.motion().x_ba) {
        pair.emit(pair.key(), &contact, found, |_| ());
    }
}

fn element(body: &MovableGroup, item: Item) -> PrimitiveRef<'_> {
    body.element(body.primitives[item.primitive as usize].kind, item.element)
}
