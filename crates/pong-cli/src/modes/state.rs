//! State of a scene that is looked at: its start, a time, or rest.

use crate::terminal::Failure;
use crate::text::number;
use pong_executive::Simulation;
use pong_executive::scene::BuiltScene;

/// Number of steps over which a scene must rest.
const STEPS_AT_REST: u32 = 50;
/// Share of the largest kinetic energy of a run below which the bodies rest.
const SHARE_AT_REST: f64 = 1e-10;
/// Kinetic energy, relative to that of all free bodies at 1 m/s, below which bodies rest whatever happened before.
const ENERGY_AT_REST: f64 = 1e-20;

/// Options that choose the state of a scene.
#[derive(clap::Args)]
pub(crate) struct StateChoice {
    /// Runs the scene to this time, s.
    #[arg(long, value_name = "TIME", conflicts_with = "settle")]
    pub(crate) at: Option<f64>,
    /// Runs the scene until all bodies rest, at most for its duration.
    #[arg(long)]
    pub(crate) settle: bool,
}

/// Runs a scene to its state and returns a description of this state.
pub(crate) fn reach(choice: &StateChoice, built: &mut BuiltScene) -> Result<String, Failure> {
    let simulation = &mut built.simulation;
    simulation.commit_initial_states()?;
    if let Some(time) = choice.at {
        if !(time >= 0.0 && time.is_finite()) {
            return Err(format!("--at: it is {time} s; give a finite time from zero up").into());
        }
        simulation.run_for(time)?;
        return Ok(format!("at t = {} s", number(simulation.time())));
    }
    if !choice.settle {
        return Ok("at the start".to_owned());
    }
    let rests = settle(simulation, built.steps)?;
    let time = number(simulation.time());
    Ok(if rests { format!("at rest from t = {time} s on") } else { format!("still moving at t = {time} s") })
}

/// Steps until the bodies rest, at most `steps` steps; returns true if they do.
fn settle(simulation: &mut Simulation, steps: u64) -> Result<bool, Failure> {
    let mass: f64 = simulation.bodies().filter_map(|(_, body)| Some(body.mass()?.mass)).sum();
    let (mut largest, mut still) = (simulation.energy().kinetic, 0);
    for _ in 0..steps {
        simulation.step()?;
        let kinetic = simulation.energy().kinetic;
        largest = largest.max(kinetic);
        still = if kinetic <= (SHARE_AT_REST * largest).max(ENERGY_AT_REST * mass) { still + 1 } else { 0 };
        if still >= STEPS_AT_REST {
            return Ok(true);
        }
    }
    Ok(false)
}
