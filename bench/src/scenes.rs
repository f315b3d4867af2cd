//! The engine on the scenes of the workloads.

use crate::rig::Rig;
use crate::ring::{self, Ring, Tip};
use crate::terrain::{Source, Terrain, WHEELS, Wheel};
use pong_engine::State;
use pong_geometry::extension::Extensions;
use pong_model::Model;
use std::error::Error;
use std::sync::Arc;

/// A model from the text of its file.
///
/// # Errors
/// What the model breaks.
pub fn parse(text: &str) -> Result<Arc<Model>, Box<dyn Error>> {
    Ok(Arc::new(pong_model::parse(text, "scene.ron", None, &Extensions::new())?))
}

/// W2 on so many threads.
///
/// # Errors
/// Whatever the engine refuses.
pub fn ring(ring: &Ring, tip: Tip, threads: usize) -> Result<Rig, Box<dyn Error>> {
    Ok(Rig::new(&ring_models(ring, tip)?, &[(0, 1)], threads)?)
}

/// The two bodies of W2.
///
/// # Errors
/// What a model breaks.
pub fn ring_models(ring: &Ring, tip: Tip) -> Result<[Arc<Model>; 2], Box<dyn Error>> {
    Ok([parse(&ring.wedge_model())?, parse(&ring.tip_model(tip))?])
}

/// The frames of W2.
pub fn ring_states() -> Vec<Vec<State>> {
    ring::states().iter().map(|states| states.to_vec()).collect()
}

/// W3: the terrain, and six wheels of which each is paired with it.
///
/// # Errors
/// Whatever the engine refuses.
pub fn wheels(terrain: &Terrain, wheel: Wheel) -> Result<Rig, Box<dyn Error>> {
    let ground = parse(&terrain.files(Source::Inline).0)?;
    let wheel = parse(&wheel.model())?;
    let models: Vec<_> = std::iter::once(ground).chain(vec![wheel; WHEELS]).collect();
    let pairs: Vec<_> = (1..=WHEELS).map(|wheel| (0, wheel)).collect();
    Ok(Rig::new(&models, &pairs, 1)?)
}
