//! Arguments of `pong modes`.

use super::state::StateChoice;
use crate::folders::AllowedFolders;
use std::path::PathBuf;

/// Computes the modes of a scene at a state: frequencies, damping ratios and shapes, and the contacts and springs that
/// carry each mode (docs/modes.md).
///
/// The state is the start of the scene, unless --at or --settle is given. Contacts count as they are in this state: those
/// that stick as springs, those that are open not at all.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE.ron")]
    pub(super) scene: PathBuf,
    #[command(flatten)]
    pub(super) state: StateChoice,
    /// Prints the modes as CSV.
    #[arg(long, conflicts_with = "json")]
    pub(super) csv: bool,
    /// Prints the modes as JSON.
    #[arg(long)]
    pub(super) json: bool,
    /// Writes the shape of --mode as a response log into this folder, for `pong view` and other viewers.
    #[arg(long, value_name = "DIR", requires = "mode")]
    pub(super) log: Option<PathBuf>,
    /// Number of the mode in the log, as in the table.
    #[arg(long, value_name = "N", requires = "log", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) mode: Option<u32>,
    /// Replaces a log in the folder of --log.
    #[arg(long, requires = "log")]
    pub(super) overwrite: bool,
    #[command(flatten)]
    pub(super) allowed: AllowedFolders,
}
