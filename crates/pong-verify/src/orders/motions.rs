//! Motions for the observation of orders.

use crate::case::Failure;
use crate::measure::{radians, rotation};
use crate::scene::{Bristle, Duo, G, Run, at, moving, point_mass, set_spring, with_friction};
use pong_engine::State;
use pong_executive::{Integrator, Load, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};

type Method = (Integrator, f64);

/// A motion in contact.
pub(super) struct Motion {
    pub name: &'static str,
    /// Order promised by the theory manual under Runge-Kutta 4, without unit.
    pub promised: f64,
    /// Duration, s.
    pub duration: f64,
    /// Number of start phases within a step.
    pub phases: u32,
    /// Reference step, far below those observed, s.
    pub reference_step: f64,
    /// Lever that converts spins to speeds, m.
    pub lever: f64,
    /// Sets up the motion at a phase, 0…1.
    pub start: fn(f64, Method) -> Result<Run, Failure>,
}

/// Motions without an onset of contact need one phase only.
const SMOOTH: Motion = Motion {
    name: "",
    promised: 2.0,
    duration: 0.1,
    phases: 1,
    reference_step: 1e-3 / 64.0,
    lever: 0.0,
    start: |_, _| Err("no motion".into()),
};

pub(super) const MOTIONS: [Motion; 13] = [
    Motion { name: "drop, undamped", duration: 0.045, phases: 16, start: |p, m| drop(0.0, p, m), ..SMOOTH },
    Motion {
        name: "drop, damped: the force jumps at touch",
        promised: 1.0,
        duration: 0.045,
        phases: 16,
        start: |p, m| drop(60.0, p, m),
        ..SMOOTH
    },
    Motion { name: "sticks in its place", promised: 4.0, start: sticks, ..SMOOTH },
    Motion { name: "slides straight, bristle on its circle", promised: 4.0, start: slides, ..SMOOTH },
    Motion { name: "begins to slide, bristle at rest", promised: 1.0, start: begins_to_slide, ..SMOOTH },
    Motion { name: "slips along a turning path", duration: 0.4, start: turns, ..SMOOTH },
    Motion { name: "rolls straight", promised: 4.0, duration: 0.2, lever: RADIUS, start: rolls, ..SMOOTH },
    Motion {
        name: "rolls with spin on a plane",
        duration: 0.2,
        lever: RADIUS,
        start: rolls_on_plane,
        ..SMOOTH
    },
    Motion {
        name: "rolls with spin on a ball",
        duration: 0.2,
        lever: RADIUS,
        start: rolls_on_ball,
        ..SMOOTH
    },
    Motion {
        name: "ellipsoid rolls with spin on a plane",
        duration: 0.2,
        lever: 0.25,
        start: egg_rolls,
        ..SMOOTH
    },
    Motion {
        name: "touches down and sticks",
        duration: 0.04,
        phases: 16,
        lever: RADIUS,
        start: touches_down,
        ..SMOOTH
    },
    Motion {
        name: "stick-slip, μ_s = μ_k",
        duration: 0.15,
        phases: 32,
        start: |p, m| stick_slip(0.0, p, m),
        ..SMOOTH
    },
    Motion {
        name: "stick-slip, μ_s = 1.25·μ_k: the force jumps at break-away",
        promised: 1.0,
        duration: 0.15,
        phases: 8,
        reference_step: 4e-6,
        start: |p, m| stick_slip(0.25, p, m),
        ..SMOOTH
    },
];

const MASS: f64 = 1.0;
const RADIUS: f64 = 0.1;
/// Stiffness of the pair, N/m: ω is 100 rad/s, so that 1 ms resolves it.
const STIFFNESS: f64 = 1e4;
const DEPTH: f64 = MASS * G / STIFFNESS;

/// A soft body against a rigid one, with some normal damping.
fn duo(soft: &str, rigid: &str, damping: f64, bristle: &Bristle) -> Result<Duo, Failure> {
    let duo = Duo::new(soft, rigid)?.mover(|s| set_spring(s, STIFFNESS, damping))?;
    with_friction(duo, bristle)
}

fn bristle(mu: f64, stiffness: f64) -> Bristle {
    Bristle { mu, excess: 0.0, stiffness, damping: 0.0 }
}

/// A mass that falls on ground, observed until it turns back, so that it includes one onset of contact; the
/// phase is a fraction of the longest step's distance.
fn drop(damping: f64, phase: f64, method: Method) -> Result<Run, Failure> {
    let duo = Duo::new("point", "ground")?.mover(|s| set_spring(s, STIFFNESS, damping))?;
    let body = point_mass(MASS).at(at(Vec3::z() * (0.01 - 6e-4 * phase))).moving(moving(Vec3::z() * -0.3));
    Ok(duo.on_ground(method, body)?.with_gravity())
}

/// A mass at rest on a bristle, pulled to and fro by a load within its limit.
fn sticks(_: f64, method: Method) -> Result<Run, Failure> {
    let duo = duo("point_rough", "ground_rough", 20.0, &bristle(0.5, STIFFNESS))?;
    let body = point_mass(MASS).at(at(Vec3::z() * -DEPTH));
    let mut run = duo.on_ground(method, body)?.with_gravity();
    let pull = |time: f64| Vec3::new(2.0 * libm::sin(40.0 * time), 1.5 * (1.0 - libm::cos(30.0 * time)), 0.0);
    run.sim.add_load(Load::force_over_time(run.body, pull))?;
    Ok(run)
}

/// A mass in slip, whose bristle two commits of the host have stretched to its limit along the velocity.
fn drawn(duo: Duo, body: RigidBody, method: Method) -> Result<Run, Failure> {
    let (mut world, [mover, ground]) = duo.world()?;
    let way = body.twist.linear.normalize() * 0.05;
    for back in [1.0, 0.0] {
        let pose = at(body.pose.position - way * back);
        world.set_states(&[(mover, State::from_motion(&pose, &body.twist)), (ground, State::identity())])?;
        world.step()?;
    }
    let mut sim = Simulation::new(world, method.0, method.1)?;
    let body = sim.add_body(body.touching(mover))?;
    let ground = sim.add_body(RigidBody::fixed("ground").touching(ground))?;
    Ok(Run { sim, body, ground }.with_gravity())
}

fn slides(_: f64, method: Method) -> Result<Run, Failure> {
    let duo = duo("point_rough", "ground_rough", 0.0, &bristle(0.2, 1e5))?;
    let body = point_mass(MASS).at(at(Vec3::z() * (-1.4 * DEPTH))).moving(moving(Vec3::x()));
    drawn(duo, body, method)
}

fn begins_to_slide(_: f64, method: Method) -> Result<Run, Failure> {
    let duo = duo("point_rough", "ground_rough", 0.0, &bristle(0.2, 1e5))?;
    let body = point_mass(MASS).at(at(Vec3::z() * -DEPTH)).moving(moving(Vec3::x()));
    Ok(duo.on_ground(method, body)?.with_gravity())
}

fn turns(_: f64, method: Method) -> Result<Run, Failure> {
    let duo = duo("point_rough", "ground_rough", 20.0, &bristle(0.2, 1e4))?;
    let body = point_mass(MASS).at(at(Vec3::z() * -DEPTH)).moving(moving(Vec3::x()));
    let mut run = drawn(duo, body, method)?;
    run.sim.add_load(Load::force(run.body, Vec3::new(-0.3, 1.5, 0.0)))?;
    Ok(run)
}

/// A rigid ball or ellipsoid on a compliant body at rest.
fn rolling(
    files: [&str; 2],
    body: RigidBody,
    ground: Pose,
    bristle: &Bristle,
    method: Method,
) -> Result<Run, Failure> {
    let ground = RigidBody::fixed("ground").at(ground);
    let run = duo(files[0], files[1], 20.0, bristle)?.simulate(method, ground, body)?;
    Ok(Run { body: run.ground, ground: run.body, sim: run.sim }.with_gravity())
}

fn ball(place: Vec3, velocity: Vec3, spin: Vec3) -> RigidBody {
    let twist = Twist { linear: velocity, angular: spin };
    RigidBody::free("ball", MassProperties::sphere(MASS, RADIUS)).at(at(place)).moving(twist)
}

fn rolls(_: f64, method: Method) -> Result<Run, Failure> {
    let turn = rotation(Vec3::y() * radians(15.0));
    let height = RADIUS - DEPTH * libm::cos(radians(15.0));
    let ball = RigidBody::free("ball", MassProperties::sphere(MASS, RADIUS))
        .at(Pose { position: turn * (Vec3::z() * height), orientation: turn });
    let ground = Pose { position: Vec3::zeros(), orientation: turn };
    rolling(["ground_rough", "ball_rough"], ball, ground, &bristle(0.5, STIFFNESS), method)
}

/// Spins about the normal while a load changes direction; rolls without slip at the start.
fn rolls_on_plane(_: f64, method: Method) -> Result<Run, Failure> {
    let ball = ball(Vec3::z() * (RADIUS - DEPTH), Vec3::x() * 0.5, Vec3::new(0.0, 5.0, 20.0));
    let ground = Pose::identity();
    let mut run = rolling(["ground_rough", "ball_rough"], ball, ground, &bristle(2.0, STIFFNESS), method)?;
    run.sim.add_load(Load::force_over_time(run.body, |time| {
        Vec3::new(0.0, 3.0 * libm::cos(20.0 * time), 0.0)
    }))?;
    Ok(run)
}

/// Rolls off the top of a ball of 1 m, with spin about the normal.
fn rolls_on_ball(_: f64, method: Method) -> Result<Run, Failure> {
    let ball = ball(Vec3::z() * (1.0 + RADIUS - DEPTH), Vec3::x() * 0.5, Vec3::new(0.0, 5.0, 20.0));
    let files = ["ball_large_rough", "ball_rough"];
    rolling(files, ball, Pose::identity(), &bristle(2.0, STIFFNESS), method)
}

fn egg_rolls(_: f64, method: Method) -> Result<Run, Failure> {
    let twist = Twist { linear: Vec3::x() * 0.4, angular: Vec3::new(0.0, 2.0, 6.0) };
    let mass = MassProperties::principal(MASS, [0.0205, 0.026, 0.0305]);
    let egg = RigidBody::free("egg", mass).at(at(Vec3::z() * (0.2 - DEPTH))).moving(twist);
    rolling(["ground_rough", "ellipsoid_rough"], egg, Pose::identity(), &bristle(2.0, STIFFNESS), method)
}

/// A ball that lands with tangential velocity and spin, and sticks from the first contact.
fn touches_down(phase: f64, method: Method) -> Result<Run, Failure> {
    let place = Vec3::z() * (RADIUS + 0.01 - 6e-4 * phase);
    let ball = ball(place, Vec3::new(0.2, 0.1, -0.3), Vec3::z() * 3.0);
    let bristle = Bristle { mu: 5.0, excess: 0.0, stiffness: 0.5 * STIFFNESS, damping: 0.0 };
    let ground = RigidBody::fixed("ground");
    let run = duo("ground_rough", "ball_rough", 0.0, &bristle)?.simulate(method, ground, ball)?;
    Ok(Run { body: run.ground, ground: run.body, sim: run.sim }.with_gravity())
}

/// A load exceeds the limit and fades once: the mass sticks, slips and sticks. Its phase moves break-away and
/// stop within the step, and against each other.
fn stick_slip(excess: f64, phase: f64, method: Method) -> Result<Run, Failure> {
    let bristle = Bristle { mu: 0.2, excess, stiffness: STIFFNESS, damping: 20.0 };
    let duo = duo("point_rough", "ground_rough", 20.0, &bristle)?;
    let body = point_mass(MASS).at(at(Vec3::z() * -DEPTH));
    let mut run = duo.on_ground(method, body)?.with_gravity();
    let pull = move |time: f64| {
        let swell = libm::sin((30.0 + 2.0 * phase) * time);
        Vec3::x() * (3.0 * swell * swell)
    };
    run.sim.add_load(Load::force_over_time(run.body, pull))?;
    Ok(run)
}
