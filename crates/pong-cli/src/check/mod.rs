//! `pong check`: check of models, alone and together.

mod bristles;
mod doubled;
mod named;
mod pairs;
mod solids;
mod stiffness;
mod together;
mod tree;

use crate::folders::AllowedFolders;
use crate::placed::{VALUE_NAME, placed};
use crate::terminal::{Outcome, failure, print, tell_lines};
use named::{Named, name};
use pong_model::{PlacedFile, printable};
use std::process::ExitCode;
use std::sync::Arc;

/// Checks model files (docs/model_format.md) and describes the contents of each and the contact of every two.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The model files. Positions in m, and orientations as quaternions, as of `pong join`, tell how fixed parts lie
    /// beside each other: part.ron@0,1.5,0. Without them all roots are in one place.
    #[arg(value_name = VALUE_NAME, required = true, value_parser = placed)]
    models: Vec<PlacedFile>,
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
    for PlacedFile { path, pose } in &arguments.models {
        match pong_model::load(path, &extensions) {
            Ok(model) => named.push(name(&named, model, *pose)),
            Err(errors) => {
                tell_lines(&errors);
                faults += errors.0.len();
            }
        }
    }
    let mut text = String::new();
    for Named { name, model, .. } in &named {
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
            if !Arc::ptr_eq(&a.model, &b.model) {
                together::notes(a, b)
                    .iter()
                    .for_each(|note| text += &format!("  note: {}\n", printable(note)));
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
