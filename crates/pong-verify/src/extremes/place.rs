//! Common frames that are far away or fast.

use super::extreme::{Answer, Extreme, Length, rows_of};
use crate::case::Outcome;

pub const FAR: Extreme = Extreme {
    id: "E1",
    asked: "Common origin 6.8e6 m and 1e8 m away, at 7.7 km/s: the same wrench, within what rounding of the inputs allows.",
    set_up: "Case V25: a docking with every kind of pair in contact, seen from six frames of reference. Allowed: k × \
             rounding of the positions plus c × rounding of the velocities, summed over the contacts.",
    answer: Answer::Safe,
    limit: "1e8 m is rounded to 1.5e-8 m, which is 1.5 mN on 1e5 N/m; keep the common origin near the contacts",
    also: "`crates/pong-engine/tests/it/invariance.rs`",
    rows,
};

fn rows(_: Length) -> Outcome {
    rows_of("V25")
}
