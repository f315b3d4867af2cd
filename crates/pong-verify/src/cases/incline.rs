//! V8 and W4: a block on an incline, held by a bristle, and creeping under regularised friction.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{radians, rotation};
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, Run, at, point_mass, set_damping, with_friction};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Vec3};

pub const V8: Case = Case {
    id: "V8",
    title: "Block on an incline",
    set_up: "1 kg on four points of 1e5 N/m each, μ = 0.5 at rest and in motion. The slope is raised slowly by turning \
             gravity; then the ground itself is tilted by 30°.",
    source: "holds below atan(μ_s) = 26.565°, slides above with g·(sin − μ_k·cos)",
    rows: incline,
};

pub const W4: Case = Case {
    id: "W4",
    title: "Regularised Coulomb friction creeps",
    set_up: "A point mass under friction `coulomb` with μ = 0.5 and v_ε = 1e-3 m/s on a slope of 20°, and sliding on \
             one of 40°.",
    source: "below v_ε the law is a damper: v = v_ε·tan(α)/μ; above it a = g·(sin − μ·cos)",
    rows: creep,
};

const MASS: f64 = 1.0;
const MU: f64 = 0.5;
const STEP: f64 = 1e-3;

fn block(ground: RigidBody, start: Pose) -> Result<Run, Failure> {
    let duo = Duo::new("block_rough", "ground_rough")?.mover(|s| set_damping(s, 200.0))?;
    let duo = with_friction(duo, &Bristle { mu: MU, excess: 0.0, stiffness: 6e4, damping: 120.0 })?;
    let body = RigidBody::free("block", MassProperties::cuboid(MASS, [0.2, 0.2, 0.1])).at(start);
    duo.simulate((Integrator::RungeKutta4, STEP), body, ground)
}

fn on_level() -> Pose {
    at(Vec3::z() * (0.05 - MASS * G / 4e5))
}

/// Gravity as on a slope that falls towards +x.
fn gravity(slope: f64) -> Vec3 {
    let (sine, cosine) = libm::sincos(slope);
    Vec3::new(G * sine, 0.0, -G * cosine)
}

fn incline() -> Outcome {
    let friction_angle = libm::atan(MU);
    let tenth = radians(0.1);
    let mut rows = vec![Row::absolute(
        "angle at which all points slip",
        "°",
        friction_angle.to_degrees(),
        break_away()?.to_degrees(),
        0.1,
    )];
    let mut held = raised_to(friction_angle - tenth, 2.0)?;
    let before = held.position();
    held.sim.run_for(1.0)?;
    let speed = (held.position() - before).norm();
    rows.push(Row::below("0.1° below: creep over 1 s", "m/s", speed, 1e-9));
    let mut loose = raised_to(friction_angle + tenth, 1.5)?;
    let expected = G * (libm::sin(friction_angle + tenth) - MU * libm::cos(friction_angle + tenth));
    rows.push(Row::relative(
        "0.1° above: acceleration",
        "m/s²",
        expected,
        acceleration(&mut loose, Vec3::x())?,
        1e-4,
    ));
    rows.push(slides_at_thirty()?);
    Ok(rows)
}

/// Raises the slope over a second, then waits.
fn raised_to(slope: f64, duration: f64) -> Result<Run, Failure> {
    let mut run = block(RigidBody::fixed("ground"), on_level())?;
    while run.sim.time() < duration {
        let share = (run.sim.time() + STEP).min(1.0);
        run.sim.set_gravity(gravity(slope * share * share * (3.0 - 2.0 * share)));
        run.sim.step()?;
    }
    Ok(run)
}

/// Raises the slope by 0.2° a second.
fn break_away() -> Result<f64, Failure> {
    let start = radians(26.0);
    let mut run = raised_to(start, 1.5)?;
    let begin = run.sim.time();
    loop {
        let slope = start + radians(0.2) * (run.sim.time() - begin);
        run.sim.set_gravity(gravity(slope));
        run.sim.step()?;
        if run.contacts().iter().all(|contact| !contact.sticks) {
            return Ok(slope);
        }
        if slope > radians(30.0) {
            return Err("the block never slips".into());
        }
    }
}

/// Mean acceleration along a direction over half a second.
fn acceleration(run: &mut Run, along: Vec3) -> Result<f64, Failure> {
    let before = run.velocity();
    run.sim.run_for(0.5)?;
    Ok((run.velocity() - before).dot(&along) / 0.5)
}

fn slides_at_thirty() -> Result<Row, Failure> {
    let slope = radians(30.0);
    let turn = rotation(Vec3::y() * slope);
    let ground = RigidBody::fixed("ground").at(Pose { position: Vec3::zeros(), orientation: turn });
    let start = Pose { position: turn * on_level().position, orientation: turn };
    let mut run = block(ground, start)?.with_gravity();
    run.sim.run_for(0.5)?;
    let expected = G * (libm::sin(slope) - MU * libm::cos(slope));
    let got = acceleration(&mut run, turn * Vec3::x())?;
    Ok(Row::relative("ground at 30°: acceleration", "m/s²", expected, got, 1e-6))
}

fn creep() -> Outcome {
    let on_slope = |degrees: f64| {
        let slope = radians(degrees);
        let turn = rotation(Vec3::y() * slope);
        let duo = Duo::new("point_coulomb", "ground_coulomb")?;
        let ground = RigidBody::fixed("ground").at(Pose { position: Vec3::zeros(), orientation: turn });
        let depth = MASS * G * libm::cos(slope) / 1e5;
        let body = point_mass(MASS).at(at(turn * (Vec3::z() * -depth)));
        // The law is a stiff damper: μ·N·dt/(m·v_ε) must stay below 2.8.
        let mut run = duo.simulate((Integrator::RungeKutta4, 2e-4), body, ground)?.with_gravity();
        run.sim.run_for(0.5)?;
        Ok::<_, Failure>((run, turn * Vec3::x()))
    };
    let (held, down) = on_slope(20.0)?;
    let (mut loose, fast_down) = on_slope(40.0)?;
    let slope = radians(40.0);
    let expected = G * (libm::sin(slope) - MU * libm::cos(slope));
    Ok(vec![
        Row::relative(
            "creep at 20°",
            "m/s",
            1e-3 * libm::tan(radians(20.0)) / MU,
            held.velocity().dot(&down),
            1e-6,
        ),
        Row::relative("acceleration at 40°", "m/s²", expected, acceleration(&mut loose, fast_down)?, 1e-6),
    ])
}
