//! A normal force law of the host: a spring that stiffens with depth, F = k·δ·(1 + (δ/d)²) for weight 1.

use pong::law::{Laws, NormalForce, NormalInput};
use pong::{Config, Extensions, Load, State, WorldBuilder};
use std::sync::Arc;

/// Stiffening spring. Its parameter is d, the depth at which the force is twice that of the linear spring, m.
#[derive(Debug)]
struct Stiffening;

impl NormalForce for Stiffening {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        let ratio = input.depth / input.parameters[0];
        input.stiffness * input.depth * (1.0 + ratio * ratio)
    }

    /// The integral of the force over the depth.
    fn stored(&self, input: &NormalInput<'_>) -> f64 {
        let ratio = input.depth / input.parameters[0];
        input.stiffness * input.depth * input.depth * (0.5 + 0.25 * ratio * ratio)
    }
}

/// Model of the ball; its surface names the law.
const BALL: &str = r#"(
    format: "pong-model", version: 1, name: "ball",
    surfaces: { "foam": (stiffness: 1e4, normal: Custom(name: "stiffening", parameters: [1e-3]), friction: None) },
    root: (name: "ball", surface: "foam", primitives: [Sphere(name: "shell", center: (0, 0, 0), radius: 0.1)]),
)"#;

/// Model of the ground. It is rigid and has no normal law of its own, so that of the ball applies.
const GROUND: &str = r#"(
    format: "pong-model", version: 1, name: "ground",
    surfaces: { "stone": (stiffness: inf, friction: None) },
    root: (name: "ground", surface: "stone", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]),
)"#;

fn main() -> Result<(), pong::Error> {
    let mut laws = Laws::default();
    laws.add_normal("stiffening", Arc::new(Stiffening));
    let mut builder = WorldBuilder::with_extensions(Config::default(), Extensions::new(), laws);
    let ball = builder.load_text(BALL, "ball")?;
    let ground = builder.load_text(GROUND, "ground")?;
    let ball = builder.create_object(ball, "ball")?;
    let ground = builder.create_object(ground, "ground")?;
    builder.pair(ball, ground)?;
    let (mut world, _report) = builder.seal()?;
    let [ball, ground] = [world.scene().interface(ball, "")?, world.scene().interface(ground, "")?];

    world.set_state(ground, &State::identity())?;
    for depth in [0.5e-3, 1e-3, 2e-3] {
        world.set_state(ball, &State { position: [0.0, 0.0, 0.1 - depth], ..State::identity() })?;
        world.evaluate()?;
        println!("{:.1} mm deep: {:.3} N", 1e3 * depth, world.wrench_common(ball)?.force.z);
    }
    Ok(())
}
