//! Arguments of `pong run`.

use crate::folders::AllowedFolders;
use std::path::PathBuf;

/// Runs a scene file (docs/scene_format.md) and summarises the run.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE.ron")]
    pub(super) scene: PathBuf,
    /// Folder for the CSV files; created if it does not exist. Implies --csv.
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Writes states.csv, wrenches.csv and contacts.csv (with the ledger also energies.csv and accounts.csv), into
    /// `<scene>_out` unless -o says otherwise.
    #[arg(long)]
    pub(super) csv: bool,
    /// Writes a response log into this folder (docs/response_logs.md).
    #[arg(long, value_name = "DIR")]
    pub(super) log: Option<PathBuf>,
    /// Writes every step into the log, whatever `record_every` says: such a log can be replayed exactly.
    #[arg(long, requires = "log")]
    pub(super) every_step: bool,
    /// Replaces a log that is in the folder.
    #[arg(long, requires = "log")]
    pub(super) overwrite: bool,
    /// Checks the step against the contacts that really act together, at every step, and reports the worst in
    /// the summary (docs/advise.md).
    #[arg(long, conflicts_with = "quiet")]
    pub(super) acting: bool,
    /// No progress bar, no notes and no summary; warnings and errors stay.
    #[arg(short, long)]
    pub(super) quiet: bool,
    #[command(flatten)]
    pub(super) allowed: AllowedFolders,
}
