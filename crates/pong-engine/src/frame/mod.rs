//! One frame: the stages in order.

mod bounding;
mod buffers;
mod forces;
mod ledger;
mod limit;
mod listing;
mod reduce;
mod relative;
mod sharing;
mod side_of_entry;
mod state_in;
mod testers;

pub(crate) use buffers::Frame;
pub(crate) use state_in::require_states;

use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::state::ContactMemory;

/// Computes everything that the present states and the committed contact state say. Writes `frame` alone.
pub(crate) fn evaluate(scene: &Scene, sealed: &Sealed, memory: &ContactMemory, frame: &mut Frame) {
    frame.begin(sealed);
    state_in::latch(scene, frame);
    relative::relate(scene, sealed, memory, frame);
    bounding::stream_leaf_pairs(scene, sealed, frame, |context, leaves, out| {
        testers::test_leaves(context, leaves, memory, out);
    });
    sharing::settle(scene, sealed, frame);
    limit::keep_deepest(sealed, frame);
    forces::press(scene, sealed, memory, frame);
    ledger::balance(scene, sealed, memory, frame);
    reduce::sum(sealed, frame);
}
