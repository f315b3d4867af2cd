//! Friction over facets, under cyclic load, and with a load that drops.

use super::extreme::{Answer, Extreme, Length, rows_of};
use super::rig::{Rig, model};
use crate::case::Outcome;
use crate::row::Row;
use pong_executive::{Quat, Vec3};
use pong_testkit::Random;

pub const FACETS: Extreme = Extreme {
    id: "E15",
    asked: "Friction over facets: a bristle survives the crossing from facet to facet.",
    set_up: "Case W7: rolling and sliding over tiles, a mesh and a ridge, against one plane.",
    answer: Answer::Safe,
    limit: "a sharp ridge is a new wall: beyond 60° between facets the bristle starts at zero",
    also: "`crates/pong-engine/tests/it/seams.rs`",
    rows: facets,
};

pub const LOADS: Extreme = Extreme {
    id: "E16",
    asked: "Friction under cyclic load and with a load that drops: no creep, never more than the load allows.",
    set_up: "Case V17: 0 to 80 % of break-away, ten cycles; an hour on a slope. Then a point whose depth jumps between 0 and \
             1 mm from frame to frame while it is dragged at random, 100,000 frames.",
    answer: Answer::Safe,
    limit: "none found",
    also: "cases V8, V16, V18; `crates/pong-engine/tests/it/closed_paths.rs`",
    rows: loads,
};

fn facets(_: Length) -> Outcome {
    rows_of("W7")
}

fn loads(_: Length) -> Outcome {
    let mut rows = rows_of("V17")?;
    let mu = 0.4;
    let surface = "stiffness: 1e5, normal: Linear(damping: 0.0), friction: Bristle(mu: 0.4, damping: 300.0)";
    let mut rig = Rig::new(
        &model(surface, "Point(name: \"x\", position: (0,0,0))"),
        &model(surface, "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)"),
    )?;
    let mut random = Random(16);
    let (mut place, mut most, mut pulled, mut slid) = (Vec3::zeros(), 0.0_f64, 0, 0);
    for _ in 0..100_000 {
        let drag = random.vector(1e-4);
        place += Vec3::new(drag.x, drag.y, 0.0);
        place.z = -1e-3 * random.unit();
        let force = rig.step(place, Quat::identity(), drag * 1e3)?.force;
        pulled += usize::from(force.z < 0.0);
        slid += usize::from(rig.contacts().iter().any(|contact| !contact.sticks));
        most = most.max(force.xy().norm() / (mu * force.z));
    }
    rows.push(Row::count("frames with a normal force that pulls", 0, pulled));
    rows.push(Row::below("largest friction over μ × load, less 1", "", (most - 1.0).max(0.0), 1e-12));
    rows.push(Row::below("frames that stick, over all frames", "", 1.0 - slid as f64 / 1e5, 0.9));
    Ok(rows)
}
