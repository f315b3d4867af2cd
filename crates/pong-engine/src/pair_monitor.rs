//! Begin and end of contact, and peaks over several frames, for hosts that make a monitor beside the world.

use crate::error::EngineError;
use crate::ids::{InterfaceId, PairId, WorldStamp};
use crate::seal::{GroupPair, Sealed};
use crate::world::World;
use pong_arena::require_memory;
use pong_geometry::Wrench;
use pong_model::LARGEST;
use std::sync::Arc;

/// Observer of committed frames: it records between which movable groups contact begins and ends, and their
/// peak forces and mean wrenches over a window of several frames. A host observes after each commit; a world
/// that is not observed pays nothing.
///
/// Two movable groups touch in a frame that lists a contact between them. Begins and ends are found by
/// comparison with the frame observed before, whatever happened to the contact state in between, so begins
/// and ends of two groups alternate:
///
/// * In the first frame, all contacts that there are begin.
/// * The contacts of a pair that is switched off end with the next commit.
/// * A cleared history changes nothing where the groups go on touching.
/// * After a contact state was restored, the next frame is compared with the last one observed, whatever its
///   time was.
///
/// For a new start, make another monitor.
pub struct PairMonitor {
    stamp: WorldStamp,
    /// Sealed scene of the world that the monitor was made for.
    sealed: Arc<Sealed>,
    /// Rows of all pairs of movable groups.
    rows: Vec<Row>,
    /// Number of the frame last observed; 0 before the first.
    frame: u64,
    /// Number of the last observation, and of the current window.
    observation: u64,
    window: u64,
    /// Length of the window, s.
    window_time: f64,
    /// Pairs of movable groups that touch in the frame last observed, in order of their indices; and those of
    /// the frame before.
    touching: Vec<u32>,
    before: Vec<u32>,
    /// Pairs whose contact began or ended in the frame last observed, and pairs with a row in the current
    /// window; both in the order in which a host sees them.
    changed: Vec<u32>,
    windowed: Vec<u32>,
}

/// A pair of movable groups.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    /// Observation in which the two last touched.
    seen: u64,
    /// Window in which the values below were summed.
    window: u64,
    begins: u32,
    ends: u32,
    peak: f64,
    /// Sum of wrench times time, along common axes, N·s and N·m·s.
    impulse: Wrench,
    time: f64,
}

/// Begin or end of contact between two movable groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactChange {
    /// The pair of Objects.
    pub pair: PairId,
    /// The two movable groups; in front that of the Object named first in the pair. In an Object paired with
    /// itself, the one with the lower id is in front.
    pub interfaces: [InterfaceId; 2],
    /// True if contact begins, false if it ends.
    pub begins: bool,
}

/// Contact between two movable groups over a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairPeaks {
    /// The pair of Objects.
    pub pair: PairId,
    /// The two movable groups, in the order of [`ContactChange::interfaces`].
    pub interfaces: [InterfaceId; 2],
    /// True if they touch in the last observed frame.
    pub touches: bool,
    /// Number of begins of contact in the window.
    pub begins: u32,
    /// Number of ends of contact in the window.
    pub ends: u32,
    /// Largest sum of the normal forces of all contacts between the two in a frame of the window, N.
    pub peak_normal_force: f64,
    /// Mean wrench on the first group from the second over the window, frames without contact included, N and
    /// N·m: about the origin of the first group in each frame, along the axes of the common frame. Times
    /// [`PairMonitor::window`], it is the impulse.
    pub mean: Wrench,
    /// Time of the frames in which they touched, s.
    pub contact_time: f64,
}

impl PairMonitor {
    /// Makes a monitor of a world, which has observed nothing yet. Allocates memory for every pair of movable
    /// groups, so that no later call allocates.
    ///
    /// # Errors
    /// [`EngineError::OutOfMemory`] if the system does not have this memory.
    pub fn new(world: &World) -> Result<Self, EngineError> {
        let sealed = world.sealed();
        let pairs = sealed.group_pairs.len();
        let each = size_of::<Row>() + 4 * size_of::<u32>();
        require_memory("pair monitor", pairs.saturating_mul(each), "pair fewer Objects")?;
        let list = || Vec::with_capacity(pairs);
        Ok(Self {
            stamp: world.scene().stamp,
            sealed: Arc::clone(sealed),
            rows: vec![Row::default(); pairs],
            frame: 0,
            observation: 0,
            window: 1,
            window_time: 0.0,
            touching: list(),
            before: list(),
            changed: list(),
            windowed: list(),
        })
    }

    /// Observes the frame that was committed last. `step` is the time since the commit before, s. To be
    /// called once after each commit, before the next evaluation. After a commit of some pairs, all contacts
    /// of the frame count. Allocates nothing.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] if the last frame is not committed or was observed already,
    /// [`EngineError::BadValue`] for a step that is not above zero or beyond [`State::LARGEST`](crate::State)
    /// and for a monitor of another world. Nothing is observed then.
    pub fn observe(&mut self, world: &World, step: f64) -> Result<(), EngineError> {
        let refused = |cause: String| Err(EngineError::BadValue { what: "pair monitor".to_owned(), cause });
        if !(step > 0.0 && step <= LARGEST) {
            return refused(format!("the step is {step} s; give the time since the commit before, s"));
        }
        if !Arc::ptr_eq(&self.sealed, world.sealed()) {
            return refused("it was made for another world; make one for each".to_owned());
        }
        let frame = world.committed_frame().filter(|frame| *frame != self.frame);
        let cure = "do it once after each commit";
        self.frame = frame.ok_or(EngineError::WrongPhase { call: "observe pairs", cure })?;
        self.window_time += step;
        self.observation += 1;
        std::mem::swap(&mut self.touching, &mut self.before);
        self.touching.clear();
        self.changed.clear();
        world.for_each_touching(|pair, normal_force, wrench| self.touch(pair, normal_force, &wrench, step));
        for index in 0..self.before.len() {
            let pair = self.before[index];
            if self.rows[pair as usize].seen != self.observation {
                self.row(pair).ends += 1;
                self.changed.push(pair);
            }
        }
        let sealed = &self.sealed;
        let order = |pair: &u32| order(&sealed.group_pairs[*pair as usize]);
        self.changed.sort_unstable_by_key(order);
        self.windowed.sort_unstable_by_key(order);
        Ok(())
    }

    /// Adds a pair of movable groups that touches in the observed frame.
    fn touch(&mut self, pair: u32, normal_force: f64, wrench: &Wrench, step: f64) {
        let observation = self.observation;
        let row = self.row(pair);
        let begins = row.seen == 0 || row.seen + 1 != observation;
        row.seen = observation;
        row.begins += u32::from(begins);
        row.peak = row.peak.max(normal_force);
        row.impulse.force += wrench.force * step;
        row.impulse.moment += wrench.moment * step;
        row.time += step;
        self.touching.push(pair);
        if begins {
            self.changed.push(pair);
        }
    }

    /// Row of a pair, reset first if it is of an earlier window.
    fn row(&mut self, pair: u32) -> &mut Row {
        let row = &mut self.rows[pair as usize];
        if row.window != self.window {
            *row = Row { seen: row.seen, window: self.window, ..Row::default() };
            self.windowed.push(pair);
        }
        row
    }

    /// Begins another window: peaks, means and counts are those of the frames observed from now on. Contacts
    /// that last do not begin again.
    pub fn begin_window(&mut self) {
        self.window += 1;
        self.window_time = 0.0;
        self.windowed.clear();
    }

    /// Length of the window, s: the sum of the steps observed in it.
    pub fn window(&self) -> f64 {
        self.window_time
    }

    /// Begins and ends of contact in the frame last observed, by pair of Objects and groups.
    pub fn changes(&self) -> impl ExactSizeIterator<Item = ContactChange> {
        self.changed.iter().map(|&index| {
            let (pair, interfaces) = self.named(index);
            ContactChange { pair, interfaces, begins: self.rows[index as usize].seen == self.observation }
        })
    }

    /// Peaks of all pairs of movable groups that touched in the window, or whose contact ended in it, by pair
    /// of Objects and groups.
    pub fn peaks(&self) -> impl ExactSizeIterator<Item = PairPeaks> {
        self.windowed.iter().map(|&index| {
            let (pair, interfaces) = self.named(index);
            let row = &self.rows[index as usize];
            let Wrench { force, moment } = row.impulse;
            let mean = Wrench { force: force / self.window_time, moment: moment / self.window_time };
            PairPeaks {
                pair,
                interfaces,
                touches: row.seen == self.observation,
                begins: row.begins,
                ends: row.ends,
                peak_normal_force: row.peak,
                mean,
                contact_time: row.time,
            }
        })
    }

    /// Ids of a pair of movable groups.
    fn named(&self, index: u32) -> (PairId, [InterfaceId; 2]) {
        let pair = &self.sealed.group_pairs[index as usize];
        (PairId::new(self.stamp, pair.pair), pair.sides().map(|group| InterfaceId::new(self.stamp, group)))
    }
}

/// Order of the lists: by pair of Objects, then by groups.
fn order(pair: &GroupPair) -> (usize, usize, usize) {
    (pair.pair, pair.first, pair.second)
}
