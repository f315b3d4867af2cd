//! `pong log`: description of a response log, the log as CSV, and the tangents of its frames.

use crate::terminal::{Outcome, print, tell};
use crate::text::{count, number};
use pong_model::printable;
use pong_record::{CsvTables, Frame, Log, LogError, ReplayOptions, write_tangents};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Describes a response log (docs/response_logs.md), and writes it as CSV files if asked to.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The folder of the log.
    #[arg(value_name = "LOG")]
    log: PathBuf,
    /// Writes states.csv, wrenches.csv, contacts.csv and, if the log has energies, energies.csv into this folder.
    #[arg(long, value_name = "DIR")]
    csv: Option<PathBuf>,
    /// Replays the log and writes the derivatives of the wrenches of every two bodies that touch, frame by frame, as this
    /// NumPy file.
    #[arg(long, value_name = "FILE.npy")]
    tangents: Option<PathBuf>,
    /// No description.
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let mut log = Log::open(&arguments.log)?;
    if !arguments.quiet {
        print(&description(&mut log)?);
    }
    if let Some(folder) = &arguments.csv {
        export(&mut log, folder)?;
    }
    if let Some(file) = &arguments.tangents {
        let (count, obstacle) = write_tangents(&mut log, ReplayOptions::default(), file)?;
        print(&format!("{}: {}\n", file.display(), rows(count, "tangent")));
        if let Some(obstacle) = obstacle {
            tell(format!("not exact from frame {} on: {obstacle}", obstacle.frame()));
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn description(log: &mut Log) -> Result<String, LogError> {
    let frames = log.frame_count();
    let mut ends = log.frame_rows(0, 1)?;
    ends.extend(log.frame_rows(frames.saturating_sub(1), 1)?);
    let contacts = ends.last().map_or(0, |last| last.first_contact + u64::from(last.contacts));
    let run = log.run();
    let mut text = format!("{}: {}", printable(&run.name), count(frames as usize, "frame", "frames"));
    if let [first, .., last] = ends[..] {
        let _ = write!(text, ", t = {} … {} s", number(first.time), number(last.time));
    }
    let _ = writeln!(
        text,
        ", {}; by {}, engine {}",
        rows(contacts, "contact"),
        printable(&run.writer),
        printable(&run.engine)
    );
    let step = run.step.map(|step| format!("step {} s", number(step)));
    let commits = run.commits_per_frame.map(|commits| rows(commits, "commit") + " per frame");
    let told: Vec<String> = step.into_iter().chain(run.integrator.clone()).chain(commits).collect();
    if !told.is_empty() {
        let _ = writeln!(text, "  {}", printable(&told.join(", ")));
    }
    for model in &run.models {
        let _ = writeln!(
            text,
            "  model `{}`: {}, hash {:#018x}",
            printable(&model.name),
            printable(&model.file),
            model.hash
        );
    }
    for body in &run.bodies {
        let _ = writeln!(text, "  body `{}`", printable(&body.name));
    }
    for pair in 0..run.pairs.len() {
        let [a, b] = run.pair_names(pair).unwrap_or_default();
        let _ = writeln!(text, "  pair `{}`, `{}`", printable(a), printable(b));
    }
    if !log.events().is_empty() {
        let _ = writeln!(text, "  {}", rows(log.events().len() as u64, "event"));
    }
    if run.lost > 0 {
        let _ = writeln!(text, "  {} lost while it was written", rows(run.lost, "frame"));
    }
    if !log.is_whole() {
        text.push_str("  not closed: the run was cut off, or is still going\n");
    }
    Ok(text)
}

fn rows(number: u64, what: &str) -> String {
    count(number as usize, what, &format!("{what}s"))
}

fn export(log: &mut Log, folder: &Path) -> Result<(), LogError> {
    let energies = log.run().tables.contains_key("energies");
    let mut tables = CsvTables::create(folder, log.run(), energies)?;
    let mut frame = Frame::default();
    for index in 0..log.frame_count() {
        log.read(index, &mut frame)?;
        tables.write(&frame)?;
    }
    tables.finish()
}
