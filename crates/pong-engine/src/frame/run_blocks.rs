//! Runs blocks of work; single-element blocks run several at a time.

use crate::frame::block::{self, BlockWork};
use crate::frame::broad_phase::blocks::joined;
use crate::frame::input::{Block, Round};
use crate::frame::single_element_blocks::{self, SingleElementBlocks};
use crate::frame::worker_context::WorkerContext;
use crate::report::{Timed, Untimed};
use pong_geometry::simd;
use std::ops::Range;

/// Arena bytes that a thread needs for any of its blocks, against trees of B with this many nodes and
/// batches.
pub(crate) fn arena_bytes(nodes: usize, batches: usize) -> usize {
    block::arena_bytes(nodes, batches).max(single_element_blocks::arena_bytes(nodes, batches))
}

/// Runs blocks and writes the results to the worker's context. Several single-element blocks run together.
/// Other blocks that continue each other run as one, because starting a block costs as much as testing a few
/// elements.
pub(crate) fn run_blocks(round: &Round<'_>, blocks: Range<usize>, worker: &mut WorkerContext) {
    for alike in round.input.blocks[blocks].chunk_by(|a, b| a.is_single == b.is_single) {
        if alike[0].is_single {
            run_single_elements(round, alike, worker);
        } else {
            joined(alike).for_each(|block| run_block(round, block, worker));
        }
    }
}

/// Runs one block, timed only if the host lent a clock.
#[inline(always)]
fn run_block(round: &Round<'_>, block: Block, worker: &mut WorkerContext) {
    worker.arena.reset();
    match round.input.clock.0 {
        None => simd::run(BlockWork { round, block, worker, laps: Untimed }),
        Some(now) => simd::run(BlockWork { round, block, worker, laps: Timed::start(now) }),
    }
}

/// Runs blocks of one element each, several at a time.
fn run_single_elements(round: &Round<'_>, mut blocks: &[Block], worker: &mut WorkerContext) {
    while !blocks.is_empty() {
        let worker = &mut *worker;
        worker.arena.reset();
        let done = match round.input.clock.0 {
            None => simd::run(SingleElementBlocks { round, blocks, worker, laps: Untimed }),
            Some(now) => simd::run(SingleElementBlocks { round, blocks, worker, laps: Timed::start(now) }),
        };
        blocks = &blocks[done..];
    }
}
