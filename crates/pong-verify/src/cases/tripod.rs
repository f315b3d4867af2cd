//! V2: three feet on a plane.
//!
//! Feet at r_i on a circle of radius R, Σ r_i·r_iᵀ = ½·3R², so that a moment M about the middle gives the
//! loads N_i = N/3 + k·(r_i·θ) with the tilt θ from 1.5·k·R²·θ = M, with M taken at the tilted position.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{Crossings, radians, rotation};
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, Run, at, set_damping, with_friction};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Vec3};

pub const V2: Case = Case {
    id: "V2",
    title: "Tripod on a plane",
    set_up: "3 kg on three feet of 1e6 N/m each, on a circle of radius 0.5 m, mass centre 0.3 m above the feet: level, \
             with the mass centre 0.1 m off, on a plane tilted by 10°; then undamped, heaving and rocking.",
    source: "loads from the moment balance; heave ω = √(3k/m), rock ω = √((1.5kR² − mgh)/I)",
    rows,
};

const MASS: f64 = 3.0;
const STIFFNESS: f64 = 1e6;
const RADIUS: f64 = 0.5;
const HEIGHT: f64 = 0.3;
const INERTIA: [f64; 3] = [0.2, 0.2, 0.3];
/// 1.5·k·R², N·m/rad.
const TURNING: f64 = 1.5 * STIFFNESS * RADIUS * RADIUS;
const REST_DEPTH: f64 = MASS * G / (3.0 * STIFFNESS);

fn rows() -> Outcome {
    let mut rows = level(Vec3::zeros(), "centred")?;
    rows.extend(level(Vec3::new(0.08, -0.06, 0.0), "mass centre off")?);
    rows.extend(tilted(10.0)?);
    rows.push(heave()?);
    rows.push(rock()?);
    Ok(rows)
}

fn feet() -> [Vec3; 3] {
    [0.0, 1.0, 2.0].map(|i| {
        let (sine, cosine) = libm::sincos(i * core::f64::consts::TAU / 3.0);
        Vec3::new(RADIUS * cosine, RADIUS * sine, 0.0)
    })
}

fn body(mass_center: Vec3) -> RigidBody {
    RigidBody::free("tripod", MassProperties::principal(MASS, INERTIA).with_mass_center(mass_center))
}

/// Loads by foot, N.
fn load_rows(what: &str, run: &Run, expected: [f64; 3]) -> Vec<Row> {
    let contacts = run.contacts();
    (0..3)
        .map(|i| {
            let load: f64 =
                contacts.iter().filter(|c| c.a.primitive == i as u32).map(|c| c.normal_force).sum();
            Row::relative(format!("{what}: load of foot {i}"), "N", expected[i], load, 1e-6)
        })
        .collect()
}

/// Rest on a level plane; `offset` of the mass centre lies in the plane, from the middle of the feet.
fn level(offset: Vec3, what: &str) -> Result<Vec<Row>, Failure> {
    let duo = Duo::new("tripod", "ground")?.mover(|s| set_damping(s, 2000.0))?;
    let start = body(offset).at(at(Vec3::z() * (HEIGHT - REST_DEPTH)));
    let mut run = duo.on_ground((Integrator::RungeKutta4, 2e-4), start)?.with_gravity();
    run.sim.run_for(0.3)?;
    // The tilt moves the mass centre, h above the feet, further out.
    let tilt = offset * (MASS * G / (TURNING - MASS * G * HEIGHT));
    Ok(load_rows(what, &run, feet().map(|foot| MASS * G / 3.0 + STIFFNESS * foot.dot(&tilt))))
}

fn tilted(degrees: f64) -> Result<Vec<Row>, Failure> {
    let slope = radians(degrees);
    let (sine, cosine) = libm::sincos(slope);
    let bristle = Bristle { mu: 0.8, excess: 0.0, stiffness: 1e6, damping: 2000.0 };
    let duo = with_friction(
        Duo::new("tripod_rough", "ground_rough")?.mover(|s| set_damping(s, 2000.0))?,
        &bristle,
    )?;
    // About y: the plane slopes down towards +x.
    let turn = rotation(Vec3::y() * slope);
    let ground = RigidBody::fixed("ground").at(Pose { position: Vec3::zeros(), orientation: turn });
    let start = body(Vec3::zeros())
        .at(Pose { position: turn * (Vec3::z() * (HEIGHT - REST_DEPTH * cosine)), orientation: turn });
    let mut run = duo.simulate((Integrator::RungeKutta4, 2e-4), start, ground)?.with_gravity();
    run.sim.run_for(0.3)?;
    let (down, along) = (MASS * G * cosine, MASS * G * sine);
    // Friction acts in the plane, which is the depth above the tips.
    let arm = HEIGHT - down / (3.0 * STIFFNESS);
    let tilt = along * arm / (TURNING - down * arm);
    let expected = feet().map(|foot| down / 3.0 + STIFFNESS * foot.x * tilt);
    Ok(load_rows("plane at 10°", &run, expected))
}

/// Circular frequency of a component, from 20 periods of small motion about rest.
fn frequency(start: RigidBody, omega: f64, sample: impl Fn(&Run) -> (f64, f64)) -> Result<f64, Failure> {
    let step = 0.05 / omega;
    let duo = Duo::new("tripod", "ground")?;
    let mut run = duo.on_ground((Integrator::RungeKutta4, step), start)?.with_gravity();
    let mut crossings = Crossings::default();
    while crossings.times.len() < 21 && run.sim.time() < 200.0 / omega {
        run.sim.step()?;
        let (value, rate) = sample(&run);
        crossings.push(run.sim.time(), value, rate);
    }
    Ok(core::f64::consts::TAU / crossings.period())
}

fn heave() -> Result<Row, Failure> {
    let omega = (3.0 * STIFFNESS / MASS).sqrt();
    let rest = HEIGHT - REST_DEPTH;
    let start = body(Vec3::zeros()).at(at(Vec3::z() * (rest + 0.5 * REST_DEPTH)));
    let got = frequency(start, omega, |run| (run.position().z - rest, run.velocity().z))?;
    Ok(Row::relative("heave: circular frequency", "rad/s", omega, got, 1e-6))
}

fn rock() -> Result<Row, Failure> {
    let omega = ((TURNING - MASS * G * HEIGHT) / INERTIA[1]).sqrt();
    // No foot may leave the plane.
    let angle = 0.5 * REST_DEPTH / RADIUS;
    let start = body(Vec3::zeros())
        .at(Pose { position: Vec3::z() * (HEIGHT - REST_DEPTH), orientation: rotation(Vec3::y() * angle) });
    let got = frequency(start, omega, |run| (2.0 * run.sim.pose(run.body).orientation.j, run.spin().y))?;
    Ok(Row::relative("rock: circular frequency", "rad/s", omega, got, 1e-6))
}
