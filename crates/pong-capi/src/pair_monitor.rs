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
    /// 1: contact begins. 0: it ends.
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
    /// 1: they touch in the frame last observed. 0: they do not.
    pub touches: i32,
    /// Zero.
    pub reserved: u32,
}

/// Starts the pair monitor of a world: takes memory for every pair of movable groups, so that later calls take
/// none. Called again, it begins anew. After sealing; a clone has no monitor. A world without a monitor pays
/// nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_start_pair_monitor(world: *mut pong_world) -> pong_status {
    with_world(world, |inner| {
        inner.monitor = Some(PairMonitor::new(inner.phase.frames("start a pair monitor")?)?);
        Ok(())
    })
}

/// Observes the frame that was committed last; it stands for `step`, the time since the commit before, s. Call
/// it once after each pong_step(), pong_commit() or pong_commit_pairs(), before the next evaluation. Allocates
/// nothing.
///
/// Two movable groups touch in a frame that lists a contact of theirs; after a commit of some pairs, all
/// contacts of the frame count. Begins and ends come from the comparison with the frame observed before,
/// whatever became of the contact state in between, so those of two groups alternate. The first frame begins
/// all its contacts. A pair that is switched off ends with the next commit. A cleared history changes nothing
/// where groups go on touching. After a restored contact state the next frame is compared with the last one
/// observed.
///
/// PONG_STATUS_WRONG_PHASE: there is no monitor, or the last frame is not committed or was observed already.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_observe_pairs(world: *mut pong_world, step: f64) -> pong_status {
    with_world(world, |inner| {
        inner.law_faults.check()?;
        let monitor = inner.monitor.as_mut().ok_or_else(no_monitor)?;
        Ok(monitor.observe(inner.phase.frames("observe pairs")?, step)?)
    })
}

/// Copies begins and ends of contact from the frame observed before to the one observed last, always in the
/// same order: by pairs of Objects, then by groups. Copies the first `capacity`; `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With
/// capacity 0 `changes` may be NULL. PONG_STATUS_WRONG_PHASE without a monitor.
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

/// Begins another window: pong_get_pair_peaks() then covers the frames observed from now on. Groups that touch
/// go on touching. PONG_STATUS_WRONG_PHASE without a monitor.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_begin_peak_window(world: *mut pong_world) -> pong_status {
    with_world(world, |inner| {
        inner.monitor.as_mut().ok_or_else(no_monitor)?.begin_window();
        Ok(())
    })
}

/// Copies peak normal force and mean wrench of all movable groups that touched in the window, or whose contact
/// ended in it, in the order of pong_get_contact_changes(): the first `capacity`; `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With
/// capacity 0 `peaks` may be NULL. PONG_STATUS_WRONG_PHASE without a monitor.
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
