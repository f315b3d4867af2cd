//! Test plans: kinds of primitives that are tested between two movable groups.

use super::filters::{apart, primitives_that_meet, representatives};
use super::leaf_filter::{LeafFilter, ObjectFilters};
use super::sealed::NO_PLAN;
use super::solids::{Partner, SolidPair};
use super::{GroupPair, Plan};
use crate::frame::narrow_phase::pair_table::{REGISTERED, has_tester, kind_pair};
use crate::frame::{PrimitivesOf, least_travel_m, reach_m, travel_of_solids_m};
use crate::scene::Scene;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Extensions, Filters, MovableGroup, PrimitiveInfo};
use std::collections::BTreeMap;

/// Name of a primitive's kind; a custom kind has its own name.
pub(crate) fn kind_name<'a>(body: &'a MovableGroup, info: &PrimitiveInfo) -> &'a str {
    match info.kind {
        PrimitiveKind::Custom => body.customs[info.elements.start as usize].kind_name(),
        kind => kind.name(),
    }
}

/// Returns true if a primitive can be tested as A against another as B.
pub(crate) fn can_be_tested(
    extensions: &Extensions,
    a: (&MovableGroup, &PrimitiveInfo),
    b: (&MovableGroup, &PrimitiveInfo),
) -> bool {
    has_tester(a.1.kind, b.1.kind)
        || extensions.contact_test(kind_name(a.0, a.1), kind_name(b.0, b.1)).is_some()
}

/// Test plan of A against B; `in_order` is true if A's Object was named first.
fn plan(
    scene: &Scene,
    a: &MovableGroup,
    b: &MovableGroup,
    in_order: bool,
    filters: Option<&Filters>,
) -> Plan {
    let (mut element_ns, mut touched) = ([None; PrimitiveKind::ALL.len()], [0; PrimitiveKind::ALL.len()]);
    let kinds = |body: &MovableGroup, info: &PrimitiveInfo| kind_name(body, info).to_owned();
    for info_a in representatives(filters, 0, a, |info| kinds(a, info)) {
        let met = representatives(filters, 1, b, |info| kinds(b, info))
            .filter(|info_b| in_order || kind_name(a, info_a) != kind_name(b, info_b))
            .filter(|info_b| !apart(filters, info_a, info_b))
            .filter(|info_b| can_be_tested(&scene.extensions, (a, info_a), (b, info_b)));
        for info_b in met {
            let slot = &mut element_ns[info_a.kind as usize];
            *slot = Some(rough_cost_ns(info_a.kind, info_b.kind)).max(*slot);
            touched[info_a.kind as usize] |= 1 << info_b.kind as u16;
        }
    }
    let tests = |a: PrimitiveKind, b: PrimitiveKind| touched[a as usize] >> b as u16 & 1 == 1;
    let filter = filters.map(|filters| Box::new(LeafFilter::new(filters, [a, b])));
    let met_a = PrimitivesOf { body: a, infos: &primitives_that_meet(filters, a, 0, b) };
    let met_b = PrimitivesOf { body: b, infos: &primitives_that_meet(filters, b, 1, a) };
    let least_travel_m = least_travel_m(met_a, met_b, tests);
    let reach_a_m = reach_m(met_a);
    let solids = solid_pairs([a, b], in_order, filters);
    let (least_travel_of_solids_m, reach_of_solids_a_m) = travel_of_solids_m([a, b], &solids);
    Plan {
        element_ns,
        touched,
        least_travel_m,
        reach_a_m,
        solids,
        least_travel_of_solids_m,
        reach_of_solids_a_m,
        filter,
    }
}

/// Solids of A with solids and planes of B that no filter keeps apart. Two solids are paired only if A's
/// Object was named first (`in_order`), so that no contact is found twice.
pub(super) fn solid_pairs(
    [a, b]: [&MovableGroup; 2],
    in_order: bool,
    filters: Option<&Filters>,
) -> Vec<SolidPair> {
    let mut pairs = Vec::new();
    for (index_a, solid_a) in (0..).zip(&a.solids) {
        let meets = |primitive_b: u32| {
            let info_a = &a.primitives[solid_a.primitive as usize];
            !apart(filters, info_a, &b.primitives[primitive_b as usize])
        };
        let solids = (0..).zip(&b.solids).filter(|_| in_order);
        let solids =
            solids.filter(|(_, solid)| meets(solid.primitive)).map(|(index, _)| Partner::Solid(index));
        let planes = (0..).zip(&b.primitives).filter(|(_, info)| info.kind == PrimitiveKind::Plane);
        let planes = planes.filter(|(index, _)| meets(*index)).map(|(index, _)| Partner::Plane(index));
        pairs.extend(solids.chain(planes).map(|b| SolidPair { a: index_a, b }));
    }
    pairs
}

/// Rough cost of an element of kind `a` against a movable group with elements of kind `b`, ns.
fn rough_cost_ns(a: PrimitiveKind, b: PrimitiveKind) -> u32 {
    kind_pair(a, b).map_or(REGISTERED.0, |row| row.cost_ns)
}

/// Test plans of both directions of all pairs, each plan once. Stores the plan indices in the pairs.
pub(super) fn plans(scene: &Scene, group_pairs: &mut [GroupPair], filters: &ObjectFilters) -> Vec<Plan> {
    let mut plans = Vec::new();
    let mut known = BTreeMap::new();
    for pair in group_pairs {
        for flipped in [0, 1] {
            let bodies = if flipped == 0 { [pair.first, pair.second] } else { [pair.second, pair.first] };
            let in_order = (flipped == 0) == pair.first_named_first;
            let groups = bodies.map(|body| scene.group_of_model(body));
            let [object_a, object_b] = bodies.map(|body| scene.bodies[body].object);
            let apart = filters.between(object_a, object_b);
            pair.plans[flipped] = *known.entry((groups, in_order, apart)).or_insert_with(|| {
                let [a, b] = bodies.map(|body| scene.body(body));
                let plan = plan(scene, a, b, in_order, apart);
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
