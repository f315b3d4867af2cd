//! `pong modes`: frequencies, damping ratios and shapes of a scene at a state (docs/modes.md).

mod animation;
mod arguments;
mod report;
pub(crate) mod state;

pub(crate) use arguments::Arguments;

use crate::terminal::{Outcome, print, tell};
use pong_executive::scene::{BuiltScene, Scene};
use std::process::ExitCode;

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let scene =
        Scene::load(&arguments.scene).map(|scene| scene.with_extensions(arguments.allowed.extensions()))?;
    let mut built = scene.build()?;
    warnings(&built);
    let state = state::reach(&arguments.state, &mut built)?;
    let linear = built.simulation.linearised()?;
    let modes = linear.system.modes(linear.tolerance())?;
    let text = match (arguments.csv, arguments.json) {
        (true, _) => report::csv(&linear, &modes),
        (_, true) => report::json(&linear, &modes)?,
        _ => report::text(&built, &state, &linear, &modes),
    };
    print(&text);
    for note in report::notes(&built, &linear) {
        tell(format!("note: {note}"));
    }
    if let Some(number) = arguments.mode {
        let mode = modes.modes.get(number as usize - 1).ok_or_else(|| {
            format!("--mode: it is {number}, and there are {} modes; give one of them", modes.modes.len())
        })?;
        animation::write(arguments, &scene, &built, (&linear, mode))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn warnings(built: &BuiltScene) {
    for warning in built.warnings.iter().cloned().chain(built.seal.warnings.iter().map(ToString::to_string)) {
        tell(format!("warning: {warning}"));
    }
}
