//! Normal and friction force of every contact.

pub(crate) mod contact;
pub(crate) mod contact_buffer;
mod eight;
mod friction;
pub(crate) mod reference_point;

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::buffers::Place;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, PairContext};
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::law::PairProps;
use crate::sealed::Sealed;
use crate::state::{ContactKey, ContactRole};
use contact_buffer::ContactBuffer;
use eight::Forces;
use pong_geometry::simd;

/// Contacts of one key share a bristle's stiffness where the cosine of their normals exceeds this (60°).
const SHARED_BRISTLE_COSINE_MIN: f64 = 0.5;

/// Hands what was found for a chunk of A to the buffer, in the order of sums. Its forces are worked out when there is enough of it.
#[inline(always)]
pub(crate) fn collect(
    context: &PairContext<'_>,
    sealed: &Sealed,
    found: &[ContactCandidate],
    out: &mut ContactBuffer,
) {
    for group in found.chunk_by(|a, b| a.key == b.key) {
        let counts = || group.iter().filter(|contact| contact.status != CandidateStatus::Culled);
        for one in counts() {
            if out.is_full() {
                // Whatever is kept then must have its forces: they are of this pair of groups alone.
                compute_forces(context, out);
            }
            let Some(contact) = out.slot(one.role, sealed) else { continue };
            contact.found = *one;
            contact.bristle_share = bristle_share(one, counts());
        }
    }
}

/// Works out the forces of all contacts that have none yet; all of them are of one direction.
pub(crate) fn compute_forces(context: &PairContext<'_>, out: &mut ContactBuffer) {
    let (first, count) = (out.settled, out.contacts.len() - out.settled);
    if count > 0 {
        simd::run(Forces { context, out, count, index: |number| first + number });
    }
    out.settled = out.contacts.len();
}

/// Computes forces again, after some of their keys were left out by a limit: what is left carries the bristle.
pub(crate) fn recompute_forces(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    let EvaluationInput { scene, sealed, memory, .. } = *given;
    let EvaluationBuffers { input, caller, order, near, poses, twists, .. } = frame;
    let motions = Motions { sealed, poses, twists, committed: &memory.poses };
    let out = &mut caller.out;
    let mut rest = order.as_slice();
    while let Some(first) = rest.first() {
        let key = key_of(out, first);
        let of_direction = rest.iter().take_while(|place| key_of(out, place).direction() == key.direction());
        let of_pair;
        (of_pair, rest) = rest.split_at(of_direction.count());
        share_bristles(out, of_pair);
        let motion = motions.known(near, input, key.direction());
        let context = PairContext::new(scene, sealed, input, key.direction(), &motion);
        let index = |number: usize| of_pair[number].index as usize;
        simd::run(Forces { context: &context, out, count: of_pair.len(), index });
    }
}

fn key_of(out: &ContactBuffer, place: &Place) -> ContactKey {
    out.contacts[place.index as usize].found.key
}

/// Shares the bristles out among contacts of one key.
fn share_bristles(out: &mut ContactBuffer, mut places: &[Place]) {
    while let Some(first) = places.first() {
        let key = key_of(out, first);
        let of_key = places.iter().take_while(|place| key_of(out, place) == key).count();
        let group;
        (group, places) = places.split_at(of_key);
        for place in group {
            let found = group.iter().map(|place| &out.contacts[place.index as usize].found);
            let share = bristle_share(&out.contacts[place.index as usize].found, found);
            out.contacts[place.index as usize].bristle_share = share;
        }
    }
}

/// h·w/Σw: the part of the pair's bristle that a contact carries.
#[inline(always)]
pub(crate) fn bristle_share<'f>(
    contact: &ContactCandidate,
    same_key: impl Iterator<Item = &'f ContactCandidate>,
) -> f64 {
    let whole: f64 = same_key
        .filter(|other| {
            other.role == ContactRole::Active
                && other.normal_b.dot(&contact.normal_b) > SHARED_BRISTLE_COSINE_MIN
        })
        .map(|other| other.weight)
        .sum();
    let half = if contact.half { 0.5 } else { 1.0 };
    // A lone contact has the whole of its own weight, whatever rounding says of n·n.
    if whole > contact.weight { half * contact.weight / whole } else { half }
}

impl PairContext<'_> {
    /// The values of the two surfaces of a contact.
    #[inline]
    pub(crate) fn props(&self, found: &ContactCandidate) -> &PairProps {
        let surface_a = self.body_a.primitives[found.key.primitive_a as usize].surface;
        let surface_b = self.body_b.primitives[found.primitive_b as usize].surface;
        self.table.props(surface_a, surface_b)
    }
}
