//! `pong man-pages`: the manual pages of the program, from the definitions of `--help`. Installation calls
//! it.

use crate::terminal::{Outcome, failure};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Writes the manual pages pong.1, pong-check.1 and so on into a folder.
#[derive(clap::Args)]
#[command(hide = true)]
pub(crate) struct Arguments {
    /// The folder; it must exist. Pages that are there are replaced.
    folder: PathBuf,
}

pub(crate) fn main(arguments: &Arguments, program: clap::Command) -> Outcome {
    // `pong help` repeats `pong --help`.
    let mut program = program.disable_help_subcommand(true);
    program.build();
    write_pages(&program, &arguments.folder).map_err(|(path, reason)| {
        let cure = "name a folder that exists and may be written";
        failure(format!("{}: cannot be written: {reason}; {cure}", path.display()))
    })?;
    Ok(ExitCode::SUCCESS)
}

fn write_pages(program: &clap::Command, folder: &Path) -> Result<(), (PathBuf, io::Error)> {
    let commands: Vec<_> = program.get_subcommands().filter(|command| !command.is_hide_set()).collect();
    let names: Vec<_> = [program].iter().chain(&commands).map(|command| page_name(command)).collect();
    for command in [program].iter().chain(&commands) {
        let path = folder.join(format!("{}.1", page_name(command)));
        let text = page(command, program.get_version().unwrap_or_default(), &names);
        text.and_then(|text| pong_model::files::replace(&path, &text)).map_err(|reason| (path, reason))?;
    }
    Ok(())
}

/// Name of a page: `pong`, `pong-check`.
fn page_name(command: &clap::Command) -> String {
    command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned()
}

fn page(command: &clap::Command, version: &str, names: &[String]) -> io::Result<Vec<u8>> {
    let man = Man::new(command.clone()).source(format!("pong {version}")).manual("Pong");
    let mut text = Vec::new();
    man.render_title(&mut text)?;
    man.render_name_section(&mut text)?;
    man.render_synopsis_section(&mut text)?;
    man.render_description_section(&mut text)?;
    if command.get_arguments().any(|argument| !argument.is_hide_set()) {
        man.render_options_section(&mut text)?;
    }
    if command.get_subcommands().next().is_some() {
        man.render_subcommands_section(&mut text)?;
    }
    ending(&page_name(command), names).to_writer(&mut text)?;
    Ok(text)
}

/// Sections that are not in the definitions of options.
fn ending(own: &str, names: &[String]) -> Roff {
    let mut roff = Roff::default();
    roff.control("SH", ["EXIT STATUS"]);
    let statuses = [
        ("0", "Success."),
        (
            "1",
            "A named file has a fault, a run failed, or the answer could not be written. Standard error tells.",
        ),
        ("2", "Wrong usage."),
    ];
    for (status, meaning) in statuses {
        roff.control("TP", []).text([bold(status)]).text([roman(meaning)]);
    }
    roff.control("SH", ["SEE ALSO"]);
    let others: Vec<_> = names.iter().filter(|name| *name != own).map(|name| format!("{name}(1)")).collect();
    roff.text([roman(others.join(", "))]);
    roff.control("PP", []);
    roff.text([roman("The user's guide is users_guide.md in the folder docs of the installed documents.")]);
    roff
}
