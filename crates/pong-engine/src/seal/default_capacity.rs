//! Contact capacity of a world whose host gives none: an estimate of the contacts that the scene may have.

use super::sealed::NO_PLAN;
use super::solids::{Partner, SolidPair};
use super::{GroupPair, Plan};
use crate::frame::narrow_phase::pair_table::most_contacts;
use crate::scene::Scene;
use pong_model::MovableGroup;

/// Maximum default capacity in contacts; the estimate may be larger.
const MOST: usize = 65_536;

/// Minimum default capacity in contacts. A sphere centred in a cone of many triangles touches all of them,
/// which is more than the estimate assumes.
const LEAST: usize = 256;

/// Pairs of a movable group that count. Twelve equal spheres fit around one, and 26 equal boxes. If each contact
/// counts for the smaller of its two groups, groups of one size have half as many each; a small group has few
/// larger ones beside it.
const NEIGHBORS: usize = 16;

/// Contacts of two parts of solids that the estimate assumes: a few cells of both fields, friction, side of
/// entry.
const SOLID_CONTACTS: usize = 8;

/// Pairs of parts that the estimate assumes at most for two solids. A mesh has more parts, but few of them touch.
const PART_PAIRS_MAX: usize = 512;

/// Estimate of the number of contacts, within the limits of the default capacity: the sum over all pairs of movable
/// groups, or, if that is less, the sum over the groups of their [`NEIGHBORS`] pairs with the most contacts.
///
/// In a pair, every primitive touches every shell of the other group, with the most contacts that the tester table
/// gives the kinds that meet. If any surfaces resist rolling or spinning (`has_resistance`), every contact has
/// the two of a couple besides.
pub(super) fn default_capacity(
    scene: &Scene,
    group_pairs: &[GroupPair],
    plans: &[Plan],
    has_resistance: bool,
) -> usize {
    let mut of_plan = vec![None; plans.len()];
    let mut of_all = 0_usize;
    let mut most_of_groups = vec![[0; NEIGHBORS]; scene.bodies.len()];
    for pair in group_pairs {
        let mut of_pair = 0_usize;
        for (plan, [a, b]) in pair.plans.iter().zip([[pair.first, pair.second], [pair.second, pair.first]]) {
            if *plan != NO_PLAN {
                let groups = [a, b].map(|body| scene.body(body));
                let estimate = || of_direction(&plans[*plan as usize], groups, has_resistance);
                let known: &mut Option<usize> = &mut of_plan[*plan as usize];
                of_pair = of_pair.saturating_add(*known.get_or_insert_with(estimate));
            }
        }
        of_all = of_all.saturating_add(of_pair);
        [pair.first, pair.second].iter().for_each(|body| keep_greatest(&mut most_of_groups[*body], of_pair));
    }
    let of_groups = most_of_groups.iter().flatten().copied().fold(0, usize::saturating_add);
    of_all.min(of_groups).clamp(LEAST, MOST)
}

/// Replaces the least of some numbers in increasing order if another one is greater.
fn keep_greatest(numbers: &mut [usize; NEIGHBORS], other: usize) {
    if other > numbers[0] {
        numbers[0] = other;
        numbers.sort_unstable();
    }
}

/// Estimate for one direction of a pair, with the plan of that direction.
fn of_direction(plan: &Plan, [a, b]: [&MovableGroup; 2], has_resistance: bool) -> usize {
    let with_couple = if has_resistance { 3 } else { 1 };
    let of_primitives: usize = a
        .primitives
        .iter()
        .map(|info| with_couple * most_contacts(info.kind, |b| plan.tests(info.kind, b)))
        .sum();
    of_primitives.saturating_mul(shells(b)).saturating_add(of_solids(&plan.solids, [a, b]))
}

/// Number of shells of a movable group. A primitive of a declared surface counts as a shell of its own besides,
/// because it may coincide with another.
fn shells(body: &MovableGroup) -> usize {
    let in_joint = body.primitives.iter().filter(|info| body.is_joint(info.shell)).count();
    body.shell_count as usize + in_joint
}

/// Estimate for pairs of solids, and of solids and planes: every part of a solid touches a part of the other. Beyond
/// the default capacity the count is not continued.
fn of_solids(pairs: &[SolidPair], [a, b]: [&MovableGroup; 2]) -> usize {
    let contacts = |parts: usize, others: usize| (parts + others - 1).min(PART_PAIRS_MAX) * SOLID_CONTACTS;
    let mut total = 0;
    for pair in pairs {
        if total > MOST {
            break;
        }
        let others = match pair.b {
            Partner::Solid(index) => b.solids[index as usize].parts.len(),
            Partner::Plane(_) => 1,
        };
        total += contacts(a.solids[pair.a as usize].parts.len(), others);
    }
    total
}
