//! What the stages that are spread over workers read, and nobody writes while they run.

pub(crate) mod motion;
pub(crate) mod relative;
pub(crate) mod states;

use crate::report::Clock;
use crate::scene::{Scene, States};
use crate::sealed::{Direction, Sealed, SurfaceTable};
use crate::state::ContactMemory;
use motion::{Motion, PairMotions};
use pong_geometry::Vec3;
use pong_geometry::bounding::VolumeTests;
use pong_model::MovableGroup;
use std::cell::OnceCell;
use std::sync::Arc;

/// What a frame is computed from.
pub(crate) struct EvaluationInput<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    pub states: &'a States,
    pub memory: &'a Arc<ContactMemory>,
    pub clock: Clock,
}

/// One frame's input, beside the contact state.
#[derive(Clone)]
pub(crate) struct WorkerInput {
    /// Number of the phase: what a context holds of another one is stale.
    pub phase: u64,
    /// Two directions of every pair of movable groups of this phase.
    pub motions: Vec<PairMotions>,
    /// Values of all pairs of surfaces.
    pub tables: Arc<Vec<SurfaceTable>>,
    /// The work of this phase.
    pub blocks: Vec<Block>,
    /// The host's, if it has lent one.
    pub clock: Clock,
}

/// A piece of work: some elements of one leaf as A, against everything of one movable group as B. All contacts of
/// one key are found in one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub direction: Direction,
    /// Where the pair's motions are.
    pub slot: u32,
    /// Leaf of A's tree.
    pub leaf: u32,
    /// Batch of that leaf (index into the tree's batches).
    pub batch: u32,
    /// First element, a multiple of eight, and one past the last.
    pub first: u32,
    pub end: u32,
    /// Whether it is the first of its batch that was laid out: what is asked once per batch is counted there.
    pub leads: bool,
    /// Whether its element is the only one of its batch.
    pub is_lone: bool,
}

impl<'a> EvaluationInput<'a> {
    /// The same, as the blocks of a round see it.
    pub fn round(&self, input: &'a WorkerInput) -> Round<'a> {
        Round { scene: self.scene, sealed: self.sealed, memory: self.memory, input }
    }
}

impl WorkerInput {
    /// Takes over another frame's input without asking for memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.phase = other.phase;
        self.clock = other.clock;
        self.motions.clear();
        self.motions.extend_from_slice(&other.motions);
        // To count who holds the tables is to write beside them, where other cores read.
        if !Arc::ptr_eq(&self.tables, &other.tables) {
            self.tables = Arc::clone(&other.tables);
        }
        self.blocks.clear();
        self.blocks.extend_from_slice(&other.blocks);
    }
}

/// What the blocks of a round are worked out from.
#[derive(Clone, Copy)]
pub(crate) struct Round<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    /// Committed contact state.
    pub memory: &'a ContactMemory,
    pub input: &'a WorkerInput,
}

/// One direction of a pair of movable groups, as the testers see it.
pub(crate) struct PairContext<'a> {
    pub scene: &'a Scene,
    pub group_pair: u32,
    /// 0 if A is in the pair's first body, 1 if in the second.
    pub flipped: u32,
    pub body_a: &'a MovableGroup,
    pub body_b: &'a MovableGroup,
    /// Motion of A against B.
    pub motion: &'a Motion,
    pub memory: &'a ContactMemory,
    pub table: &'a SurfaceTable,
    pub volume_tests: &'a VolumeTests,
    /// Whether A's Object was named first: of two primitives of one kind A is its.
    pub in_order: bool,
    /// Whether B's model remembers the side of entry.
    pub remembers_entry: bool,
    /// φ of the motion since the last commit, once a contact has asked for it, rad.
    pub rotation_b: OnceCell<Vec3>,
}

impl<'a> PairContext<'a> {
    pub fn new(round: &Round<'a>, direction: Direction, motion: &'a Motion) -> Self {
        let Round { scene, sealed, memory, input } = *round;
        let Direction { group_pair, flipped } = direction;
        let pair = &sealed.group_pairs[group_pair as usize];
        let (a, b) = sealed.bodies_of(direction);
        Self {
            scene,
            group_pair,
            flipped,
            body_a: scene.body(a),
            body_b: scene.body(b),
            motion,
            memory,
            table: &input.tables[pair.tables[flipped as usize]],
            volume_tests: &sealed.volume_tests,
            in_order: (flipped == 0) == pair.first_named_first,
            remembers_entry: scene.model_of_body(b).entry_memory,
            rotation_b: OnceCell::new(),
        }
    }
}
