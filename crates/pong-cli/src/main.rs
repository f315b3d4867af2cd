//! `pong`: the command line of the contact engine.
//!
//! Exit codes: 0 success, 1 a fault of a named file, or an answer that could not be written (with a message
//! on standard error), 2 wrong usage, 3 a run in which paired objects could not touch.

#![forbid(unsafe_code)]
// `print!` and its kin panic where they cannot write: all writing goes through `terminal`.
#![deny(clippy::print_stdout, clippy::print_stderr)]

mod advise;
mod check;
mod decompose;
mod doctor;
mod fit;
mod fmu;
mod folders;
mod import;
mod interface;
mod join;
mod log;
mod man_pages;
mod mass;
mod modes;
mod placed;
mod replay;
mod run;
mod terminal;
mod text;
mod trade;
mod tune;
mod verify;
mod view;

use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

/// Contact dynamics from the terminal.
#[derive(Parser)]
#[command(name = "pong", version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Advise(advise::Arguments),
    Check(check::Arguments),
    Decompose(decompose::Arguments),
    Doctor(doctor::Arguments),
    Fit(fit::Arguments),
    Fmu(fmu::Arguments),
    Import(import::Arguments),
    Interface(interface::Arguments),
    Join(join::Arguments),
    Run(run::Arguments),
    Log(log::Arguments),
    ManPages(man_pages::Arguments),
    Mass(mass::Arguments),
    Modes(modes::Arguments),
    Replay(replay::Arguments),
    Trade(trade::Arguments),
    Tune(tune::Arguments),
    Verify(verify::Arguments),
    View(view::Arguments),
}

fn main() -> ExitCode {
    let arguments = match Cli::try_parse() {
        Ok(arguments) => arguments,
        Err(asked) => return terminal::exit_code_of(Ok(usage(&asked))),
    };
    let outcome = match arguments.command {
        Command::Advise(arguments) => advise::main(&arguments),
        Command::Check(arguments) => check::main(&arguments),
        Command::Decompose(arguments) => decompose::main(&arguments),
        Command::Doctor(arguments) => doctor::main(&arguments),
        Command::Fit(arguments) => fit::main(&arguments),
        Command::Fmu(arguments) => fmu::main(&arguments),
        Command::Import(arguments) => import::main(&arguments),
        Command::Interface(arguments) => interface::main(&arguments),
        Command::Join(arguments) => join::main(&arguments),
        Command::Run(arguments) => run::main(&arguments),
        Command::Log(arguments) => log::main(&arguments),
        Command::ManPages(arguments) => man_pages::main(&arguments, Cli::command()),
        Command::Mass(arguments) => mass::main(&arguments),
        Command::Modes(arguments) => modes::main(&arguments),
        Command::Replay(arguments) => replay::main(&arguments),
        Command::Trade(arguments) => trade::main(&arguments),
        Command::Tune(arguments) => tune::main(&arguments),
        Command::Verify(arguments) => verify::main(&arguments),
        Command::View(arguments) => view::main(&arguments),
    };
    terminal::exit_code_of(outcome)
}

/// Prints help and version as answers, wrong usage as an error.
fn usage(asked: &clap::Error) -> ExitCode {
    let text = asked.render().to_string();
    if asked.use_stderr() {
        terminal::tell_lines(text.trim_end());
        return ExitCode::from(2);
    }
    terminal::print(&text);
    ExitCode::SUCCESS
}
