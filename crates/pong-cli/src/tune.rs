//! `pong tune`: bounds and leaves that lower the frame time of a run, with the same bits.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, SPINNER, print, progress, show, tell};
use pong_study::StudyError;
use pong_study::tree_tuning::{Output, Progress, Settings, Tuned, report, tune};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Searches for bounding volumes and leaves with which the frames of a run take less time, and writes new
/// model files (docs/tune.md).
///
/// Every frame of the run must come out the same, bit for bit; a change that is not faster by more than noise
/// is not taken. Files are called `<model>_tuned.ron`; nothing is replaced.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file, or the folder of a response log.
    #[arg(value_name = "SCENE.ron|LOG")]
    subject: PathBuf,
    /// Another run that the models must serve too; may be given several times. All count the same.
    #[arg(long, value_name = "SCENE.ron|LOG")]
    also: Vec<PathBuf>,
    /// Folder for the tuned models, with the meshes that they need; beside each model unless given, for a log
    /// `<log>_tuned`.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Replaces existing tuned models.
    #[arg(long)]
    force: bool,
    /// Another duration than the run's, s.
    #[arg(long, value_name = "SECONDS")]
    duration: Option<f64>,
    /// Number of timings of every proposal; before and after three times as many.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(2..=1000))]
    rounds: u32,
    /// Frames of each run that are timed in the end, spread over it; the search uses a quarter of them.
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u64).range(16..=1_000_000))]
    frames: u64,
    /// No progress and no page; warnings and errors stay.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let tuned = run(arguments)?;
    if !arguments.quiet {
        print(&report::page(&tuned));
    }
    for line in tuned.refused.iter().filter(|_| arguments.quiet) {
        tell(format!("warning: a proposal was thrown away: {line}"));
    }
    Ok(ExitCode::SUCCESS)
}

fn run(arguments: &Arguments) -> Result<Tuned, StudyError> {
    let mut runs: Vec<&Path> = vec![&arguments.subject];
    runs.extend(arguments.also.iter().map(PathBuf::as_path));
    let settings = Settings {
        rounds: arguments.rounds,
        frames: arguments.frames,
        duration_s: arguments.duration,
        output: Output { folder: folder(arguments), force: arguments.force },
        extensions: arguments.allowed.extensions(),
    };
    let bar = progress(None, SPINNER, arguments.quiet);
    let mut watch = |progress: &Progress| {
        match progress {
            Progress::Running { doing, done, of } => show(&bar, &format!("{doing}: frame {done} of {of}")),
            Progress::Searching(doing) => show(&bar, doing),
        }
        ControlFlow::Continue(())
    };
    let tuned = tune(&runs, &settings, &mut watch);
    bar.finish_and_clear();
    tuned
}

/// Output folder; for a log not its own folder, which keeps copies of the models.
fn folder(arguments: &Arguments) -> Option<PathBuf> {
    arguments.output.clone().or_else(|| crate::folders::beside_a_log(&arguments.subject, "tuned"))
}
