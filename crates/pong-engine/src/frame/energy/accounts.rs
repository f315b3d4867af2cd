//! Accounts of contacts and of pairs of movable groups, on request (see [`Account`]).
//!
//! The work of a wrench that the host holds from one commit to the next, with x the origin of A seen from B, is
//!
//! ```text
//! W = F·Δx + M·φ
//! ```
//!
//! with F and M those of the commit before, or of one that is as many frames older as the wrenches come late. They are
//! taken as held along the axes of B: held along common axes while B turns by φ_B they do ½|F||x|φ_B² more at most.

use super::displacement::Displacement;
use super::interval::Interval;
use crate::energy::account::{Account, WrenchUse};
use crate::frame::forces::contact::FrameContact;
use crate::frame::input::WorkerInput;
use crate::law::stored_energy;
use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::state::{Books, ContactMemory, ContactRecord, ContactRole, PairPose};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Vec3, Wrench};

/// Numbers of one contact: its account, what its bristle stores, and the wrenches on their way.
pub(crate) fn contact_numbers(wrench_use: WrenchUse) -> usize {
    WAITING_AT + WRENCH_NUMBERS * wrench_use.late()
}

const BRISTLE_AT: usize = Account::NUMBERS;
const WAITING_AT: usize = BRISTLE_AT + 1;
const WRENCH_NUMBERS: usize = 6;

/// Keeps the accounts of one frame.
pub(crate) struct Keeper<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    pub memory: &'a ContactMemory,
    pub input: &'a WorkerInput,
    pub wrench_use: WrenchUse,
    /// What a commit will remember of pairs.
    pub books: &'a mut Books,
    /// What happened to each pair since the last commit.
    pub intervals: &'a mut [Interval],
    /// Numbers of the frame's contacts.
    pub custom: &'a mut [f64],
}

/// Force of a contact on A, by what makes it, and its place.
#[derive(Default)]
struct Pressed {
    point: Vec3,
    normal: Vec3,
    friction: Vec3,
    /// In the normal spring and in the bristle, J.
    stored: [f64; 2],
}

/// Work on the bodies of the normal force and of friction.
struct Followed {
    normal: f64,
    friction: f64,
}

impl Pressed {
    fn before(record: &ContactRecord, bristle: f64) -> Self {
        let normal = record.normal * record.normal.dot(&record.force);
        let stored = [record.stored - bristle, bristle];
        Self { point: record.point, normal, friction: record.force - normal, stored }
    }
}

impl Keeper<'_> {
    /// Begins a frame.
    pub fn begin(&mut self) {
        self.books.copy_from(&self.memory.books);
        self.intervals.fill(Interval::default());
    }

    /// Numbers of a contact that was committed.
    fn before(&self, earlier: usize) -> &[f64] {
        &self.memory.custom_of(earlier)[self.sealed.account_at..]
    }

    /// Takes in a contact that pushes, which may continue a committed one.
    pub fn contact(
        &mut self,
        index: usize,
        contact: &FrameContact,
        earlier: Option<usize>,
        displacement: Option<&Displacement>,
    ) {
        let pair = contact.found.key.group_pair as usize;
        let mut numbers = Numbers::new(earlier.map(|earlier| self.before(earlier)));
        let before = earlier.map(|earlier| Pressed::before(&self.memory.records[earlier], numbers.bristle));
        let now = self.pressed(contact);
        numbers.bristle = now.stored[1];
        let begins = before.is_none();
        let before = before.unwrap_or_default();
        let record = earlier.map(|earlier| &self.memory.records[earlier]);
        let (done, followed) = self.work(&mut numbers, record, (&before, Some(&now)), displacement);
        let interval = &mut self.intervals[pair];
        interval.pushes = true;
        let mut one = self.entry(&before, &now, &followed, begins);
        if displacement.is_none() {
            // Without an earlier pose the host has put the bodies into each other.
            one.put_in = now.stored[0] + now.stored[1];
            one.damping_loss += now.stored[0];
            one.friction_loss += now.stored[1];
        }
        self.note(pair, &one, done, &followed);
        if begins && displacement.is_some() && self.memory.books.pairs[pair].touching {
            // What another contact of the pair had stored may now be this one's.
            one.put_in = (now.stored[0] + now.stored[1] + done).max(0.0);
            one.damping_loss += one.put_in;
        }
        one.work(done);
        one.made = done - followed.sum();
        numbers.account.add(&one);
        let stride = self.sealed.custom_stride;
        let place = index * stride + self.sealed.account_at..(index + 1) * stride;
        numbers.write(&mut self.custom[place]);
    }

    /// Takes in a committed contact that is no more.
    pub fn ended(&mut self, earlier: usize, displacement: Option<&Displacement>) {
        let record = &self.memory.records[earlier];
        let mut numbers = Numbers::new(Some(self.before(earlier)));
        let before = Pressed::before(record, numbers.bristle);
        let (done, followed) = self.work(&mut numbers, Some(record), (&before, None), displacement);
        let one = self.entry(&before, &Pressed::default(), &followed, true);
        self.note(record.key.group_pair as usize, &one, done, &followed);
    }

    /// Work since the last commit, of the wrench as the host uses it and as it would have followed the motion; none without
    /// an earlier pose.
    fn work(
        &self,
        numbers: &mut Numbers,
        record: Option<&ContactRecord>,
        (before, now): (&Pressed, Option<&Pressed>),
        displacement: Option<&Displacement>,
    ) -> (f64, Followed) {
        let Some(displacement) = displacement else { return (0.0, Followed { normal: 0.0, friction: 0.0 }) };
        let followed = displacement.followed(before, now);
        let done = match self.wrench_use {
            WrenchUse::Held { late } => {
                let sent = record.map_or_else(Wrench::zero, |record| displacement.held(record));
                displacement.origin_work(&numbers.exchange(sent, late as usize))
            }
            WrenchUse::Stages | WrenchUse::SemiImplicit => followed.sum(),
        };
        (done, followed)
    }

    /// Losses of a contact since the last commit.
    fn entry(&self, before: &Pressed, now: &Pressed, followed: &Followed, at_an_end: bool) -> Account {
        let doubtful = at_an_end && self.wrench_use == WrenchUse::Stages;
        Account {
            damping_loss: -followed.normal - (now.stored[0] - before.stored[0]),
            friction_loss: -followed.friction - (now.stored[1] - before.stored[1]),
            resolution: if doubtful { followed.sum().abs() } else { 0.0 },
            ..Account::default()
        }
    }

    fn note(&mut self, pair: usize, one: &Account, done: f64, followed: &Followed) {
        let interval = &mut self.intervals[pair];
        interval.sum.add(one);
        interval.done += done;
        interval.followed += followed.sum();
    }

    fn pressed(&self, contact: &FrameContact) -> Pressed {
        let found = &contact.found;
        let (body_a, body_b) = self.sealed.bodies_of(&found.key);
        let surface_a = self.scene.body(body_a).primitives[found.key.primitive_a as usize].surface;
        let surface_b = self.scene.body(body_b).primitives[found.primitive_b as usize].surface;
        let pair = &self.sealed.group_pairs[found.key.group_pair as usize];
        let table = &self.input.tables[pair.tables[found.key.flipped as usize]];
        let spring = stored_energy(table.props(surface_a, surface_b), found.full_weight(), found.depth);
        Pressed {
            point: contact.point,
            normal: found.normal * contact.normal_force,
            friction: contact.friction_force,
            stored: [spring, contact.stored - spring],
        }
    }

    /// Ends a frame: sums of pairs, and touches that are over.
    pub fn close(&mut self, remembered: &[PairPose]) {
        if self.wrench_use.late() > 0 {
            self.send_wrenches(remembered);
        }
        for (pair, interval) in self.intervals.iter().enumerate() {
            let mut sum = interval.sum;
            sum.work(interval.done);
            sum.made = interval.done - interval.followed;
            let waits = self.books.is_waiting(pair);
            let book = &mut self.books.pairs[pair];
            book.total.add(&sum);
            book.touch.add(&sum);
            if interval.pushes || waits {
                book.touching = true;
            } else if book.touching {
                book.end_touch();
            }
        }
    }

    /// What comes late is the wrench of a whole pair: it comes even if the contacts that made it are gone.
    fn send_wrenches(&mut self, remembered: &[PairPose]) {
        let mut records = self.memory.records.iter().peekable();
        for (pair, pose) in remembered.iter().enumerate() {
            let earlier = &self.memory.poses[pair];
            let mut sent = Wrench::zero();
            while let Some(record) = records.next_if(|record| record.key.group_pair as usize == pair) {
                if record.role == ContactRole::Active {
                    sent += on_first(record, &earlier.relative[0]);
                }
            }
            let arrives = self.books.exchange(pair, sent);
            let known = earlier.known && pose.known;
            self.intervals[pair].done = if known { work_on_first(&arrives, earlier, pose) } else { 0.0 };
        }
    }
}

/// Wrench of a contact on the pair's first group about its origin, in the frame of the second.
fn on_first(record: &ContactRecord, first_seen_from_second: &Pose) -> Wrench {
    if record.key.flipped == 0 {
        return Wrench::of_force_at(record.force, &(record.point - first_seen_from_second.position));
    }
    let rotation = &first_seen_from_second.orientation;
    Wrench::of_force_at(-(rotation * record.force), &(rotation * record.point))
}

fn work_on_first(wrench: &Wrench, earlier: &PairPose, now: &PairPose) -> f64 {
    let (before, after) = (&earlier.relative[0], &now.relative[0]);
    let rotation = rotation_vector(&(after.orientation * before.orientation.inverse()));
    wrench.force.dot(&(after.position - before.position)) + wrench.moment.dot(&rotation)
}

impl Followed {
    fn sum(&self) -> f64 {
        self.normal + self.friction
    }
}

impl Displacement {
    /// Work of a force as it follows the motion: the trapezoid rule.
    fn followed(&self, before: &Pressed, now: Option<&Pressed>) -> Followed {
        let work = |of: fn(&Pressed) -> &Vec3| {
            self.half_work(&before.point, of(before), false)
                + now.map_or(0.0, |now| self.half_work(&now.point, of(now), true))
        };
        Followed { normal: work(|pressed| &pressed.normal), friction: work(|pressed| &pressed.friction) }
    }

    /// Wrench of a committed contact on A about its origin.
    fn held(&self, record: &ContactRecord) -> Wrench {
        Wrench::of_force_at(record.force, &(record.point - self.origin_before))
    }

    /// Work of a wrench on A about its origin.
    fn origin_work(&self, wrench: &Wrench) -> f64 {
        wrench.force.dot(&(self.origin_now - self.origin_before)) + wrench.moment.dot(&self.rotation)
    }
}

/// The numbers of one contact while they are worked on.
struct Numbers {
    account: Account,
    bristle: f64,
    waiting: [[f64; WRENCH_NUMBERS]; WrenchUse::LATE_MAX as usize],
}

impl Numbers {
    fn new(before: Option<&[f64]>) -> Self {
        let mut waiting = [[0.0; WRENCH_NUMBERS]; WrenchUse::LATE_MAX as usize];
        let Some(numbers) = before else {
            return Self { account: Account::default(), bristle: 0.0, waiting };
        };
        for (to, from) in waiting.iter_mut().zip(numbers[WAITING_AT..].chunks_exact(WRENCH_NUMBERS)) {
            to.copy_from_slice(from);
        }
        Self { account: Account::from_numbers(numbers), bristle: numbers[BRISTLE_AT], waiting }
    }

    /// Sends a wrench on its way and takes out the one that arrives.
    fn exchange(&mut self, sent: Wrench, late: usize) -> Wrench {
        let Some(first) = self.waiting[..late].first_mut() else { return sent };
        let arrives = *first;
        let [fx, fy, fz, mx, my, mz] = arrives;
        let (force, moment) = (sent.force, sent.moment);
        *first = [force.x, force.y, force.z, moment.x, moment.y, moment.z];
        self.waiting[..late].rotate_left(1);
        Wrench { force: Vec3::new(fx, fy, fz), moment: Vec3::new(mx, my, mz) }
    }

    fn write(&self, numbers: &mut [f64]) {
        numbers[..BRISTLE_AT].copy_from_slice(&self.account.numbers());
        numbers[BRISTLE_AT] = self.bristle;
        for (to, from) in numbers[WAITING_AT..].chunks_exact_mut(WRENCH_NUMBERS).zip(&self.waiting) {
            to.copy_from_slice(from);
        }
    }
}

/// The account of a contact among its numbers.
pub(crate) fn account_of(numbers: &[f64], stored: f64) -> Account {
    Account { stored, ..Account::from_numbers(numbers) }
}
