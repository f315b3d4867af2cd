//! A host that integrates by the classical Runge–Kutta method: evaluate at each stage, commit at the end of a step.
//!
//! A ball of 1 kg rests on the ground and is released 0.3 mm above its rest. It never leaves the ground, so it is a
//! damped oscillator, whose motion has a closed form. Run the example in the folder of the two models.

use pong::{Config, InterfaceId, Load, State, World, WorldBuilder};

const MASS: f64 = 1.0; // kg
const GRAVITY: f64 = 9.81; // m/s²
const STIFFNESS: f64 = 2e4; // N/m, of ball.ron
const DAMPING: f64 = 30.0; // N·s/m, of ball.ron
const RADIUS: f64 = 0.1; // m
const OFFSET: f64 = 3e-4; // m, above the rest at the start
const STEP: f64 = 5e-4; // s
const STEPS: u32 = 100;

/// Height (m) and vertical velocity (m/s) of the ball.
type Motion = [f64; 2];

fn main() -> Result<(), pong::Error> {
    let (mut world, ball) = ball_on_ground()?;
    let mut motion = [rest() + OFFSET, 0.0];
    for _ in 0..STEPS {
        motion = step(&mut world, ball, motion)?;
    }
    let time = f64::from(STEPS) * STEP;
    let exact = closed_form(time);
    println!("height after {time:.3} s: {:.6} m", motion[0]);
    println!("closed form: {exact:.6} m, difference below 1 nm: {}", (motion[0] - exact).abs() < 1e-9);
    Ok(())
}

/// One step of the method. The world forgets the stages; only the commit changes its contact state.
fn step(world: &mut World, ball: InterfaceId, start: Motion) -> Result<Motion, pong::Error> {
    let k1 = derivative(world, ball, start)?;
    let k2 = derivative(world, ball, advanced(start, k1, STEP / 2.0))?;
    let k3 = derivative(world, ball, advanced(start, k2, STEP / 2.0))?;
    let k4 = derivative(world, ball, advanced(start, k3, STEP))?;
    let mean = [0, 1].map(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
    let end = advanced(start, mean, STEP);
    world.set_state(ball, &state(end))?;
    world.commit()?;
    Ok(end)
}

/// Velocity and acceleration of the ball: the contact force at this motion, and gravity.
fn derivative(world: &mut World, ball: InterfaceId, motion: Motion) -> Result<Motion, pong::Error> {
    world.set_state(ball, &state(motion))?;
    world.evaluate()?;
    Ok([motion[1], world.wrench_common(ball)?.force.z / MASS - GRAVITY])
}

fn advanced(from: Motion, rate: Motion, time: f64) -> Motion {
    [from[0] + time * rate[0], from[1] + time * rate[1]]
}

fn state([height, velocity]: Motion) -> State {
    let (position, linear_velocity) = ([0.0, 0.0, height], [0.0, 0.0, velocity]);
    State { position, linear_velocity, ..State::identity() }
}

/// Height at which the spring carries the weight, m.
fn rest() -> f64 {
    RADIUS - MASS * GRAVITY / STIFFNESS
}

/// Height of the damped oscillator that is released at rest, m.
fn closed_form(time: f64) -> f64 {
    let decay = DAMPING / (2.0 * MASS);
    let frequency = (STIFFNESS / MASS - decay * decay).sqrt();
    let phase = frequency * time;
    rest() + OFFSET * (-decay * time).exp() * (phase.cos() + decay / frequency * phase.sin())
}

fn ball_on_ground() -> Result<(World, InterfaceId), pong::Error> {
    let mut builder = WorldBuilder::new(Config::default());
    let (ball, ground) = (builder.load("ball.ron")?, builder.load("ground.ron")?);
    let ball = builder.create_object(ball, "ball")?;
    let ground = builder.create_object(ground, "ground")?;
    builder.pair(ball, ground)?;
    let (mut world, _report) = builder.seal()?;
    let [ball, ground] = [world.scene().interface(ball, "")?, world.scene().interface(ground, "")?];
    world.set_state(ground, &State::identity())?;
    Ok((world, ball))
}
