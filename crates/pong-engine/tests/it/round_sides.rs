//! Polyhedra of N sides converge to round parts as 1/N², in the force on a ball.

use crate::common::*;
use pong_geometry::{Quat, Vec3};
use std::f64::consts::{PI, TAU};

const K: f64 = 1e5;
const RADIUS: f64 = 0.1;
const BALL: &str = "Sphere(name: \"s\", center: (0,0,0), radius: 0.02)";
const CYLINDER: &str = "Cylinder(name: \"c\", ends: ((0,0,-0.2),(0,0,0.2)), radius: 0.1)";

/// A prism over a regular polygon with corners on the circle.
fn prism(sides: usize) -> String {
    let corner = |i: usize, z: f64| {
        let turn = TAU * i as f64 / sides as f64;
        place_of(&Vec3::new(RADIUS * turn.cos(), RADIUS * turn.sin(), z))
    };
    let vertices: Vec<_> =
        (0..2 * sides).map(|i| corner(i % sides, if i < sides { -0.2 } else { 0.2 })).collect();
    let list = |indices: Vec<usize>| format!("{indices:?}");
    let mut faces = vec![list((0..sides).rev().collect()), list((sides..2 * sides).collect())];
    faces.extend((0..sides).map(|i| {
        let j = (i + 1) % sides;
        list(vec![i, j, sides + j, sides + i])
    }));
    format!("Polyhedron(name: \"p\", vertices: [{}], faces: [{}])", vertices.join(","), faces.join(","))
}

/// Forces on the ball around a part, 1 mm deep in the cylinder.
fn forces(part: &str) -> Vec<Vec3> {
    let steel = surface(2.0 * K, "friction: None");
    let mut rig = Rig::new(&model("a", &steel, BALL), &model("b", &steel, part));
    let force = |i: usize| {
        let turn = TAU * (i as f64 + 0.37) / 719.0;
        let at = Vec3::new(turn.cos(), turn.sin(), 0.01) * (RADIUS + 0.019);
        rig.place_a(Vec3::new(at.x, at.y, 0.013), Quat::identity());
        rig.world.evaluate().unwrap();
        rig.wrench(0).force
    };
    (0..719).map(force).collect()
}

#[test]
fn what_a_ball_feels_on_polyhedra_comes_closer_as_one_over_the_square_of_their_sides() {
    let round = forces(CYLINDER);
    assert!(round.iter().all(|force| (force.norm() - K * 1e-3).abs() < 1e-9 * K), "1 mm deep all around");
    let mut before = f64::INFINITY;
    for sides in [16, 32, 64, 128] {
        let off = |(force, round): (&Vec3, &Vec3)| (force.norm() - round.norm()).abs() / K;
        let worst = forces(&prism(sides)).iter().zip(&round).map(off).fold(0.0, f64::max);
        let sag = (RADIUS * (1.0 - (PI / sides as f64).cos())).min(1e-3);
        assert!((worst / sag - 1.0).abs() < 0.02, "{sides} sides: {worst:e} m for {sag:e} m");
        if sides > 32 {
            assert!((before / worst / 4.0 - 1.0).abs() < 0.02, "{sides} sides: {before:e} m to {worst:e} m");
        }
        before = worst;
    }
}
