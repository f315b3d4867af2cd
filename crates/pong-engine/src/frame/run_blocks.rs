//! Runs blocks of work; single-element blocks run several at a time.

use crate::frame::block::{self, BlockWork};
use crate::frame::broad_phase::blocks::joined;
use crate::frame::input::{BlockKind, Round};
use crate::frame::single_element_blocks::{self, SingleElementBlocks};
use crate::frame::solids::run_solids;
use crate::frame::worker_context::WorkerContext;
use crate::report::{Timed, Untimed};
use pong_geometry::simd;
use std::ops::Range;

/// Arena bytes that a thread needs for any of its blocks, against trees of B with this many nodes and
/// batches.
pub(crate) fn arena_bytes(nodes: usize, batches: usize) -> usize {
    block::arena_bytes(nodes, batches).max(single_element_blocks::arena_bytes(nodes, batches))
}

/// Runs blocks and writes the results to the worker's context, timed only if the host lent a clock. Several
/// single-element blocks run together. Other blocks that continue each other run as one, because starting a
/// block costs as much as testing a few elements.
pub(crate) fn run_blocks(round: &Round<'_>, blocks: Range<usize>, worker: &mut WorkerContext) {
    let clock = round.input.clock.0;
    for alike in round.input.blocks[blocks].chunk_by(|a, b| a.kind == b.kind) {
        match alike[0].kind {
            BlockKind::Single => {
                let mut blocks = alike;
                while !blocks.is_empty() {
                    let worker = &mut *worker;
                    worker.arena.reset();
                    let done = match clock {
                        None => simd::run(SingleElementBlocks { round, blocks, worker, laps: Untimed }),
                        Some(now) => {
                            simd::run(SingleElementBlocks { round, blocks, worker, laps: Timed::start(now) })
                        }
                    };
                    blocks = &blocks[done..];
                }
            }
            BlockKind::Elements => {
                for block in joined(alike) {
                    worker.arena.reset();
                    match clock {
                        None => simd::run(BlockWork { round, block, worker, laps: Untimed }),
                        Some(now) => simd::run(BlockWork { round, block, worker, laps: Timed::start(now) }),
                    }
                }
            }
            BlockKind::Solids | BlockKind::SolidSlice => match clock {
                None => alike.iter().for_each(|block| run_solids(round, block, worker, &mut Untimed)),
                Some(now) => {
                    alike.iter().for_each(|block| run_solids(round, block, worker, &mut Timed::start(now)));
                }
            },
        }
    }
}
