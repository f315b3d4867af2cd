//! Normal and friction force of every contact, and the record that a commit would keep of it.

use super::Frame;
use super::buffers::FrameContact;
use super::relative::Motion;
use crate::friction::{FrictionInput, FrictionOutput, friction};
use crate::law::{FrictionProps, PairProps, normal_force, stored_energy};
use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::state::{ContactMemory, ContactRecord, Role};
use pong_geometry::Vec3;
use pong_geometry::pose::carry_by_smallest_rotation;
use pong_geometry::primitive::{CustomPrimitive, PrimitiveKind};
use pong_model::Body;

/// Contacts of one key share a bristle's stiffness where the cosine of their normals exceeds this (60°).
const SHARED_BRISTLE_COSINE_MIN: f64 = 0.5;

/// Presses every contact and writes the trial records in the contacts' order.
pub(super) fn press(scene: &Scene, sealed: &Sealed, memory: &ContactMemory, frame: &mut Frame) {
    let mut start = 0;
    while start < frame.contacts.len() {
        let key = frame.contacts[start].key;
        let count = frame.contacts[start..].partition_point(|contact| contact.key == key);
        let pair = &sealed.group_pairs[key.group_pair as usize];
        let bodies = [pair.first, pair.second].map(|body| scene.body(body));
        let flipped = key.flipped as usize;
        let side = KeyContext {
            body_a: bodies[flipped],
            body_b: bodies[1 - flipped],
            motion: frame.motions[key.group_pair as usize][flipped],
            memory,
        };
        for index in start..start + count {
            let mut contact = frame.contacts[index];
            let surface_a = side.body_a.primitives[key.primitive_a as usize].surface;
            let surface_b = side.body_b.primitives[contact.primitive_b as usize].surface;
            let props = sealed.tables[pair.tables[flipped]].props(surface_a, surface_b);
            let share = bristle_share(&contact, &frame.contacts[start..start + count]);
            let custom = frame.trial.custom.len();
            frame.trial.custom.resize(custom + memory.custom_stride, 0.0);
            let record = side.press(&mut contact, props, share, &mut frame.trial.custom[custom..]);
            frame.contacts[index] = contact;
            frame.trial.records.push(record);
        }
        start += count;
    }
}

/// h·w/Σw: the part of the pair's bristle that a contact carries.
fn bristle_share(contact: &FrameContact, same_key: &[FrameContact]) -> f64 {
    let whole: f64 = same_key
        .iter()
        .filter(|other| {
            other.role == Role::Pushes && other.normal.dot(&contact.normal) > SHARED_BRISTLE_COSINE_MIN
        })
        .map(|other| other.weight)
        .sum();
    let half = if contact.half { 0.5 } else { 1.0 };
    // A lone contact has the whole of its own weight, whatever rounding says of n·n.
    if whole > contact.weight { half * contact.weight / whole } else { half }
}

struct KeyContext<'a> {
    body_a: &'a Body,
    body_b: &'a Body,
    motion: Motion,
    memory: &'a ContactMemory,
}

impl KeyContext<'_> {
    fn press(
        &self,
        contact: &mut FrameContact,
        props: &PairProps,
        share: f64,
        custom: &mut [f64],
    ) -> ContactRecord {
        contact.point = contact.point_a + contact.normal * (props.share_a * contact.depth);
        let velocity = self.motion.velocity_at(&contact.point);
        let closing = -contact.normal.dot(&velocity);
        contact.rate = closing;
        contact.slip_velocity = velocity + contact.normal * closing;
        contact.continues =
            self.memory.matching(&contact.key, &contact.normal, Role::Pushes).map(|record| record as u32);
        let mut output = FrictionOutput { sticks: true, ..FrictionOutput::free() };
        if contact.role == Role::Pushes {
            let weight = contact.full_weight();
            contact.normal_force = normal_force(props, weight, contact.depth, closing);
            contact.stored = stored_energy(props, weight, contact.depth);
            if contact.normal_force > 0.0 {
                output = self.rub(contact, props, share, custom);
            }
        }
        contact.friction_force = output.force;
        contact.sticks = output.sticks;
        contact.stored += output.stored;
        self.record(contact, &output)
    }

    fn rub(
        &self,
        contact: &FrameContact,
        props: &PairProps,
        share: f64,
        custom: &mut [f64],
    ) -> FrictionOutput {
        if matches!(props.friction, FrictionProps::None) {
            return FrictionOutput::free();
        }
        let mut input = FrictionInput {
            normal_force: contact.normal_force,
            normal: contact.normal,
            slip: Vec3::zeros(),
            slip_velocity: contact.slip_velocity,
            share,
            stiffness: 0.0,
            carried: Vec3::zeros(),
            stuck: true,
            parameters: &[],
        };
        if let Some(index) = contact.continues {
            let record = &self.memory.records[index as usize];
            input.carried = carry_by_smallest_rotation(&record.bristle, &record.normal, &contact.normal);
            input.stuck = record.sticks;
            input.slip = self.slip(contact, record);
            custom.copy_from_slice(self.memory.custom_of(index as usize));
        }
        friction(&props.friction, &input, custom)
    }

    /// u: tangential part of Δo + φ × (c₀ − o₀), the displacement of A since the last commit at the place where
    /// the contact was then.
    fn slip(&self, contact: &FrameContact, record: &ContactRecord) -> Vec3 {
        let Some(since) = &self.motion.since_commit else { return Vec3::zeros() };
        let reference = reference_point(self.body_a, contact);
        let before = since.x_ba.point(&reference);
        let now = self.motion.x_ba.point(&reference);
        let displacement = now - before + since.turn.cross(&(record.point - before));
        displacement - contact.normal * contact.normal.dot(&displacement)
    }

    fn record(&self, contact: &FrameContact, output: &FrictionOutput) -> ContactRecord {
        ContactRecord {
            key: contact.key,
            feature: contact.feature.0,
            element_b: contact.element_b,
            entry_face: contact.entry_face,
            sticks: output.sticks,
            role: contact.role,
            normal: contact.normal,
            point: contact.point,
            bristle: output.bristle,
            force: contact.force(),
            stored: contact.stored,
            work: 0.0,
            dissipated: 0.0,
        }
    }
}

/// o: the point of A that carries the bristle's reference, in A's frame: the centre of a ball, the point itself,
/// a segment's end, a ray's tip.
pub(super) fn reference_point(body_a: &Body, contact: &FrameContact) -> Vec3 {
    let element = contact.element_a as usize;
    match body_a.primitives[contact.key.primitive_a as usize].kind {
        PrimitiveKind::Point => body_a.points[element].position,
        PrimitiveKind::LineSegment => body_a.segments[element].ends[contact.key.end as usize],
        PrimitiveKind::Ray => body_a.rays[element].tip(),
        PrimitiveKind::Sphere => body_a.spheres[element].center,
        PrimitiveKind::Ellipsoid => body_a.ellipsoids[element].center,
        PrimitiveKind::Custom => middle(&*body_a.customs[element]),
        PrimitiveKind::Triangle | PrimitiveKind::Polyhedron | PrimitiveKind::Plane => Vec3::zeros(),
    }
}

/// Centre of the box around a custom primitive; the frame's origin where the box is unbounded.
fn middle(primitive: &dyn CustomPrimitive) -> Vec3 {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let coordinates = axes.map(|axis| 0.5 * (primitive.support(&axis) - primitive.support(&-axis)));
    let middle = Vec3::from(coordinates);
    if middle.iter().all(|x| x.is_finite()) { middle } else { Vec3::zeros() }
}
