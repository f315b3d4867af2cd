//! Which kinds of which movable groups are tested against which.

use super::testable::{can_be_tested, kind_name};
use crate::frame::narrow_phase::pair_table::{REGISTERED, kind_pair};
use crate::frame::{least_travel_m, reach_m};
use crate::scene::Scene;
use crate::sealed::{GroupPair, NO_PLAN, Plan};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{MovableGroup, PrimitiveInfo};
use std::collections::{BTreeMap, BTreeSet};

/// What is tested of A against B; `in_order` says that A's Object was named first.
fn plan(scene: &Scene, (a, b): (&MovableGroup, &MovableGroup), in_order: bool) -> Plan {
    let (mut element_ns, mut touched) = ([None; PrimitiveKind::ALL.len()], [0; PrimitiveKind::ALL.len()]);
    for info_a in representatives(a) {
        let met = representatives(b)
            .filter(|info_b| in_order || kind_name(a, info_a) != kind_name(b, info_b))
            .filter(|info_b| can_be_tested(&scene.extensions, (a, info_a), (b, info_b)));
        for info_b in met {
            let slot = &mut element_ns[info_a.kind as usize];
            *slot = Some(rough_cost_ns(info_a.kind, info_b.kind)).max(*slot);
            touched[info_a.kind as usize] |= 1 << info_b.kind as u16;
        }
    }
    let tests = |a: PrimitiveKind, b: PrimitiveKind| touched[a as usize] >> b as u16 & 1 == 1;
    let (least_travel_m, reach_a_m) = (least_travel_m(a, b, tests), reach_m(a));
    Plan { element_ns, touched, least_travel_m, reach_a_m }
}

/// One primitive of every kind in a body.
fn representatives(body: &MovableGroup) -> impl Iterator<Item = &PrimitiveInfo> {
    let mut seen = BTreeSet::new();
    body.primitives.iter().filter(move |info| seen.insert(kind_name(body, info).to_owned()))
}

/// What an element of A may cost against a body with elements of B, ns.
fn rough_cost_ns(a: PrimitiveKind, b: PrimitiveKind) -> u32 {
    kind_pair(a, b).map_or(REGISTERED.0, |row| row.cost_ns)
}

/// What is tested in the directions of all pairs, each plan once. Tells every pair which are its own.
pub(super) fn plans(scene: &Scene, group_pairs: &mut [GroupPair]) -> Vec<Plan> {
    let mut plans = Vec::new();
    let mut known = BTreeMap::new();
    for pair in group_pairs {
        for flipped in [0, 1] {
            let bodies = if flipped == 0 { [pair.first, pair.second] } else { [pair.second, pair.first] };
            let in_order = (flipped == 0) == pair.first_named_first;
            let groups = bodies.map(|body| scene.group_of_model(body));
            pair.plans[flipped] = *known.entry((groups, in_order)).or_insert_with(|| {
                let [a, b] = bodies.map(|body| scene.body(body));
                let plan = plan(scene, (a, b), in_order);
                if !plan.finds_something() {
                    return NO_PLAN;
                }
                plans.push(plan);
                plans.len() as u32 - 1
            });
        }
    }
    plans
}
