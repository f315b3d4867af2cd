//! `pong interface`: linear interface of two sets of bodies at a state, for structural models (docs/modes.md).

mod arguments;
mod cards;
mod source;
mod tables;

pub(crate) use arguments::Arguments;

use crate::terminal::{Outcome, print, tell, unwritable};
use crate::text::count;
use pong_advise::LinearInterface;
use source::State;
use std::process::ExitCode;
use tables::{About, SMALL, largest_off_diagonal};

/// Extensions of files with NASTRAN cards; others are CSV.
const CARDS: [&str; 3] = ["bdf", "dat", "nas"];

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let mut state = source::read(arguments)?;
    let first = source::groups(state.world()?, &arguments.of, "--of")?;
    let second = source::groups(state.world()?, &arguments.on, "--on")?;
    let interface = LinearInterface::between(state.world()?, &first.ids, &second.ids)?;
    let about = About {
        source: state.description(),
        sets: [&arguments.of, &arguments.on].map(|names| names.join(", ")),
        reference: first.names[0].clone(),
    };
    print(&tables::text(&about, &interface));
    for note in notes(&state, &interface, [&first.names, &second.names]) {
        tell(format!("note: {note}"));
    }
    if let Some(path) = &arguments.out {
        let cards = path.extension().is_some_and(|end| CARDS.iter().any(|known| end == *known));
        let text = if cards { cards::text(&about, &interface) } else { tables::csv(&about, &interface) };
        pong_model::files::replace(path, text.as_bytes()).map_err(|reason| unwritable(path, &reason))?;
        print(&format!("{}: {}\n", path.display(), if cards { "CBUSH, PBUSH and DMIG" } else { "CSV" }));
    }
    Ok(ExitCode::SUCCESS)
}

/// Statements about the validity of the interface.
fn notes(state: &State, interface: &LinearInterface, sets: [&[String]; 2]) -> Vec<String> {
    let mut notes = Vec::new();
    if interface.by_differences {
        notes.push("a part of the stiffness comes from differences, to about 6 digits".to_owned());
    }
    if interface.slipping > 0 {
        let slipping = count(interface.slipping, "contact slips", "contacts slip");
        notes.push(format!(
            "{slipping}: no stiffness of friction there, and no load at which it begins to slide"
        ));
    }
    if interface.without_limit > 0 {
        let contacts = count(interface.without_limit, "contact has", "contacts have");
        notes.push(format!(
            "{contacts} no stiffness of its own (solids, laws of the host): the limits leave them out"
        ));
    }
    let (share, [row, column]) = largest_off_diagonal(interface);
    if share > SMALL {
        let [row, column] = [row, column].map(|index| tables::LOADS[index]);
        notes.push(format!(
            "off-diagonal stiffness {row}, {column} is {share:.2} of √(K·K): a CBUSH leaves it out, DMIG has it"
        ));
    }
    notes.extend(state.notes(sets));
    notes
}
