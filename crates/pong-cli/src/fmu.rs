//! `pong fmu`: a scene as a Functional Mock-up Unit.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, print, tell, unwritable};
use crate::text::{count, number};
use pong_fmu::{Fmi, LIBRARY_FILE, Options, Package};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Makes a Functional Mock-up Unit (FMI) of a scene, for Model Exchange and Co-Simulation (docs/fmu.md).
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE.ron")]
    scene: PathBuf,
    /// The unit; `<scene>.fmu` unless given.
    #[arg(short, long, value_name = "FILE.fmu")]
    output: Option<PathBuf>,
    /// Version of the standard: 2 for FMI 2.0, 3 for FMI 3.0.
    #[arg(long, value_name = "VERSION", default_value_t = 3, value_parser = clap::value_parser!(u8).range(2..=3))]
    fmi: u8,
    /// Has the importer move this body (`object` or `object/group`, as the scene names it): its pose and twist are inputs.
    /// May be given several times.
    #[arg(long = "input", value_name = "BODY")]
    inputs: Vec<String>,
    /// Has the importer move every body that is not fixed: the unit computes contact alone.
    #[arg(long, conflicts_with = "inputs")]
    contact_only: bool,
    /// Adds the mean of every contact force and moment over the last communication step to the outputs.
    #[arg(long)]
    step_means: bool,
    /// The shared library that goes into the unit; without it the one that was built or installed with this program.
    #[arg(long, value_name = "FILE.so")]
    library: Option<PathBuf>,
    /// Says nothing unless something is wrong.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let output = arguments.output.clone().unwrap_or_else(|| arguments.scene.with_extension("fmu"));
    let package = package(arguments)?;
    pong_model::files::replace(&output, &package.bytes).map_err(|reason| unwritable(&output, &reason))?;
    for warning in &package.warnings {
        tell(format!("warning: {warning}"));
    }
    if !arguments.quiet {
        print(&summary(arguments, &output, &package));
    }
    Ok(ExitCode::SUCCESS)
}

fn package(arguments: &Arguments) -> Result<Package, String> {
    let (path, library) = library(arguments.library.as_deref())?;
    pong_fmu::check_library(&library).map_err(|line| format!("{}: {line}", path.display()))?;
    let options = Options {
        inputs: arguments.inputs.clone(),
        all_inputs: arguments.contact_only,
        step_means: arguments.step_means,
        extensions: arguments.allowed.extensions(),
    };
    let fmi = if arguments.fmi == 2 { Fmi::V2 } else { Fmi::V3 };
    pong_fmu::package(&arguments.scene, &library, fmi, &options)
}

/// The shared library: the named one, or else the one beside the program, as cargo builds or installs it.
fn library(named: Option<&Path>) -> Result<(PathBuf, Vec<u8>), String> {
    let unreadable = |path: &Path, reason: std::io::Error| {
        format!("{}: cannot be read: {reason}; name {LIBRARY_FILE} with --library", path.display())
    };
    if let Some(path) = named {
        let bytes = pong_model::files::read(path).map_err(|reason| unreadable(path, reason))?;
        return Ok((path.to_owned(), bytes));
    }
    let program = std::env::current_exe().and_then(|program| program.canonicalize());
    let program = program.map_err(|reason| {
        format!(
            "{LIBRARY_FILE}: this program does not find itself: {reason}; name the library with --library"
        )
    })?;
    let folder = program.parent().unwrap_or(Path::new("/"));
    let places = places(folder);
    let Some(path) = places.iter().find(|path| path.is_file()) else {
        let looked: Vec<String> = places.iter().map(|path| path.display().to_string()).collect();
        return Err(format!(
            "{LIBRARY_FILE}: it is not beside this program; build it (cargo build -p pong-fmu -p pong-cli), install it \
             (ci/install), or name it with --library. Looked for: {}",
            looked.join(", ")
        ));
    };
    let bytes = pong_model::files::read(path).map_err(|reason| unreadable(path, reason))?;
    Ok((path.clone(), bytes))
}

/// Places of the library as cargo builds it (`deps`: as a part of this program), and as it is installed.
fn places(folder: &Path) -> Vec<PathBuf> {
    let relative = ["", "deps", "../lib/pong", "../lib/x86_64-linux-gnu/pong", "../lib64/pong"];
    relative.iter().map(|place| folder.join(place).join(LIBRARY_FILE)).collect()
}

fn summary(arguments: &Arguments, output: &Path, package: &Package) -> String {
    let [inputs, outputs, parameters, states] = package.counts;
    let moved = match package.inputs.is_empty() {
        true => String::new(),
        false => format!("Moved by the importer: {}\n", package.inputs.join(", ")),
    };
    format!(
        "{}: `{}`, FMI {}.0, Model Exchange and Co-Simulation, {} MB; {}, {}, {}, {}\n{moved}",
        output.display(),
        package.name,
        arguments.fmi,
        number((package.bytes.len() as f64 / 1e3).round() / 1e3),
        count(inputs, "input", "inputs"),
        count(outputs, "output", "outputs"),
        count(parameters, "parameter", "parameters"),
        count(states, "continuous state", "continuous states"),
    )
}
