//! A scene in an FMU: the data common to all its instances, and the simulation of one of them.

use crate::surfaces::{ScaledSurface, scaled_surfaces};
use crate::variables::Variables;
use pong_engine::{FrictionPreload, PairId};
use pong_executive::scene::BuiltScene;
use pong_executive::{BodyId, Motion, Simulation};

/// A scene whose bodies are moved by the FMU, or some of them by the importer.
pub(crate) struct Unit {
    pub name: String,
    pub simulation: Simulation,
    pub variables: Variables,
    pub surfaces: Vec<ScaledSurface>,
    /// True if outputs include mean contact wrenches over a communication step.
    pub step_means: bool,
    /// Initial friction.
    pub preload: Vec<(PairId, FrictionPreload)>,
    /// Saved initial instant of the simulation.
    pub begin: Vec<u8>,
    /// Duration of the scene, s.
    pub duration: f64,
    /// Warnings for the author of scene and models.
    pub warnings: Vec<String>,
    /// Hash of all its files.
    pub token: String,
}

/// Bodies that the importer moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Inputs {
    /// Bodies with these names.
    Named(Vec<String>),
    /// All bodies that the scene does not hold fixed.
    All,
}

impl Unit {
    /// Makes a unit from a scene that was built and not run.
    ///
    /// # Errors
    /// Bodies that do not exist or are named twice: thing, cause and cure.
    pub fn new(built: BuiltScene, inputs: &Inputs, step_means: bool) -> Result<Self, String> {
        let mut simulation = built.simulation;
        let led = led_bodies(&simulation, inputs)?;
        let failed = |error: pong_executive::ExecutiveError| error.to_string();
        for body in &led {
            let (pose, twist) = (simulation.pose(*body), simulation.twist(*body));
            simulation.lead(*body, simulation.time(), pose, twist).map_err(failed)?;
        }
        let surfaces = scaled_surfaces(simulation.world());
        let variables = Variables::new(&simulation, &led, &surfaces, step_means);
        if step_means {
            simulation.keep_contact_impulses();
        }
        let mut begin = Vec::new();
        simulation.save(&mut begin);
        let duration = built.steps as f64 * simulation.step_length();
        let warnings = built.warnings.into_iter().chain(built.seal.warnings.iter().map(ToString::to_string));
        let (warnings, preload, name) = (warnings.collect(), built.preload, built.name);
        let token = String::new();
        Ok(Self {
            name,
            simulation,
            variables,
            surfaces,
            step_means,
            preload,
            begin,
            duration,
            warnings,
            token,
        })
    }

    /// Names of the bodies that the importer moves.
    pub fn input_bodies(&self) -> Vec<String> {
        let led = self
            .simulation
            .bodies()
            .filter(|(_, body)| matches!(&body.motion, Motion::Prescribed(pong_executive::Path::Led { .. })));
        led.map(|(_, body)| body.name.clone()).collect()
    }
}

fn led_bodies(simulation: &Simulation, inputs: &Inputs) -> Result<Vec<BodyId>, String> {
    let Inputs::Named(names) = inputs else {
        let moves = simulation.bodies().filter(|(_, body)| !matches!(body.motion, Motion::Fixed));
        return Ok(moves.map(|(id, _)| id).collect());
    };
    let mut led = Vec::new();
    for name in names {
        let Some((id, _)) = simulation.bodies().find(|(_, body)| &body.name == name) else {
            let known: Vec<&str> = simulation.bodies().map(|(_, body)| body.name.as_str()).collect();
            return Err(format!(
                "input `{name}`: the scene has no such body; name one of: {}",
                known.join(", ")
            ));
        };
        if led.contains(&id) {
            return Err(format!("input `{name}`: it is named twice; name each body once"));
        }
        led.push(id);
    }
    Ok(led)
}
