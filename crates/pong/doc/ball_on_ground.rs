// Scene of the documentation's examples: the ball of `examples/ball.ron` pressed 1 mm into the ground.

/// Set-up with both Objects, the ball first, and their pair.
fn set_up(config: pong::Config) -> Result<(pong::WorldBuilder, [pong::ObjectId; 2], pong::PairId), pong::Error> {
    use pong::Load;
    let mut builder = pong::WorldBuilder::new(config);
    let texts = [
        ("ball", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ball.ron"))),
        ("ground", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ground.ron"))),
    ];
    let mut objects = Vec::new();
    for (name, text) in texts {
        let model = builder.load_text(text, name)?;
        objects.push(builder.create_object(model, name)?);
    }
    let pair = builder.pair(objects[0], objects[1])?;
    Ok((builder, [objects[0], objects[1]], pair))
}

/// World whose states are set, and the Interfaces of ball and ground.
fn ball_on_ground(config: pong::Config) -> Result<(pong::World, [pong::InterfaceId; 2], pong::PairId), pong::Error> {
    let (builder, [ball, ground], pair) = set_up(config)?;
    let (mut world, _) = builder.seal()?;
    let roots = [world.scene().interface(ball, "")?, world.scene().interface(ground, "")?];
    let pressed = pong::State { position: [0.0, 0.0, 0.099], ..pong::State::identity() };
    world.set_states(&[(roots[0], pressed), (roots[1], pong::State::identity())])?;
    Ok((world, roots, pair))
}
