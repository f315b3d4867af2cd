//! Contact of solids by overlapped volume (docs/theory.md, 2.11 and 2.12).
//!
//! | step | file |
//! |---|---|
//! | slices of a large mesh, which several threads share | `slices.rs` |
//! | sides of a pair, and which of their parts are near each other | `mod.rs`, `side.rs` |
//! | faces that push, by the side of entry | `entry.rs` |
//! | cells of both fields | `cells.rs` |
//! | normal forces, friction, contacts | `patch.rs` |

mod cell_force;
mod cells;
mod entry;
mod patch;
mod relative;
mod side;
pub(crate) mod slices;

use crate::frame::block::plan_of;
use crate::frame::input::{Block, BlockKind, PairContext, Round};
use crate::frame::worker_context::WorkerContext;
use crate::report::{Laps, Work};
use crate::seal::{Direction, Partner, SolidPair, field_shares};
use crate::state::SolidContactPart;
use cells::Cells;
pub(crate) use cells::SolidScratch;
use patch::Patch;
use pong_geometry::Vec3;
use relative::Relative;
use side::Side;

/// Finds and computes the contacts of some pairs of solids, and writes them to the worker's context.
pub(crate) fn run_solids(round: &Round<'_>, block: &Block, worker: &mut WorkerContext, laps: &mut impl Laps) {
    let (plan, motion) = plan_of(round, block);
    let context = PairContext::new(round, block.direction, motion);
    let relative = Relative::new(motion);
    let bodies = round.sealed.bodies_of(block.direction);
    let slice = (block.kind == BlockKind::SolidSlice).then_some(block.leaf);
    for pair in &plan.solids[block.first as usize..block.end as usize] {
        touch(round, &context, bodies, &relative, (pair, slice), worker, laps);
    }
}

/// Direction from B to A at which two convex solids began to overlap, in B's frame. `None` if they did not overlap
/// at the last commit, or do not remember it.
pub(crate) fn committed_entry(context: &PairContext<'_>, pair: &SolidPair) -> Option<Vec3> {
    let Partner::Solid(b) = pair.b else { return None };
    let [a, b] = [&context.body_a.solids[pair.a as usize], &context.body_b.solids[b as usize]];
    if !a.is_convex() || !b.is_convex() {
        return None;
    }
    let sides = (&Side::unit(a, 0), &Side::unit(b, 0));
    entry::records(context, sides, SolidContactPart::Entry).next().map(|(_, record)| record.normal_b)
}

/// Computes the contacts of a pair of solids, or of a slice of A's solid: one patch for each of its parts that are near
/// each other.
fn touch(
    round: &Round<'_>,
    context: &PairContext<'_>,
    (body_a, body_b): (usize, usize),
    relative: &Relative,
    (pair, slice): (&SolidPair, Option<u32>),
    worker: &mut WorkerContext,
    laps: &mut impl Laps,
) {
    let solid_a = &context.body_a.solids[pair.a as usize];
    let solid_b = match pair.b {
        Partner::Solid(index) => Some(&context.body_b.solids[index as usize]),
        Partner::Plane(_) => None,
    };
    if solid_b.is_some_and(|solid_b| !side::boxes_meet(&relative.x_ba, &solid_a.bound, &solid_b.bound)) {
        return;
    }
    let groups = [body_a, body_b].map(|body| round.scene.group_of_model(body).1);
    let props = &context.table.foundations[&(groups[0], pair.a, groups[1], pair.b)];
    let shares = field_shares(solid_a, solid_b, props.share_a).expect("sealing has checked it");
    let mut with = |a: &Side<'_>, b: &Side<'_>| {
        touch_units(round, context, relative, (a, b), shares, props, worker);
    };
    let root_a = slice.map_or(solid_a.tree.root(), |slice| slices::node(&solid_a.tree, slice));
    match (pair.b, root_a, solid_b.and_then(|solid| solid.tree.root())) {
        (Partner::Plane(primitive), Some(root_a), _) => {
            let half_space = side::half_space(context.body_b, primitive);
            let plane = Side::plane(context.body_b, primitive, &half_space);
            side::for_each_below(relative, (solid_a, &half_space[0]), root_a, &mut |unit| {
                with(&Side::unit(solid_a, unit), &plane);
            });
        }
        (Partner::Solid(index), Some(root_a), Some(root_b)) => {
            let solid_b = &context.body_b.solids[index as usize];
            let mut meet = |one, other| with(&Side::unit(solid_a, one), &Side::unit(solid_b, other));
            side::for_each_meeting(relative, (solid_a, solid_b), (root_a, root_b), &mut meet);
        }
        _ => {}
    }
    laps.lap(Work::Forces, &mut worker.out.times);
}

/// Computes the contacts of two convex bodies, or of two parts of bodies.
fn touch_units(
    round: &Round<'_>,
    context: &PairContext<'_>,
    relative: &Relative,
    (a, b): (&Side<'_>, &Side<'_>),
    shares: [f64; 2],
    props: &crate::law::PairProps,
    worker: &mut WorkerContext,
) {
    let WorkerContext { solids, out, .. } = worker;
    // Regions of facets know only the volume near the surface.
    let has_regions = !a.regions.facets.is_empty() || !b.regions.facets.is_empty();
    if !has_regions && !solids.share_volume(relative, a, b) {
        return;
    }
    let entry = entry::side_of_entry(context, relative, (a, b));
    solids.choose_faces((a, b), entry.as_ref());
    let cells = Cells { relative, shares, sides: (a, b) };
    cells.find(solids);
    if has_regions {
        if !solids.found_any() {
            return;
        }
        let PairContext { group_pair, flipped, .. } = *context;
        let (body_a, body_b) = round.sealed.bodies_of(Direction { group_pair, flipped });
        out.demand.deep_in_meshes.note((body_b, body_a), solids.of_b.floors_reached);
        out.demand.deep_in_meshes.note((body_a, body_b), solids.of_a.floors_reached);
    }
    let patch = Patch { context, sealed: round.sealed, relative, sides: (a, b), shares, props };
    patch.add_contacts(solids, entry.as_ref(), out);
}
