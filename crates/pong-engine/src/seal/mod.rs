//! Sealing: turns a scene into the data that frames read and that no longer change.
//!
//! | data for frames | file | computed by |
//! |---|---|---|
//! | all of it; pairs of movable groups | `sealed.rs` | `mod.rs` |
//! | filters between groups | `leaf_filter.rs` | `filters.rs` |
//! | test plans | `test_plan.rs` | `plans.rs` |
//! | combined surface values | `surface_table.rs` | `surfaces.rs` |
//! | solids that may touch | `solids.rs` | `solids.rs` |
//! | contact capacity, if the host gives none | | `default_capacity.rs` |
//! | capacities of buffers | `frame_limits.rs` | `sizes.rs` |
//!
//! `memory.rs` checks that there is memory for all of it. `warnings.rs` and `known_limits.rs` find what the
//! author of the scene may not have intended.

mod default_capacity;
mod filters;
mod frame_limits;
mod known_limits;
mod leaf_filter;
mod memory;
mod plans;
mod sealed;
mod sizes;
mod solids;
mod surface_table;
mod surfaces;
mod test_plan;
mod values;
mod warnings;

pub(crate) use filters::part_groups;
pub(crate) use plans::{can_be_tested, kind_name};
pub use sealed::GroupPair;
pub(crate) use sealed::Sealed;
pub(crate) use solids::{Partner, SolidPair, field_shares, solids_touch};
pub(crate) use surface_table::SurfaceTable;
pub(crate) use surfaces::{law_state_len, surface_tables};
pub(crate) use test_plan::{Direction, Plan};
pub(crate) use values::values_of;
pub use warnings::{MetIn, SetupNote, SetupWarning};

use crate::energy::account::WrenchCoupling;
use crate::energy::contact::ContactEnergies;
use crate::error::EngineError;
use crate::scene::{GroupFilter, ObjectPair, Scene};
use default_capacity::default_capacity;
use filters::{drop_kept_apart, filter_count, filters_of_objects};
use known_limits::known_limits;
use plans::plans;
use pong_arena::require_memory;
use pong_geometry::bounding::VolumeTests;
use pong_model::{Fnv, Surface};
use pong_threads::WorkerStart;
use sealed::NO_PLAN;
use sizes::{limits, too_large};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use surfaces::friction_lost;
use warnings::{idle_filters, warnings};

/// Result of a seal.
#[derive(Clone, Debug, PartialEq)]
pub struct SealReport {
    /// Pairs of movable groups that will be tested.
    pub group_pairs: usize,
    /// Maximum contacts of a frame.
    pub contact_capacity: usize,
    /// Size of the largest contact state block, bytes.
    pub state_size: usize,
    /// Memory that was checked to be available for the seal, bytes: an upper bound of its use.
    pub memory: usize,
    /// Start of every worker: its core and priority, or the reason why it has none.
    pub workers: Vec<WorkerStart>,
    /// Number of filters that keep groups of paired Objects apart.
    pub filters: usize,
    /// Pairs of kinds that meet but have no tester; they are ignored, as the author may intend.
    pub warnings: Vec<SetupWarning>,
    /// Names of the Objects of every pair without any tester between them: the two pass through each other.
    pub untouchable_pairs: Vec<[String; 2]>,
    /// Friction that only one of two surfaces has, known limits of the contact model that the scene may meet,
    /// and filters without effect.
    pub notes: Vec<SetupNote>,
}

pub(crate) fn seal(
    scene: &Scene,
    surfaces: &[Vec<Surface>],
) -> Result<(Sealed, Vec<SurfaceTable>, SealReport), EngineError> {
    let pair_count = count_group_pairs(scene);
    let for_pairs = memory::for_pairs(scene, pair_count);
    require_memory(
        "seal: the pairs of movable groups",
        for_pairs,
        "pair fewer Objects, or split the movable groups among Objects that need not all be paired",
    )?;
    let filters = filters_of_objects(scene);
    let mut group_pairs = group_pairs(scene, pair_count);
    drop_kept_apart(scene, &filters, &mut group_pairs);
    let volume_tests = VolumeTests::new(&scene.extensions);
    let mut problems = untestable_volumes(scene, &group_pairs, &volume_tests);
    let mut tables = Vec::new();
    match surface_tables(scene, surfaces, &group_pairs, &filters) {
        Ok(made) => tables = made,
        Err(more) => problems.extend(more),
    }
    if let Some(0) = scene.config.contact_capacity {
        problems.push("contact capacity: 0 leaves no contact; give at least 1 or leave it out".to_owned());
    }
    let (law_state_len, coupling) = (law_state_len(&tables), scene.config.accounts);
    let delay = coupling.map_or(0, WrenchCoupling::delay);
    if delay > WrenchCoupling::DELAY_FRAMES_MAX as usize {
        let most = WrenchCoupling::DELAY_FRAMES_MAX;
        problems.push(format!("accounts: wrenches that come {delay} frames late; give at most {most}"));
    }
    problems.extend(scene.config.contact_capacity.and_then(|wanted| too_large(scene, wanted, law_state_len)));
    if !problems.is_empty() {
        return Err(EngineError::Seal { problems });
    }
    let numbered = tables.iter().enumerate();
    let table_of: BTreeMap<(usize, usize), usize> =
        numbered.map(|(index, table)| ((table.model_a, table.model_b), index)).collect();
    for pair in &mut group_pairs {
        let [a, b] = [pair.first, pair.second].map(|body| scene.group_of_model(body).0);
        pair.tables = [table_of[&(a, b)], table_of[&(b, a)]];
    }
    let has_resistance = tables.iter().any(|table| table.has_resistance);
    let plans = plans(scene, &mut group_pairs, &filters);
    let contact_capacity = scene
        .config
        .contact_capacity
        .unwrap_or_else(|| default_capacity(scene, &group_pairs, &plans, has_resistance));
    let record_capacity = 2 * contact_capacity;
    let hash = scene_hash(scene, contact_capacity, law_state_len);
    let paired_bodies = paired_bodies(scene, &group_pairs);
    let limits = limits(scene, &paired_bodies, record_capacity);
    let for_frames = memory::for_frames(scene, pair_count, &limits, contact_capacity, law_state_len);
    require_memory(
        "seal: the frames",
        for_frames,
        "ask for a smaller `contact_capacity` or fewer workers, or pair fewer Objects",
    )?;
    let sealed = Sealed {
        plans,
        paired_bodies,
        rays_meet_groups: rays_meet_groups(scene, &group_pairs),
        group_pairs,
        filters,
        limits,
        volume_tests,
        contact_capacity,
        record_capacity,
        law_state_len,
        coupling,
        hash,
    };
    let (warnings, untouchable_pairs) = warnings(scene, &sealed.filters);
    let notes = friction_lost(scene, surfaces, &tables)
        .into_iter()
        .chain(known_limits(scene))
        .chain(idle_filters(scene));
    let report = SealReport {
        group_pairs: sealed.group_pairs.len(),
        contact_capacity,
        state_size: 0,
        memory: for_pairs.saturating_add(for_frames),
        workers: Vec::new(),
        filters: filter_count(scene),
        warnings,
        untouchable_pairs,
        notes: notes.collect(),
    };
    Ok((sealed, tables, report))
}

/// Checks that there is memory for the frames of a clone of a sealed scene.
pub(crate) fn require_memory_of_clone(scene: &Scene, sealed: &Sealed) -> Result<(), EngineError> {
    let Sealed { limits, contact_capacity, law_state_len, .. } = sealed;
    let pairs = sealed.group_pairs.len();
    require_memory(
        "clone: the frames",
        memory::for_frames(scene, pairs, limits, *contact_capacity, *law_state_len),
        "destroy worlds that are not needed, or seal the first with a smaller `contact_capacity`",
    )?;
    Ok(())
}

/// Number of pairs of movable groups that [`group_pairs`] lists.
fn count_group_pairs(scene: &Scene) -> usize {
    let bodies_of = |object: usize| scene.models[scene.objects[object].model].bodies.len();
    let pairs_of = |pair: &ObjectPair| match (bodies_of(pair.a), bodies_of(pair.b)) {
        (a, _) if pair.a == pair.b => a.saturating_mul(a.saturating_sub(1)) / 2,
        (a, b) => a.saturating_mul(b),
    };
    scene.pairs.iter().map(pairs_of).fold(0, usize::saturating_add)
}

/// Every pair of movable groups of paired Objects, in the order of the first group and then of the second.
fn group_pairs(scene: &Scene, count: usize) -> Vec<GroupPair> {
    let bodies_of = |object: usize| {
        let object = &scene.objects[object];
        object.first_body..object.first_body + scene.models[object.model].bodies.len()
    };
    let mut found = Vec::with_capacity(count);
    for (pair, objects) in scene.pairs.iter().enumerate() {
        for a in bodies_of(objects.a) {
            for b in bodies_of(objects.b).filter(|b| objects.a != objects.b || a < *b) {
                found.push(GroupPair {
                    pair,
                    first: a.min(b),
                    second: a.max(b),
                    first_named_first: a < b,
                    tables: [0, 0],
                    plans: [NO_PLAN; 2],
                });
            }
        }
    }
    found.sort_by_key(|pair| (pair.first, pair.second));
    found
}

/// Indices of the movable groups that are in a pair, each once, in increasing order.
fn paired_bodies(scene: &Scene, group_pairs: &[GroupPair]) -> Arc<[usize]> {
    let mut is_paired = vec![false; scene.bodies.len()];
    for pair in group_pairs {
        (is_paired[pair.first], is_paired[pair.second]) = (true, true);
    }
    (0..is_paired.len()).filter(|&body| is_paired[body]).collect()
}

fn rays_meet_groups(scene: &Scene, group_pairs: &[GroupPair]) -> bool {
    let has_rays = |body: usize| !scene.body(body).rays.is_empty();
    let mut met = BTreeSet::new();
    group_pairs.iter().any(|pair| {
        [(pair.first, pair.second), (pair.second, pair.first)]
            .into_iter()
            .filter(|&(a, _)| has_rays(a))
            .any(|(a, b)| !met.insert((a, scene.bodies[b].object)))
    })
}

fn untestable_volumes(scene: &Scene, group_pairs: &[GroupPair], tests: &VolumeTests) -> Vec<String> {
    let mut problems = BTreeSet::new();
    let mut testable = BTreeSet::new();
    let kinds = |body: usize| -> BTreeSet<String> {
        scene.body(body).tree.nodes.iter().map(|node| node.volume.kind_name().to_owned()).collect()
    };
    for pair in group_pairs {
        let groups = [pair.first, pair.second].map(|body| scene.group_of_model(body));
        if testable.contains(&groups) {
            continue;
        }
        let (kinds_a, kinds_b) = (kinds(pair.first), kinds(pair.second));
        if kinds_a.iter().all(|a| kinds_b.iter().all(|b| tests.supports(a, b))) {
            testable.insert(groups);
            continue;
        }
        for a in kinds_a {
            for b in kinds_b.iter().filter(|b| !tests.supports(&a, b)) {
                problems.insert(format!(
                    "bounding volumes {a} and {b} of `{}` and `{}`: no test is registered; register one or use \
                     another bound kind",
                    scene.body_name(pair.first),
                    scene.body_name(pair.second)
                ));
            }
        }
    }
    problems.into_iter().collect()
}

/// Hash of everything that determines the meaning of a contact state block.
fn scene_hash(scene: &Scene, capacity: usize, law_state_len: usize) -> u64 {
    let stride = law_state_len + ContactEnergies::numbers_each(scene.config.accounts);
    let mut text = format!("capacity {capacity} stride {stride} ledger {}\n", scene.config.ledger);
    if let Some(coupling) = scene.config.accounts {
        text += &format!("accounts {}\n", coupling.hashed());
    }
    for model in &scene.models {
        text += &format!("model {:016x}\n", model.hash);
    }
    for object in &scene.objects {
        text += &format!("object {} {}\n", object.model, object.name);
    }
    for pair in &scene.pairs {
        text += &format!("pair {} {}\n", pair.a, pair.b);
    }
    let filters: BTreeSet<_> = scene.filters.iter().collect();
    for GroupFilter { objects, groups } in filters {
        text += &format!("filter {} {} {} {}\n", objects[0], groups[0], objects[1], groups[1]);
    }
    for law in scene.laws.names() {
        text += &format!("law {law}\n");
    }
    Fnv::of(text.as_bytes())
}
