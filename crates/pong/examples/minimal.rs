//! Ball pressed 1 mm into the ground. Run it in the folder of the two models.

use pong::{Config, Load, State, WorldBuilder};

fn main() -> Result<(), pong::Error> {
    let mut builder = WorldBuilder::new(Config::default());
    let (ball, ground) = (builder.load("ball.ron")?, builder.load("ground.ron")?);
    let ball = builder.create_object(ball, "ball")?;
    let ground = builder.create_object(ground, "ground")?;
    builder.pair(ball, ground)?;
    let (mut world, _report) = builder.seal()?;
    let [ball, ground] = [world.scene().interface(ball, "")?, world.scene().interface(ground, "")?];

    // Each frame: states in, wrenches out. A host that integrates evaluates at stages and commits at the end.
    let pressed = State { position: [0.0, 0.0, 0.099], ..State::identity() };
    world.set_states(&[(ball, pressed), (ground, State::identity())])?;
    world.step()?;
    println!("force on the ball: {:.3} N up", world.wrench_common(ball)?.force.z);
    Ok(())
}
