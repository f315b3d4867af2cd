//! Normal and friction force of every contact.

pub(crate) mod contact;
pub(crate) mod contact_buffer;
pub(crate) mod reference_point;

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::buffers::Place;
use crate::frame::forces::contact::FrameContact;
use crate::frame::input::motion::SinceCommit;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, PairContext};
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::worker_context::WorkerContext;
use crate::law::friction::{FrictionInput, FrictionOutput, friction_force, shortened};
use crate::law::{FrictionProps, PairProps, normal_force, stored_energy};
use crate::sealed::Sealed;
use crate::state::{ContactRecord, ContactRole};
use contact_buffer::ContactBuffer;
use pong_geometry::pose::carry_by_smallest_rotation;
use pong_geometry::{Vec3, Wrench};
use reference_point::reference_point;

/// Contacts of one key share a bristle's stiffness where the cosine of their normals exceeds this (60°).
const SHARED_BRISTLE_COSINE_MIN: f64 = 0.5;

/// Computes the forces of what was found for a chunk of A, in the order of sums, and hands it to the buffer.
///
/// `law_state` has room for the numbers of one contact's registered friction law.
#[inline(always)]
pub(crate) fn compute_forces(
    context: &PairContext<'_>,
    sealed: &Sealed,
    found: &[ContactCandidate],
    law_state: &mut [f64],
    out: &mut ContactBuffer,
) {
    for group in found.chunk_by(|a, b| a.key == b.key) {
        let counts = || group.iter().filter(|contact| contact.status != CandidateStatus::Culled);
        for one in counts() {
            let Some(contact) = out.slot(one.role, sealed) else { continue };
            contact.found = *one;
            context.compute_force(one, contact, bristle_share(one, counts()), law_state);
            out.law_state.extend_from_slice(law_state).expect("as much room as for contacts");
        }
    }
}

/// Computes forces again, after some of their keys were left out by a limit: what is left carries the bristle.
pub(crate) fn recompute_forces(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    let EvaluationInput { scene, sealed, memory, .. } = *given;
    let EvaluationBuffers { input, caller, order, near, poses, twists, .. } = frame;
    let motions = Motions { sealed, poses, twists, committed: &memory.poses };
    caller.scratch.reset();
    let WorkerContext { scratch, out, .. } = caller;
    let law_state = scratch.slice(out.law_state_len, 0.0).expect("sealing has sized the scratch");
    let places = &*order;
    let key_of = |out: &ContactBuffer, place: &Place| out.contacts[place.index as usize].found.key;
    let mut rest = places.as_slice();
    while let Some(first) = rest.first() {
        let key = key_of(out, first);
        let group;
        (group, rest) = rest.split_at(rest.iter().take_while(|place| key_of(out, place) == key).count());
        let motion = motions.known(near, input, key.direction());
        let context = PairContext::new(scene, sealed, input, key.direction(), &motion);
        for place in group {
            let index = place.index as usize;
            let found = out.contacts[index].found;
            let share =
                bristle_share(&found, group.iter().map(|place| &out.contacts[place.index as usize].found));
            context.compute_force(&found, &mut out.contacts[index], share, law_state);
            let first = index * out.law_state_len;
            out.law_state[first..first + out.law_state_len].copy_from_slice(law_state);
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

/// A contact whose friction is asked for.
struct Slipping<'f> {
    found: &'f ContactCandidate,
    /// c, m, in B's frame, as the next.
    point: Vec3,
    /// Of A past B in the tangent plane, m/s.
    slip_velocity: Vec3,
    /// Normal force, N.
    pressed: f64,
    /// The committed record that it continues.
    continues: Option<usize>,
}

impl PairContext<'_> {
    /// The values of the two surfaces of a contact.
    pub(crate) fn props(&self, found: &ContactCandidate) -> &PairProps {
        let surface_a = self.body_a.primitives[found.key.primitive_a as usize].surface;
        let surface_b = self.body_b.primitives[found.primitive_b as usize].surface;
        self.table.props(surface_a, surface_b)
    }

    /// Fills in all of a contact but what was found.
    ///
    /// Every number is written once, and what is needed again is not read back from there: the processor would wait for it.
    #[inline(always)]
    fn compute_force(
        &self,
        found: &ContactCandidate,
        contact: &mut FrameContact,
        share: f64,
        law_state: &mut [f64],
    ) {
        law_state.fill(0.0);
        let props = self.props(found);
        let point = found.deepest_b + found.normal_b * (props.share_a * found.depth);
        let velocity = self.motion.velocity_at(&point);
        let closing = -found.normal_b.dot(&velocity);
        let slip_velocity = velocity + found.normal_b * closing;
        let continues = self.memory.matching(&found.key, &found.normal_b, ContactRole::Active);
        let mut output = FrictionOutput { sticks: true, ..FrictionOutput::free() };
        let (mut pressed, mut stored, mut wrenches) = (0.0, 0.0, [Wrench::zero(); 2]);
        if found.role == ContactRole::Active {
            let weight = found.full_weight();
            pressed = normal_force(props, weight, found.depth, closing);
            stored = stored_energy(props, weight, found.depth);
            if pressed > 0.0 {
                let slipping = Slipping { found, point, slip_velocity, pressed, continues };
                output = self.friction_force(&slipping, props, share, law_state);
            }
            wrenches = self.wrenches(&(found.normal_b * pressed + output.force_b), &point);
        }
        // Whoever gives a contact one more field is told here.
        let FrameContact {
            found: _,
            point_b,
            rate,
            normal_force,
            friction_force_b,
            slip_velocity_b,
            bristle_b,
            wrenches: of_force,
            stored: in_springs,
            sticks,
            continues: continued,
            work,
            dissipated,
        } = contact;
        (*point_b, *rate, *normal_force) = (point, closing, pressed);
        (*friction_force_b, *slip_velocity_b) = (output.force_b, slip_velocity);
        (*bristle_b, *sticks) = (output.bristle_b, output.sticks);
        (*of_force, *in_springs) = (wrenches, stored + output.stored);
        *continued = continues.map(|record| record as u32);
        (*work, *dissipated) = (0.0, 0.0);
    }

    /// What a force on A at a point is to the movable groups; both in B's frame.
    #[inline(always)]
    fn wrenches(&self, force_b: &Vec3, point_b: &Vec3) -> [Wrench; 2] {
        let x_ba = &self.motion.x_ba;
        let force_a = x_ba.rotation.tr_mul(force_b);
        let arm_a = x_ba.rotation.tr_mul(&(point_b - x_ba.translation));
        [Wrench::of_force_at(force_a, &arm_a), Wrench::of_force_at(-force_b, point_b)]
    }

    #[inline(always)]
    fn friction_force(
        &self,
        contact: &Slipping<'_>,
        props: &PairProps,
        share: f64,
        law_state: &mut [f64],
    ) -> FrictionOutput {
        if matches!(props.friction, FrictionProps::None) {
            return FrictionOutput::free();
        }
        let mut input = FrictionInput {
            normal_force: contact.pressed,
            normal_b: contact.found.normal_b,
            slip_b: Vec3::zeros(),
            slip_velocity_b: contact.slip_velocity,
            share,
            stiffness: 0.0,
            carried_b: Vec3::zeros(),
            stuck: true,
            parameters: &[],
        };
        let record = contact.continues.map(|index| &self.memory.records[index]);
        if let Some(record) = record {
            input.carried_b =
                carry_by_smallest_rotation(&record.bristle_b, &record.normal_b, &contact.found.normal_b);
            input.stuck = record.sticks;
        }
        if let Some(index) = contact.continues {
            law_state.copy_from_slice(self.memory.law_state_of(index));
        }
        // Coulomb's law asks for the velocity alone.
        if !matches!(props.friction, FrictionProps::Coulomb { .. }) {
            input.slip_b = self.slip(contact, record);
        }
        friction_force(&props.friction, &input, law_state)
    }

    /// φ, worked out once for all contacts of the pair.
    fn rotation(&self, since: &SinceCommit) -> Vec3 {
        self.rotation_b.get().unwrap_or_else(|| {
            let rotation = since.rotation();
            self.rotation_b.set(Some(rotation));
            rotation
        })
    }

    /// u, in the present contact plane: the displacement of A since the last commit where it touches,
    ///
    /// ```text
    /// Δo + φ × ½[(c₀ − o₀) + (c₁ − o₁)]
    /// ```
    ///
    /// with the mean of the levers then and now: the lever of the start alone lets a ball that rolls and spins slip by the
    /// spin times the way that its contact has moved. A contact that is born has only the present lever, and of its
    /// displacement the part since the touch, as if the approach Δn had been even.
    #[inline(always)]
    fn slip(&self, contact: &Slipping<'_>, earlier: Option<&ContactRecord>) -> Vec3 {
        let Some(since) = &self.motion.since_commit else { return Vec3::zeros() };
        let reference = reference_point(self.body_a, &contact.found.key, contact.found.element_a);
        let before = since.x_ba.point(&reference);
        let now = self.motion.x_ba.point(&reference);
        let present = contact.point - now;
        let lever = earlier.map_or(present, |earlier| ((earlier.point_b - before) + present) * 0.5);
        let displacement = now - before + self.rotation(since).cross(&lever);
        let approach = -contact.found.normal_b.dot(&displacement);
        let across = displacement + contact.found.normal_b * approach;
        let depth = contact.found.depth;
        if earlier.is_none() { shortened(across, approach, depth) } else { across }
    }
}
