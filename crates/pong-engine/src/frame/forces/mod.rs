//! Normal and friction force of each contact.

mod bristles;
pub(crate) mod contact;
pub(crate) mod contact_buffer;
pub(crate) mod contact_ref;
pub(crate) mod couples;
pub(crate) mod found;

use crate::frame::broad_phase::chunk::Chunk;
use crate::frame::input::motion::SinceCommit;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, PairContext, WorkerInput};
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::law::friction::{FrictionInput, shortened};
use crate::law::{FrictionProps, PairProps, normal_force, stored_energy};
use crate::seal::Sealed;
use crate::state::{ContactRecord, ContactRole};
use bristles::Bristle;
use contact::FrameContact;
use contact_buffer::ContactBuffer;
use contact_ref::ContactRef;
use couples::Couple;
use pong_geometry::Vec3;
use pong_geometry::lanes::Lanes;
use pong_geometry::pose::carry_by_smallest_rotation;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::LANES;

/// Contacts of one key share the tangential stiffness if the cosine of the angle between their normals
/// exceeds this (60°).
const SHARED_BRISTLE_COSINE_MIN: f64 = 0.5;

/// Computes the forces of the candidates of a chunk of A that were not culled, and adds the contacts to the
/// buffer. `found` is in summation order. Bristle friction stays pending in the buffer until eight contacts
/// need it.
#[inline(always)]
pub(crate) fn compute_forces(
    context: &PairContext<'_>,
    sealed: &Sealed,
    elements_a: ElementsOfA<'_>,
    found: &[ContactCandidate],
    out: &mut ContactBuffer,
) {
    for group in found.chunk_by(|a, b| a.key == b.key) {
        let counts = || group.iter().filter(|contact| contact.status != CandidateStatus::Culled);
        for one in counts() {
            if let Some(index) = out.slot(one.role, sealed) {
                // Most keys have one contact, which needs no sum over the others.
                let share = if group.len() > 1 { bristle_share(one, counts()) } else { one.half_or_whole() };
                context.compute_force(elements_a, one, share, index, out);
            }
        }
    }
    if context.table.has_resistance {
        add_couples((context, sealed), elements_a.kind, found, out);
    }
}

/// Adds the couples of the contacts of a chunk whose surfaces resist rolling or spinning. `found` is in
/// summation order.
#[inline(never)]
fn add_couples(
    (context, sealed): (&PairContext<'_>, &Sealed),
    kind_a: PrimitiveKind,
    found: &[ContactCandidate],
    out: &mut ContactBuffer,
) {
    // A ray is a plunger, which does not roll.
    if kind_a == PrimitiveKind::Ray {
        return;
    }
    for group in found.chunk_by(|a, b| a.key == b.key) {
        let counts = || group.iter().filter(|contact| contact.status != CandidateStatus::Culled);
        for one in counts().filter(|contact| contact.role == ContactRole::Active) {
            if let Some(couple) = Couple::of(context, kind_a, one, bristle_share(one, counts())) {
                couple.add(sealed, out);
            }
        }
    }
}

/// Recomputes the forces after the contact capacity has removed contacts, because the remaining contacts then
/// share the whole tangential spring.
pub(crate) fn recompute_forces(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    order: &[ContactRef],
    out: &mut ContactBuffer,
) {
    let key_of = |out: &ContactBuffer, reference: &ContactRef| out.contacts[reference.slot.index()].found.key;
    let mut rest = order;
    while let Some(first) = rest.first() {
        let key = key_of(out, first);
        let group;
        (group, rest) =
            rest.split_at(rest.iter().take_while(|reference| key_of(out, reference) == key).count());
        // The forces of solids and of resistance couples share no springs.
        if !key.is_tested() {
            continue;
        }
        let motion = motions.known(input, key.direction());
        let context = PairContext::new(&given.round(input), key.direction(), &motion);
        for reference in group {
            let index = reference.slot.index();
            let found = out.contacts[index].found;
            let share = bristle_share(
                &found,
                group.iter().map(|reference| &out.contacts[reference.slot.index()].found),
            );
            let kind = context.body_a.primitives[key.primitive_a as usize].kind;
            out.law_state_mut(index).fill(0.0);
            let elements_a = ElementsOfA { kind, centers: None };
            context.compute_force(elements_a, &found, share, index, out);
        }
    }
    out.flush();
}

/// Share h·w/Σw of the tangential spring that a contact has: w is its weight, h is one half or one
/// (`half_or_whole`), and Σw is the sum of the weights of the pushing contacts of its key whose normals are
/// less than 60° from its own.
#[inline(always)]
pub(crate) fn bristle_share<'f>(
    contact: &ContactCandidate,
    same_key: impl Iterator<Item = &'f ContactCandidate>,
) -> f64 {
    let whole: f64 = same_key.filter(|other| share_a_bristle(other, contact)).map(|other| other.weight).sum();
    // If no other contact counts, `whole` is the weight itself and the share is exactly h. If the contact
    // does not push, its share is not used.
    let half = contact.half_or_whole();
    if whole > contact.weight { half * contact.weight / whole } else { half }
}

/// Returns true if `other` is a pushing contact that shares the tangential spring with a contact of the same key.
#[inline(always)]
pub(crate) fn share_a_bristle(other: &ContactCandidate, contact: &ContactCandidate) -> bool {
    other.role == ContactRole::Active && other.normal_b.dot(&contact.normal_b) > SHARED_BRISTLE_COSINE_MIN
}

/// Elements of A of the current chunk.
#[derive(Clone, Copy)]
pub(crate) struct ElementsOfA<'c> {
    kind: PrimitiveKind,
    /// Centres of the points or spheres of the current chunk, in A's frame and in B's frame; `None` for other
    /// kinds. Borrowed from the chunk, which is in the cache, while the model is not.
    centers: Option<[&'c Lanes; 2]>,
}

impl<'c> ElementsOfA<'c> {
    /// Elements of a chunk.
    #[inline(always)]
    pub fn of(chunk: &Chunk<'c>) -> Self {
        let centers = match chunk.own_centers {
            Some(own) => Some([own, chunk.centers]),
            None => None,
        };
        Self { kind: chunk.kind, centers }
    }
}

/// A contact whose friction is to be computed.
struct Slipping<'f> {
    elements_a: ElementsOfA<'f>,
    found: &'f ContactCandidate,
    /// Contact point c in B's frame, m.
    point: Vec3,
    /// Velocity of A's surface relative to B's in the tangent plane, in B's frame, m/s.
    slip_velocity: Vec3,
    /// Normal force, N.
    pressed: f64,
    /// Committed record that the contact continues, with its index.
    continues: Option<(usize, &'f ContactRecord)>,
    /// Share of the tangential spring that the contact has.
    share: f64,
    /// Index in the buffer.
    index: usize,
}

impl PairContext<'_> {
    /// Combined properties of the two surfaces of a contact.
    #[inline]
    pub(crate) fn props(&self, found: &ContactCandidate) -> &PairProps {
        let surface_a = self.body_a.surfaces[found.key.primitive_a as usize];
        let surface_b = self.body_b.surfaces[found.primitive_b as usize];
        self.table.props(surface_a, surface_b)
    }

    /// Writes a contact with its forces, except for bristle friction, which stays pending in the buffer. If a
    /// friction law of the host has state values, those of this contact must be zero before the call: only
    /// those of a continued contact are written here, and a new contact has to start from zero.
    ///
    /// Each field is written once and not read back, because a read right after the write would stall (store
    /// forwarding).
    #[inline(always)]
    fn compute_force(
        &self,
        elements_a: ElementsOfA<'_>,
        found: &ContactCandidate,
        share: f64,
        index: usize,
        out: &mut ContactBuffer,
    ) {
        let props = self.props(found);
        let point = found.deepest_b + found.normal_b * (props.share_a * found.depth);
        let velocity = self.motion.velocity_at(&point);
        let closing = -found.normal_b.dot(&velocity);
        let mut slip_velocity = velocity + found.normal_b * closing;
        if let Some(surfaces) = self.surfaces.motions() {
            slip_velocity += surfaces.velocity(self.motion, &point, &found.normal_b);
        }
        let records = match found.remembered {
            Some(range) => self.memory.at(range),
            None => self.memory.under(&found.key),
        };
        let continues = records.matching(&found.normal_b, ContactRole::Active);
        let (mut pressed, mut stored) = (0.0, 0.0);
        if found.role == ContactRole::Active {
            let weight = found.full_weight();
            pressed = normal_force(props, weight, found.depth, closing);
            stored = stored_energy(props, weight, found.depth);
        }
        let rubs = pressed > 0.0;
        let slot = out.slot_of(index);
        // No `..`, so that a new field of the contact cannot be forgotten here.
        let FrameContact {
            found: as_found,
            point_b,
            rate,
            normal_force,
            friction_force_b,
            slip_velocity_b,
            bristle_b,
            stored: in_springs,
            sticks,
            work,
            dissipated,
        } = &mut out.contacts[index];
        *as_found = *found;
        (*point_b, *rate, *normal_force, *slip_velocity_b) = (point, closing, pressed, slip_velocity);
        (*friction_force_b, *bristle_b, *sticks) = (Vec3::zeros(), Vec3::zeros(), !rubs);
        *in_springs = stored;
        (*work, *dissipated) = (0.0, 0.0);
        let pushes = found.role == ContactRole::Active;
        let continued = continues.map(|(record, _)| record as u32);
        out.refs[index] = ContactRef::new(found.key.head(), slot, pushes, continued);
        if rubs && !matches!(props.friction, FrictionProps::None) {
            let slipping =
                Slipping { elements_a, found, point, slip_velocity, pressed, continues, share, index };
            self.add_friction(&slipping, props, out);
            out.flush_if_full();
        }
    }

    /// Adds friction to a contact whose normal force is written. Bristle friction stays pending in the
    /// buffer.
    #[inline(always)]
    fn add_friction(&self, contact: &Slipping<'_>, props: &PairProps, out: &mut ContactBuffer) {
        let record = contact.continues.map(|(_, record)| record);
        if let Some((record, _)) = contact.continues
            && out.has_law_state()
        {
            out.law_state_mut(contact.index).copy_from_slice(self.memory.law_state_of(record));
        }
        let carried = record.map_or(Vec3::zeros(), |record| {
            carry_by_smallest_rotation(&record.bristle_b, &record.normal_b, &contact.found.normal_b)
        });
        let stuck = record.is_none_or(|record| record.sticks);
        if let FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static, .. } = props.friction {
            return out.bristles.add(
                contact.index,
                &Bristle {
                    normal_b: contact.found.normal_b,
                    carried_b: carried,
                    slip_b: self.slip(contact, record),
                    slip_velocity_b: contact.slip_velocity,
                    stiffness: contact.share * stiffness,
                    damping: contact.share * damping,
                    kinetic_limit: mu_kinetic * contact.pressed,
                    static_limit: mu_static * contact.pressed,
                    stuck,
                },
            );
        }
        // Coulomb's law needs only the velocity, so the slip is not computed for it.
        let asks_slip = !matches!(props.friction, FrictionProps::Coulomb { .. });
        let input = FrictionInput {
            normal_force: contact.pressed,
            normal_b: contact.found.normal_b,
            slip_b: if asks_slip { self.slip(contact, record) } else { Vec3::zeros() },
            slip_velocity_b: contact.slip_velocity,
            share: contact.share,
            stiffness: 0.0,
            carried_b: carried,
            stuck,
            parameters: &[],
        };
        out.add_friction_alone(contact.index, &props.friction, &input);
    }

    /// Rotation vector φ of A relative to B since the last commit, rad; computed once for all contacts of
    /// this context.
    pub(crate) fn rotation(&self, since: &SinceCommit) -> &Vec3 {
        // Set and then read in place, which avoids a store-forwarding stall.
        if self.rotation_b.get().is_none() {
            _ = self.rotation_b.set(since.rotation());
        }
        self.rotation_b.get().expect("it was set")
    }

    /// Slip u of A in the current contact plane since the last commit, m: the tangential part of
    ///
    /// ```text
    /// Δo + φ × ½[(c₀ − o₀) + (c₁ − o₁)]
    /// ```
    ///
    /// where o is the reference point of A, c the contact point, φ the rotation vector of A, and the indices
    /// 0 and 1 stand for the last commit and now.
    ///
    /// The lever c − o is the mean of its two values: with c₀ − o₀ alone, a sphere that rolls and spins would
    /// slip by its spin times the distance that the contact has moved. The travel of surfaces that move along
    /// themselves is added. For a new contact there is no c₀, so
    /// the lever is c₁ − o₁. Only the part of its displacement after the first touch counts; the time of the
    /// first touch follows from the depth if A has approached uniformly.
    #[inline(always)]
    fn slip(&self, contact: &Slipping<'_>, earlier: Option<&ContactRecord>) -> Vec3 {
        let Some(since) = &self.motion.since_commit else { return Vec3::zeros() };
        let found = contact.found;
        let (before, now) = match contact.elements_a.centers {
            Some([own, centers]) => {
                // The modulo removes a bounds check.
                let lane = usize::from(found.lane) % LANES;
                (since.x_ba.point(&own.get(lane)), centers.get(lane))
            }
            None => {
                let element = self.body_a.element(contact.elements_a.kind, found.element_a);
                let reference = element.reference_point(found.key.end);
                (since.x_ba.point(&reference), self.motion.x_ba.point(&reference))
            }
        };
        let present = contact.point - now;
        let lever = earlier.map_or(present, |earlier| ((earlier.point_b - before) + present) * 0.5);
        let displacement = now - before + self.rotation(since).cross(&lever);
        let approach = -found.normal_b.dot(&displacement);
        let mut across = displacement + found.normal_b * approach;
        if let Some(surfaces) = self.surfaces.motions() {
            let earlier = earlier.map(|earlier| (earlier.point_b, earlier.normal_b));
            across += surfaces.travel((self.motion, since), earlier, &contact.point, &found.normal_b);
        }
        if earlier.is_none() { shortened(across, approach, found.depth) } else { across }
    }
}
