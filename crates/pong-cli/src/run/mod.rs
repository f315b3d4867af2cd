//! `pong run`: runs a scene, records it, summarises it.
//!
//! Exit code 3: the run ended, but paired objects could not touch each other.

mod acting;
mod arguments;
mod outputs;
mod statistics;
mod summary;

pub(crate) use arguments::Arguments;

use crate::terminal::{Failure, Outcome, failure, print, progress, tell};
use crate::text::number;
use outputs::Outputs;
use pong_executive::StepWatch;
use pong_executive::scene::{BuiltScene, Scene};
use statistics::Statistics;
use std::process::ExitCode;
use std::time::Instant;

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let scene =
        Scene::load(&arguments.scene).map(|scene| scene.with_extensions(arguments.allowed.extensions()));
    let mut built = scene.and_then(|scene| scene.build())?;
    for warning in built.warnings.iter().cloned().chain(built.seal.warnings.iter().map(ToString::to_string)) {
        tell(format!("warning: {warning}"));
    }
    let told = built.simulation.step_warnings();
    told.iter().for_each(|warning| tell(format!("warning: {warning}")));
    if !arguments.quiet {
        built.seal.notes.iter().for_each(|note| tell(format!("note: {note}")));
        built.simulation.step_notes().iter().for_each(|note| tell(format!("note: {note}")));
    }
    let mut statistics = Statistics::new(&built, arguments.acting);
    let ended = run(arguments, &mut built, &mut statistics, StepWatch::after(&told));
    if !arguments.quiet {
        print(&summary::summary(&built, &statistics));
    }
    for warning in built.simulation.energy_warnings() {
        tell(format!("warning: {warning}"));
    }
    for advice in statistics.run.advice() {
        tell(format!("warning: {advice}"));
    }
    ended.map_err(|reason| failure(format!("{}: {reason}", arguments.scene.display())))?;
    if built.passing_through.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    tell(passing_through(arguments, &built));
    Ok(ExitCode::from(PASSING_THROUGH))
}

/// Exit code of a run in which paired objects could not touch, so that contact had no part in its results.
const PASSING_THROUGH: u8 = 3;

fn passing_through(arguments: &Arguments, built: &BuiltScene) -> String {
    let pairs: Vec<String> =
        built.passing_through.iter().map(|[a, b]| format!("(\"{a}\", \"{b}\")")).collect();
    format!(
        "{}: paired objects passed through each other, for nothing of one can touch anything of the other: {}; give them what \
         can (the warnings above say what), or write passes_through: [{}] in the scene if that is meant",
        arguments.scene.display(),
        pairs.join(", "),
        pairs.join(", "),
    )
}

fn run(
    arguments: &Arguments,
    built: &mut BuiltScene,
    statistics: &mut Statistics,
    watch: StepWatch,
) -> Result<(), Failure> {
    let mut outputs = Outputs::create(arguments, built)?;
    let ended = advance(arguments, built, (statistics, watch), &mut outputs);
    // After a failure the records are completed too: its cause is looked for in them.
    let written = outputs.finish().map_err(Failure::from);
    ended.and(written)
}

fn advance(
    arguments: &Arguments,
    built: &mut BuiltScene,
    (statistics, mut watch): (&mut Statistics, StepWatch),
    outputs: &mut Outputs,
) -> Result<(), Failure> {
    let template = "{bar:40} {percent:>3} %  step {pos} of {len}, {eta} left";
    let bar = progress(Some(built.steps), template, arguments.quiet);
    built.simulation.commit_initial_states()?;
    if !arguments.quiet {
        built.simulation.start_notes().iter().for_each(|note| bar.suspend(|| tell(format!("note: {note}"))));
    }
    statistics.start(&built.simulation);
    for done in 0..=built.steps {
        if done > 0 {
            let begin = Instant::now();
            built.simulation.step()?;
            statistics.took(begin.elapsed());
            statistics.observe(&built.simulation);
            bar.inc(1);
        }
        for warning in watch.observe(&built.simulation) {
            let time = number(built.simulation.time());
            bar.suspend(|| tell(format!("warning: from t = {time} s on: {warning}")));
        }
        let last = done == built.steps;
        outputs.observe(&built.simulation, done, last)?;
    }
    bar.finish_and_clear();
    Ok(())
}
