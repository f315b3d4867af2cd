//! W15: a body is pushed out by the face through which it entered, at any depth.

use crate::case::{Case, Failure, Outcome};
use crate::row::Row;
use crate::scene::Duo;
use pong_engine::State;

pub const W15: Case = Case {
    id: "W15",
    title: "The side of entry is remembered",
    set_up: "A point, and a rigid ball of radius 0.1 m, led in steps of 10 mm through a block 0.5 m thick, from above and \
             from below, to 0.4 m beyond the face by which they came; block of 1e5 N/m.",
    source: "force k·δ along the normal of the face of entry, δ from that face",
    rows,
};

const THICKNESS: f64 = 0.5;
const REACH: f64 = 0.4;
const STIFFNESS: f64 = 1e5;

fn rows() -> Outcome {
    let mut rows = Vec::new();
    for (file, name, radius) in [("point", "point", 0.0), ("ball_rough", "ball", 0.1)] {
        for (side, from) in [(1.0, "from above"), (-1.0, "from below")] {
            let force = force_beyond(file, side)?;
            let expected = side * STIFFNESS * (REACH + radius);
            rows.push(Row::relative(format!("{name} {from}: force"), "N", expected, force, 1e-12));
        }
    }
    Ok(rows)
}

/// Force along z on a mover whose centre is 0.4 m below the face on the `side` (±1).
fn force_beyond(file: &str, side: f64) -> Result<f64, Failure> {
    let duo = Duo::new(file, "tiles_rough")?.mover(|s| s.stiffness = f64::INFINITY)?;
    let (mut world, [mover, block]) = duo.ground(|s| s.stiffness = STIFFNESS)?.world()?;
    world.set_state(block, &State::identity())?;
    // The upper face is at z = 0.
    let face = if side > 0.0 { 0.0 } else { -THICKNESS };
    for step in -20..=40 {
        let z = face - side * 0.01 * f64::from(step);
        world.set_state(mover, &State { position: [0.3, 0.1, z], ..State::identity() })?;
        world.step()?;
    }
    Ok(world.wrench_common(mover)?.force.z)
}
