//! W7: a cloud of spheres, each a separate Object, all paired with all, none touching another.

use crate::random::Random;
use crate::ron;
use pong_engine::State;
use pong_geometry::{Pose, Quat, Twist, Vec3};
use std::f64::consts::TAU;

/// Radius of a sphere, m.
pub const RADIUS: f64 = 0.1;
/// Distance between neighbouring lattice points, m; each sphere moves by up to [`WAY`] about its own.
const SPACING: f64 = 0.5;
const WAY: f64 = 0.08;
/// Frames of the closed pass.
pub const FRAMES: usize = 32;
const FRAME_SECONDS: f64 = 0.01;

/// Model file of one sphere.
pub fn model() -> String {
    ron::model("sphere", &format!("Sphere(name: \"s\", center: (0, 0, 0), radius: {RADIUS:?})"))
}

/// States of `count` spheres in every frame: each on a circle about its point of a cubic lattice.
pub fn states(count: usize) -> Vec<Vec<State>> {
    let side = (count as f64).cbrt().ceil() as usize;
    let mut random = Random(0xc10d + count as u64);
    let paths: Vec<(Vec3, [Vec3; 2], f64)> = (0..count)
        .map(|i| {
            let place = [i % side, i / side % side, i / (side * side)].map(|n| n as f64 * SPACING);
            let one = random.direction();
            let other = one.cross(&random.direction()).normalize();
            (Vec3::from(place), [one * WAY, other * WAY], random.between(0.0, TAU))
        })
        .collect();
    (0..FRAMES).map(|frame| paths.iter().map(|path| on_circle(path, frame)).collect()).collect()
}

fn on_circle((middle, [one, other], start): &(Vec3, [Vec3; 2], f64), frame: usize) -> State {
    let rate = TAU / (FRAMES as f64 * FRAME_SECONDS);
    let (sine, cosine) = (start + frame as f64 * FRAME_SECONDS * rate).sin_cos();
    let pose = Pose { position: middle + one * cosine + other * sine, orientation: Quat::identity() };
    let linear = (other * cosine - one * sine) * rate;
    State::from_motion(&pose, &Twist { linear, angular: Vec3::zeros() })
}
