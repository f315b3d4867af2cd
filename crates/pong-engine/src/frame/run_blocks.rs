//! Runs blocks of work; single-element blocks run several at a time.

use crate::frame::block::BlockWork;
use crate::frame::broad_phase::blocks::joined;
use crate::frame::input::{Block, Round};
use crate::frame::lone_blocks::LoneBlocks;
use crate::frame::worker_context::WorkerContext;
use crate::report::{Timed, Untimed};
use pong_geometry::simd;
use std::ops::Range;

/// Runs blocks and writes the results to the worker's context. Single-element blocks run several at a time,
/// and contiguous blocks run as one: starting a block costs as much as testing a few elements.
pub(crate) fn run_blocks(round: &Round<'_>, blocks: Range<usize>, worker: &mut WorkerContext) {
    let mut left = &round.input.blocks[blocks];
    while let Some(first) = left.first() {
        let alike = left.iter().take_while(|block| block.is_lone == first.is_lone).count();
        let (now, later) = left.split_at(alike);
        left = later;
        if first.is_lone && alike > 1 {
            run_lone(round, now, worker);
        } else {
            joined(now).for_each(|block| run_block(round, block, worker));
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
fn run_lone(round: &Round<'_>, blocks: &[Block], worker: &mut WorkerContext) {
    let mut left = blocks;
    while let Some((&first, rest)) = left.split_first() {
        let worker = &mut *worker;
        let done = match round.input.clock.0 {
            None => simd::run(LoneBlocks { round, blocks: left, worker, laps: Untimed }),
            Some(now) => simd::run(LoneBlocks { round, blocks: left, worker, laps: Timed::start(now) }),
        };
        left = match done {
            0 => {
                run_block(round, first, worker);
                rest
            }
            _ => &left[done..],
        };
    }
}
