//! The engine on the scenes of the workloads.

use crate::berthing;
use crate::cloud;
use crate::docking;
use crate::rig::Rig;
use crate::ring::{self, Ring, Tip};
use crate::ron;
use crate::terrain::{self, Source, Terrain, WHEELS, Wheel};
use pong_engine::{EngineError, State, WorldBuilder};
use pong_geometry::{Pose, Twist, Vec3};
use pong_model::{Extensions, Model};
use std::error::Error;
use std::sync::Arc;

/// Frames of a pass over a fixed scene.
pub const FRAMES: usize = 64;
/// Names of the fixed scenes.
pub const FIXED: [&str; 4] = ["docking", "ring", "wheels", "contact"];

/// States of all movable groups, frame by frame.
pub type Frames = Vec<Vec<State>>;

/// A scene before a world exists: one Object per model, some of them paired, and a closed path.
pub struct Scene {
    /// Models, one per Object.
    pub models: Vec<Arc<Model>>,
    /// Pairs of Objects that may touch.
    pub pairs: Vec<(usize, usize)>,
    /// States of a pass.
    pub states: Frames,
}

impl Scene {
    /// One of [`FIXED`]: the docking model, 48 wedges against 1,000 spheres, six spheres on 10,000 triangles, one sphere on a
    /// plane.
    ///
    /// # Errors
    /// Unknown name, or a fault of a model.
    pub fn fixed(name: &str) -> Result<Self, Box<dyn Error>> {
        match name {
            "docking" => Self::docking(),
            "ring" => Self::ring(&Ring::new(ring::SIZES[1]), Tip::Sphere),
            "wheels" => Self::wheels(&Terrain::SIZES[1], Wheel::BOTH[0]),
            "contact" => Self::spheres_on_plane(1, 0.0),
            "contacts" => Self::spheres_on_plane(65, 0.0),
            other => Err(format!("{other}: use one of {}", FIXED.join(", ")).into()),
        }
    }

    /// The docking model.
    ///
    /// # Errors
    /// A fault of a model.
    pub fn docking() -> Result<Self, Box<dyn Error>> {
        let models = docking::models()?;
        let states = docking::states(&models[0]);
        Ok(Self { models: models.into(), pairs: vec![(0, 1)], states })
    }

    /// The berthing mechanism: both halves and four indicators.
    ///
    /// # Errors
    /// A fault of a model.
    pub fn berthing() -> Result<Self, Box<dyn Error>> {
        let models = berthing::models()?;
        let states = berthing::states(&models);
        let [active, passive, indicator] = models;
        let objects = [active, passive].into_iter().chain(vec![indicator; berthing::INDICATORS]);
        let pairs = (0..2 + berthing::INDICATORS).filter(|&object| object != 1).map(|object| (object, 1));
        Ok(Self { models: objects.collect(), pairs: pairs.collect(), states })
    }

    /// W7: spheres, all paired with all.
    ///
    /// # Errors
    /// A fault of a model.
    pub fn cloud(count: usize) -> Result<Self, Box<dyn Error>> {
        Ok(Self {
            models: vec![parse(&cloud::model())?; count],
            pairs: (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect(),
            states: cloud::states(count),
        })
    }

    /// One movable group of primitives against one of others, paired, at rest.
    ///
    /// # Errors
    /// A fault of a model.
    pub fn two(a: &str, b: &str, states: [State; 2]) -> Result<Self, Box<dyn Error>> {
        Ok(Self { models: vec![parse(a)?, parse(b)?], pairs: vec![(0, 1)], states: vec![states.to_vec()] })
    }

    /// Spheres of one movable group over a plane of another: 4 mm deep, raised by `higher`, m.
    ///
    /// # Errors
    /// The engine's loader refuses the models.
    pub fn spheres_on_plane(count: usize, higher: f64) -> Result<Self, Box<dyn Error>> {
        let sphere = |i: usize| {
            let center = ron::vector(&Vec3::new((i % 8) as f64, (i / 8) as f64, 0.0));
            format!("Sphere(name: \"s{i}\", center: {center}, radius: 0.25),\n")
        };
        let spheres = ron::model("spheres", &(0..count).map(sphere).collect::<String>());
        let plane = ron::model("floor", "Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)");
        let placed = Pose { position: Vec3::z() * (0.246 + higher), ..Pose::identity() };
        Self::two(&spheres, &plane, [State::from_motion(&placed, &Twist::zero()), State::identity()])
    }

    /// Scene of W2.
    ///
    /// # Errors
    /// A fault of a model.
    pub fn ring(ring: &Ring, tip: Tip) -> Result<Self, Box<dyn Error>> {
        Ok(Self { models: ring_models(ring, tip)?.into(), pairs: vec![(0, 1)], states: ring_states() })
    }

    /// Scene of W3: the terrain, and six wheels that are each paired with it.
    ///
    /// # Errors
    /// A fault of a model.
    pub fn wheels(terrain: &Terrain, wheel: Wheel) -> Result<Self, Box<dyn Error>> {
        let ground = parse(&terrain.files(Source::Inline).0)?;
        let rolling = parse(&wheel.model())?;
        Ok(Self {
            models: std::iter::once(ground).chain(vec![rolling; WHEELS]).collect(),
            pairs: (1..=WHEELS).map(|wheel| (0, wheel)).collect(),
            states: terrain::states(FRAMES, wheel),
        })
    }

    /// Builds the scene in the world of `builder`.
    ///
    /// # Errors
    /// Any error of the engine.
    pub fn rig(&self, builder: WorldBuilder) -> Result<Rig, EngineError> {
        Rig::in_world(builder, &self.models, &self.pairs)
    }
}

/// A model from the text of its file.
///
/// # Errors
/// A fault of the model.
pub fn parse(text: &str) -> Result<Arc<Model>, Box<dyn Error>> {
    Ok(Arc::new(pong_model::parse(text, "scene.ron", None, &Extensions::new())?))
}

/// W2 on this many threads.
///
/// # Errors
/// Any error of the engine.
pub fn ring(ring: &Ring, tip: Tip, threads: usize) -> Result<Rig, Box<dyn Error>> {
    Ok(Rig::new(&ring_models(ring, tip)?, &[(0, 1)], threads)?)
}

/// The two bodies of W2.
///
/// # Errors
/// A fault of a model.
pub fn ring_models(ring: &Ring, tip: Tip) -> Result<[Arc<Model>; 2], Box<dyn Error>> {
    Ok([parse(&ring.wedge_model())?, parse(&ring.tip_model(tip))?])
}

/// The frames of W2.
pub fn ring_states() -> Frames {
    ring::states().iter().map(|states| states.to_vec()).collect()
}

/// W3 on one thread.
///
/// # Errors
/// Any error of the engine.
pub fn wheels(terrain: &Terrain, wheel: Wheel) -> Result<Rig, Box<dyn Error>> {
    Ok(Scene::wheels(terrain, wheel)?.rig(WorldBuilder::new(crate::rig::config(1)))?)
}
