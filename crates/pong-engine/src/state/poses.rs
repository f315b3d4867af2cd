//! Poses of the movable groups at the last commits of the pairs.
//!
//! The motion of a pair since its last commit follows from the poses of its two movable groups then and now.
//! A commit stores one pose per movable group, for all pairs that it commits: a *commit epoch*, or epoch. A
//! commit of all pairs leaves one epoch. There are several only if some pairs were committed and others kept
//! their history.
//!
//! Relative poses of an epoch are computed on demand, by the same function and from the same numbers as in
//! the committed frame, so they have the same bits.

use crate::scene::SurfaceField;
use pong_geometry::Pose;
use std::sync::Arc;

/// Epoch of a pair without history.
pub(crate) const NEVER: u8 = u8::MAX;

/// Capacity in poses, where that allows more than [`LEAST_EPOCHS`] epochs.
const ROOM: usize = 1 << 14;

/// Minimum capacity in epochs.
const LEAST_EPOCHS: usize = 8;

/// Committed poses of the movable groups, per epoch.
#[derive(Clone, Debug, Default)]
pub(crate) struct CommittedPoses {
    /// Movable groups that are part of a pair. No other poses are stored.
    bodies: Arc<[usize]>,
    /// Number of movable groups of the world.
    stride: usize,
    /// Poses, epoch by epoch, one per movable group of the world.
    poses: Box<[Pose]>,
    /// Travels of the surfaces, laid out as the poses; none unless surfaces may move.
    travels: Box<[[f64; SurfaceField::NUMBERS]]>,
    /// True if `travels` is in use; otherwise all travels are zero.
    has_travels: bool,
    /// Epoch of the last commit of each pair of Objects, or [`NEVER`].
    pub(super) epoch_of: Box<[u8]>,
    /// Version of `epoch_of`: two states of one world with equal versions have equal epochs.
    version: u64,
    /// True if every enabled pair is in epoch 0 and every other pair has none, so that the next commit of all
    /// pairs changes no epoch.
    uniform: bool,
    past: Past,
    /// Number of the frame whose commit of all pairs stored these poses, if nothing has changed them since; 0
    /// otherwise.
    frame: u64,
}

/// Number of epochs in use, as a class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Past {
    /// No commit yet.
    #[default]
    Nothing,
    /// Only epoch 0, as every commit of the whole world leaves it.
    OneEpoch,
    /// Several epochs: some pairs were committed without the others.
    Several,
}

impl CommittedPoses {
    /// Empty state for this many pairs of Objects and `stride` movable groups; `bodies` are those in a pair.
    pub fn new(bodies: Arc<[usize]>, stride: usize, object_pairs: usize) -> Self {
        let room = Self::epochs(stride, object_pairs) * stride;
        Self {
            bodies,
            stride,
            poses: vec![Pose::identity(); room].into_boxed_slice(),
            travels: Box::default(),
            has_travels: false,
            epoch_of: vec![NEVER; object_pairs].into_boxed_slice(),
            version: 0,
            uniform: false,
            past: Past::Nothing,
            frame: 0,
        }
    }

    /// Adds room for the travels of surfaces, if they may move.
    pub fn with_travels(self, moving_surfaces: bool) -> Self {
        let room = if moving_surfaces { self.poses.len() } else { 0 };
        Self { travels: vec![[0.0; SurfaceField::NUMBERS]; room].into_boxed_slice(), ..self }
    }

    /// Returns true if there is room for the travels of surfaces.
    pub fn keeps_travels(&self) -> bool {
        !self.travels.is_empty()
    }

    /// Capacity in epochs; small worlds have one for each pair, so that each pair can be committed alone.
    fn epochs(stride: usize, object_pairs: usize) -> usize {
        object_pairs.min((ROOM / stride.max(1)).clamp(LEAST_EPOCHS, usize::from(NEVER)))
    }

    /// Size of the committed poses of a world, bytes.
    pub fn bytes(stride: usize, object_pairs: usize, moving_surfaces: bool) -> usize {
        let each = size_of::<Pose>() + if moving_surfaces { size_of::<SurfaceField>() } else { 0 };
        Self::epochs(stride, object_pairs) * stride * each + object_pairs
    }

    /// Capacity in epochs.
    pub fn capacity(&self) -> usize {
        self.poses.len().checked_div(self.stride).unwrap_or(0)
    }

    /// Number of pairs of Objects.
    pub fn pairs(&self) -> usize {
        self.epoch_of.len()
    }

    /// Movable groups whose poses are stored.
    pub fn bodies(&self) -> &[usize] {
        &self.bodies
    }

    /// Epoch of the last commit of a pair of Objects, or [`NEVER`].
    pub fn epoch_of(&self, pair: usize) -> u8 {
        self.epoch_of[pair]
    }

    /// Returns true if any pair has a history.
    pub fn knows_any(&self) -> bool {
        self.epoch_of.iter().any(|epoch| *epoch != NEVER)
    }

    /// Pose of a movable group in an epoch.
    pub fn pose(&self, epoch: u8, body: usize) -> &Pose {
        &self.poses[usize::from(epoch) * self.stride + body]
    }

    /// Pose of movable group `a` seen from `b` at the last commit of their pair of Objects, if there was one.
    #[inline]
    pub fn relative(&self, pair: usize, a: usize, b: usize) -> Option<Pose> {
        let epoch = self.epoch_of[pair];
        (epoch != NEVER).then(|| Pose::relative(self.pose(epoch, a), self.pose(epoch, b)))
    }

    /// Returns true if any travel may differ from zero.
    pub fn has_travels(&self) -> bool {
        self.has_travels
    }

    /// Travel of the surface of a movable group in an epoch.
    pub fn travel_in(&self, epoch: u8, body: usize) -> SurfaceField {
        let index = usize::from(epoch) * self.stride + body;
        if self.has_travels {
            SurfaceField::from_numbers(&self.travels[index])
        } else {
            SurfaceField::default()
        }
    }

    /// Travel of the surface of a movable group at the last commit of a pair of Objects, if there was one.
    pub fn travel(&self, pair: usize, body: usize) -> Option<SurfaceField> {
        let epoch = self.epoch_of[pair];
        (epoch != NEVER).then(|| self.travel_in(epoch, body))
    }

    /// Stores the travels of all movable groups in the epoch of a commit that has stored its poses. `travels` is
    /// empty where no surface moves or has moved.
    #[inline]
    pub fn commit_travels(&mut self, epoch: u8, travels: impl ExactSizeIterator<Item = SurfaceField>) {
        if !self.keeps_travels() || (travels.len() == 0 && !self.has_travels) {
            return;
        }
        self.use_travels();
        for (body, travel) in travels.enumerate() {
            self.put_travel(epoch, body, &travel);
        }
    }

    /// Prepares to store travels.
    pub fn use_travels(&mut self) {
        if !self.has_travels {
            self.travels.fill([0.0; SurfaceField::NUMBERS]);
            self.has_travels = true;
        }
    }

    /// Stores a travel; [`use_travels`](Self::use_travels) must have been called.
    pub fn put_travel(&mut self, epoch: u8, body: usize, travel: &SurfaceField) {
        self.travels[usize::from(epoch) * self.stride + body] = travel.numbers();
    }

    /// Sets all travels to zero.
    pub fn drop_travels(&mut self) {
        self.has_travels = false;
    }

    /// Class of the epochs in use.
    pub fn past(&self) -> Past {
        self.past
    }

    /// Number of the frame whose commit of all pairs stored these poses; 0 if anything else changed them.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    #[inline]
    fn write(&mut self, epoch: u8, poses: &[Pose]) {
        let first = usize::from(epoch) * self.stride;
        for &body in &*self.bodies {
            self.poses[first + body] = poses[body];
        }
    }

    /// Commits all pairs of a frame after the state `before`: enabled pairs get epoch 0, all others lose
    /// their history. The time grows with the number of movable groups only, except in the first commit of
    /// all pairs after another change.
    #[inline]
    pub fn commit(&mut self, before: &Self, (frame, poses): (u64, &[Pose]), enabled: &[bool]) {
        if !before.uniform {
            for (epoch, on) in self.epoch_of.iter_mut().zip(enabled) {
                *epoch = if *on { 0 } else { NEVER };
            }
            (self.version, self.uniform) = (before.version + 1, true);
        } else if self.version != before.version {
            self.epoch_of.copy_from_slice(&before.epoch_of);
            (self.version, self.uniform) = (before.version, true);
        }
        if self.capacity() > 0 {
            self.write(0, poses);
        }
        self.has_travels = before.has_travels;
        (self.past, self.frame) = (Past::OneEpoch, frame);
    }

    /// Lowest epoch that is used by no pair, or only by accepted pairs, which leave it when they are
    /// committed; `None` if there is none.
    pub fn free_epoch(&self, accepted: impl Fn(usize) -> bool) -> Option<u8> {
        let mut taken = [false; NEVER as usize + 1];
        for (pair, epoch) in self.epoch_of.iter().enumerate() {
            taken[usize::from(*epoch)] |= !accepted(pair);
        }
        (0..self.capacity() as u8).find(|epoch| !taken[usize::from(*epoch)])
    }

    /// Commits the accepted pairs after `before` into a free epoch. All other pairs keep theirs.
    pub fn commit_some(
        &mut self,
        before: &Self,
        (poses, enabled): (&[Pose], &[bool]),
        epoch: u8,
        accepted: impl Fn(usize) -> bool,
    ) {
        self.copy_from(before);
        for (pair, known) in self.epoch_of.iter_mut().enumerate().filter(|(pair, _)| accepted(*pair)) {
            *known = if enabled[pair] { epoch } else { NEVER };
        }
        self.write(epoch, poses);
        self.past = Past::Several;
        self.mark_changed();
    }

    /// Clears the history of some pairs of Objects.
    pub fn clear_history(&mut self, cleared: impl Fn(usize) -> bool) {
        for (pair, epoch) in self.epoch_of.iter_mut().enumerate() {
            if cleared(pair) {
                *epoch = NEVER;
            }
        }
        self.mark_changed();
    }

    fn mark_changed(&mut self) {
        self.version += 1;
        self.uniform = false;
    }

    /// Copies the poses of another state of the same world. Every change except a commit of all pairs starts
    /// with this.
    pub fn copy_from(&mut self, other: &Self) {
        self.epoch_of.copy_from_slice(&other.epoch_of);
        self.poses.copy_from_slice(&other.poses);
        if other.has_travels {
            self.travels.copy_from_slice(&other.travels);
        }
        self.has_travels = other.has_travels;
        (self.version, self.uniform, self.past) = (other.version, other.uniform, other.past);
        self.frame = 0;
    }

    /// Epoch numbers as written to a block, and their count. They are in the order of first use by a pair, so
    /// that they do not depend on earlier epochs.
    pub fn numbered(&self) -> ([u8; NEVER as usize + 1], u8) {
        let mut number = [NEVER; NEVER as usize + 1];
        let mut count = 0;
        for epoch in self.epoch_of.iter().filter(|epoch| **epoch != NEVER) {
            let known = &mut number[usize::from(*epoch)];
            if *known == NEVER {
                *known = count;
                count += 1;
            }
        }
        (number, count)
    }

    /// Number of epochs among the pairs that exist in the other world.
    pub fn epochs_to_carry(&self, pairs: &[Option<usize>]) -> usize {
        let mut epochs: Vec<u8> = pairs.iter().flatten().map(|&pair| self.epoch_of[pair]).collect();
        epochs.retain(|epoch| *epoch != NEVER);
        epochs.sort_unstable();
        epochs.dedup();
        epochs.len()
    }

    /// Replaces everything by the poses of another world; there must be room for its epochs. Pairs that only
    /// this world has lose their history.
    ///
    /// `bodies` and `pairs` hold the indices in the other world. A movable group without a pose there gets
    /// its pose from `elsewhere`, which no pair with a history reads. `frame` is the frame number that the
    /// poses get if they are from a commit of all pairs.
    pub fn carry(
        &mut self,
        from: &Self,
        (bodies, pairs): (&[Option<usize>], &[Option<usize>]),
        elsewhere: &[Pose],
        frame: u64,
    ) {
        let mut number = [NEVER; NEVER as usize + 1];
        let mut epochs = Vec::new();
        let mut is_known = vec![false; from.stride];
        from.bodies.iter().for_each(|&body| is_known[body] = true);
        for (epoch_of, pair) in self.epoch_of.iter_mut().zip(pairs) {
            let earlier = pair.map_or(NEVER, |pair| from.epoch_of[pair]);
            let numbered = &mut number[usize::from(earlier)];
            if earlier != NEVER && *numbered == NEVER {
                *numbered = epochs.len() as u8;
                epochs.push(earlier);
            }
            *epoch_of = *numbered;
        }
        self.has_travels = false;
        let has_travels = from.has_travels && self.keeps_travels();
        if has_travels {
            self.use_travels();
        }
        for (epoch, earlier) in epochs.iter().enumerate() {
            for &body in &*Arc::clone(&self.bodies) {
                let known = bodies[body].filter(|&body| is_known[body]);
                let pose = known.map_or(&elsewhere[body], |body| from.pose(*earlier, body));
                self.put_pose(epoch as u8, body, *pose);
                if let Some(body_there) = known.filter(|_| has_travels) {
                    self.put_travel(epoch as u8, body, &from.travel_in(*earlier, body_there));
                }
            }
        }
        self.put_count(epochs.len());
        self.frame = if from.frame > 0 && epochs.len() == 1 { frame } else { 0 };
    }

    /// Returns true if a pair of Objects has a history.
    pub fn knows(&self, pair: usize) -> bool {
        self.epoch_of[pair] != NEVER
    }

    /// Stores a pose read from a block.
    pub fn put_pose(&mut self, epoch: u8, body: usize, pose: Pose) {
        self.poses[usize::from(epoch) * self.stride + body] = pose;
    }

    /// Stores the epochs of all pairs read from a block.
    pub fn put_epochs(&mut self, count: u8, epochs: impl Iterator<Item = u8>) {
        self.epoch_of.iter_mut().zip(epochs).for_each(|(known, epoch)| *known = epoch);
        self.put_count(usize::from(count));
    }

    /// Sets the number of epochs after the epochs of pairs have changed.
    fn put_count(&mut self, epochs: usize) {
        self.past = match epochs {
            0 => Past::Nothing,
            1 => Past::OneEpoch,
            _ => Past::Several,
        };
        self.mark_changed();
    }
}

/// Equal if all pairs have the same history, independent of the epochs' numbering.
impl PartialEq for CommittedPoses {
    fn eq(&self, other: &Self) -> bool {
        let (own, others) = (self.numbered(), other.numbered());
        let pairs = self.epoch_of.iter().zip(&other.epoch_of);
        self.pairs() == other.pairs()
            && own.1 == others.1
            && pairs.clone().all(|(a, b)| own.0[usize::from(*a)] == others.0[usize::from(*b)])
            && pairs.filter(|(a, _)| **a != NEVER).all(|(a, b)| {
                self.bodies.iter().all(|&body| {
                    self.pose(*a, body) == other.pose(*b, body)
                        && self.travel_in(*a, body) == other.travel_in(*b, body)
                })
            })
    }
}
