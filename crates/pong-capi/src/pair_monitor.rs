//! Begin and end of contact, and peaks over several frames.

use crate::failure::{Failure, Outcome};
use crate::guard::with_world;
use crate::handle::{Inner, pong_world};
use crate::ids::{pong_interface_id, pong_pair_id};
use crate::interfaces::too_small;
use crate::pointers::{Out, OutArray, apart};
use crate::status::pong_status;
use crate::wrenches::pong_wrench;
use pong_engine::{ContactChange, PairMonitor, PairPeaks};

/// Begin or end of contact between two movable groups.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_contact_change {
    /// The pair of Objects.
    pub pair: pong_pair_id,
    /// The two movable groups: first that of the Object that was named first in the pair. In an Object paired with itself, the
    /// one with the lower id.
    pub interfaces: [pong_interface_id; 2],
    /// 1 if contact begins, 0 if it ends.
    pub begins: i32,
    /// Zero.
    pub reserved: u32,
}

/// Contact between two movable groups over a window of several frames.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_pair_peaks {
    /// The pair of Objects.
    pub pair: pong_pair_id,
    /// The two movable groups, in the order of pong_contact_change.
    pub interfaces: [pong_interface_id; 2],
    /// Largest sum of the normal forces of all their contacts in a frame of the window, N.
    pub peak_normal_force: f64,
    /// Mean over the window, frames without contact included, of the wrench on the first group from the second: about the
    /// origin of the first group, wherever it was, along the axes of the common frame. Times `window`, it is the impulse.
    pub mean: pong_wrench,
    /// Time of the frames in which they touched, s.
    pub contact_time: f64,
    /// Length of the window, s: the sum of the steps observed in it.
    pub window: f64,
    /// Number of begins of contact in the window.
    pub begins: u32,
    /// Number of its ends.
    pub ends: u32,
    /// 1 if they touch in the frame last observed.
    pub touches: i32,
    /// Zero.
    pub reserved: u32,
}

/// Has the world kept under observation by pong_observe_pairs(), from nothing on: takes memory for every pair of movable groups,
/// so that nothing takes any later. Called again, it begins anew. After the seal; a clone is not observed. A world that is not
/// observed pays nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_start_pair_monitor(world: *mut pong_world) -> pong_status {
    with_world(world, |inner| {
        inner.monitor = Some(PairMonitor::new(inner.phase.frames("start a pair monitor")?)?);
        Ok(())
    })
}

/// Observes the frame that was committed last, which stands for `step`, the time since the commit before, s: call it once after
/// each pong_step(), pong_commit() or pong_commit_pairs(), before the next evaluation. After a commit of some pairs all contacts
/// of the frame count. Two movable groups touch in a frame that lists a contact of theirs; begins and ends are told by comparison
/// with the frame observed before, whatever became of the contact state in between, so those of two groups alternate: the first
/// frame begins all contacts that there are, a pair that is switched off ends with the next commit, a cleared history changes
/// nothing where groups go on touching, and after a restored contact state the next frame is compared with the last one
/// observed. PONG_STATUS_WRONG_PHASE: there is no monitor, or the last frame is not committed or was observed already.
/// Allocates nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_observe_pairs(world: *mut pong_world, step: f64) -> pong_status {
    with_world(world, |inner| {
        inner.law_faults.check()?;
        let monitor = inner.monitor.as_mut().ok_or_else(no_monitor)?;
        Ok(monitor.observe(inner.phase.frames("observe pairs")?, step)?)
    })
}

/// Begins and ends of contact from the frame observed before to the one observed last, in the order of the pairs of Objects and
/// then of the groups, always the same: the first `capacity` are copied, `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With capacity 0 `changes` may
/// be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_contact_changes(
    world: *const pong_world,
    changes: *mut pong_contact_change,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("changes", changes, capacity), ("count", count, 1))?;
        let (mut out, count) = (OutArray::new(changes, capacity, "changes")?, Out::new(count, "count")?);
        let listed = inner.monitor()?.changes();
        let total = listed.len();
        listed.take(capacity).enumerate().for_each(|(index, change)| out.set(index, (&change).into()));
        count.set(total);
        too_small("changes", capacity, total)
    })
}

/// Begins another window: pong_get_pair_peaks() then tells of the frames observed from now on. What touches is kept.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_begin_peak_window(world: *mut pong_world) -> pong_status {
    with_world(world, |inner| {
        inner.monitor.as_mut().ok_or_else(no_monitor)?.begin_window();
        Ok(())
    })
}

/// Peak normal force and mean wrench of all movable groups that touched in the window, or whose contact ended in it, in the order
/// of pong_get_contact_changes(): the first `capacity` are copied, `count` gets their number. PONG_STATUS_BUFFER_TOO_SMALL if
/// not all fit; `group_pairs` of the seal report is always enough. With capacity 0 `peaks` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_pair_peaks(
    world: *const pong_world,
    peaks: *mut pong_pair_peaks,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("peaks", peaks, capacity), ("count", count, 1))?;
        let (mut out, count) = (OutArray::new(peaks, capacity, "peaks")?, Out::new(count, "count")?);
        let monitor = inner.monitor()?;
        let listed = monitor.peaks();
        let total = listed.len();
        let rows = listed.map(|peaks| pong_pair_peaks { window: monitor.window(), ..(&peaks).into() });
        rows.take(capacity).enumerate().for_each(|(index, row)| out.set(index, row));
        count.set(total);
        too_small("peaks", capacity, total)
    })
}

fn no_monitor() -> Failure {
    let message = "pair monitor: there is none; make one with pong_start_pair_monitor()";
    Failure::new(pong_status::WrongPhase, message)
}

impl Inner {
    fn monitor(&self) -> Outcome<&PairMonitor> {
        self.monitor.as_ref().ok_or_else(no_monitor)
    }
}

impl From<&ContactChange> for pong_contact_change {
    fn from(change: &ContactChange) -> Self {
        Self {
            pair: change.pair.into(),
            interfaces: change.interfaces.map(Into::into),
            begins: change.begins.into(),
            reserved: 0,
        }
    }
}

impl From<&PairPeaks> for pong_pair_peaks {
    fn from(peaks: &PairPeaks) -> Self {
        Self {
            pair: peaks.pair.into(),
            interfaces: peaks.interfaces.map(Into::into),
            peak_normal_force: peaks.peak_normal_force,
            mean: (&peaks.mean).into(),
            contact_time: peaks.contact_time,
            window: 0.0,
            begins: peaks.begins,
            ends: peaks.ends,
            touches: peaks.touches.into(),
            reserved: 0,
        }
    }
}
