//! Input of a frame: the states of the movable groups, and the input of the parallel stages, constant while they run.

pub(crate) mod motion;
pub(crate) mod moving_surfaces;
pub(crate) mod relative;

use crate::error::EngineError;
use crate::report::Clock;
use crate::scene::{Scene, States, SurfaceField};
use crate::seal::{Direction, Sealed, SurfaceTable};
use crate::state::{CommittedPoses, ContactMemory};
use motion::{Motion, PairMotions};
use moving_surfaces::{GroupSurface, MovingSurfaces, PairSurfaces};
use pong_geometry::bounding::VolumeTests;
use pong_geometry::{Pose, Twist, Vec3};
use pong_model::MovableGroup;
use std::cell::OnceCell;
use std::sync::Arc;

/// Input of a frame.
pub(crate) struct EvaluationInput<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    pub states: &'a States,
    pub memory: &'a Arc<ContactMemory>,
    pub clock: Clock,
}

/// Input of one parallel phase for the workers, apart from the contact state.
#[derive(Clone)]
pub(crate) struct WorkerInput {
    /// Phase number; contents of a context with another number are stale.
    pub phase: u64,
    /// Motions of all pairs of movable groups of this phase, two directions each.
    pub motions: Vec<PairMotions>,
    /// Motions of the surfaces of all movable groups along themselves; empty where none moves or has moved.
    pub surfaces: Vec<GroupSurface>,
    /// Combined properties of all pairs of surfaces.
    pub tables: Arc<Vec<SurfaceTable>>,
    /// Blocks of this phase.
    pub blocks: Vec<Block>,
    /// The host's clock, if any.
    pub clock: Clock,
}

/// Work item: some elements of one leaf of A against all of one movable group B, or some pairs of solids. All
/// contacts of one key are found in one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub direction: Direction,
    /// Index of the pair's motions.
    pub slot: u32,
    /// Leaf of A's tree, or index of the slice of a solid.
    pub leaf: u32,
    /// Batch of that leaf (index into the tree's batches).
    pub batch: u32,
    /// First element, a multiple of eight, or first pair of solids of the plan; `end` is one past the last.
    pub first: u32,
    pub end: u32,
    /// True for the first block of its batch; tests done once per batch are counted there.
    pub leads: bool,
    pub kind: BlockKind,
}

/// Content of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BlockKind {
    /// Elements of a batch.
    Elements,
    /// The only element of a batch.
    Single,
    /// Pairs of solids; the block has no leaf and no batch.
    Solids,
    /// One pair of solids, but only one slice of the solid of A: `leaf` is the index of the slice
    /// ([`slices`](crate::frame::solids::slices::count)).
    SolidSlice,
}

impl<'a> EvaluationInput<'a> {
    /// View of this input for the blocks of a round.
    pub fn round(&self, input: &'a WorkerInput) -> Round<'a> {
        Round { scene: self.scene, sealed: self.sealed, memory: self.memory, input }
    }
}

impl WorkerInput {
    /// Copies the motions of the surfaces; none of them where no surface moves or has moved.
    #[inline]
    pub fn latch_surfaces(&mut self, states: &States, committed: &CommittedPoses) {
        self.surfaces.clear();
        if states.any_surface_moves() || committed.has_travels() {
            self.surfaces.extend(states.surfaces.iter().map(GroupSurface::from));
        }
    }

    /// Travels of the surfaces of all movable groups; none where no surface moves or has moved.
    pub fn travels(&self) -> impl ExactSizeIterator<Item = SurfaceField> + '_ {
        self.surfaces.iter().map(|surface| surface.travel)
    }

    /// Copies another input without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.phase = other.phase;
        self.clock = other.clock;
        self.motions.clear();
        self.motions.extend_from_slice(&other.motions);
        self.surfaces.clear();
        self.surfaces.extend_from_slice(&other.surfaces);
        // Cloned only if changed: a clone writes the reference count, which other cores read.
        if !Arc::ptr_eq(&self.tables, &other.tables) {
            self.tables = Arc::clone(&other.tables);
        }
        self.blocks.clear();
        self.blocks.extend_from_slice(&other.blocks);
    }
}

/// Input of the blocks of one round. A frame with very many pairs runs in several rounds.
#[derive(Clone, Copy)]
pub(crate) struct Round<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    /// Committed contact state.
    pub memory: &'a ContactMemory,
    pub input: &'a WorkerInput,
}

impl<'a> Round<'a> {
    /// Motions of the surfaces of A and B along themselves; `None` where neither moves.
    #[inline]
    pub fn moving_surfaces(&self, direction: Direction) -> Option<MovingSurfaces> {
        self.surfaces_of(direction).motions()
    }

    /// Surfaces of A and B.
    #[inline]
    fn surfaces_of(&self, direction: Direction) -> PairSurfaces<'a> {
        PairSurfaces {
            all: &self.input.surfaces,
            bodies: self.sealed.bodies_of(direction).into(),
            pair: self.sealed.group_pairs[direction.group_pair as usize].pair,
            committed: &self.memory.poses,
        }
    }
}

/// Context of the testers for one direction of a pair of movable groups.
pub(crate) struct PairContext<'a> {
    pub scene: &'a Scene,
    pub group_pair: u32,
    /// 0 if A is the first movable group of the group pair, 1 if it is the second.
    pub flipped: u32,
    pub body_a: &'a MovableGroup,
    pub body_b: &'a MovableGroup,
    /// Motion of A relative to B.
    pub motion: &'a Motion,
    /// Surfaces of A and B, which may move along themselves.
    pub surfaces: PairSurfaces<'a>,
    pub memory: &'a ContactMemory,
    pub table: &'a SurfaceTable,
    pub volume_tests: &'a VolumeTests,
    /// True if A's Object was named first when the pair was made. A contact test that the host has registered
    /// for two primitives of the same kind runs only in this direction, so that no contact is reported twice.
    pub in_order: bool,
    /// True if B's model remembers the side of entry; the same for A's.
    pub remembers_entry: bool,
    pub a_remembers_entry: bool,
    /// Rotation vector φ of A relative to B since the last commit, rad; computed on first use.
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
            surfaces: round.surfaces_of(direction),
            memory,
            table: &input.tables[pair.tables[flipped as usize]],
            volume_tests: &sealed.volume_tests,
            in_order: (flipped == 0) == pair.first_named_first,
            remembers_entry: scene.model_of_body(b).entry_memory,
            a_remembers_entry: scene.model_of_body(a).entry_memory,
            rotation_b: OnceCell::new(),
        }
    }
}

/// Returns an error if a movable group of an enabled pair has no state.
#[inline]
pub(crate) fn require_states(scene: &Scene, sealed: &Sealed, states: &States) -> Result<(), EngineError> {
    // Fast path: usually all groups have a state, and there may be many more pairs than groups.
    if sealed.paired_bodies.iter().all(|&body| states.bodies[body].is_some()) {
        return Ok(());
    }
    for pair in sealed.group_pairs.iter().filter(|pair| states.enabled[pair.pair]) {
        for body in [pair.first, pair.second] {
            if states.bodies[body].is_none() {
                return Err(EngineError::UnsetState { interface: scene.body_name(body) });
            }
        }
    }
    Ok(())
}

/// Copies the states, validated when they were set, into the poses and twists of the frame.
#[inline]
pub(crate) fn latch_states(sealed: &Sealed, states: &States, poses: &mut [Pose], twists: &mut [Twist]) {
    for &body in &*sealed.paired_bodies {
        if let Some(state) = &states.bodies[body] {
            poses[body] = states.poses[body];
            // Copied field by field, because copying the struct right after writing its fields would stall
            // (store forwarding).
            let twist = &mut twists[body];
            twist.linear.copy_from_slice(&state.linear_velocity);
            twist.angular.copy_from_slice(&state.angular_velocity);
        }
    }
}
