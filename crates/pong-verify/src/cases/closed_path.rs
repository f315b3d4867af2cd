//! W10: without friction and damping the net work over a closed path is zero.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{order, rotation};
use crate::row::Row;
use crate::scene::{Duo, at};
use pong_engine::State;
use pong_executive::{Pose, Twist, Vec3};

pub const W10: Case = Case {
    id: "W10",
    title: "Closed paths gain nothing",
    set_up: "An ellipsoid led and turned once round the corner of an octahedron, a ball round the same corner, and an \
             ellipsoid led and turned over a plane, in 4,000 steps, without friction and damping. Net work by the \
             engine's ledger over the largest energy stored.",
    source: "the force is the gradient of ½·k·δ²; the ledger's trapezoid rule leaves an error of second order",
    rows,
};

/// Pose by an angle; a whole turn closes the path.
type PathOfPose = fn(f64) -> Pose;

/// Net work over one turn of the path, over the largest energy stored.
fn net(mover: &str, ground: &str, path: PathOfPose, steps: u32) -> Result<f64, Failure> {
    let duo = Duo::with_ledger(mover, ground, true)?;
    let duo = if mover == "ball_rough" { duo.ground(|s| s.stiffness = 1e5)? } else { duo };
    let (mut world, [body, ground]) = duo.world()?;
    world.set_state(ground, &State::identity())?;
    let (mut largest, mut start) = (0.0_f64, 0.0);
    for step in 0..=steps {
        let angle = core::f64::consts::TAU * f64::from(step) / f64::from(steps);
        world.set_state(body, &State::from_motion(&path(angle), &Twist::zero()))?;
        world.step()?;
        largest = largest.max(world.ledger().stored);
        if step == 0 {
            start = world.ledger().work;
        }
    }
    if largest == 0.0 {
        return Err("the path touches nothing".into());
    }
    Ok((world.ledger().work - start) / largest)
}

fn round_corner(angle: f64) -> Pose {
    let (sine, cosine) = libm::sincos(angle);
    at(Vec3::new(0.8 + 0.01 * sine, 0.08 * cosine, 0.07 * sine))
}

fn turning_round_corner(angle: f64) -> Pose {
    let (sine, cosine) = libm::sincos(angle);
    let orientation = rotation(Vec3::new(0.5 * sine, 0.4 * cosine, -0.3 * sine));
    Pose { position: Vec3::new(1.02 + 0.02 * sine, 0.1 * cosine, 0.09 * sine), orientation }
}

fn over_plane(angle: f64) -> Pose {
    let (sine, cosine) = libm::sincos(angle);
    let orientation = rotation(Vec3::new(1.2 * sine, 0.9 * (1.0 - cosine), 0.4 * sine));
    Pose { position: Vec3::new(0.3 * sine, 0.0, 0.21 + 0.03 * cosine), orientation }
}

fn rows() -> Outcome {
    let cases: [(&str, &str, &str, PathOfPose); 3] = [
        ("ball round a corner", "ball_rough", "target_polyhedron", round_corner),
        ("ellipsoid round a corner", "ellipsoid", "target_polyhedron", turning_round_corner),
        ("ellipsoid over a plane", "ellipsoid", "ground", over_plane),
    ];
    let mut rows = Vec::new();
    for (name, mover, ground, path) in cases {
        let errors = [500, 1000].map(|steps| net(mover, ground, path, steps));
        let [coarse, fine] = errors;
        let got = net(mover, ground, path, 4000)?;
        let (coarse, fine) = (coarse?, fine?);
        let row = Row::below(format!("{name}: net work"), "", got.abs(), 1e-6);
        // Errors of rounding alone have no order.
        rows.push(if fine.abs() > 1e-12 { row.with_order(order(coarse, fine)) } else { row });
    }
    Ok(rows)
}
