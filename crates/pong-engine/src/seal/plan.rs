//! Which kinds of which movable groups are tested against which.

use super::testable::{can_be_tested, kind_name};
use crate::frame::narrow_phase::pair_table::{REGISTERED, kind_pair};
use crate::frame::{least_travel_m, reach_m};
use crate::scene::Scene;
use crate::sealed::{GroupPair, Plan};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{MovableGroup, PrimitiveInfo};
use std::collections::BTreeSet;

/// What is tested in one direction of a pair.
fn plan(scene: &Scene, group_pair: usize, pair: &GroupPair, flipped: u32) -> Plan {
    let (body_a, body_b) = if flipped == 0 { (pair.first, pair.second) } else { (pair.second, pair.first) };
    let (a, b) = (scene.body(body_a), scene.body(body_b));
    let in_order = (flipped == 0) == pair.first_named_first;
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
    let group_pair = group_pair as u32;
    Plan { group_pair, flipped, body_a, body_b, element_ns, touched, least_travel_m, reach_a_m }
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

/// All directions of all pairs in which something can be found.
pub(super) fn plans(scene: &Scene, group_pairs: &[GroupPair]) -> Vec<Plan> {
    let directions = group_pairs
        .iter()
        .enumerate()
        .flat_map(|(index, pair)| [0, 1].map(|flipped| plan(scene, index, pair, flipped)));
    directions.filter(Plan::finds_something).collect()
}
