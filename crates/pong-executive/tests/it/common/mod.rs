//! Helpers of several tests.

use pong_engine::{Config, World, WorldBuilder};
use pong_executive::Simulation;
use pong_executive::scene::{Scene, Variation};
use pong_model::Extensions;
use std::path::Path;
use std::sync::Arc;

/// A sealed world in which nothing can touch.
pub fn empty_world() -> World {
    let builder = WorldBuilder::new(Config::default());
    let (world, _) = builder.seal().unwrap();
    world
}

/// A scene of `ball.ron`, a rough ball of radius 0.1 m and 1e5 N/m, and `ground.ron`, a rigid half space below z = 0.
pub fn simulation_of_balls(text: &str) -> Simulation {
    let model = |name: &str, surface: &str, primitive: &str| {
        let text = format!(
            r#"(format: "pong-model", version: 1, name: "{name}",
                surfaces: {{ "s": ({surface}, normal: Linear(damping: 20.0), friction: Bristle(mu: 0.5, damping: 5.0)) }},
                root: (name: "{name}", surface: "s", primitives: [{primitive}]))"#
        );
        let model = pong_model::parse(&text, name, None, &Extensions::new());
        Arc::new(model.unwrap_or_else(|errors| panic!("{errors}")))
    };
    let ball = model("ball", "stiffness: 1e5", r#"Sphere(name: "b", center: (0, 0, 0), radius: 0.1)"#);
    let ground = model("ground", "stiffness: inf", r#"Plane(name: "g", normal: (0, 0, 1), offset: 0)"#);
    let of_file = |path: &Path| Some(Arc::clone(if path.ends_with("ball.ron") { &ball } else { &ground }));
    let scene = Scene::parse(text, "scene", Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    let built = scene.build_varied(&Variation { instead: Some(&of_file), ..Variation::default() });
    built.unwrap_or_else(|errors| panic!("{errors}")).simulation
}
