//! `pong trade`: accuracy against speed, measured on the user's scene.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, print, progress, show, tell};
use pong_engine::WorkerSettings;
use pong_study::sweep::{
    Lever, LogAlternative, PlanSettings, Progress, Quantity, Settings, Study, report, study, study_log,
};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

/// Runs a scene, or the motions of a log, with the options that buy speed, and reports frame time against
/// error to a reference (docs/trade.md).
///
/// Writes trade.md, trade.csv, errors.csv and trade.svg. Finished runs are kept beside them: a study that was
/// stopped goes on where it was.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file, or the folder of a response log.
    #[arg(value_name = "SCENE.ron|LOG")]
    subject: PathBuf,
    /// Folder for the results; `<scene>_trade` or `<log>_trade` unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The allowed error: names the cheapest level within it.
    #[arg(long, value_name = "ERROR", default_value = "2%", value_parser = share)]
    within: f64,
    /// Quantities that must be within: any of wrench, impulse, peak, energy, pose.
    #[arg(long, value_name = "QUANTITIES", value_delimiter = ',', value_parser = quantity)]
    of: Vec<Quantity>,
    /// Length of a frame, s: the longest step. 16 steps of the scene unless given, fewer if that leaves less than 64 frames.
    #[arg(long, value_name = "SECONDS")]
    frame: Option<f64>,
    /// Number of halvings of the frame for the shortest step; down to half the scene's step unless given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=16))]
    halvings: Option<u32>,
    /// Another duration than the scene's, s.
    #[arg(long, value_name = "SECONDS")]
    duration: Option<f64>,
    /// Only these levers: any of step, integrator, friction, alternatives, bounds, leaves, workers, long_frame.
    #[arg(long, value_name = "LEVERS", value_delimiter = ',', value_parser = lever)]
    levers: Vec<Lever>,
    /// Other files for some of a log's models, as NAME:MODEL=FILE,MODEL=FILE; may be given several times. A
    /// scene names its own.
    #[arg(long, value_name = "NAME:MODEL=FILE", value_parser = alternative)]
    alternative: Vec<LogAlternative>,
    /// Leaf sizes to try, in elements.
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', default_value = "8,32,128")]
    leaves: Vec<usize>,
    /// Numbers of workers to try.
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', default_value = "1")]
    workers: Vec<usize>,
    /// Number of timings of every level.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Most halvings of the step of the reference until it has converged.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=8))]
    refinements: u32,
    /// Begins anew, without the kept results.
    #[arg(long)]
    fresh: bool,
    /// No progress bar and no page; errors stay.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 0.01));
    let value =
        number.trim().parse::<f64>().map_err(|_| "give a share such as 2% or 0.02".to_owned())? * unit;
    if value > 0.0 && value < 1.0 {
        Ok(value)
    } else {
        Err("give a share above 0 and below 100 %".to_owned())
    }
}

fn quantity(text: &str) -> Result<Quantity, String> {
    one_of(text, &Quantity::ALL, Quantity::name)
}

fn lever(text: &str) -> Result<Lever, String> {
    one_of(text, Lever::ALL, Lever::name)
}

fn one_of<T: Copy>(text: &str, all: &[T], name: fn(T) -> &'static str) -> Result<T, String> {
    let known: Vec<&str> = all.iter().map(|one| name(*one)).collect();
    let found = known.iter().position(|name| *name == text.trim());
    found.map(|place| all[place]).ok_or_else(|| format!("give any of {}", known.join(", ")))
}

fn alternative(text: &str) -> Result<LogAlternative, String> {
    let cure = || "give NAME:MODEL=FILE, such as coarse:peg=peg_coarse.ron".to_owned();
    let (name, rest) = text.split_once(':').filter(|(name, _)| !name.is_empty()).ok_or_else(cure)?;
    let models = rest.split(',').map(|pair| {
        let (model, file) = pair.split_once('=').ok_or_else(cure)?;
        Ok((model.to_owned(), PathBuf::from(file)))
    });
    Ok(LogAlternative { name: name.to_owned(), models: models.collect::<Result<_, String>>()? })
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let study = &run(arguments)?;
    if !arguments.quiet {
        print(&report::markdown(study));
        print(&format!(
            "\nwritten: trade.md, trade.csv, errors.csv and trade.svg in {}\n",
            output(arguments).display()
        ));
    }
    let changed: Vec<&str> = study
        .rows
        .iter()
        .filter(|row| study.same_bits(row) == Some(false))
        .map(|row| row.name.as_str())
        .collect();
    for name in &changed {
        tell(format!(
            "{name}: the answer is not the same bits as without this lever; that is a fault of the engine"
        ));
    }
    if !study.converged {
        tell("warning: the reference has not converged; no level is named");
    }
    Ok(if changed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn output(arguments: &Arguments) -> PathBuf {
    let subject = &arguments.subject;
    let name = if subject.is_dir() { subject.file_name() } else { subject.file_stem() };
    let stem = name.unwrap_or_default().to_string_lossy();
    arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}_trade")))
}

fn run(arguments: &Arguments) -> Result<Study, pong_study::StudyError> {
    let bar = progress(Some(1), "{bar:30} {percent:>3} %, {eta} left: {msg}", arguments.quiet);
    let mut watch = |now: &Progress<'_>| {
        bar.set_length(now.of);
        bar.set_position(now.done);
        show(&bar, now.doing);
        ControlFlow::Continue(())
    };
    let (subject, output) = (&arguments.subject, output(arguments));
    let study = match subject.is_dir() {
        true => study_log(subject, &arguments.alternative, &output, &settings(arguments), &mut watch),
        false if !arguments.alternative.is_empty() => {
            bar.finish_and_clear();
            let line =
                "--alternative: a scene names its own; write `alternatives` into it (docs/scene_format.md)";
            return Err(pong_study::StudyError(line.to_owned()));
        }
        false => study(subject, &output, &settings(arguments), &mut watch),
    };
    bar.finish_and_clear();
    let study = study?;
    report::write(&study, &output)?;
    Ok(study)
}

fn settings(arguments: &Arguments) -> Settings {
    let all_if_none =
        |chosen: &[Quantity]| if chosen.is_empty() { Quantity::ALL.to_vec() } else { chosen.to_vec() };
    Settings {
        plan: PlanSettings {
            frame_s: arguments.frame,
            halvings: arguments.halvings,
            duration_s: arguments.duration,
            levers: if arguments.levers.is_empty() { Lever::usual() } else { arguments.levers.clone() },
            leaves: arguments.leaves.clone(),
            workers: granted(&arguments.workers),
        },
        within: arguments.within,
        of: all_if_none(&arguments.of),
        rounds: arguments.rounds,
        refinements: arguments.refinements,
        fresh: arguments.fresh,
        extensions: arguments.allowed.extensions(),
    }
}

/// The numbers of workers for which this machine has cores; the others are reported.
fn granted(wanted: &[usize]) -> Vec<usize> {
    let has = |workers: &usize| {
        let settings = WorkerSettings { workers: *workers, ..WorkerSettings::default() };
        settings.workers_granted() >= *workers
    };
    let (granted, refused): (Vec<usize>, Vec<usize>) = wanted.iter().partition(|workers| has(workers));
    for workers in refused {
        tell(format!(
            "warning: --workers {workers} is left out: there are not so many cores beside the caller's"
        ));
    }
    granted
}
