//! W3: damping that sets in over a depth.

use crate::case::{Case, Outcome};
use crate::row::Row;
use crate::scene::{Duo, set_damping, set_ramp};
use pong_engine::State;

pub const W3: Case = Case {
    id: "W3",
    title: "Damping ramp",
    set_up: "A point closing at 0.2 m/s, and leaving at 2 m/s, at depths from a tenth to twice the ramp of 1 mm; 1e5 \
             N/m, 400 N·s/m.",
    source: "F = max(0, k·δ + c·S(δ/ramp)·δ'), S(x) = 3x² − 2x³ up to 1",
    rows,
};

const RAMP: f64 = 1e-3;
const STIFFNESS: f64 = 1e5;
const DAMPING: f64 = 400.0;

fn rows() -> Outcome {
    let duo = Duo::new("point", "ground")?
        .mover(|s| {
            s.stiffness = STIFFNESS;
            set_damping(s, DAMPING);
            set_ramp(s, RAMP);
        })?
        .ground(|s| set_ramp(s, RAMP))?;
    let (mut world, [point, ground]) = duo.world()?;
    world.set_state(ground, &State::identity())?;
    let mut rows = Vec::new();
    for (rate, way) in [(0.2, "closing"), (-2.0, "leaving")] {
        for x in [0.1, 0.5, 0.9, 2.0] {
            let depth = x * RAMP;
            let state = State {
                position: [0.0, 0.0, -depth],
                linear_velocity: [0.0, 0.0, -rate],
                ..State::identity()
            };
            world.set_state(point, &state)?;
            world.evaluate()?;
            let set_in = if x < 1.0 { x * x * (3.0 - 2.0 * x) } else { 1.0 };
            let force = (STIFFNESS * depth + DAMPING * set_in * rate).max(0.0);
            let got: f64 = world.contacts().iter().map(|contact| contact.normal_force).sum();
            let name = format!("{way}, depth {x} ramp: force");
            rows.push(Row::absolute(name, "N", force, got, 1e-11));
        }
    }
    Ok(rows)
}
