//! Scene files of `models/verification`, run as by `pong run`, compared with the answers in their headings.

use pong_executive::Simulation;
use pong_executive::scene::{BuiltScene, Scene};
use pong_testkit::assert_near;
use std::path::PathBuf;

fn load(name: &str) -> BuiltScene {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/verification"));
    let scene = Scene::load(&folder.join(name)).unwrap_or_else(|errors| panic!("{errors}"));
    scene.build().unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn v1_static_rest() {
    let mut scene = load("scene_v1_static_rest.ron");
    scene.simulation.observe(scene.steps, 1, &mut |_: &Simulation| ()).unwrap();
    assert_near(scene.simulation.world().contacts()[0].depth, 9.81e-5, 1e-9);
}

#[test]
fn v7_two_spheres() {
    let mut scene = load("scene_v7_two_spheres.ron");
    let (mut touch, mut deepest) = (None, 0.0_f64);
    let mut watch = |sim: &Simulation| {
        if let [contact] = sim.world().contacts().as_slice() {
            touch.get_or_insert(sim.time() - contact.depth / contact.depth_rate);
            deepest = deepest.max(contact.depth);
        }
    };
    scene.simulation.observe(scene.steps, 1, &mut watch).unwrap();
    assert_near(touch.unwrap(), 5.0, 1e-4);
    assert_near(deepest, 0.210903, 1e-4);
    let speed = scene.simulation.twist(scene.objects[1].bodies[0]).linear.x;
    assert_near(speed, 0.778965, 1e-4);
}

#[test]
fn v16_stick_slip() {
    let mut scene = load("scene_v16_stick_slip.ron");
    let (mut breaks, mut stuck) = (Vec::new(), true);
    let mut watch = |sim: &Simulation| {
        let sticks = sim.world().contacts()[0].sticks;
        if stuck && !sticks {
            breaks.push(sim.time());
        }
        stuck = sticks;
    };
    scene.simulation.observe(scene.steps, 1, &mut watch).unwrap();
    assert_near(breaks[0], 7.5, 2e-3);
    assert_near(breaks[2] - breaks[1], 7.61126, 2e-3);
}
