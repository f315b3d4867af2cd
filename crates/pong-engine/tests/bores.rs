//! Bores in a world: what came from behind, what lies on a seam, pins that wedge.

mod common;

use common::*;
use pong_geometry::{Quat, Vec3};

const K: f64 = 1e5;
const HOLE: &str = "Bore(name: \"b\", ends: ((0,0,-0.25),(0,0,0.25)), radii: (0.1,0.1), thickness: 0.05)";

fn rig(a: &str, b: &str) -> Rig {
    let steel = surface(2.0 * K, "friction: None");
    Rig::new(&model("a", &steel, a), &model("b", &steel, b))
}

/// The force on A along x, one committed frame after another.
fn pushes(rig: &mut Rig, places: &[f64]) -> Vec<f64> {
    let push = |x: &f64| {
        rig.place_a(Vec3::new(*x, 0.0, 0.02), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force.x
    };
    places.iter().map(push).collect()
}

/// Set down behind the wall a body is pushed into the hole; what comes from behind is not, until it has left the wall.
#[test]
fn what_comes_from_behind_is_not_pushed_into_the_hole() {
    for (a, size) in [
        ("Point(name: \"p\", position: (0,0,0))", 0.0),
        ("Sphere(name: \"s\", center: (0,0,0), radius: 0.02)", 0.02),
    ] {
        let expect = |found: Vec<f64>, depths: &[f64]| {
            let is_close =
                found.iter().zip(depths).all(|(found, depth)| (found + K * depth).abs() < 1e-9 * K);
            assert!(is_close, "{a}: {found:?}");
        };
        expect(pushes(&mut rig(a, HOLE), &[0.13, 0.05, 0.11]), &[0.03 + size, 0.0, 0.01 + size]);
        expect(
            pushes(&mut rig(a, HOLE), &[0.2, 0.13, 0.11, 0.09, 0.05, 0.11]),
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.01 + size],
        );
    }
}

/// A ball that is too large for a hole feels nothing in its middle, and twice the stiffness about it.
#[test]
fn a_ball_too_large_for_a_hole_is_held_in_its_middle() {
    let mut rig = rig("Sphere(name: \"s\", center: (0,0,0), radius: 0.101)", HOLE);
    let expected = [0.0, -2.0 * K * 1e-4, 2.0 * K * 3e-4, -K * 0.006];
    let found = pushes(&mut rig, &[0.0, 1e-4, -3e-4, 0.005]);
    assert!(
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9 * K),
        "{found:?}"
    );
}

/// A ray that stands in a hole is pressed by the wall that its tip has passed, from within alone.
#[test]
fn a_ray_is_pressed_by_the_wall_that_it_comes_to_from_within() {
    let ray = "Ray(name: \"r\", origin: (0,0,0), direction: (1,0,0), length: 0.05)";
    let mut rig = rig(ray, HOLE);
    let found = pushes(&mut rig, &[0.0, 0.06, 0.09, 0.12, 0.2]);
    let expected = [0.0, -K * 0.01, -K * 0.04, -K * 0.07, 0.0];
    assert!(
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9 * K),
        "{found:?}"
    );
}
