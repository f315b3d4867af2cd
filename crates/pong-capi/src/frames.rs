//! Frames: evaluate, commit, step.

use crate::failure::Outcome;
use crate::guard::with_world;
use crate::handle::{Inner, pong_world};
use crate::ids::pong_pair_id;
use crate::pointers::array;
use crate::status::pong_status;
use pong_record::Recorder;
use std::time::Instant;

/// Computes contacts and wrenches from the states and the committed contact state. Changes nothing that a later
/// evaluate or commit can see: integrators call it any number of times, at times in any order. A frame that hit a
/// limit succeeds; its report has a flag.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_evaluate(world: *mut pong_world) -> pong_status {
    with_world(world, Inner::evaluate)
}

/// Accepts the states presently set, evaluating them first if they are not the ones last evaluated. The only
/// writer of contact state: call it once per accepted step, never from a stage of an integrator.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_commit(world: *mut pong_world) -> pong_status {
    with_world(world, Inner::commit_all)
}

/// As pong_commit(), for some pairs only: the others keep their last committed state. For executives that run
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
            inner.tell_log(|log| log.committed_some(&ids));
        }
        inner.pairs = ids;
        outcome
    })
}

/// Evaluate and commit, for executives that call once a frame.
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
        let report = self.phase.frames_mut("evaluate")?.evaluate()?;
        self.tell_log(Recorder::evaluated);
        self.counters.evaluate_ns = elapsed_ns(start);
        self.counters.evaluations += 1;
        self.counters.peak_contacts_wanted = self.counters.peak_contacts_wanted.max(report.contacts_wanted);
        self.law_faults.collect();
        self.law_faults.check()
    }

    fn commit_all(&mut self) -> Outcome {
        self.commit(|world| world.commit())?;
        self.tell_log(Recorder::committed);
        Ok(())
    }

    /// Evaluates first where the engine would, so that a law's fault is seen before anything is accepted.
    fn commit(
        &mut self,
        commit: impl FnOnce(&mut pong_engine::World) -> Result<(), pong_engine::EngineError>,
    ) -> Outcome {
        if !self.phase.frames("evaluate")?.is_evaluated() {
            self.evaluate()?;
        }
        self.law_faults.check()?;
        let start = Instant::now();
        commit(self.phase.frames_mut("commit")?)?;
        self.counters.commit_ns = elapsed_ns(start);
        self.counters.commits += 1;
        Ok(())
    }
}

fn elapsed_ns(start: Instant) -> u64 {
    u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX)
}
