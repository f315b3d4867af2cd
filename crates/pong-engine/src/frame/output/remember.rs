//! What a commit remembers of a frame's contacts.
//!
//! In a world with workers every lane, the caller's first, writes the records of the contacts that it finds. Where those are
//! all, a commit takes over their tables as they are and only counts the records in the order of their keys: no record is
//! moved, and most are read in the next frame by the core that has written them. Else it writes all of them anew.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::worker_pool::WorkerPool;
use crate::state::{ContactMemory, RecordPlace, Remembered};
use pong_threads::MAX_WORKERS;

/// Replaces all records by those of the frame's contacts.
pub(crate) fn remember(frame: &mut EvaluationBuffers, pool: Option<&WorkerPool>, next: &mut ContactMemory) {
    next.clear_records();
    if pool.is_some_and(|pool| adopt(frame, pool, next)) {
        return;
    }
    let out = &frame.caller.out;
    for place in frame.order.iter() {
        let index = place.index as usize;
        let (law_state, energy) = (out.law_state_of(index), frame.energy.contacts.get(index));
        let remembered = next.push_with(law_state, energy, |slot| out.contacts[index].write_record(slot));
        remembered.expect("a frame keeps no more contacts than there is room to remember");
    }
}

/// Takes over what the lanes have written, if each contact of the frame has its record; whether so.
fn adopt(frame: &mut EvaluationBuffers, pool: &WorkerPool, next: &mut ContactMemory) -> bool {
    let EvaluationBuffers { caller, order, input, .. } = frame;
    let out = &mut caller.out;
    // The contacts of all lanes stand one lane's after another's: here they end.
    let mut ends = [0; MAX_WORKERS + 1];
    let ends = &mut ends[..=pool.workers()];
    let mut whole = out.keeps_its_places();
    ends.fill(out.records.len() as u32);
    pool.with_gathered(input.phase, |worker, out| {
        whole &= out.remembers_all();
        let end = ends[worker] + out.contacts.len() as u32;
        ends[worker + 1..].fill(end);
    });
    if !whole || ends.last() != Some(&(out.contacts.len() as u32)) {
        return false;
    }
    let written = order.iter().map(|place| {
        let lane = ends.partition_point(|&end| end <= place.index);
        let first = if lane > 0 { ends[lane - 1] } else { 0 };
        (place.head, RecordPlace::in_lane(lane, place.index - first))
    });
    if !next.records.adopt(written) {
        return false;
    }
    std::mem::swap(&mut out.records, next.records.lane_mut(0));
    pool.with_gathered(input.phase, |worker, out| {
        std::mem::swap(&mut out.records, next.records.lane_mut(worker + 1));
    });
    true
}

/// What a commit would remember of the frame's contacts, in order.
pub(crate) fn fresh(frame: &EvaluationBuffers) -> impl Iterator<Item = Remembered<'_>> + Clone {
    let out = &frame.caller.out;
    frame.order.iter().map(|place| {
        let index = place.index as usize;
        Remembered {
            record: out.contacts[index].record(),
            law_state: out.law_state_of(index),
            energy: frame.energy.contacts.get(index),
        }
    })
}
