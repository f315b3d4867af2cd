//! Messages of `pong run` where frames leave contacts out: the cause, and a sufficient capacity.

use crate::common;
use crate::common::pong;
use pong_testkit::ron::{model, shell_mesh, surface};

const SCENE: &str = r#"(format: "pong-scene", version: 1, name: "inside",
    models: { "balls": "balls.ron", "shell": "shell.ron" },
    objects: [
        (name: "balls", model: "balls", bodies: [(motion: Fixed)]),
        (name: "shell", model: "shell", bodies: [(motion: Fixed)])],
    pairs: [("balls", "shell")], contact_capacity: CAPACITY,
    integrator: SemiImplicitEuler, step: 1e-3, duration: 1e-3)"#;

/// The causes reported on the way from a capacity to one that leaves nothing out.
fn causes(name: &str, balls: usize, shell: &str, mut capacity: usize) -> Vec<String> {
    let ball = |index| format!("Sphere(name: \"b{index}\", center: (0, 0, {index}e-5), radius: 0.2)");
    let balls = (0..balls).map(ball).collect::<Vec<_>>().join(",");
    let [balls, shell] = [("balls", balls.as_str()), ("shell", shell)]
        .map(|(name, text)| model(name, &surface(1e5, ""), text));
    let mut causes = Vec::new();
    loop {
        let scene = SCENE.replace("CAPACITY", &capacity.to_string());
        let files = [("balls.ron", balls.as_str()), ("shell.ron", &shell), ("inside.ron", &scene)];
        let folder = common::folder(&format!("left_out/{name}"), &files);
        let (code, _, told) = pong(&folder, &["run", "inside.ron", "--quiet"]);
        assert_eq!(code, 0, "{told}");
        let Some((cause, cure)) = told.split_once("; set contact_capacity: ") else {
            assert!(!told.contains("left out"), "{told}");
            return causes;
        };
        let advised = cure.split_whitespace().next().unwrap().parse().unwrap();
        assert!(advised > capacity && causes.len() < 12, "{capacity}: {told}");
        causes.push(cause.to_owned());
        capacity = advised;
    }
}

#[test]
fn more_contacts_than_the_world_keeps() {
    let floor = r#"Plane(name: "floor", normal: (0, 0, 1), offset: 0)"#;
    let told = causes("many", 5, floor, 2);
    assert_eq!(
        told,
        [
            "warning: there were more contacts in a frame than the world keeps, and the shallowest were left out"
        ]
    );
}

/// The contacts fit, but are too many to be shared: a capacity equal to their number would change nothing.
#[test]
fn more_places_of_a_ball_than_can_be_shared() {
    let told = causes("shared", 1, &shell_mesh(24, 0.25, 2.85, true), 1000);
    let sharing = "a ball touched one surface in more places than could be shared exactly";
    assert!(!told.is_empty() && told.iter().all(|cause| cause.contains(sharing)), "{told:?}");
}
