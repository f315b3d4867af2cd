//! Round parts in the engine: springs, ends of contacts and directions as the theory manual (2.8) tells them.

mod common;

use common::*;
use pong_geometry::{Quat, Vec3};

const K: f64 = 1e4;

fn part(text: &str) -> String {
    model("part", &surface(K, "friction: None"), text)
}

/// Force on A, N, and the ends of the contacts, of a part set down on something.
fn set_down(a: &str, b: &str) -> (Vec3, Vec<u32>) {
    let mut rig = Rig::new(&part(a), &part(b));
    rig.place_a(Vec3::zeros(), Quat::identity());
    rig.world.evaluate().unwrap();
    (rig.wrench(0).force, rig.world.contacts().iter().map(|contact| contact.end).collect())
}

/// A part so deep, with such a share of the pair's spring: two equal springs in series.
fn check(a: &str, b: &str, depth: f64, share: f64, ends: &[u32]) {
    let (force, found) = set_down(a, b);
    let expected = 0.5 * K * share * depth;
    assert!((force - Vec3::z() * expected).norm() < 1e-9 * expected, "{a}: {force}");
    assert_eq!(found, ends, "{a}");
}

#[test]
fn parts_on_a_plane_carry_half_a_spring_at_each_place() {
    let floor = "Plane(name: \"p\", normal: (0,0,1), offset: 0)";
    check("Capsule(name: \"c\", ends: ((0,0,0.28),(1,0,0.28)), radius: 0.3)", floor, 0.02, 1.0, &[0, 1]);
    check("Capsule(name: \"c\", ends: ((0,0,0.28),(1,0,0.7)), radius: 0.3)", floor, 0.02, 0.5, &[0]);
    check("Cylinder(name: \"c\", ends: ((0,0,0.28),(1,0,0.28)), radius: 0.3)", floor, 0.02, 1.0, &[0, 1]);
    check("Cylinder(name: \"c\", ends: ((0,0,0.6),(0,0,-0.02)), radius: 0.3)", floor, 0.02, 1.0, &[1, 3]);
    check("Cone(name: \"c\", ends: ((0,0,-0.02),(0,0,1)), radii: (0.3,0.1))", floor, 0.02, 1.0, &[0, 2]);
    check("Cone(name: \"c\", ends: ((0,0,1),(0,0,-0.02)), radii: (0.3,0))", floor, 0.02, 0.5, &[1]);
}

#[test]
fn rays_press_on_round_parts() {
    let ray = "Ray(name: \"r\", origin: (0,0,1), direction: (0,0,-1), length: 0.8)";
    for b in [
        "Capsule(name: \"c\", ends: ((0.5,0,-0.08),(-0.5,0,-0.08)), radius: 0.3)",
        "Cylinder(name: \"c\", ends: ((0.5,0,-0.08),(-0.5,0,-0.08)), radius: 0.3)",
        "Cone(name: \"c\", ends: ((0,0,0.22),(0,0,-1)), radii: (0.1,0.3))",
    ] {
        check(ray, b, 0.02, 1.0, &[0]);
    }
}
