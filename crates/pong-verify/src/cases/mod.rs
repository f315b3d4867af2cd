//! The cases, in the order of the report.

mod balls;
mod block;
mod bounce;
mod closed_path;
mod entry;
mod facets;
mod frames;
mod friction_circle;
mod hertz;
mod incline;
mod integrators;
mod ledger;
mod orders;
mod peg;
mod power_law;
mod ramp;
mod rays;
mod resting;
mod rocking;
mod rolling;
mod series;
mod static_rest;
mod step_bounds;
mod stick_slip;
mod support;
mod tripod;
mod trough;
mod tumbling;
mod turntable;
mod two_spheres;

use crate::case::Case;

/// All cases.
pub fn cases() -> Vec<Case> {
    vec![
        static_rest::V1,
        tripod::V2,
        bounce::V3,
        bounce::V4,
        balls::V6,
        two_spheres::V7,
        incline::V8,
        block::V9,
        rolling::V10,
        rolling::V11,
        stick_slip::V16,
        stick_slip::V17,
        friction_circle::V18,
        peg::V20,
        tumbling::V24,
        frames::V25,
        frames::V26,
        bounce::V28,
        rays::V29,
        support::V30,
        hertz::W1,
        series::W2,
        ramp::W3,
        incline::W4,
        resting::W5,
        trough::W6,
        facets::W7,
        two_spheres::W8,
        rocking::W9,
        closed_path::W10,
        ledger::W11,
        integrators::W12,
        step_bounds::W13,
        turntable::W14,
        entry::W15,
        bounce::W16,
        orders::W17,
        power_law::W18,
    ]
}

/// The case of an id, ignoring letter case.
pub fn find(id: &str) -> Option<Case> {
    cases().into_iter().find(|case| case.id.eq_ignore_ascii_case(id))
}

#[cfg(test)]
mod tests {
    #[test]
    fn ids_are_unique() {
        let mut ids: Vec<_> = super::cases().iter().map(|case| case.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), super::cases().len());
    }
}
