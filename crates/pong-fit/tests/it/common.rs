//! Scenes that the tests write: a ball on the ground, a block that slides, a cube that is tossed.

use pong_executive::scene::Scene;

const GROUND: &str = r#"(
    format: "pong-model", version: 1, name: "ground",
    surfaces: { "stone": (stiffness: inf) },
    root: (name: "ground", surface: "stone", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]),
)"#;

const BALL: &str = r#"(
    format: "pong-model", version: 1, name: "ball",
    surfaces: { "rubber": (stiffness: 2e4, normal: Linear(damping: 20), friction: Bristle(mu: 0.4, stiffness: 1e4, damping: 10)) },
    root: (name: "ball", surface: "rubber", primitives: [Sphere(name: "shell", center: (0, 0, 0), radius: 0.1)]),
)"#;

/// Cube with an edge of 0.1 m, of eight points.
fn cube() -> String {
    let mut points = String::new();
    for (number, (x, y, z)) in (0..8).map(|i| (i, (i & 1, i >> 1 & 1, i >> 2))) {
        let at = |half: i32| if half == 0 { -0.05 } else { 0.05 };
        points += &format!("Point(name: \"p{number}\", position: ({}, {}, {})), ", at(x), at(y), at(z));
    }
    format!(
        r#"(
    format: "pong-model", version: 1, name: "cube",
    surfaces: {{ "acrylic": (stiffness: 1e4, normal: Linear(damping: 30, ramp: 1e-3), friction: Bristle(mu: 0.3, stiffness: 7e3, damping: 20)) }},
    root: (name: "cube", surface: "acrylic", primitives: [{points}]),
)"#
    )
}

fn scene(name: &str, body: &str, head: &str) -> String {
    format!(
        r#"(
    format: "pong-scene", version: 1, name: "{name}",
    models: {{ "{name}": "{name}.ron", "ground": "ground.ron" }},
    objects: [
        (name: "{name}", model: "{name}", bodies: [({body})]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
    ],
    pairs: [("{name}", "ground")], {head}
)"#
    )
}

/// Writes a scene with its models and loads it.
fn written(test: &str, name: &str, model: &str, text: &str) -> Scene {
    let folder = pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), &format!("fit/{test}"));
    std::fs::write(folder.join("ground.ron"), GROUND).unwrap();
    std::fs::write(folder.join(format!("{name}.ron")), model).unwrap();
    std::fs::write(folder.join("scene.ron"), text).unwrap();
    Scene::load(&folder.join("scene.ron")).unwrap()
}

/// A ball of 1 kg that falls on the ground.
pub fn bouncing(test: &str) -> Scene {
    let body = "motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.15), linear_velocity: (0.3, 0, 0)";
    let head = "gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 5e-4, duration: 0.4";
    written(test, "ball", BALL, &scene("ball", body, head))
}

/// The ball with damping that sets in over a depth, so that its force is continuous.
pub fn ramped(test: &str) -> Scene {
    let body = "motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.105)";
    let head = "gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 5e-4, duration: 0.4";
    let ball = BALL.replace("Linear(damping: 20)", "Linear(damping: 20, ramp: 1e-3)");
    written(test, "ball", &ball, &scene("ball", body, head))
}

/// The ball under a host that holds wrenches over a frame, and gets them two frames late.
pub fn held(test: &str) -> Scene {
    let body = "motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.1), linear_velocity: (0.3, 0, 0)";
    let head =
        "gravity: (0, 0, -9.81), integrator: ZeroOrderHold(delay_frames: 2), step: 5e-4, duration: 0.4";
    written(test, "ball", BALL, &scene("ball", body, head))
}

/// A cube of 0.4 kg that slides on the ground, at its depth of rest.
pub fn sliding(test: &str) -> Scene {
    let body = "motion: Free, mass: 0.4, inertia: Diagonal(7e-4, 7e-4, 7e-4), position: (0, 0, 0.0499019), linear_velocity: (1.0, 0, 0)";
    let head = "gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 5e-4, duration: 0.4";
    written(test, "cube", &cube(), &scene("cube", body, head))
}

/// A cube of 0.4 kg that is tossed.
pub fn tossed(test: &str) -> Scene {
    let body = "motion: Free, mass: 0.4, inertia: Diagonal(7e-4, 7e-4, 7e-4), position: (0, 0, 0.12), \
                orientation: (0.9, 0.3, 0.3, 0.1), linear_velocity: (0.8, 0.2, -0.5), angular_velocity: (2, 5, 1)";
    let head = "gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 5e-4, duration: 0.4";
    written(test, "cube", &cube(), &scene("cube", body, head))
}

/// The cube with the inertia of a rod.
pub fn rod(test: &str) -> Scene {
    let body = "motion: Free, mass: 0.4, inertia: Diagonal(7e-4, 7e-4, 1e-4), position: (0, 0, 0.12)";
    let head = "gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 5e-4, duration: 0.4";
    written(test, "cube", &cube(), &scene("cube", body, head))
}
