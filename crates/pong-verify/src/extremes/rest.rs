//! Long periods of rest.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, model};
use crate::case::{Failure, Outcome};
use crate::row::Row;
use pong_executive::{Quat, Vec3};

pub const REST: Extreme = Extreme {
    id: "E14",
    asked: "1e8 frames of rest without drift.",
    set_up: "1 kg on one contact (1e5 N/m, 200 N·s/m, μ = 0.5), pulled along the ground with 40 % of the force that \
             breaks it away, semi-implicit Euler at 1 ms. After 10,000 frames to come to rest, 1e5 frames; 1e8 with \
             `--long`.",
    answer: Answer::Safe,
    limit: "none found: the state becomes one that a frame maps onto itself",
    also: "cases V1, V17, W4",
    rows,
};

const GRAVITY: f64 = 9.81;
const STEP: f64 = 1e-3;

/// A point mass on the ground, pulled along it.
struct Block {
    rig: Rig,
    place: Vec3,
    velocity: Vec3,
}

impl Block {
    fn new() -> Result<Self, Failure> {
        let friction = "friction: Bristle(mu: 0.5, stiffness: 6e4, damping: 400.0)";
        let point = format!("stiffness: 1e5, normal: Linear(damping: 200.0), {friction}");
        let ground = "stiffness: inf, normal: Linear(damping: 0.0), friction: Bristle(mu: 0.5)";
        let rig = Rig::new(
            &model(&point, "Point(name: \"x\", position: (0,0,0))"),
            &model(ground, "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)"),
        )?;
        Ok(Self { rig, place: Vec3::z() * (-GRAVITY / 1e5), velocity: Vec3::zeros() })
    }

    fn step(&mut self) -> Result<(), Failure> {
        let wrench = self.rig.step(self.place, Quat::identity(), self.velocity)?;
        let pull = Vec3::new(0.4 * 0.5 * GRAVITY, 0.0, -GRAVITY);
        self.velocity += (wrench.force + pull) * STEP;
        self.place += self.velocity * STEP;
        Ok(())
    }
}

fn rows(length: Length) -> Outcome {
    let mut block = Block::new()?;
    for _ in 0..10_000 {
        block.step()?;
    }
    let settled = block.place;
    let frames = length.of(100_000, 100_000_000);
    let (mut farthest, mut fastest) = (0.0_f64, 0.0_f64);
    for _ in 0..frames {
        block.step()?;
        farthest = farthest.max((block.place - settled).amax());
        fastest = fastest.max(block.velocity.amax());
    }
    Ok(vec![
        Row::below(
            format!("{frames:e} frames: largest distance from the place of rest"),
            "m",
            farthest,
            1e-12,
        ),
        Row::below("largest speed", "m/s", fastest, 1e-12),
        Row::relative("depth", "m", GRAVITY / 1e5, -block.place.z, 1e-9),
        Row::relative("stretch of the bristle", "m", 0.2 * GRAVITY / 6e4, block.place.x, 1e-2),
    ])
}
