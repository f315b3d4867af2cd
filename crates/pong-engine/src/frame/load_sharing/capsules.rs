//! Load sharing between the end spheres of a capsule and the edges that its axis crosses, on a polyhedron or
//! triangles. Of the convex edges that the axis crosses, only the deepest pushes: it takes the load that the
//! end spheres do not (docs/theory.md, 2.8). On triangles this is the rule only where `axes.rs` has none.

use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::Vec3;

/// Assigns the weights of the contacts of a capsule's end spheres (`ends`) and of its axis with edges
/// (`middle`). Only the deepest edge contact counts, and only if its depth exceeds the minimum translations
/// of both end spheres; all other edge contacts are culled. `StandIn` contacts of `middle` count only if nothing else
/// pushes.
///
/// Let E be the square of the depth at the edge, and A and B the squares of the minimum translations of the
/// two end spheres. With stiffness k, the stored energy is ¼k(E + A·B/E), or ¼k(A + B) if no edge counts. The
/// weights follow from its derivatives: 1 − A·B/E² at the edge; those at the two ends are multiplied by B/E
/// and A/E.
pub(super) fn couple(ends: &mut [ContactCandidate], middle: &mut [ContactCandidate]) {
    let pushes =
        |contact: &ContactCandidate| contact.takes_part() && contact.status != CandidateStatus::StandIn;
    if ends.iter().any(ContactCandidate::takes_part) || middle.iter().any(pushes) {
        let stand_ins = middle.iter_mut().filter(|contact| contact.status == CandidateStatus::StandIn);
        stand_ins.for_each(|contact| contact.status = CandidateStatus::Culled);
    }
    let squares = [0, 1].map(|end| square_moved(ends, end));
    let deeper = |a: usize, b: usize| if middle[b].depth > middle[a].depth { b } else { a };
    let deepest = (0..middle.len()).filter(|&index| middle[index].takes_part()).reduce(deeper);
    for (index, contact) in middle.iter_mut().enumerate() {
        let square = contact.depth * contact.depth;
        if deepest != Some(index) || square <= squares[0].max(squares[1]) {
            contact.status = CandidateStatus::Culled;
            continue;
        }
        let parts = squares.map(|other| other / square);
        contact.weight = 1.0 - parts[0] * parts[1];
        for ball in ends.iter_mut().filter(|ball| ball.takes_part()) {
            ball.weight *= parts[1 - ball.key.end as usize];
        }
    }
}

/// Square of the minimum translation of the sphere at one end of the capsule, m².
fn square_moved(ends: &[ContactCandidate], end: u32) -> f64 {
    let of_end = ends.iter().filter(|contact| contact.key.end == end && contact.takes_part());
    let moved = of_end.map(|contact| contact.normal_b * (contact.weight * contact.depth));
    moved.sum::<Vec3>().norm_squared()
}
