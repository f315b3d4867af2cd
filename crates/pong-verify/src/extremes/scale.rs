//! Sizes, stiffness, mass ratios.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, block, model, sheet};
use crate::case::{Failure, Outcome};
use crate::measure::rotation;
use crate::row::Row;
use crate::scene::{Duo, Run, moving};
use pong_executive::{Integrator, MassProperties, Pose, Quat, RigidBody, Vec3, Wrench};
use pong_testkit::Random;
use pong_testkit::ron::place_of;

pub const SIZES: Extreme = Extreme {
    id: "E2",
    asked: "Sizes 1e-4 m to 1e4 m, stiffness 1 to 1e12 N/m: scaling the scene scales the result to 1e-10.",
    set_up: "A point, a line segment, a sphere and an ellipsoid on a box, a wavy sheet and a plane, with damping and \
             friction; 40 steps of rough motion, in five sizes and three stiffnesses each, compared with the same at \
             1 m and 1e5 N/m.",
    answer: Answer::Safe,
    limit: "none in this range: no tolerance of the engine is absolute",
    also: "`crates/pong-engine/tests/it/invariance.rs`, `crates/pong-geometry/tests/it/features_scaling.rs`",
    rows: sizes,
};

pub const MASSES: Extreme = Extreme {
    id: "E3",
    asked: "Mass ratios of 1e6: no special case.",
    set_up: "An undamped collision of two spheres at 2 m/s, 1 kg and 1e6 kg, 1 mg and 1 kg, Runge-Kutta at ω·dt = \
             0.01, compared with momentum and energy balance.",
    answer: Answer::Safe,
    limit: "masses belong to the host; its step has to suit the lighter body",
    also: "cases V7 and W8",
    rows: masses,
};

const STIFFNESS: f64 = 1e5;

fn scene(size: f64, stiffness: f64) -> Result<Rig, Failure> {
    let damping = 3e-3 * stiffness;
    let surface = format!(
        "stiffness: {stiffness:?}, normal: Linear(damping: {damping:?}), \
         friction: Bristle(mu: 0.3, static_excess: 0.2, damping: {:?})",
        0.1 * damping
    );
    let v = |x: f64, y: f64, z: f64| place_of(&(Vec3::new(x, y, z) * size));
    let movers = [
        format!("Point(name: \"p\", position: {})", v(0.02, 0.01, -0.205)),
        format!("LineSegment(name: \"l\", ends: ({}, {}))", v(-0.3, 0.1, -0.202), v(0.25, -0.1, -0.207)),
        format!("Sphere(name: \"b\", center: {}, radius: {:?})", v(-0.15, 0.15, -0.05), 0.17 * size),
        format!(
            "Ellipsoid(name: \"e\", center: {}, semi_axes: {}, orientation: (0.9,0.1,0.3,0.3))",
            v(0.15, -0.15, -0.08),
            v(0.2, 0.12, 0.15)
        ),
    ];
    let wave = |x: f64, y: f64| Vec3::new(x, y, -0.195 + 0.02 * x * y) * size;
    let grounds = [
        block("box", Vec3::new(0.0, 0.0, -0.3) * size, Vec3::new(0.5, 0.5, 0.1) * size, |p| p),
        format!("Plane(name: \"floor\", normal: (0.05,-0.02,1.0), offset: {:?})", -0.199 * size),
        sheet("mesh", "", 6, wave),
    ];
    Rig::new(&model(&surface, &movers.join(",")), &model(&surface, &grounds.join(",")))
}

fn wrenches(size: f64, stiffness: f64) -> Result<Vec<Wrench>, Failure> {
    let mut rig = scene(size, stiffness)?;
    let mut random = Random(2);
    (0..40)
        .map(|_| {
            let (place, turn) = (random.vector(0.01), rotation(random.vector(0.05)));
            rig.step(place * size, turn, random.vector(0.05) * size)
        })
        .collect()
}

fn sizes(_: Length) -> Outcome {
    let expected = wrenches(1.0, STIFFNESS)?;
    let mut rows = Vec::new();
    for size in [1e-4, 1e-2, 1.0, 1e2, 1e4] {
        for stiffness in [1.0, STIFFNESS, 1e12] {
            let force = size * stiffness / STIFFNESS;
            let got = wrenches(size, stiffness)?;
            let off = got.iter().zip(&expected).map(|(got, expected)| {
                let whole = expected.force.norm();
                let forces = (got.force / force - expected.force).norm();
                forces.max((got.moment / (force * size) - expected.moment).norm()) / whole
            });
            let worst = off.fold(0.0, f64::max);
            rows.push(Row::below(
                format!("{size:e} m, {stiffness:e} N/m: worst difference"),
                "",
                worst,
                1e-10,
            ));
        }
    }
    Ok(rows)
}

fn masses(_: Length) -> Outcome {
    let mut rows = Vec::new();
    for (light, heavy) in [(1.0, 1e6), (1e-6, 1.0)] {
        let mut run = collision(light, heavy)?;
        run.sim.run_for(0.2 + 4.0 * (light / 3502.5f64).sqrt())?;
        let (small, large) = (run.velocity().x, run.sim.twist(run.ground).linear.x);
        let name = format!("{light:e} kg on {heavy:e} kg");
        let sum = light + heavy;
        rows.push(Row::relative(
            format!("{name}: rebound of the light one"),
            "m/s",
            2.0 * (light - heavy) / sum,
            small,
            1e-4,
        ));
        rows.push(Row::relative(
            format!("{name}: speed of the heavy one"),
            "m/s",
            4.0 * light / sum,
            large,
            1e-4,
        ));
        let momentum = (light * small + heavy * large) / (2.0 * light) - 1.0;
        rows.push(Row::below(
            format!("{name}: change of momentum over that of the light one"),
            "",
            momentum.abs(),
            1e-9,
        ));
    }
    Ok(rows)
}

/// Two balls of radius 1 m just before contact: the light one, which moves, and the heavy one.
fn collision(light: f64, heavy: f64) -> Result<Run, Failure> {
    let step = 0.01 * (light / 3502.5f64).sqrt();
    let ball = |name: &str, mass: f64, x: f64, speed: f64| {
        RigidBody::free(name, MassProperties::sphere(mass, 1.0))
            .at(Pose { position: Vec3::x() * x, orientation: Quat::identity() })
            .moving(moving(Vec3::x() * speed))
    };
    let duo = Duo::new("ball", "ball")?;
    duo.simulate(
        (Integrator::RungeKutta4, step),
        ball("light", light, -2.0 - step, 2.0),
        ball("heavy", heavy, 0.0, 0.0),
    )
}
