//! Arguments of `pong interface`.

use crate::folders::AllowedFolders;
use crate::modes::state::StateChoice;
use std::path::PathBuf;

/// Computes the linear interface of two sets of bodies at a state: the 6×6 stiffness and damping of the contacts between
/// them at the present preload, and under which load the first contact opens and the first one slides (docs/modes.md).
///
/// Loads are those on the bodies of --of, which those of --on hold. Reference point and axes are the origin and the axes
/// of the first body of --of. The bodies of a set move as one: joints between them count as locked. Bodies in neither set
/// keep their forces.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file, or the folder of a response log. A log is taken at its last frame, or at the first one from --at on.
    #[arg(value_name = "SCENE.ron|LOG")]
    pub(super) source: PathBuf,
    /// Bodies of the first set, by their names in the scene or the log; `arm*` names all that begin with `arm`.
    #[arg(long, value_name = "BODY,…", value_delimiter = ',', required = true)]
    pub(super) of: Vec<String>,
    /// Bodies of the second set.
    #[arg(long, value_name = "BODY,…", value_delimiter = ',', required = true)]
    pub(super) on: Vec<String>,
    /// Writes the interface to this file: NASTRAN cards (.bdf, .dat, .nas) or CSV.
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    #[command(flatten)]
    pub(super) state: StateChoice,
    #[command(flatten)]
    pub(super) allowed: AllowedFolders,
}
