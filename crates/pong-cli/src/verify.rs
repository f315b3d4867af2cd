//! `pong verify`: the cases with known answers, and their report.

use crate::text::print;
use pong_verify::{Case, Verdict, cases, report};
use std::path::PathBuf;
use std::process::ExitCode;

/// Runs cases with known answers through engine and executive and prints what came out.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only these cases, by id (V3); may be given several times.
    #[arg(long, value_name = "ID", conflicts_with = "output")]
    only: Vec<String>,
    /// Also writes the report (docs/verification.md) to this file.
    #[arg(short, long, value_name = "FILE.md")]
    output: Option<PathBuf>,
    /// Lists the cases and runs none.
    #[arg(long)]
    list: bool,
}

pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let chosen = match choose(&arguments.only) {
        Ok(chosen) => chosen,
        Err(unknown) => {
            eprintln!("there is no case `{unknown}`; `pong verify --list` names them");
            return ExitCode::from(2);
        }
    };
    if arguments.list {
        let lines = chosen.iter().map(|case| format!("{:<4} {}\n", case.id, case.title));
        print(&lines.collect::<String>());
        return ExitCode::SUCCESS;
    }
    let verdicts: Vec<Verdict> =
        chosen.iter().enumerate().map(|(index, case)| run(case, index + 1, chosen.len())).collect();
    print(&report::text(&verdicts));
    let failed = verdicts.iter().filter(|verdict| !verdict.passes()).count();
    print(&format!("\n{} of {} cases pass\n", verdicts.len() - failed, verdicts.len()));
    if let Some(path) = &arguments.output
        && let Err(reason) = std::fs::write(path, report::markdown(&verdicts))
    {
        eprintln!("{}: {reason}", path.display());
        return ExitCode::FAILURE;
    }
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The cases of these ids, all if there are none, or the first id that no case has.
fn choose(ids: &[String]) -> Result<Vec<Case>, &String> {
    if ids.is_empty() {
        return Ok(cases());
    }
    ids.iter().map(|id| pong_verify::find(id).ok_or(id)).collect()
}

fn run(case: &Case, number: usize, of: usize) -> Verdict {
    eprint!("[{number}/{of}] {:<4} {} … ", case.id, case.title);
    let verdict = case.run();
    eprintln!("{}", if verdict.passes() { "pass" } else { "FAIL" });
    verdict
}
