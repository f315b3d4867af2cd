//! `pong join`: several models that never move relative to each other become one.

use crate::folders::AllowedFolders;
use crate::placed::{VALUE_NAME, placed};
use crate::terminal::{Outcome, failure, print, tell, tell_lines, unwritable};
use pong_model::{JoinError, PlacedFile, join_files, printable};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Joins models that never move relative to each other into one, so that flush faces of theirs are one surface.
///
/// Contacts on one surface share one spring; over a seam of two Objects, or of two surfaces, springs add, and what
/// rolls over it hops. The root of each model becomes a group of the new root. Movable groups below it stay movable.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The model file to write.
    #[arg(value_name = "OUT.ron")]
    output: PathBuf,
    /// The models, each with its position in m, and its orientation as a quaternion: part.ron@0,1.5,0 or
    /// part.ron@0,1.5,0,1,0,0,0. A model may be named several times.
    #[arg(value_name = VALUE_NAME, required = true, value_parser = placed)]
    models: Vec<PlacedFile>,
    /// Name of the new model; that of the file unless given.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Does not declare the new root one surface.
    #[arg(long)]
    separate: bool,
    /// Replaces an existing file.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let Arguments { output, models, separate, force, .. } = arguments;
    if output.exists() && !force {
        return Err(failure(format!("{} is there already; --force replaces it", output.display())));
    }
    let extensions = arguments.allowed.extensions();
    let folder = output.parent().unwrap_or(Path::new(""));
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let name = arguments.name.as_deref().unwrap_or(&stem);
    let text = match join_files(name, models, folder, !separate, &extensions) {
        Ok(text) => text,
        Err(JoinError::Model(errors)) => {
            tell_lines(&errors);
            return Err(failure("nothing is written"));
        }
        Err(JoinError::Cause(cause)) => return Err(failure(cause)),
    };
    let model = match pong_model::parse(&text, &output.display().to_string(), Some(folder), &extensions) {
        Ok(model) => model,
        Err(errors) => {
            tell_lines(&errors);
            return Err(failure("the joined model is refused; nothing is written"));
        }
    };
    std::fs::write(output, text).map_err(|reason| unwritable(output, &reason))?;
    model.warnings.iter().for_each(|warning| tell(format!("warning: {}", printable(warning))));
    print(&format!("written: {}\n", output.display()));
    Ok(ExitCode::SUCCESS)
}
