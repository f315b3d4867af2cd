//! Poses of the movable groups at the commits from which pairs are remembered.
//!
//! What a pair has moved since its last commit is told by the poses of its two movable groups then and now. A commit of
//! all pairs is one *moment*: one pose per movable group, however many pairs there are. Only where some pairs are
//! committed and others keep their past do the poses of several moments have to be known. The relative poses of a
//! moment are computed when they are asked for, by the function and from the numbers of the frame that was committed.

use pong_geometry::Pose;
use std::sync::Arc;

/// In place of a moment: nothing is remembered of the pair.
pub(crate) const NEVER: u8 = u8::MAX;

/// Poses for which there is room where that allows more than [`LEAST_MOMENTS`].
const ROOM: usize = 1 << 14;

/// Moments for which there is room in a world of however many movable groups.
const LEAST_MOMENTS: usize = 8;

/// Poses of the movable groups at the last commits of the pairs.
#[derive(Clone, Debug, Default)]
pub(crate) struct CommittedPoses {
    /// The movable groups that meet others. Nobody asks for the poses of the rest.
    bodies: Arc<[usize]>,
    /// Movable groups of the world.
    stride: usize,
    /// Moment after moment, a pose of every movable group of the world.
    poses: Box<[Pose]>,
    /// The moment of the last commit of every pair of Objects, or [`NEVER`].
    pub(super) moment_of: Box<[u8]>,
    /// Number of the present `moment_of`: of two states of one world, those of equal number are equal.
    version: u64,
    /// Whether every pair that is on is of moment 0 and every other of none: the next commit changes no moment.
    settled: bool,
    past: Past,
    /// Number of the frame whose poses these are, if a commit of all pairs has made them of it and nothing was changed since;
    /// 0 otherwise.
    frame: u64,
}

/// How many moments pairs may be of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Past {
    /// Nothing was committed yet.
    #[default]
    Nothing,
    /// No other than moment 0, as every commit of the whole world leaves it.
    OneMoment,
    /// Several: some pairs were committed and others not.
    Several,
}

impl CommittedPoses {
    /// Of nothing yet: of so many pairs of Objects in a world of so many movable groups, of which `bodies` meet others.
    pub fn new(bodies: Arc<[usize]>, stride: usize, object_pairs: usize) -> Self {
        let room = Self::moments(stride, object_pairs) * stride;
        Self {
            bodies,
            stride,
            poses: vec![Pose::identity(); room].into_boxed_slice(),
            moment_of: vec![NEVER; object_pairs].into_boxed_slice(),
            version: 0,
            settled: false,
            past: Past::Nothing,
            frame: 0,
        }
    }

    /// Moments for which there is room: in a small world one for every pair, so that each may be committed by itself.
    fn moments(stride: usize, object_pairs: usize) -> usize {
        object_pairs.min((ROOM / stride.max(1)).clamp(LEAST_MOMENTS, usize::from(NEVER)))
    }

    /// Memory of a world's poses, bytes.
    pub fn bytes(stride: usize, object_pairs: usize) -> usize {
        Self::moments(stride, object_pairs) * stride * size_of::<Pose>() + object_pairs
    }

    /// Most moments that can be remembered.
    pub fn capacity(&self) -> usize {
        self.poses.len().checked_div(self.stride).unwrap_or(0)
    }

    /// Pairs of Objects.
    pub fn pairs(&self) -> usize {
        self.moment_of.len()
    }

    /// The movable groups of which poses are remembered.
    pub fn bodies(&self) -> &[usize] {
        &self.bodies
    }

    /// The moment of the last commit of a pair of Objects, or [`NEVER`].
    pub fn moment_of(&self, pair: usize) -> u8 {
        self.moment_of[pair]
    }

    /// Whether anything is remembered of any pair.
    pub fn knows_any(&self) -> bool {
        self.moment_of.iter().any(|moment| *moment != NEVER)
    }

    /// Pose of a movable group at a moment.
    pub fn pose(&self, moment: u8, body: usize) -> &Pose {
        &self.poses[usize::from(moment) * self.stride + body]
    }

    /// Pose of movable group `a` seen from `b` at the last commit of their pair of Objects, if there was one.
    #[inline]
    pub fn relative(&self, pair: usize, a: usize, b: usize) -> Option<Pose> {
        let moment = self.moment_of[pair];
        (moment != NEVER).then(|| Pose::relative(self.pose(moment, a), self.pose(moment, b)))
    }

    /// How many moments pairs may be of.
    pub fn past(&self) -> Past {
        self.past
    }

    /// The number of the frame that a commit of all pairs has made these poses of; 0 if anything else has.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    #[inline]
    fn write(&mut self, moment: u8, poses: &[Pose]) {
        let first = usize::from(moment) * self.stride;
        for &body in &*self.bodies {
            self.poses[first + body] = poses[body];
        }
    }

    /// A commit of all pairs of a frame, told by its number, after `before`: those that are on are of this moment, and nothing
    /// is remembered of the others. Grows with the movable groups, but for the first commit after some pairs were treated apart.
    #[inline]
    pub fn commit(&mut self, before: &Self, (frame, poses): (u64, &[Pose]), enabled: &[bool]) {
        if !before.settled {
            for (moment, on) in self.moment_of.iter_mut().zip(enabled) {
                *moment = if *on { 0 } else { NEVER };
            }
            (self.version, self.settled) = (before.version + 1, true);
        } else if self.version != before.version {
            self.moment_of.copy_from_slice(&before.moment_of);
            (self.version, self.settled) = (before.version, true);
        }
        if self.capacity() > 0 {
            self.write(0, poses);
        }
        (self.past, self.frame) = (Past::OneMoment, frame);
    }

    /// A moment that no pair needs once the accepted ones are committed; `None` if all are taken.
    pub fn free_moment(&self, accepted: impl Fn(usize) -> bool) -> Option<u8> {
        let mut taken = [false; NEVER as usize + 1];
        for (pair, moment) in self.moment_of.iter().enumerate() {
            taken[usize::from(*moment)] |= !accepted(pair);
        }
        (0..self.capacity() as u8).find(|moment| !taken[usize::from(*moment)])
    }

    /// A commit of the accepted pairs after `before`, at a moment that is free; the others stay as they were.
    pub fn commit_some(
        &mut self,
        before: &Self,
        (poses, enabled): (&[Pose], &[bool]),
        moment: u8,
        accepted: impl Fn(usize) -> bool,
    ) {
        self.copy_from(before);
        for (pair, known) in self.moment_of.iter_mut().enumerate().filter(|(pair, _)| accepted(*pair)) {
            *known = if enabled[pair] { moment } else { NEVER };
        }
        self.write(moment, poses);
        self.past = Past::Several;
        self.is_changed();
    }

    /// Drops what is remembered of some pairs of Objects.
    pub fn clear_history(&mut self, cleared: impl Fn(usize) -> bool) {
        for (pair, moment) in self.moment_of.iter_mut().enumerate() {
            if cleared(pair) {
                *moment = NEVER;
            }
        }
        self.is_changed();
    }

    fn is_changed(&mut self) {
        self.version += 1;
        self.settled = false;
    }

    /// Becomes equal to the poses of another state of the same world. All but a commit of all pairs begins with this.
    pub fn copy_from(&mut self, other: &Self) {
        self.moment_of.copy_from_slice(&other.moment_of);
        self.poses.copy_from_slice(&other.poses);
        (self.version, self.settled, self.past) = (other.version, other.settled, other.past);
        self.frame = 0;
    }

    /// The moments that pairs are of, numbered in the order of the first pair of each: the numbers of a block, which do not
    /// depend on what moments there were before. With how many there are.
    pub fn numbered(&self) -> ([u8; NEVER as usize + 1], u8) {
        let mut number = [NEVER; NEVER as usize + 1];
        let mut count = 0;
        for moment in self.moment_of.iter().filter(|moment| **moment != NEVER) {
            let known = &mut number[usize::from(*moment)];
            if *known == NEVER {
                *known = count;
                count += 1;
            }
        }
        (number, count)
    }

    /// Puts a pose in place, as a block says it.
    pub fn put_pose(&mut self, moment: u8, body: usize, pose: Pose) {
        self.poses[usize::from(moment) * self.stride + body] = pose;
    }

    /// Puts the moments of all pairs in place, as a block says them.
    pub fn put_moments(&mut self, count: u8, moments: impl Iterator<Item = u8>) {
        self.past = match count {
            0 => Past::Nothing,
            1 => Past::OneMoment,
            _ => Past::Several,
        };
        self.moment_of.iter_mut().zip(moments).for_each(|(known, moment)| *known = moment);
        self.is_changed();
    }
}

/// Equal if the same is remembered of every pair, whatever the moments' numbers are.
impl PartialEq for CommittedPoses {
    fn eq(&self, other: &Self) -> bool {
        let (own, others) = (self.numbered(), other.numbered());
        let pairs = self.moment_of.iter().zip(&other.moment_of);
        self.pairs() == other.pairs()
            && own.1 == others.1
            && pairs.clone().all(|(a, b)| own.0[usize::from(*a)] == others.0[usize::from(*b)])
            && pairs
                .filter(|(a, _)| **a != NEVER)
                .all(|(a, b)| self.bodies.iter().all(|&body| self.pose(*a, body) == other.pose(*b, body)))
    }
}
