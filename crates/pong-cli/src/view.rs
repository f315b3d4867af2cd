//! `pong view`: a response log as one web page.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, print, tell, unwritable};
use crate::text::{count, number};
use pong_record::Log;
use pong_view::{Options, Page, ViewError};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Makes one self-contained web page of a response log (docs/response_logs.md) that plays the run in any browser.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The folder of the log.
    #[arg(value_name = "LOG")]
    log: PathBuf,
    /// The page; `<log>.html` unless given.
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,
    /// Keeps only every N-th frame and the last; without it as many as --budget holds.
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u64).range(1..))]
    every: Option<u64>,
    /// Most megabytes of the frames before they are packed.
    #[arg(long, value_name = "MB", default_value_t = 64, conflicts_with = "every",
          value_parser = clap::value_parser!(u64).range(1..=4000))]
    budget: u64,
    /// Says nothing unless something is wrong.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let output = arguments.output.clone().unwrap_or_else(|| beside(&arguments.log));
    let page = page(arguments)?;
    pong_model::files::replace(&output, page.html.as_bytes())
        .map_err(|reason| unwritable(&output, &reason))?;
    for note in &page.notes {
        tell(format!("note: {note}"));
    }
    if !arguments.quiet {
        print(&summary(&output, &page));
    }
    Ok(ExitCode::SUCCESS)
}

fn page(arguments: &Arguments) -> Result<Page, ViewError> {
    let mut log = Log::open(&arguments.log)?;
    let options = Options { every: arguments.every, budget: arguments.budget * 1_000_000 };
    pong_view::page(&mut log, &options, &arguments.allowed.extensions())
}

/// The page beside a log: `runs/drop.html` for `runs/drop` and `runs/drop/`.
fn beside(log: &Path) -> PathBuf {
    match log.file_name() {
        Some(name) => log.with_file_name(format!("{}.html", name.to_string_lossy())),
        None => PathBuf::from("view.html"),
    }
}

fn summary(output: &Path, page: &Page) -> String {
    let frames = if page.every > 1 {
        format!("{} of {} frames (every {})", page.frames, page.frames_in_log, page.every)
    } else {
        count(page.frames as usize, "frame", "frames")
    };
    let [unpacked, packed] = page.data_bytes;
    format!(
        "{}: {frames}, {}, {}; {} MB, of it {} MB of data ({} bytes per frame before packing)\n",
        output.display(),
        count(page.contacts as usize, "contact", "contacts"),
        count(page.triangles as usize, "triangle", "triangles"),
        number(megabytes(page.html.len() as u64)),
        number(megabytes(packed)),
        unpacked / page.frames.max(1),
    )
}

/// Megabytes with three decimals.
fn megabytes(bytes: u64) -> f64 {
    (bytes as f64 / 1e3).round() / 1e3
}
