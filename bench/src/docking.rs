//! The docking model on a fixed path: the passive side moves to and fro against the active one, off-centre
//! and turned, with petals and rings in contact for most of the path.

use crate::motion::state;
use pong_engine::State;
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_model::{Extensions, Model, ModelErrors};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::Arc;

/// Frames of the closed path.
pub const FRAMES: usize = 64;
/// Time between frames, s: every other frame of a host at 1 kHz, 0.13 s for the path.
const FRAME_SECONDS: f64 = 2e-3;
/// Height of the passive ring's face over the active vehicle at contact of the two rings, m.
const CAPTURED: f64 = 0.3;

/// The active side, then the passive side.
///
/// # Errors
/// The models cannot be loaded.
pub fn models() -> Result<[Arc<Model>; 2], ModelErrors> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/idss_docking");
    let load = |file: &str| pong_model::load(&folder.join(file), &Extensions::new()).map(Arc::new);
    Ok([load("idss_active.ron")?, load("idss_passive.ron")?])
}

/// States of all movable groups in every frame: the active side at rest at its model pose, then the passive
/// side.
pub fn states(active: &Model) -> Vec<Vec<State>> {
    let at_rest = |body: &pong_model::MovableGroup| {
        State::from_motion(&body.initial_pose.unwrap_or_else(Pose::identity), &Twist::zero())
    };
    let active: Vec<State> = active.bodies.iter().map(at_rest).collect();
    let frame = |frame: usize| {
        let passive = state(passive, frame as f64, FRAME_SECONDS);
        active.iter().copied().chain(std::iter::once(passive)).collect()
    };
    (0..FRAMES).map(frame).collect()
}

/// Pose of the passive side, which is turned over to face the active one, from first contact of petal tips to
/// pressed rings.
fn passive(frame: f64) -> Pose {
    let phase = frame / FRAMES as f64 * TAU;
    let wave = |shift: f64| (phase + shift).sin();
    let height = CAPTURED + 0.058 + 0.06 * wave(0.0);
    let turned_over = Quat::from_scaled_axis(Vec3::x() * PI);
    let tilt = Quat::from_scaled_axis(Vec3::new(0.01 * wave(0.7), 0.01 * wave(2.1), 0.02 * wave(3.3)));
    Pose {
        position: Vec3::new(0.015 * wave(1.3), 0.015 * wave(2.6), height),
        orientation: tilt * turned_over,
    }
}
