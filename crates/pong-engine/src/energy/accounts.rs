//! Energy accounts of contacts and of pairs of movable groups, on request (see [`EnergyAccount`]).
//!
//! The work of a wrench that the host holds from one commit to the next is
//!
//! ```text
//! W = F·Δx + M·φ
//! ```
//!
//! with x the origin of A seen from B, and φ the rotation vector of A relative to B between the two commits.
//!
//! F and M are those of the earlier commit, or older by the number of delay frames. They are taken as
//! constant in the axes of B. If the host holds them constant in common axes instead, while B rotates by φ_B,
//! the work differs by at most ½|F||x|φ_B².

use super::account::{EnergyAccount, WrenchCoupling};
use super::buffers::Interval;
use super::contact::{ContactEnergies, ContactEnergy};
use super::displacement::Displacement;
use super::episodes::PairEnergies;
use crate::frame::forces::contact::FrameContact;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, WorkerInput};
use crate::law::stored_energy;
use crate::seal::values_of;
use crate::state::{ContactRecord, ContactRole};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Vec3, Wrench};

/// The energy accounts of one frame.
pub(crate) struct Accounts<'a> {
    pub given: &'a EvaluationInput<'a>,
    pub input: &'a WorkerInput,
    pub coupling: WrenchCoupling,
    /// Pair energies for the next commit.
    pub pairs: &'a mut PairEnergies,
    /// Energies of each pair since the last commit.
    pub intervals: &'a mut [Interval],
    /// Contact energies for the next commit.
    pub energies: &'a mut ContactEnergies,
}

/// Force of a contact on A, split into normal force and friction, and its contact point.
#[derive(Default)]
struct ForceParts {
    point_b: Vec3,
    normal_b: Vec3,
    friction_b: Vec3,
    /// Energy stored in the normal spring and in the bristle, J.
    stored: [f64; 2],
}

/// Work of the normal force and of friction on the bodies, J, for forces that follow the motion.
#[derive(Default)]
struct WorkAlongMotion {
    normal: f64,
    friction: f64,
}

/// Work on the bodies since the last commit, J.
#[derive(Default)]
struct Work {
    /// Work of the wrench as the host applies it, J.
    as_used: f64,
    along_motion: WorkAlongMotion,
    /// Wrench of the last commit, if the host holds wrenches over the frame.
    sent: Option<Wrench>,
}

impl ForceParts {
    fn before(record: &ContactRecord, bristle: f64) -> Self {
        let normal = record.normal_b * record.normal_b.dot(&record.force_b);
        let stored = [record.stored - bristle, bristle];
        Self { point_b: record.point_b, normal_b: normal, friction_b: record.force_b - normal, stored }
    }
}

impl Accounts<'_> {
    /// Begins a frame.
    pub fn begin(&mut self) {
        self.pairs.copy_from(&self.given.memory.pair_energies);
        self.intervals.fill(Interval::default());
    }

    /// Adds a contact that pushes, which may continue a committed one. `drive` is the work of the drives of moving
    /// surfaces since the last commit, J, which the contact dissipates.
    pub fn contact(
        &mut self,
        index: usize,
        contact: &FrameContact,
        earlier: Option<usize>,
        (displacement, drive): (Option<&Displacement>, f64),
    ) {
        let pair = contact.found.key.group_pair as usize;
        let committed = earlier.and_then(|earlier| self.given.memory.energies.get(earlier));
        let mut energy = committed.map_or_else(ContactEnergy::default, |committed| *committed.energy);
        let delayed = committed.map_or(&[][..], |committed| committed.delayed);
        let before =
            earlier.map(|earlier| ForceParts::before(&self.given.memory.records[earlier], energy.bristle));
        let now = self.force_parts(contact);
        energy.bristle = now.stored[1];
        let begins = before.is_none();
        let before = before.unwrap_or_default();
        let record = earlier.map(|earlier| &self.given.memory.records[earlier]);
        let done = self.work(delayed, record, &before, Some(&now), displacement);
        let interval = &mut self.intervals[pair];
        interval.pushes = true;
        let mut one = self.entry((&before, &now), &done.along_motion, drive, begins);
        if displacement.is_none() {
            // Without an earlier pose, the host placed the bodies in contact: all stored energy is inserted.
            one.inserted = now.stored[0] + now.stored[1];
            one.damping_loss += now.stored[0];
            one.friction_loss += now.stored[1];
        }
        self.note(pair, &one, &done);
        if begins && displacement.is_some() && self.given.memory.pair_energies.pairs[pair].episode.lasts {
            // A new contact may take over energy that another contact of the pair had stored.
            let taken_over = (now.stored[0] + now.stored[1] + done.as_used - drive).max(0.0);
            one.inserted += taken_over;
            one.damping_loss += taken_over;
        }
        one.work(done.as_used);
        one.hold_error = done.as_used - done.along_motion.sum();
        energy.account.add(&one);
        self.energies.set(index, energy, delayed, done.sent);
    }

    /// Adds a committed contact that has ended.
    pub fn ended(&mut self, earlier: usize, (displacement, drive): (Option<&Displacement>, f64)) {
        let Some(committed) = self.given.memory.energies.get(earlier) else { return };
        let record = &self.given.memory.records[earlier];
        let before = ForceParts::before(record, committed.energy.bristle);
        let done = self.work(committed.delayed, Some(record), &before, None, displacement);
        let one = self.entry((&before, &ForceParts::default()), &done.along_motion, drive, true);
        self.note(record.key.group_pair as usize, &one, &done);
    }

    /// Work since the last commit: of the wrench as the host applies it, and of forces that follow the
    /// motion. Both are zero without an earlier pose.
    fn work(
        &self,
        delayed: &[Wrench],
        record: Option<&ContactRecord>,
        before: &ForceParts,
        now: Option<&ForceParts>,
        displacement: Option<&Displacement>,
    ) -> Work {
        let Some(displacement) = displacement else { return Work::default() };
        let along_motion = displacement.work_along_motion(before, now);
        match self.coupling {
            WrenchCoupling::ZeroOrderHold { .. } => {
                let sent = record.map_or_else(Wrench::zero, |record| displacement.held(record));
                // A new contact has no delayed wrench yet.
                let nothing = if self.coupling.delay() > 0 { Wrench::zero() } else { sent };
                let arrives = delayed.first().copied().unwrap_or(nothing);
                Work { as_used: displacement.origin_work(&arrives), along_motion, sent: Some(sent) }
            }
            WrenchCoupling::Stages | WrenchCoupling::SemiImplicit => {
                Work { as_used: along_motion.sum(), along_motion, sent: None }
            }
        }
    }

    /// Losses of a contact since the last commit, and their uncertainty. `at_an_end` is true if the contact
    /// began or ended since then.
    fn entry(
        &self,
        (before, now): (&ForceParts, &ForceParts),
        followed: &WorkAlongMotion,
        drive: f64,
        at_an_end: bool,
    ) -> EnergyAccount {
        let doubtful = at_an_end && self.coupling == WrenchCoupling::Stages;
        EnergyAccount {
            damping_loss: -followed.normal - (now.stored[0] - before.stored[0]),
            friction_loss: -followed.friction - (now.stored[1] - before.stored[1]) + drive,
            inserted: drive,
            resolution: if doubtful { followed.sum().abs() } else { 0.0 },
            ..EnergyAccount::default()
        }
    }

    fn note(&mut self, pair: usize, one: &EnergyAccount, done: &Work) {
        let interval = &mut self.intervals[pair];
        interval.sum.add(one);
        interval.as_used += done.as_used;
        interval.along_motion += done.along_motion.sum();
    }

    /// Force of a contact, split into normal and friction force.
    fn force_parts(&self, contact: &FrameContact) -> ForceParts {
        let found = &contact.found;
        let props = values_of(self.given.scene, self.given.sealed, &self.input.tables, found);
        let spring = stored_energy(props, found.full_weight(), found.depth);
        ForceParts {
            point_b: contact.point_b,
            normal_b: found.normal_b * contact.normal_force,
            friction_b: contact.friction_force_b,
            stored: [spring, contact.stored - spring],
        }
    }

    /// Ends a frame: sums the pairs and closes finished episodes.
    pub fn close(&mut self, motions: &Motions<'_>, enabled: &[bool]) {
        if self.coupling.delay() > 0 {
            self.exchange_wrenches(motions, enabled);
        }
        for (pair, interval) in self.intervals.iter().enumerate() {
            let mut sum = interval.sum;
            sum.work(interval.as_used);
            sum.hold_error = interval.as_used - interval.along_motion;
            let is_delayed = self.pairs.is_delayed(pair);
            let energy = &mut self.pairs.pairs[pair];
            energy.total.add(&sum);
            energy.episode.account.add(&sum);
            if interval.pushes || is_delayed {
                energy.episode.lasts = true;
            } else if energy.episode.lasts {
                energy.end_episode();
            }
        }
    }

    /// Queues the wrench of each pair, and computes the work of the wrench that arrives. A delayed wrench
    /// arrives even if the contacts of its pair have ended.
    fn exchange_wrenches(&mut self, motions: &Motions<'_>, enabled: &[bool]) {
        let mut records = self.given.memory.records.iter().peekable();
        for (pair, groups) in self.given.sealed.group_pairs.iter().enumerate() {
            let before = motions.committed.relative(groups.pair, groups.first, groups.second);
            let seen = before.unwrap_or_else(Pose::identity);
            let mut sent = Wrench::zero();
            while let Some(record) = records.next_if(|record| record.key.group_pair as usize == pair) {
                if record.role == ContactRole::Active {
                    sent += on_first(record, &seen);
                }
            }
            let arrives = self.pairs.exchange(pair, sent);
            let now = || Pose::relative(&motions.poses[groups.first], &motions.poses[groups.second]);
            let followed = before.filter(|_| enabled[groups.pair]);
            self.intervals[pair].as_used =
                followed.map_or(0.0, |before| work_on_first(&arrives, &before, &now()));
        }
    }
}

/// Wrench of a contact on the pair's first group about its origin, in the frame of the second.
fn on_first(record: &ContactRecord, first_seen_from_second: &Pose) -> Wrench {
    if record.key.flipped == 0 {
        return Wrench::of_force_at(record.force_b, &(record.point_b - first_seen_from_second.position));
    }
    let rotation = &first_seen_from_second.orientation;
    Wrench::of_force_at(-(rotation * record.force_b), &(rotation * record.point_b))
}

/// Work of a wrench on the first group over its displacement, seen from the second.
fn work_on_first(wrench: &Wrench, before: &Pose, after: &Pose) -> f64 {
    let rotation = rotation_vector(&(after.orientation * before.orientation.inverse()));
    wrench.force.dot(&(after.position - before.position)) + wrench.moment.dot(&rotation)
}

impl WorkAlongMotion {
    fn sum(&self) -> f64 {
        self.normal + self.friction
    }
}

impl Displacement {
    /// Work of forces that follow the motion, by the trapezoidal rule.
    fn work_along_motion(&self, before: &ForceParts, now: Option<&ForceParts>) -> WorkAlongMotion {
        let work = |of: fn(&ForceParts) -> &Vec3| {
            self.half_work(&before.point_b, of(before), false)
                + now.map_or(0.0, |now| self.half_work(&now.point_b, of(now), true))
        };
        WorkAlongMotion { normal: work(|parts| &parts.normal_b), friction: work(|parts| &parts.friction_b) }
    }

    /// Wrench of a committed contact on A about A's origin.
    fn held(&self, record: &ContactRecord) -> Wrench {
        Wrench::of_force_at(record.force_b, &(record.point_b - self.origin_before_b))
    }

    /// Work of a wrench on A about A's origin.
    fn origin_work(&self, wrench: &Wrench) -> f64 {
        wrench.force.dot(&(self.origin_now_b - self.origin_before_b)) + wrench.moment.dot(&self.rotation_b)
    }
}
