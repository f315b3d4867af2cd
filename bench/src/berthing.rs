//! The berthing mechanism on a fixed path: the passive half moves to and fro against the active one,
//! off-centre and rolled, with guides, standoffs, plungers and paddles in contact for part of the path.
//! Segments, rays, points and spheres on polyhedra, in fourteen movable groups.

use crate::motion::state;
use pong_engine::State;
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_model::{Extensions, Model, ModelErrors};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::Path;
use std::sync::Arc;

/// Frames of the closed path.
pub const FRAMES: usize = 64;
/// Indicators, one a quadrant.
pub const INDICATORS: usize = 4;
const FRAME_SECONDS: f64 = 2e-3;

/// The active half, the passive half, and the indicator.
///
/// # Errors
/// The models cannot be loaded.
pub fn models() -> Result<[Arc<Model>; 3], ModelErrors> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/common_berthing");
    let load = |file: &str| pong_model::load(&folder.join(file), &Extensions::new()).map(Arc::new);
    Ok([load("active.ron")?, load("passive.ron")?, load("indicator.ron")?])
}

/// States of all movable groups in every frame: the active half at rest, the passive half, and the
/// indicators, a quarter turn apart.
pub fn states([active, _, indicator]: &[Arc<Model>; 3]) -> Vec<Vec<State>> {
    let fixed: Vec<State> = at_rest(active, &Pose::identity());
    let quarter = |i: usize| Pose {
        position: Vec3::zeros(),
        orientation: Quat::from_scaled_axis(Vec3::z() * (i as f64 * FRAC_PI_2)),
    };
    let indicators: Vec<State> = (0..INDICATORS).flat_map(|i| at_rest(indicator, &quarter(i))).collect();
    let frame = |frame: usize| {
        let passive = state(passive, frame as f64, FRAME_SECONDS);
        fixed.iter().copied().chain([passive]).chain(indicators.iter().copied()).collect()
    };
    (0..FRAMES).map(frame).collect()
}

/// All groups of an Object at their model poses.
fn at_rest(model: &Model, root: &Pose) -> Vec<State> {
    let placed =
        |body: &pong_model::MovableGroup| root.compose(&body.initial_pose.unwrap_or_else(Pose::identity));
    model.bodies.iter().map(|body| State::from_motion(&placed(body), &Twist::zero())).collect()
}

/// Pose of the passive half, from first contact of the guides to compressed standoffs.
fn passive(frame: f64) -> Pose {
    let phase = frame / FRAMES as f64 * TAU;
    let wave = |shift: f64| (phase + shift).sin();
    let turned = Vec3::new(0.002 * wave(0.7), 0.002 * wave(2.1), 0.006 * wave(3.3));
    Pose {
        position: Vec3::new(0.006 * wave(1.3), 0.006 * wave(2.6), 0.025 + 0.03 * wave(0.0)),
        orientation: Quat::from_scaled_axis(turned),
    }
}
