//! `pong replay`: replay of a response log in the engine.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, print, progress, tell};
use crate::text::count;
use pong_engine::WorkerSettings;
use pong_record::{Log, LogError, ReplayOptions, ReplayReport, replay};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

/// Runs the recorded states of a response log through the engine again and compares wrenches and contacts bit
/// for bit.
///
/// Ends with 0 if every frame of the log came out the same, with 1 otherwise; the first frame that differs is
/// reported with body or contact, quantity and both values.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The folder of the log.
    #[arg(value_name = "LOG")]
    log: PathBuf,
    /// Tolerance relative to the largest number of a kind in the frame: for other versions of the engine, and
    /// for logs that do not have every commit.
    #[arg(long, value_name = "RELATIVE", value_parser = tolerance)]
    tolerance: Option<f64>,
    /// Additional threads; the results are the same bits.
    #[arg(long, value_name = "N", default_value_t = 0)]
    workers: usize,
    /// No progress bar and no summary; differences and errors stay.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "give a number, such as 1e-9".to_owned())?;
    if (0.0..1.0).contains(&value) { Ok(value) } else { Err("give a number from 0 up to 1".to_owned()) }
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let report = run(arguments)?;
    if !arguments.quiet {
        print(&summary(&report, arguments.tolerance));
    }
    for difference in &report.differences {
        tell(difference);
    }
    if let Some(obstacle) = &report.obstacle {
        tell(format!("not exact from frame {} on: {obstacle}", obstacle.frame()));
    }
    Ok(if report.agrees() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn run(arguments: &Arguments) -> Result<ReplayReport, LogError> {
    let mut log = Log::open(&arguments.log)?;
    if !log.is_whole() {
        tell(format!("warning: the log was not closed: {} whole frames of it are there", log.frame_count()));
    }
    let settings = WorkerSettings { workers: arguments.workers, ..WorkerSettings::default() };
    let options = ReplayOptions {
        workers: (arguments.workers > 0).then_some(settings),
        tolerance: arguments.tolerance,
        extensions: arguments.allowed.extensions(),
        ..ReplayOptions::default()
    };
    let template = "{bar:40} {percent:>3} %  frame {pos} of {len}, {eta} left";
    let bar = progress(Some(log.frame_count()), template, arguments.quiet);
    let report = replay(&mut log, &options, &mut |done| {
        if done % 256 == 0 {
            bar.set_position(done);
        }
        ControlFlow::Continue(())
    });
    bar.finish_and_clear();
    report
}

fn summary(report: &ReplayReport, tolerance: Option<f64>) -> String {
    let frames = count(report.frames as usize, "frame", "frames");
    let contacts = count(report.contacts as usize, "contact", "contacts");
    let same = match tolerance {
        None => "the same bits".to_owned(),
        Some(tolerance) => format!("the same within {tolerance:?}"),
    };
    match (report.agrees(), report.compared) {
        (true, _) => format!("{frames} with {contacts}: {same}\n"),
        (false, compared) => {
            let good = compared - u64::from(!report.differences.is_empty());
            format!("{good} of {frames} replayed: {same}\n")
        }
    }
}
