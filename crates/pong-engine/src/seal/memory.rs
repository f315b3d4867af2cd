//! Memory demand of sealing, checked before any of it is allocated ([`pong_arena::require_memory`]).
//!
//! It is computed from the scene in two parts: for the data per pair of movable groups, before the pairs are
//! listed, and for the frames, when the capacities of their buffers are known.

use super::frame_limits::Limits;
use super::sizes::{bytes_per_contact, least_thread_bytes};
use super::{GroupPair, Plan};
use crate::energy::LedgerEntry;
use crate::energy::account::WrenchCoupling;
use crate::energy::buffers::Interval;
use crate::energy::episodes::PairEnergy;
use crate::frame::solids::SolidScratch;
use crate::frame::{Block, MOTIONS_AT_ONCE, NearPairs, PairMotions, PendingParts, ROUND};
use crate::scene::Scene;
use crate::state::CommittedPoses;
use pong_geometry::{Pose, Twist, Wrench};
use pong_threads::MAX_WORKERS;

/// Reserve for names, reports and the allocator's own data, bytes.
const SLACK: usize = 1 << 18;

/// Stack of a worker, bytes: Rust's default size with its guard page.
const STACK: usize = (2 << 20) + (1 << 16);

/// Memory to list and check the pairs of movable groups, and to keep their data in the frames, bytes.
pub(super) fn for_pairs(scene: &Scene, pairs: usize) -> usize {
    /// A list that grows by doubling has up to twice the needed room and, while it is copied, its old half.
    const GROWING: usize = 3;
    /// Sorting allocates half a list.
    const SORTING: usize = 2;
    /// Sets of movable groups per pair, bytes.
    const JUDGING: usize = 64;
    let listed = SORTING * size_of::<GroupPair>();
    // There are at most as many plans as pairs of the models' movable groups, in both orders.
    let groups = scene.models.iter().map(|model| model.bodies.len()).sum::<usize>();
    let kinds = pairs.min(groups.saturating_mul(groups));
    let plans = kinds.saturating_mul(4 * GROWING * size_of::<Plan>() + JUDGING);
    let tables = scene.pairs.iter().map(|pair| {
        let surfaces = |object: usize| scene.models[scene.objects[object].model].surfaces.len();
        2 * surfaces(pair.a) * surfaces(pair.b) * size_of::<Option<crate::law::PairProps>>()
    });
    let names = scene.objects.iter().map(|object| 4 * object.name.len() + 256).sum::<usize>();
    let bodies = scene.bodies.len() * 256;
    let each = listed + scene.room_per_pair + per_pair(scene);
    pairs
        .saturating_mul(each)
        .saturating_add(plans)
        .saturating_add(tables.sum::<usize>() + names + bodies + SLACK)
}

/// Memory of the frames per pair of movable groups, bytes.
fn per_pair(scene: &Scene) -> usize {
    let crew = usize::from(scene.config.workers.is_some());
    let delay = scene.config.accounts.map_or(0, WrenchCoupling::delay);
    let energies = scene.config.accounts.map_or(0, |_| size_of::<PairEnergy>() + delay * size_of::<Wrench>());
    let intervals = if scene.config.accounts.is_some() { size_of::<Interval>() } else { 0 };
    let ledger = if scene.config.ledger { size_of::<LedgerEntry>() } else { 0 };
    // Contact states that are swapped, the one that a stuck worker may hold, and the frame's own.
    let states = 3 + crew;
    states * energies + intervals + ledger + 2 * size_of::<u32>()
}

/// Memory of the frames, bytes.
pub(super) fn for_frames(
    scene: &Scene,
    pairs: usize,
    limits: &Limits,
    capacity: usize,
    stride: usize,
) -> usize {
    let workers = scene.config.workers.as_ref().map_or(0, |settings| settings.workers.min(MAX_WORKERS));
    let threads = scene.config.workers.as_ref().map_or(0, |_| workers + 1);
    let contacts = capacity.saturating_mul(bytes_per_contact(scene, threads, stride));
    let solids = SolidScratch::bytes(limits.facets, limits.faces);
    let scratch = limits.arena_bytes + limits.scratch_bytes + least_thread_bytes(limits, stride) + solids;
    let blocks = 2 * ROUND * size_of::<Block>() + PendingParts::bytes(limits.tree_parts);
    let bodies = scene.bodies.len() * (size_of::<(Pose, Twist)>() + size_of::<Wrench>());
    let committed = (2 + usize::from(threads > 0))
        * CommittedPoses::bytes(scene.bodies.len(), scene.pairs.len(), scene.config.moving_surfaces);
    let motions = (1 + usize::from(threads > 0)) * pairs.min(MOTIONS_AT_ONCE) * size_of::<PairMotions>();
    let near = NearPairs::bytes(pairs, scene.bodies.len());
    let sum = pairs
        .saturating_mul(per_pair(scene))
        .saturating_add(contacts)
        .saturating_add(threads.max(1).saturating_mul(scratch))
        .saturating_add(workers * STACK + blocks + bodies + committed + motions + near + SLACK);
    // The allocator rounds every piece up.
    sum.saturating_add(sum / 16)
}
