//! `pong trim`: models without primitives that runs never came near, with the same wrenches.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, SPINNER, print, progress, show};
use pong_study::trimming::{Output, Settings, report, trim};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Finds the primitives that a run never came near, and writes new model files without them (docs/trim.md).
///
/// The run is repeated with these; the wrenches of every frame must be the same bits. Files are called
/// `<model>_trimmed.ron`; nothing is replaced.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file, or the folder of a response log.
    #[arg(value_name = "SCENE.ron|LOG")]
    subject: PathBuf,
    /// Another run that the models must serve too; may be given several times. Primitives that any of them
    /// came near stay.
    #[arg(long, value_name = "SCENE.ron|LOG")]
    also: Vec<PathBuf>,
    /// Removes a primitive that came no nearer than this to any partner, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.1)]
    margin: f64,
    /// Folder for the trimmed models, with the meshes that they need; beside each model unless given, for a log
    /// `<log>_trimmed`.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Replaces existing trimmed models.
    #[arg(long)]
    force: bool,
    /// Another duration than the run's, s.
    #[arg(long, value_name = "SECONDS")]
    duration: Option<f64>,
    /// Number of timings of the frames before and after, in turn.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Frames of each run that are timed, spread over it.
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u64).range(16..=1_000_000))]
    frames: u64,
    /// No progress and no page; errors stay.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let mut runs: Vec<&Path> = vec![&arguments.subject];
    runs.extend(arguments.also.iter().map(PathBuf::as_path));
    let settings = Settings {
        margin: arguments.margin,
        rounds: arguments.rounds,
        frames: arguments.frames,
        duration_s: arguments.duration,
        output: Output { folder: folder(arguments), force: arguments.force },
        extensions: arguments.allowed.extensions(),
    };
    let bar = progress(None, SPINNER, arguments.quiet);
    let trimmed = trim(&runs, &settings, &mut |doing, done, of| {
        show(&bar, &format!("{doing}: frame {done} of {of}"));
        Ok(())
    });
    bar.finish_and_clear();
    let trimmed = trimmed?;
    if !arguments.quiet {
        print(&report::page(&trimmed));
    }
    Ok(ExitCode::SUCCESS)
}

/// Output folder; for a log not its own folder, which keeps copies of the models.
fn folder(arguments: &Arguments) -> Option<PathBuf> {
    arguments.output.clone().or_else(|| crate::folders::beside_a_log(&arguments.subject, "trimmed"))
}
