//! Tangents and incremental potentials of every family of scenes against central differences (docs/theory.md, 7).

use pong_invariance::make;
use pong_invariance::{Order, Survey};

/// Scenes of each family: enough to meet every tester; with `PONG_TESTS=night` a million in all, an hour on one core.
fn scenes() -> u64 {
    match std::env::var("PONG_TESTS").as_deref() {
        Ok("night") => 30_000,
        Ok("full") => 130,
        _ => 40,
    }
}

/// One scene in this many is checked (`INVARIANCES`).
const EVERY: u64 = 16;

/// Scenes of a family, in a thousand, that may differ: kinks within the width of the differences.
const KINKS_MOST: u64 = 8;

#[test]
fn tangents_of_every_family() {
    every_family("tangent");
}

#[test]
fn potentials_of_every_family() {
    every_family("potential");
}

fn every_family(claim: &str) {
    for family in make::families() {
        let order = Order {
            seed: 1,
            first: 0,
            scenes: scenes() * EVERY,
            only: vec![claim.to_owned()],
            family: Some(family.to_owned()),
            threads: 1,
            kept: 1,
        };
        let survey = Survey::run(&order, &|_| ());
        let tally = survey.tallies.get(claim).cloned().unwrap_or_default();
        println!(
            "{family:<18} compared {:>6} differ {:>4} worst {:.1e}",
            tally.compared, tally.differ, tally.worst
        );
        let found: String = survey.found.iter().map(|found| found.text()).collect();
        print!("{found}");
        assert!(tally.differ <= scenes() * KINKS_MOST / 1000, "{}\n{found}", survey.text());
        // Solids have no potential, and their tangents are compared where closed forms take part. Cylinders and cones
        // have closed forms on faces alone, capsules on meshes at their ends alone.
        let few = family.starts_with("wheel") || family == "rod_on_mesh";
        let least = if few { scenes() / 10 } else { scenes() / 4 };
        let is_met = tally.compared > least || (claim == "potential" && tally.compared == 0);
        assert!(is_met, "{family}: only {} compared", tally.compared);
    }
}
