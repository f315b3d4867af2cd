//! Slow hosts: the wrench of a long frame, from substeps on copies of the bodies.

use crate::failure::{Failure, Outcome};
use crate::guard::{Locked, guarded, lock, with_world};
use crate::handle::pong_world;
use crate::ids::pong_interface_id;
use crate::interfaces::too_small;
use crate::law_adapters::LawFaults;
use crate::pointers::{Out, OutArray, apart, array, one};
use crate::slow_input::{pong_slow_coupling, pong_slow_input};
use crate::slow_report::{pong_slow_difference, pong_slow_report};
use crate::slow_settings::pong_slow_settings;
use crate::status::pong_status;
use crate::world::end_workers;
use crate::wrenches::{along_common_axes, pong_reference_frame, pong_wrench};
use pong_slow::{GroupInput, SlowHost};
use std::ffi::c_void;
use std::sync::{Mutex, PoisonError, TryLockError};

/// Contact for a host that calls once in a long frame: a clone of a world, in which copies of the bodies follow the
/// contacts with short substeps. Opaque. Threads as for a world.
pub struct pong_slow_host {
    inner: Mutex<Slow>,
}

/// Data guarded by the lock.
pub(crate) struct Slow {
    host: SlowHost,
    law_faults: LawFaults,
    /// Scratch for the inputs of a frame.
    inputs: Vec<GroupInput>,
}

impl Locked for pong_slow_host {
    type Inner = Slow;
    const NOUN: &'static str = "slow host";
    const MADE_BY: &'static str = "pong_create_slow_host()";

    fn inner(&self) -> &Mutex<Slow> {
        &self.inner
    }
}

/// Makes a slow host of a clone of a sealed world, with the same ids, surfaces, pairs and contact state. Later changes of
/// the world do not reach it, and the world may be destroyed before it; `user` data of laws must live as long. It is
/// the caller's: destroy it with pong_destroy_slow_host(). On failure `host` gets NULL. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_create_slow_host(
    world: *const pong_world,
    settings: *const pong_slow_settings,
    host: *mut *mut pong_slow_host,
) -> pong_status {
    if let Ok(out) = Out::new(host, "host") {
        out.set(std::ptr::null_mut());
    }
    with_world(world, |inner| {
        let out = Out::new(host, "host")?;
        let settings = one(settings, "settings")?.settings()?;
        let (world, law_faults, _) = inner.clone_engine("make a slow host")?;
        let slow = Slow { host: SlowHost::with_world(world, settings)?, law_faults, inputs: Vec::new() };
        out.set(Box::into_raw(Box::new(pong_slow_host { inner: Mutex::new(slow) })));
        Ok(())
    })
}

/// Destroys a slow host. NULL is allowed and does nothing. No other call on it may follow. PONG_STATUS_BUSY and
/// PONG_STATUS_WORKER_LEFT as for pong_destroy_world().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_destroy_slow_host(host: *mut pong_slow_host) -> pong_status {
    guarded(|| {
        // SAFETY: see "Safety of all entries" in lib.rs.
        let Some(held) = (unsafe { host.as_ref() }) else { return Ok(()) };
        if let Err(TryLockError::WouldBlock) = held.inner.try_lock() {
            let message = "the slow host is in another call; destroy it when that has returned";
            return Err(Failure::new(pong_status::Busy, message));
        }
        // SAFETY: `pong_create_slow_host` made it by `Box::into_raw`, and the caller destroys it once.
        let host = unsafe { Box::from_raw(host) };
        let slow = host.inner.into_inner().unwrap_or_else(PoisonError::into_inner);
        end_workers(&mut slow.host.into_world(), "slow host")
    })
}

/// Sets the couplings of jointed groups for the frames that are evaluated from now on: all `n` of them, in place of those of
/// the last call. Groups that are not coupled do not move by the impulses of each other. Give them anew where the joints
/// have moved. With n = 0 `couplings` may be NULL.
///
/// PONG_STATUS_BAD_VALUE: a coupling of a group with itself, given twice, or not finite; the couplings stay as they were.
/// That its groups are not jointed, or that the whole mobility has a negative eigenvalue, says pong_evaluate_slow().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_slow_couplings(
    host: *mut pong_slow_host,
    couplings: *const pong_slow_coupling,
    n: usize,
) -> pong_status {
    with_host(host, |slow| {
        let couplings = array(couplings, n, "couplings")?;
        let couplings: Vec<_> = couplings.iter().map(pong_slow_coupling::coupling).collect();
        Ok(slow.host.set_couplings(&couplings)?)
    })
}

/// Computes the wrenches to hold over a frame of `length`, s: the time until the next call. `inputs` has one entry for
/// each movable group of the world, in any order. Affects no later evaluate or commit; after a failure there is no frame
/// to commit. Allocates.
///
/// PONG_STATUS_BAD_VALUE: the length is not positive; a group is missing or given twice; dynamics are none of
/// PONG_DYNAMICS_...; a mass is not positive, an inertia not positive definite, a mobility not symmetric or with a
/// negative eigenvalue; an acceleration is not finite. PONG_STATUS_BAD_STATE as for pong_set_states().
/// PONG_STATUS_LAW_FAILED: the frame does not count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_evaluate_slow(
    host: *mut pong_slow_host,
    length: f64,
    inputs: *const pong_slow_input,
    n: usize,
) -> pong_status {
    with_host(host, |slow| slow.evaluate(length, array(inputs, n, "inputs")?))
}

/// Accepts the frame that was evaluated last: the only call that changes what is kept between frames.
/// PONG_STATUS_WRONG_PHASE if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_commit_slow(host: *mut pong_slow_host) -> pong_status {
    with_host(host, |slow| Ok(slow.host.commit()?))
}

/// pong_evaluate_slow() and pong_commit_slow(), for hosts that call once a frame. Errors as for pong_evaluate_slow();
/// nothing is committed then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_step_slow(
    host: *mut pong_slow_host,
    length: f64,
    inputs: *const pong_slow_input,
    n: usize,
) -> pong_status {
    with_host(host, |slow| {
        slow.evaluate(length, array(inputs, n, "inputs")?)?;
        Ok(slow.host.commit()?)
    })
}

/// Copies the wrenches to hold of the last frame on `n` movable groups, N and N m, about the origin of each, for the
/// orientation at the start of the frame. Take PONG_REFERENCE_FRAME_COMMON for a free body, which holds the wrench along
/// these axes, and PONG_REFERENCE_FRAME_GROUP for a jointed one. The arrays must not share memory; with n = 0 they may be
/// NULL. PONG_STATUS_WRONG_PHASE before the first frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_slow_wrenches(
    host: *const pong_slow_host,
    interfaces: *const pong_interface_id,
    frame: pong_reference_frame,
    wrenches: *mut pong_wrench,
    n: usize,
) -> pong_status {
    with_host(host, |slow| {
        apart(("interfaces", interfaces, n), ("wrenches", wrenches, n))?;
        let ids = array(interfaces, n, "interfaces")?;
        let mut out = OutArray::new(wrenches, n, "wrenches")?;
        let common = along_common_axes(frame)?;
        let wrench = |id: &pong_interface_id| match common {
            true => slow.host.wrench_common(id.id()),
            false => slow.host.wrench(id.id()),
        };
        let found = ids.iter().map(wrench).collect::<Result<Vec<_>, _>>()?;
        found.iter().enumerate().for_each(|(index, wrench)| out.set(index, wrench.into()));
        Ok(())
    })
}

/// Copies the report of the last frame; before the first all zero, and theta_measured not a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_slow_report(
    host: *const pong_slow_host,
    report: *mut pong_slow_report,
) -> pong_status {
    with_host(host, |slow| {
        Out::new(report, "report")?.set(slow.host.report().into());
        Ok(())
    })
}

/// Copies, for each movable group, what the host did otherwise than the last frame had predicted, in the order of the
/// world: the first `capacity`; `count` gets their number, which is 0 before the first frame.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit. With capacity 0 `differences` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_slow_differences(
    host: *const pong_slow_host,
    differences: *mut pong_slow_difference,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_host(host, |slow| {
        apart(("differences", differences, capacity), ("count", count, 1))?;
        let (mut out, count) =
            (OutArray::new(differences, capacity, "differences")?, Out::new(count, "count")?);
        let groups = &slow.host.report().groups;
        count.set(groups.len());
        groups.iter().take(capacity).enumerate().for_each(|(index, group)| out.set(index, group.into()));
        too_small("differences", capacity, groups.len())
    })
}

/// Size of the largest state that this slow host can save, bytes. It never changes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_slow_state_size(host: *const pong_slow_host, size: *mut usize) -> pong_status {
    with_host(host, |slow| {
        Out::new(size, "size")?.set(slow.host.state_size());
        Ok(())
    })
}

/// Saves all that a slow host keeps between frames, the contact state and the wrenches on their way included, into the
/// caller's buffer of `size` bytes; `used`, which may be NULL, gets the number of bytes written. A buffer of
/// pong_slow_state_size() bytes is always large enough. The bytes hold no pointer. Allocates.
/// PONG_STATUS_BUFFER_TOO_SMALL: the message has the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_save_slow_state(
    host: *const pong_slow_host,
    buffer: *mut c_void,
    size: usize,
    used: *mut usize,
) -> pong_status {
    with_host(host, |slow| {
        apart(("buffer", buffer.cast::<u8>(), size), ("used", used, 1))?;
        let used = Out::optional(used, "used")?;
        let state = slow.host.save_state();
        if size < state.len() {
            let needed = state.len();
            let message = format!(
                "state of a slow host: the buffer has {size} bytes, it takes {needed}; make it larger"
            );
            return Err(Failure::new(pong_status::BufferTooSmall, message));
        }
        OutArray::new(buffer.cast::<u8>(), state.len(), "buffer")?.zeroed().copy_from_slice(&state);
        used.set(state.len());
        Ok(())
    })
}

/// Restores a state that was saved by this slow host or by one of a world built by the same calls: exactly the bytes
/// that saving wrote. PONG_STATUS_BAD_STATE_BLOCK: it is damaged or of another scene; the slow host keeps the state it
/// had. Allocates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_restore_slow_state(
    host: *mut pong_slow_host,
    buffer: *const c_void,
    size: usize,
) -> pong_status {
    with_host(host, |slow| Ok(slow.host.restore_state(array(buffer.cast::<u8>(), size, "buffer")?)?))
}

/// As `guard::with_world`, with a slow host.
///
/// # Safety
/// `host` is NULL or a living slow host.
unsafe fn with_host(host: *const pong_slow_host, call: impl FnOnce(&mut Slow) -> Outcome) -> pong_status {
    guarded(|| call(&mut *lock(host, "host")?))
}

impl Slow {
    fn evaluate(&mut self, length: f64, inputs: &[pong_slow_input]) -> Outcome {
        self.host.discard();
        self.inputs.clear();
        for (index, input) in inputs.iter().enumerate() {
            self.inputs.push(input.group_input(index)?);
        }
        let evaluated = self.host.evaluate(length, &self.inputs).map(|_| ());
        // A law's fault may be the cause of an overflow and is then the one to report.
        self.law_faults.collect();
        if let Err(failure) = self.law_faults.check() {
            self.host.discard();
            return Err(failure);
        }
        Ok(evaluated?)
    }
}
