//! V10, V11: a rigid ball on compliant ground, slipping and rolling.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{radians, rotation};
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, Run, moving, set_spring, with_friction};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Vec3};

pub const V10: Case = Case {
    id: "V10",
    title: "Sphere from slipping to rolling",
    set_up: "1 kg, radius 0.1 m, v = 1 m/s without spin, μ = 0.3, rigid ball on ground of 1.5e6 N/m, bristle damped \
             near critical, Runge-Kutta, dt 1e-4 s.",
    source: "slips for t = 2v/(7μg) over x = 12v²/(49μg), then rolls with 5v/7",
    rows: slip_to_roll,
};

pub const V11: Case = Case {
    id: "V11",
    title: "Sphere rolls down a slope",
    set_up: "1 kg, radius 0.1 m, from rest on slopes of 10° and 30° to 100 rad/s, μ = 0.3, rigid ball on ground of 1e5 \
             N/m, bristle damped near critical, Runge-Kutta, dt 1e-3 s.",
    source: "a = (5/7)·g·sin α, friction (2/7)·m·g·sin α",
    rows: down_slopes,
};

pub const MASS: f64 = 1.0;
pub const RADIUS: f64 = 0.1;
/// Effective mass of a free ball at its contact point: 1/m + R²/I = 7/(2m).
const RIM_MASS: f64 = 2.0 / 7.0 * MASS;

/// A rigid ball at rest at `x` on the ground of a file, with a stiffness and a slope about y.
pub fn ball_on(
    ground: &str,
    (stiffness, mu): (f64, f64),
    slope: f64,
    (x, speed): (f64, f64),
    method: (Integrator, f64),
) -> Result<Run, Failure> {
    let bristle_stiffness = 2.0 / 3.0 * stiffness;
    let bristle = Bristle {
        mu,
        excess: 0.0,
        stiffness: bristle_stiffness,
        damping: 2.0 * (bristle_stiffness * RIM_MASS).sqrt(),
    };
    // The ball's surface is rigid, so the ground's values are those of the pair.
    let duo = Duo::new(ground, "ball_rough")?;
    let duo =
        with_friction(duo, &bristle)?.mover(|s| set_spring(s, stiffness, 1.4 * (stiffness * MASS).sqrt()))?;
    let turn = rotation(Vec3::y() * slope);
    let depth = MASS * G * libm::cos(slope) / stiffness;
    let ball = RigidBody::free("ball", MassProperties::sphere(MASS, RADIUS))
        .at(Pose { position: turn * Vec3::new(x, 0.0, RADIUS - depth), orientation: turn })
        .moving(moving(turn * (Vec3::x() * speed)));
    let fixed = RigidBody::fixed("ground").at(Pose { position: Vec3::zeros(), orientation: turn });
    // The ground is the first Object here, the ball the second.
    let run = duo.simulate(method, fixed, ball)?;
    Ok(Run { body: run.ground, ground: run.body, sim: run.sim }.with_gravity())
}

fn slip_to_roll() -> Outcome {
    let (mu, speed, step) = (0.3, 1.0, 1e-4);
    let mut run = ball_on("ground_rough", (1.5e6, mu), 0.0, (0.0, speed), (Integrator::RungeKutta4, step))?;
    let (mut slipped, mut end) = (false, None);
    while run.sim.time() < 0.3 {
        run.sim.step()?;
        let sticks = run.contact()?.sticks;
        slipped |= !sticks;
        if slipped && sticks && end.is_none() {
            end = Some((run.sim.time(), run.position().x));
        }
    }
    let (time, place) = end.ok_or("the ball never rolls")?;
    let rolling = 5.0 / 7.0 * speed;
    Ok(vec![
        Row::absolute("time of slipping", "s", 2.0 * speed / (7.0 * mu * G), time, 2.0 * step),
        Row::absolute(
            "way while slipping",
            "m",
            12.0 * speed * speed / (49.0 * mu * G),
            place,
            2.0 * step * speed,
        ),
        Row::relative("speed of rolling", "m/s", rolling, run.velocity().x, 1e-9),
        Row::relative("spin of rolling", "rad/s", rolling / RADIUS, run.spin().y, 1e-9),
    ])
}

fn down_slopes() -> Outcome {
    let mut rows = down_slope("ground_rough", 10.0, 100.0, 0.0)?;
    rows.extend(down_slope("ground_rough", 30.0, 100.0, 0.0)?);
    Ok(rows)
}

/// Rolls from rest to a spin (rad/s): acceleration over the whole path, friction at low and at high speed.
pub fn down_slope(ground: &str, degrees: f64, fastest: f64, x: f64) -> Result<Vec<Row>, Failure> {
    let slope = radians(degrees);
    let mut run = ball_on(ground, (1e5, 0.3), slope, (x, 0.0), (Integrator::RungeKutta4, 1e-3))?;
    run.sim.run_for(0.1)?;
    let (begin, before) = (run.sim.time(), run.velocity());
    let early = run.sim.world().contacts().iter().map(|c| c.friction_force).sum::<Vec3>().norm();
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    while run.spin().norm() < fastest {
        run.sim.step()?;
        let friction = run.sim.world().contacts().iter().map(|c| c.friction_force).sum::<Vec3>().norm();
        (least, most) = (least.min(friction), most.max(friction));
        if run.sim.time() > 60.0 {
            return Err("the ball does not get up to speed".into());
        }
    }
    let gained = (run.velocity() - before).norm() / (run.sim.time() - begin);
    let drive = G * libm::sin(slope);
    let friction = 2.0 / 7.0 * MASS * drive;
    Ok(vec![
        Row::relative(format!("{degrees}°: acceleration"), "m/s²", 5.0 / 7.0 * drive, gained, 1e-4),
        Row::relative(format!("{degrees}°: friction, early"), "N", friction, early, 1e-4),
        Row::relative(format!("{degrees}°: friction, least"), "N", friction, least, 1e-4),
        Row::relative(format!("{degrees}°: friction, most, to {fastest} rad/s"), "N", friction, most, 1e-4),
    ])
}
