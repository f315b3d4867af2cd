//! Runs blocks of work, those of one element several together.

use crate::frame::block::BlockWork;
use crate::frame::broad_phase::blocks::joined;
use crate::frame::input::{Block, Round};
use crate::frame::lone_blocks::LoneBlocks;
use crate::frame::worker_context::WorkerContext;
use crate::report::{Timed, Untimed};
use pong_geometry::simd;
use std::ops::Range;

/// Runs some blocks; what they find goes to the context of the thread. Those of one element by itself go several together, and
/// neighbours are run as one: to begin a block takes as long as to test a few elements.
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

/// Where no clock was lent, there is no trace of one either.
#[inline(always)]
fn run_block(round: &Round<'_>, block: Block, worker: &mut WorkerContext) {
    worker.arena.reset();
    match round.input.clock.0 {
        None => simd::run(BlockWork { round, block, worker, laps: Untimed }),
        Some(now) => simd::run(BlockWork { round, block, worker, laps: Timed::start(now) }),
    }
}

/// Blocks of one element each.
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
