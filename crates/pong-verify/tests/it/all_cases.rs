//! One test per case, so that a failure has a name, and tests that the committed report is current.

use pong_verify::{Case, Verdict, cases, find, report};
use std::sync::OnceLock;

/// Verdict of a case, which runs once for all tests.
fn verdict(case: &Case) -> &'static Verdict {
    static VERDICTS: OnceLock<Vec<(&'static str, OnceLock<Verdict>)>> = OnceLock::new();
    let all = VERDICTS.get_or_init(|| cases().iter().map(|case| (case.id, OnceLock::new())).collect());
    let (_, slot) = all.iter().find(|(id, _)| *id == case.id).expect("every case has a slot");
    slot.get_or_init(|| case.run())
}

macro_rules! one_test_each {
    ($($test:ident => $id:literal),* $(,)?) => {
        $(
            #[test]
            fn $test() {
                let verdict = verdict(&find($id).expect("the case exists"));
                assert!(verdict.passes(), "\n{verdict}");
            }
        )*

        #[test]
        fn each_has_a_test() {
            let ids: Vec<_> = cases().iter().map(|case| case.id).collect();
            assert_eq!(ids, [$($id),*]);
        }
    };
}

one_test_each! {
    v1_static_rest => "V1",
    v2_tripod => "V2",
    v3_bounce_linear => "V3",
    v4_bounce_hunt_crossley => "V4",
    v6_elastic_balls => "V6",
    v7_two_spheres => "V7",
    v8_incline => "V8",
    v9_sliding_to_a_stop => "V9",
    v10_slip_to_roll => "V10",
    v11_rolling_down => "V11",
    v16_stick_slip => "V16",
    v17_drift => "V17",
    v18_friction_circle => "V18",
    v20_peg_wedging => "V20",
    v24_tumbling => "V24",
    v25_frames => "V25",
    v26_action_and_reaction => "V26",
    v28_zero_order_hold => "V28",
    v29_rays => "V29",
    v30_ellipsoid_on_a_plane => "V30",
    w1_hertz => "W1",
    w2_series => "W2",
    w3_damping_ramp => "W3",
    w4_coulomb_creep => "W4",
    w5_resting => "W5",
    w6_trough => "W6",
    w7_facets => "W7",
    w8_oblique_collision => "W8",
    w9_rocking_ellipsoid => "W9",
    w10_closed_paths => "W10",
    w11_ledger => "W11",
    w12_orders => "W12",
    w13_longest_steps => "W13",
    w14_turntable => "W14",
    w15_side_of_entry => "W15",
    w16_restitution => "W16",
    w17_orders_of_contact => "W17",
    w18_power_law => "W18",
}

/// Compares the plot beside the report.
#[test]
fn the_committed_picture_is_current() {
    let fresh = pong_verify::orders::svg(pong_verify::orders::curves().unwrap());
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/figures/orders.svg");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        fresh == committed,
        "docs/figures/orders.svg is out of date, run `pong verify -o docs/verification.md`"
    );
}

/// `pong verify -o docs/verification.md` writes the report again.
#[test]
fn the_committed_report_is_current() {
    let verdicts: Vec<Verdict> = cases().iter().map(|case| verdict(case).clone()).collect();
    let fresh = report::markdown(&verdicts);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/verification.md");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    let differs = fresh.lines().zip(committed.lines()).find(|(fresh, committed)| fresh != committed);
    if let Some((fresh, committed)) = differs {
        panic!(
            "docs/verification.md is out of date, run `pong verify -o docs/verification.md`:\n- {committed}\n+ {fresh}"
        );
    }
    assert_eq!(fresh.lines().count(), committed.lines().count(), "docs/verification.md is out of date");
}
