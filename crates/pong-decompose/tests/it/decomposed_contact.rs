//! Decomposed shapes in the engine: cavities are empty, seams have no effect.

use pong_decompose::DecomposeOptions;
use pong_engine::{Config, State, WorldBuilder};
use pong_geometry::Vec3;
use pong_import::DefaultSurface;
use pong_model::Extensions;
use pong_testkit::meshes::{blocks, obj};
use pong_testkit::scratch;
use std::sync::Arc;

const STIFFNESS: f64 = 1e6;

/// Force on a sphere or point (radius 0) at each of some places, separately, from a decomposed set of cubes
/// held at the origin.
fn forces(test: &str, cubes: &[[i32; 3]], radius: f64, places: &[[f64; 3]]) -> Vec<Vec3> {
    let path = scratch(env!("CARGO_TARGET_TMPDIR"), &format!("contact_{test}")).join("shape.obj");
    std::fs::write(&path, obj(&blocks(cubes, 1.0))).unwrap();
    let surface = DefaultSurface { name: "s".to_owned(), stiffness: STIFFNESS, damping: 0.0, mu: 0.0 };
    let import = pong_import::Options { surface: Some(surface), ..pong_import::Options::default() };
    let options = DecomposeOptions { import, samples: 1000, ..DecomposeOptions::default() };
    let done = pong_decompose::decompose(&path, &path.with_extension("ron"), &options, &mut |_| ());
    assert!(done.findings.faults.is_empty() && done.findings.notes.is_empty(), "{}", done.findings);
    let shape = pong_model::load(&done.files[0], &Extensions::new()).unwrap();
    let probe = match radius {
        0.0 => "Point(name: \"p\", position: (0, 0, 0))".to_owned(),
        radius => format!("Sphere(name: \"p\", center: (0, 0, 0), radius: {radius:?})"),
    };
    let text = format!(
        "(format: \"pong-model\", version: 1, name: \"probe\", surfaces: {{ \"r\": (stiffness: inf) }}, \
         root: (name: \"probe\", surface: \"r\", primitives: [{probe}]))"
    );
    let probe = pong_model::parse(&text, "probe.ron", None, &Extensions::new()).unwrap();
    places.iter().map(|place| force(shape.clone(), probe.clone(), Vec3::from(*place))).collect()
}

fn force(shape: pong_model::Model, probe: pong_model::Model, place: Vec3) -> Vec3 {
    let mut builder = WorldBuilder::new(Config::default());
    let objects = [(probe, "probe"), (shape, "shape")].map(|(model, name)| {
        let model = builder.add_model(Arc::new(model));
        builder.create_object(model, name).unwrap()
    });
    builder.pair(objects[0], objects[1]).unwrap();
    let [probe, shape] = objects.map(|object| builder.scene().interface(object, "").unwrap());
    let (mut world, _) = builder.seal().unwrap();
    let at = |place: Vec3| State { position: place.into(), ..State::identity() };
    world.set_states(&[(probe, at(place)), (shape, at(Vec3::zeros()))]).unwrap();
    world.evaluate().unwrap();
    world.wrench(probe).unwrap().force
}

#[test]
fn a_point_in_a_cup_touches_nothing_and_in_its_wall_it_does() {
    let is_wall = |x: i32, y: i32, z: i32| z == 0 || [0, 4].contains(&x) || [0, 4].contains(&y);
    let all = (0..100).map(|k| [k % 5, k / 5 % 5, k / 25]);
    let cup: Vec<[i32; 3]> = all.filter(|&[x, y, z]| is_wall(x, y, z)).collect();
    let inside: Vec<[f64; 3]> = (0..60)
        .map(|k| [1.1 + f64::from(k % 4) * 0.9, 1.1 + f64::from(k / 4 % 5) * 0.7, 1.01 + f64::from(k / 20)])
        .collect();
    assert!(forces("cup", &cup, 0.0, &inside).iter().all(|force| *force == Vec3::zeros()));
    let in_floor = forces("floor", &cup, 0.0, &[[2.3, 2.1, 0.99]]);
    assert!((in_floor[0] - Vec3::new(0.0, 0.0, 0.01 * STIFFNESS)).norm() < 1e-6, "{}", in_floor[0]);
}

#[test]
fn a_ball_that_rolls_over_the_seams_of_a_tee_feels_one_plane() {
    let tee = [[0, 0, 2], [1, 0, 2], [2, 0, 2], [3, 0, 2], [4, 0, 2], [2, 0, 0], [2, 0, 1]];
    // In front of the internal face between bar and stem, at its corners, and along both.
    let places: Vec<[f64; 3]> =
        (0..41).map(|k| [2.0 + f64::from(k) * 0.025, -0.19, 1.8 + f64::from(k) * 0.01]).collect();
    for force in forces("tee", &tee, 0.2, &places) {
        assert!((force - Vec3::new(0.0, -0.01 * STIFFNESS, 0.0)).norm() < 1e-6, "{force}");
    }
}

#[test]
fn in_a_square_corner_both_walls_push_fully() {
    let ell = [[0, 0, 0], [1, 0, 0], [0, 0, 1]];
    let push = forces("ell", &ell, 0.2, &[[1.19, 0.5, 1.18]])[0];
    assert!((push - Vec3::new(0.01, 0.0, 0.02) * STIFFNESS).norm() < 1e-6, "{push}");
}
