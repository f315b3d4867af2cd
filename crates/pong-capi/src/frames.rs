//! Frames: evaluate, commit, step.

use crate::failure::{Failure, Outcome};
use crate::guard::with_world;
use crate::handle::{Inner, pong_world};
use crate::ids::pong_pair_id;
use crate::pointers::array;
use crate::status::pong_status;
use pong_engine::{EngineError, World};
use pong_record::Recorder;
use std::time::Instant;

/// Computes contacts and wrenches from the states and the committed contact state. Affects no later evaluate or
/// commit: integrators call it any number of times, at times in any order. A frame that reached a limit
/// succeeds; its report has a flag. After sealing. PONG_STATUS_UNSET_STATE: a paired group has no state.
/// PONG_STATUS_LAW_FAILED, PONG_STATUS_BAD_STATE: the frame does not count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_evaluate(world: *mut pong_world) -> pong_status {
    with_world(world, Inner::evaluate)
}

/// Accepts the states presently set: writes the contact state of the frame, which is evaluated first if the
/// last evaluation used other states. Nothing else writes contact state in a frame: call it once per accepted
/// step, never from a stage of an integrator. Errors as for pong_evaluate(); nothing is committed then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_commit(world: *mut pong_world) -> pong_status {
    with_world(world, Inner::commit_all)
}

/// As pong_commit(), for `n` pairs only: the others keep their last committed state. For executives that run
/// several rates. With n = 0 `pairs` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_commit_pairs(
    world: *mut pong_world,
    pairs: *const pong_pair_id,
    n: usize,
) -> pong_status {
    with_world(world, |inner| {
        let pairs = array(pairs, n, "pairs")?;
        let mut ids = std::mem::take(&mut inner.pairs);
        ids.clear();
        ids.extend(pairs.iter().map(|id| id.id()));
        let outcome = inner.commit(|world| world.commit_pairs(&ids));
        if outcome.is_ok() {
            inner.log_event(|log| log.committed_some(&ids));
        }
        inner.pairs = ids;
        outcome
    })
}

/// Evaluates and commits, for executives that call once a frame. Errors as for pong_evaluate().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_step(world: *mut pong_world) -> pong_status {
    with_world(world, |inner| {
        inner.evaluate()?;
        inner.commit_all()
    })
}

impl Inner {
    fn evaluate(&mut self) -> Outcome {
        let start = Instant::now();
        let evaluated = self.phase.frames_mut("evaluate")?.evaluate();
        // Collect faults even when the evaluation failed: a law's fault may be the cause of an overflow and
        // is then the one to report, and a fault that is left would be reported for the next frame.
        self.law_faults.collect();
        if let Ok(report) = &evaluated {
            self.log_event(Recorder::evaluated);
            self.counters.evaluate_ns = elapsed_ns(start);
            self.counters.evaluations += 1;
            self.counters.note_wanted(report);
        }
        self.law_faults.check()?;
        evaluated?;
        Ok(())
    }

    fn commit_all(&mut self) -> Outcome {
        self.commit(|world| world.commit())?;
        self.log_event(Recorder::committed);
        Ok(())
    }

    /// Evaluates first where the engine would, so that a law's fault is seen before the commit accepts
    /// anything.
    pub(crate) fn commit<T>(
        &mut self,
        commit: impl FnOnce(&mut World) -> Result<T, EngineError>,
    ) -> Result<T, Failure> {
        if !self.phase.frames("commit")?.is_evaluated() {
            self.evaluate()?;
        }
        self.law_faults.check()?;
        let start = Instant::now();
        let world = self.phase.frames_mut("commit")?;
        let committed = commit(world)?;
        self.counters.commit_ns = elapsed_ns(start);
        self.counters.commits += 1;
        // A commit of some pairs may lack room for all contact records.
        self.counters.note_wanted(&world.report());
        Ok(committed)
    }
}

fn elapsed_ns(start: Instant) -> u64 {
    u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX)
}
