//! `pong verify`: cases with known answers, extremes and their reports; invariances.

use crate::terminal::{Outcome, failure, print, tell};
use pong_invariance::{Order, Survey, invariances, make};
use pong_verify::extremes::{self, Extreme, Length};
use pong_verify::{Case, cases, orders, report};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs cases with known answers through engine and executive and prints the results.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Runs the extremes of the range instead of the cases, each with its margin.
    #[arg(long)]
    extremes: bool,
    /// Runs random scenes instead of the cases, each against its turned, moved, cut or reordered variants,
    /// which must give the same answer.
    #[arg(long, conflicts_with_all = ["extremes", "output"])]
    invariances: bool,
    /// With --invariances: number of scenes.
    #[arg(long, requires = "invariances", default_value_t = 20_000)]
    scenes: u64,
    /// With --invariances: only scenes of this family (plate, valley, junction, …; a wrong name lists them).
    #[arg(long, requires = "invariances")]
    family: Option<String>,
    /// With --invariances: seed of the scenes; the same seed makes the same scenes.
    #[arg(long, requires = "invariances", default_value_t = 1)]
    seed: u64,
    /// With --invariances: number of the first scene of the seed, to run one again.
    #[arg(long, requires = "invariances", default_value_t = 0)]
    first: u64,
    /// With --invariances: one line for each scene that differs, with the command that shows it; scenes are
    /// not made smaller.
    #[arg(long, requires = "invariances")]
    list_findings: bool,
    /// With --extremes: also the soaks, which take minutes.
    #[arg(long, requires = "extremes")]
    long: bool,
    /// Only these cases, by id (V3, or E11 with --extremes, or `cut` with --invariances); may be given several times.
    #[arg(long, value_name = "ID", conflicts_with = "output")]
    only: Vec<String>,
    /// Also writes the report (docs/verification.md, docs/extremes.md) to this file.
    #[arg(short, long, value_name = "FILE.md")]
    output: Option<PathBuf>,
    /// Lists the cases and runs none.
    #[arg(long)]
    list: bool,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    if arguments.extremes {
        return main_of_extremes(arguments);
    }
    if arguments.invariances {
        return main_of_invariances(arguments);
    }
    let chosen = match choose(&arguments.only) {
        Ok(chosen) => chosen,
        Err(unknown) => {
            return wrong_usage(format!("there is no case `{unknown}`; `pong verify --list` names them"));
        }
    };
    if arguments.list {
        return list(chosen.iter().map(|case| format!("{:<4} {}\n", case.id, case.title)));
    }
    let verdicts = on_all_cores(&chosen, |case: &Case| {
        let verdict = case.run();
        (format!("{:<4} {}", case.id, case.title), verdict.passes(), verdict)
    });
    print(&report::text(&verdicts));
    let failed = verdicts.iter().filter(|verdict| !verdict.passes()).count();
    print(&format!("\n{} of {} cases pass\n", verdicts.len() - failed, verdicts.len()));
    if let Some(reason) = write_picture(arguments) {
        return Err(failure(reason));
    }
    finish(arguments, &report::markdown(&verdicts), failed)
}

/// Writes the figure of the report into the folder `figures` beside it; returns the reason if it cannot.
fn write_picture(arguments: &Arguments) -> Option<String> {
    let folder = arguments.output.as_ref()?.parent()?.join("figures");
    let path = folder.join("orders.svg");
    // A motion that cannot be run is reported by its case.
    let curves = orders::curves().ok()?;
    let written = std::fs::create_dir_all(&folder)
        .and_then(|()| pong_model::files::replace(&path, orders::svg(curves).as_bytes()));
    written.err().map(|reason| format!("{}: {reason}", path.display()))
}

/// Writes the report, if requested.
fn finish(arguments: &Arguments, report: &str, failed: usize) -> Outcome {
    if let Some(path) = &arguments.output {
        let written = pong_model::files::replace(path, report.as_bytes());
        written.map_err(|reason| failure(format!("{}: {reason}", path.display())))?;
    }
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn wrong_usage(line: String) -> Outcome {
    tell(line);
    Ok(ExitCode::from(2))
}

fn list(lines: impl Iterator<Item = String>) -> Outcome {
    print(&lines.collect::<String>());
    Ok(ExitCode::SUCCESS)
}

fn main_of_extremes(arguments: &Arguments) -> Outcome {
    let all = extremes::extremes();
    let is_asked = |extreme: &&Extreme| arguments.only.iter().any(|id| id.eq_ignore_ascii_case(extreme.id));
    let unknown = |id: &&String| !all.iter().any(|extreme| id.eq_ignore_ascii_case(extreme.id));
    if let Some(unknown) = arguments.only.iter().find(unknown) {
        return wrong_usage(format!(
            "there is no extreme `{unknown}`; `pong verify --extremes --list` names them"
        ));
    }
    let chosen: Vec<_> = match arguments.only.as_slice() {
        [] => all,
        _ => all.iter().filter(is_asked).copied().collect(),
    };
    if arguments.list {
        return list(chosen.iter().map(|extreme| format!("{:<4} {}\n", extreme.id, extreme.asked)));
    }
    let length = Length { long: arguments.long };
    let findings = on_all_cores(&chosen, |extreme| {
        let finding = extreme.run(length);
        (format!("{:<4} {}", extreme.id, extreme.asked), finding.passes(), finding)
    });
    print(&extremes::text(&findings));
    let failed = findings.iter().filter(|finding| !finding.passes()).count();
    print(&format!("\n{} of {} extremes hold\n", findings.len() - failed, findings.len()));
    finish(arguments, &extremes::markdown(&findings), failed)
}

fn main_of_invariances(arguments: &Arguments) -> Outcome {
    if let Some(unknown) = arguments.only.iter().find(|name| invariances::find(name).is_none()) {
        return wrong_usage(format!(
            "there is no invariance `{unknown}`; `pong verify --invariances --list` names them"
        ));
    }
    if arguments.list {
        return list(invariances::INVARIANCES.iter().map(|one| format!("{:<16} {}\n", one.name, one.says)));
    }
    let all = [make::round::ALL, make::volumes::ALL, make::belts::ALL];
    let families = || make::families().chain(all);
    if let Some(unknown) = arguments.family.as_ref().filter(|asked| !families().any(|name| name == *asked)) {
        let known: Vec<_> = families().collect();
        return wrong_usage(format!(
            "there is no family of scenes `{unknown}`; there are {}",
            known.join(", ")
        ));
    }
    let order = Order {
        family: arguments.family.clone(),
        seed: arguments.seed,
        first: arguments.first,
        scenes: arguments.scenes,
        only: arguments.only.clone(),
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        kept: usize::from(!arguments.list_findings),
    };
    let told = AtomicUsize::new(0);
    let survey = Survey::run(&order, &|done| {
        let tenth = (10 * done / order.scenes) as usize;
        if told.fetch_max(tenth, Ordering::Relaxed) < tenth {
            tell(format!("[{done}/{}]", order.scenes));
        }
    });
    survey.found.iter().for_each(|found| print(&found.text()));
    if arguments.list_findings {
        print(&survey.list());
    }
    print(&survey.text());
    Ok(if survey.holds() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The cases with these ids, or all if there are none; an id without a case is returned as the error.
fn choose(ids: &[String]) -> Result<Vec<Case>, &String> {
    if ids.is_empty() {
        return Ok(cases());
    }
    ids.iter().map(|id| pong_verify::find(id).ok_or(id)).collect()
}

/// Runs all items, as many at a time as there are cores, and reports each with its outcome. Returns the
/// results in the order of the items.
fn on_all_cores<T: Sync, R: Send + Sync>(
    items: &[T],
    run: impl Fn(&T) -> (String, bool, R) + Sync,
) -> Vec<R> {
    let results: Vec<OnceLock<R>> = items.iter().map(|_| OnceLock::new()).collect();
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(index) else { break };
            let (name, holds, answer) = run(item);
            let number = done.fetch_add(1, Ordering::Relaxed) + 1;
            tell(format!("[{number}/{}] {name} … {}", items.len(), if holds { "holds" } else { "FAILS" }));
            let _ = results[index].set(answer);
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores.min(items.len()) {
            scope.spawn(work);
        }
    });
    results.into_iter().filter_map(OnceLock::into_inner).collect()
}
