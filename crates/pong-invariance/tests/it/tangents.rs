//! Tangents of every family of scenes against central differences (docs/theory.md, 7).

use pong_invariance::make;
use pong_invariance::{Order, Survey};

/// Scenes of each family: enough to meet every tester, or with `PONG_TESTS=night` every thousandth branch.
fn scenes() -> u64 {
    match std::env::var("PONG_TESTS").as_deref() {
        Ok("night") => 4000,
        Ok("full") => 200,
        _ => 40,
    }
}

/// One scene in this many is checked (`INVARIANCES`).
const EVERY: u64 = 16;

/// Scenes of a family, in a thousand, that may differ: kinks within the width of the differences.
const KINKS_MOST: u64 = 8;

#[test]
fn every_family() {
    for family in make::families() {
        let order = Order {
            seed: 1,
            first: 0,
            scenes: scenes() * EVERY,
            only: vec!["tangent".to_owned()],
            family: Some(family.to_owned()),
            threads: 1,
            kept: 1,
        };
        let survey = Survey::run(&order, &|_| ());
        let tally = survey.tallies.get("tangent").cloned().unwrap_or_default();
        println!(
            "{family:<18} compared {:>6} differ {:>4} worst {:.1e}",
            tally.compared, tally.differ, tally.worst
        );
        let found: String = survey.found.iter().map(|found| found.text()).collect();
        assert!(tally.differ <= scenes() * KINKS_MOST / 1000, "{}\n{found}", survey.text());
        assert!(tally.compared > scenes() / 4, "{family}: only {} compared", tally.compared);
    }
}
