//! Small surveys around what once disagreed: each must find nothing, and finds again what is put back (`ci/planted`).

use pong_invariance::{Order, Survey};

/// Nothing differs in so many scenes of a family, or of those that the invariances make for themselves.
fn nothing_differs(only: &[&str], family: Option<&str>, scenes: u64) {
    let order = Order {
        seed: 20,
        first: 0,
        scenes,
        only: only.iter().map(|name| (*name).to_owned()).collect(),
        family: family.map(str::to_owned),
        threads: 1,
        kept: 1,
    };
    let survey = Survey::run(&order, &|_| {});
    let found: String = survey.found.iter().map(|found| found.text()).collect();
    assert!(survey.differ() == 0 && survey.refused == 0, "{}\n{found}", survey.text());
    assert!(survey.compared() > scenes / 40, "too little was compared:\n{}", survey.text());
}

#[test]
fn balls_that_roll_and_spin() {
    nothing_differs(&["rolling"], None, 160);
}

#[test]
fn slip_evaluated_again_and_beside() {
    nothing_differs(&["committed_again"], Some("plane"), 200);
    nothing_differs(&["beside"], None, 200);
}

#[test]
fn what_must_be_the_same_bits() {
    let bits =
        ["swapped", "regrouped", "bounded", "negated", "thrown_away", "restored", "forgotten", "workers"];
    nothing_differs(&bits, None, 400);
}
