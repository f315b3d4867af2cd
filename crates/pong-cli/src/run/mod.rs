//! `pong run`: runs a scene, records it, sums it up.

mod acting;
mod arguments;
mod outputs;
mod statistics;
mod summary;

pub(crate) use arguments::Arguments;

use crate::terminal::{print, tell, tell_lines};
use crate::text::number;
use indicatif::{ProgressBar, ProgressStyle};
use outputs::Outputs;
use pong_executive::scene::{BuiltScene, Scene};
use pong_executive::{ExecutiveError, StepWatch};
use statistics::Statistics;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Why a run ended early.
enum Failure {
    Dynamics(ExecutiveError),
    Output(String),
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Dynamics(error) => error.fmt(f),
            Self::Output(reason) => f.write_str(reason),
        }
    }
}

pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let scene =
        Scene::load(&arguments.scene).map(|scene| scene.with_extensions(arguments.allowed.extensions()));
    let mut built = match scene.and_then(|scene| scene.build()) {
        Ok(built) => built,
        Err(errors) => {
            tell_lines(&errors);
            return ExitCode::FAILURE;
        }
    };
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
    for advice in
        [statistics.run.incomplete_advice(), statistics.run.tunnelling_advice()].into_iter().flatten()
    {
        tell(format!("warning: {advice}"));
    }
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            tell(format!("{}: {failure}", arguments.scene.display()));
            ExitCode::FAILURE
        }
    }
}

fn run(
    arguments: &Arguments,
    built: &mut BuiltScene,
    statistics: &mut Statistics,
    watch: StepWatch,
) -> Result<(), Failure> {
    let mut outputs = Outputs::create(arguments, built).map_err(Failure::Output)?;
    let ended = advance(arguments, built, (statistics, watch), &mut outputs);
    // What was recorded before a failure is what its cause is sought in.
    let written = outputs.finish().map_err(Failure::Output);
    ended.and(written)
}

fn advance(
    arguments: &Arguments,
    built: &mut BuiltScene,
    (statistics, mut watch): (&mut Statistics, StepWatch),
    outputs: &mut Outputs,
) -> Result<(), Failure> {
    let bar = progress_bar(built.steps, arguments.quiet);
    built.simulation.commit_initial_states().map_err(Failure::Dynamics)?;
    statistics.start(&built.simulation);
    for done in 0..=built.steps {
        if done > 0 {
            let begin = Instant::now();
            built.simulation.step().map_err(Failure::Dynamics)?;
            statistics.took(begin.elapsed());
            statistics.observe(&built.simulation);
            bar.inc(1);
        }
        for warning in watch.observe(&built.simulation) {
            let time = number(built.simulation.time());
            bar.suspend(|| tell(format!("warning: from t = {time} s on: {warning}")));
        }
        let last = done == built.steps;
        outputs.observe(&built.simulation, done, last).map_err(Failure::Output)?;
    }
    bar.finish_and_clear();
    Ok(())
}

/// A bar on standard error, if that is a terminal.
fn progress_bar(steps: u64, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(steps);
    let template = "{bar:40} {percent:>3} %  step {pos} of {len}, {eta} left";
    bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
