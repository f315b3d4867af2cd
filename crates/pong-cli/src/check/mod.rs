//! `pong check`: check of models, alone and together.

mod bristles;
mod doubled;
mod named;
mod pairs;
mod solids;
mod stiffness;
mod tree;

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, failure, print, tell_lines};
use named::{Named, name};
use pong_model::printable;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

/// Checks model files (docs/model_format.md) and describes the contents of each and the contact of every two.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The model files.
    #[arg(value_name = "MODEL.ron", required = true)]
    models: Vec<PathBuf>,
    /// Checks each model by itself, without the contacts between them.
    #[arg(long)]
    alone: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let mut named: Vec<Named> = Vec::new();
    let mut faults = 0;
    let extensions = arguments.allowed.extensions();
    for path in &arguments.models {
        match pong_model::load(path, &extensions) {
            Ok(model) => named.push(name(&named, model)),
            Err(errors) => {
                tell_lines(&errors);
                faults += errors.0.len();
            }
        }
    }
    let mut text = String::new();
    for Named { name, model } in &named {
        text += &tree::description(name, model);
        text += &solids::description(model);
        let warnings = model.warnings.iter().cloned().chain(doubled::warnings(model));
        warnings.for_each(|warning| text += &format!("  warning: {}\n", printable(&warning)));
        let notes = bristles::notes(model).into_iter().chain(solids::notes(model));
        notes.for_each(|note| text += &format!("  note: {}\n", printable(&note)));
    }
    if !arguments.alone {
        for (a, b) in meetings(&named) {
            match pairs::description(a, b) {
                Ok(meeting) => text += &meeting,
                // Only a note: a scene need not pair the two, and one that does is refused.
                Err(problems) => {
                    text += &match Arc::ptr_eq(&a.model, &b.model) {
                        true => format!("`{}` cannot be paired with itself:\n", a.name),
                        false => format!("`{}` and `{}` cannot be paired:\n", a.name, b.name),
                    };
                    problems.iter().for_each(|problem| text += &format!("  note: {}\n", printable(problem)));
                }
            }
        }
    }
    print(&text);
    match faults {
        0 => Ok(ExitCode::SUCCESS),
        _ => Err(failure(crate::text::count(faults, "fault", "faults"))),
    }
}

/// Every two models, and each model with several movable groups with itself.
fn meetings(named: &[Named]) -> Vec<(&Named, &Named)> {
    let mut meetings = Vec::new();
    for (index, a) in named.iter().enumerate() {
        for (other, b) in named.iter().enumerate().skip(index) {
            if other != index || a.model.bodies.len() > 1 {
                meetings.push((a, b));
            }
        }
    }
    meetings
}
