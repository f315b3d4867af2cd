//! Tests of the loads of a body whose two ends yield.

use crate::frame::load_sharing::solver::two_ends::Loaded;
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;
use pong_geometry::interference::axis_triangle::AxisPlace;
use pong_testkit::Random;

fn place(normal: Vec3, along: f64, depth: f64) -> AxisPlace {
    AxisPlace { normal_b: normal.normalize(), along, depth, part: [along; 2], feature: Feature::WHOLE }
}

/// The displacements Σ λ·a clear all places, and touch those that carry load: the conditions of the least |u₀|² + |u₁|².
/// From normals that fill a cone to normals that differ by rounding.
#[test]
fn the_least_displacements_clear_all_places() {
    let mut random = Random(3);
    for lean in [1.0, 1e-3, 1e-5, 1e-7, 1e-9, 1e-12] {
        for _ in 0..2_000 {
            let tilt = [0, 1].map(|_| random.between(0.5, 1.0));
            let count = 2 + (random.unit() * 30.0) as usize;
            let mut places = Vec::new();
            for _ in 0..count {
                let along = [0.0, 1.0, random.unit(), random.unit()][(random.unit() * 4.0) as usize];
                let offset = random.vector(lean);
                let depth = tilt[0] * (1.0 - along) + tilt[1] * along + lean * random.between(-0.3, 0.3);
                places.push(place(Vec3::new(offset.x, offset.y, 1.0), along, depth));
            }
            let loaded = Loaded::new(&places, 0.0).expect("normals within 90° of each other");
            let mut moved = [Vec3::zeros(); 2];
            for &(index, load) in loaded.members() {
                assert!(load >= 0.0);
                moved[0] += places[index].normal_b * (load * (1.0 - places[index].along));
                moved[1] += places[index].normal_b * (load * places[index].along);
            }
            let slack = |place: &AxisPlace| {
                let there = moved[0] * (1.0 - place.along) + moved[1] * place.along;
                place.normal_b.dot(&there) - place.depth
            };
            let least = places.iter().map(slack).fold(f64::INFINITY, f64::min);
            assert!(least > -1e-10, "{lean}: {least:e}");
            for &(index, _) in loaded.members().iter().filter(|(_, load)| *load > 1e-9) {
                assert!(slack(&places[index]).abs() < 1e-10, "{lean}: {:e}", slack(&places[index]));
            }
        }
    }
}

/// Opposite walls leave no displacement that clears both.
#[test]
fn between_opposite_walls_there_is_no_way_out() {
    let places = [place(Vec3::z(), 0.0, 1.0), place(-Vec3::z(), 0.0, 1.0)];
    assert!(Loaded::new(&places, 0.0).is_none());
}
