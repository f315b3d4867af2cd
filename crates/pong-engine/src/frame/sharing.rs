//! Which of the interferences found count, and with what weight.

use super::Frame;
use super::buffers::{FrameContact, Stance};
use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::sharing::{Sharer, share};
use crate::state::{NO_FACE, Role};
use pong_geometry::interference::triangle_features::{EdgeClass, TriangleView};
use pong_geometry::primitive::{PrimitiveKind, TriangleSet};

/// Relative: a spare contact counts if no other is deeper by more than rounding.
const SPARE_DEPTH_SLACK: f64 = 1e-9;

/// Sorts the contacts into the order of every sum and settles their weights.
pub(super) fn settle(scene: &Scene, sealed: &Sealed, frame: &mut Frame) {
    frame.contacts.sort_unstable_by_key(order);
    keep_first_ray_hits(scene, sealed, &mut frame.contacts);
    let mut start = 0;
    while start < frame.contacts.len() {
        let key = frame.contacts[start].key;
        let count = frame.contacts[start..].partition_point(|contact| contact.key == key);
        let group = &mut frame.contacts[start..start + count];
        // A lone contact has nothing to share with: it keeps the weight 1.
        if group[0].shares && count > 1 {
            let (_, body_b) = sealed.bodies_of(&key);
            settle_surface(group, &scene.body(body_b).triangles, &mut frame.sharers);
        }
        start += count;
    }
    frame.contacts.retain(|contact| contact.stance != Stance::Dropped);
}

fn order(contact: &FrameContact) -> impl Ord + use<> {
    (contact.key, contact.primitive_b, contact.element_b, contact.feature)
}

/// One contact per ray and opposing Object: the least distance, ties in key order.
fn keep_first_ray_hits(scene: &Scene, sealed: &Sealed, contacts: &mut [FrameContact]) {
    let mut hits: Vec<(usize, u32, usize, f64, usize)> = Vec::new();
    for (index, contact) in contacts.iter().enumerate() {
        let Some(distance) = contact.ray_distance else { continue };
        let (a, b) = sealed.bodies_of(&contact.key);
        hits.push((a, contact.key.primitive_a, scene.bodies[b].object, distance, index));
    }
    hits.sort_by(|x, y| (x.0, x.1, x.2).cmp(&(y.0, y.1, y.2)).then(x.3.total_cmp(&y.3)).then(x.4.cmp(&y.4)));
    for later in hits.windows(2) {
        let same = (later[0].0, later[0].1, later[0].2) == (later[1].0, later[1].1, later[1].2);
        if same {
            contacts[later[1].4].stance = Stance::Dropped;
        }
    }
}

/// Contacts of one sphere or ellipsoid with one surface.
fn settle_surface(group: &mut [FrameContact], triangles: &TriangleSet, sharers: &mut Vec<Sharer>) {
    drop_deeper_of_convex_faces(group, triangles);
    drop_idle_spares(group);
    let counts = |contact: &FrameContact| contact.stance != Stance::Dropped && contact.role == Role::Pushes;
    sharers.clear();
    sharers.extend(group.iter().filter(|c| counts(c)).map(|c| Sharer::new(c.normal, c.depth)));
    share(sharers);
    for (contact, sharer) in group.iter_mut().filter(|c| counts(c)).zip(&*sharers) {
        contact.weight = sharer.lambda / sharer.depth;
        if contact.weight > 0.0 {
            continue;
        }
        if contact.entry_face != NO_FACE || contact.stance == Stance::Behind {
            contact.role = Role::Silent;
        } else {
            contact.stance = Stance::Dropped;
        }
    }
}

/// With the centre behind, of two faces that meet convexly only the less deep pushes, as in a polyhedron.
fn drop_deeper_of_convex_faces(group: &mut [FrameContact], triangles: &TriangleSet) {
    for i in 0..group.len() {
        if group[i].stance != Stance::Behind {
            continue;
        }
        let view = TriangleView::new(triangles, group[i].element_b);
        let covered = (0..3).any(|k| match view.classify_edge(triangles, k) {
            EdgeClass::Convex { neighbor, .. } => group.iter().any(|other| {
                let is_neighbor = other.kind_b == PrimitiveKind::Triangle
                    && other.feature.is_face()
                    && other.element_b == neighbor
                    && other.role == Role::Pushes;
                is_neighbor
                    && (other.depth < group[i].depth
                        || (other.depth == group[i].depth && neighbor < group[i].element_b))
            }),
            EdgeClass::Free | EdgeClass::Silent { .. } => false,
        });
        if covered {
            group[i].role = Role::Silent;
        }
    }
}

/// A spare contact counts only where rounding has left nothing else that is as deep.
fn drop_idle_spares(group: &mut [FrameContact]) {
    let deepest = group
        .iter()
        .filter(|contact| contact.stance != Stance::Spare && contact.role == Role::Pushes)
        .map(|contact| contact.depth)
        .fold(0.0, f64::max);
    for contact in group.iter_mut().filter(|contact| contact.stance == Stance::Spare) {
        if deepest >= contact.depth * (1.0 - SPARE_DEPTH_SLACK) {
            contact.stance = Stance::Dropped;
        }
    }
}
