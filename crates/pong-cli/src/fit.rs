//! `pong fit`: parameters of a scene from measured data.

use crate::folders::AllowedFolders;
use crate::terminal::{Failure, Outcome, SPINNER, failure, print, progress, show, tell_lines, unwritable};
use pong_executive::scene::Scene;
use pong_fit::{
    Batch, Fit, FitError, Free, MomentumSettings, Quantity, Settings, Starts, fit_file, free_bodies,
    inertia_from_momentum, load, report,
};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

/// Finds parameters of a scene with which its runs agree best with measured poses, velocities and wrenches
/// (docs/fit.md).
///
/// Writes fit.md, parameters.csv, profiles.csv and fit.svg: the optimum with intervals, what cannot be told
/// apart, the error on records that took no part, and surfaces to paste. With `--momentum`: the inertia of a
/// tossed body, without any law of contact; writes momentum.md.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE.ron")]
    scene: PathBuf,
    /// Measured data: a CSV file, or the folder of a response log.
    #[arg(long, value_name = "FILE|LOG")]
    data: PathBuf,
    /// A free parameter, with its bounds; may be given several times. Without bounds: a hundredth to a hundred
    /// times of the scene's value. The search is on a logarithmic scale if both bounds are above zero.
    #[arg(long = "free", value_name = "NAME[=LOW..HIGH]", value_parser = free, required_unless_present = "momentum")]
    free: Vec<Free>,
    /// Folder for the results; `<scene>_fit` unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Standard deviation of a sensor along one axis, in m, rad, m/s, rad/s, N or N·m; may be given several
    /// times, and replaces that of the data.
    #[arg(long, value_name = "QUANTITY=NUMBER", value_parser = noise)]
    noise: Vec<(Quantity, f64)>,
    /// Quantities that count: any of position, rotation, velocity, angular_velocity, force, moment. All that
    /// were measured unless given.
    #[arg(long, value_name = "QUANTITIES", value_delimiter = ',', value_parser = quantity)]
    of: Vec<Quantity>,
    /// Time from the start of each record before which nothing counts, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0)]
    from: f64,
    /// Length of each record that counts, s; all of it unless given.
    #[arg(long, value_name = "SECONDS")]
    horizon: Option<f64>,
    /// Share of the records that takes no part and tests the result.
    #[arg(long, value_name = "SHARE", default_value = "25%", value_parser = share)]
    test: f64,
    /// Takes the first measurement of each record as it is; otherwise it is fitted as all others are.
    #[arg(long)]
    measured_starts: bool,
    /// Number of points from which the search begins: the scene's values, and others between the bounds.
    #[arg(long, value_name = "N", default_value_t = 8)]
    tries: usize,
    /// Seed of the split, of the tries and of the bootstrap.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Number of threads; one for each core unless given. The results have the same bits.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Share of cases in which an interval must contain the true value.
    #[arg(long, value_name = "SHARE", default_value = "95%", value_parser = share)]
    confidence: f64,
    /// Leaves out the profile intervals, which take most of the time.
    #[arg(long)]
    no_profiles: bool,
    /// No progress and no page; errors stay.
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
    #[command(flatten)]
    momentum: Momentum,
}

/// Options of the inertia from momentum.
#[derive(clap::Args)]
#[command(next_help_heading = "Inertia from momentum")]
struct Momentum {
    /// Inertia of a free body from touches of one point between two flights, without any law of contact; needs
    /// positions and orientations alone.
    #[arg(long, conflicts_with_all = ["free", "noise", "of", "from", "horizon", "test", "measured_starts",
        "tries", "threads", "no_profiles"])]
    momentum: bool,
    /// The body; not needed if one body is free.
    #[arg(long, value_name = "NAME", conflicts_with = "free")]
    body: Option<String>,
    /// Number of measurements of the flights before and after a touch.
    #[arg(long, value_name = "N", default_value_t = MomentumSettings::default().flight, conflicts_with = "free")]
    flight: usize,
    /// Number of measurements between a touch and each flight.
    #[arg(long, value_name = "N", default_value_t = MomentumSettings::default().clear, conflicts_with = "free")]
    clear: usize,
    /// Largest number of measurements in a touch.
    #[arg(long, value_name = "N", default_value_t = MomentumSettings::default().longest, conflicts_with = "free")]
    longest: usize,
    /// Distance from the other bodies below which a point may touch, m.
    #[arg(long, value_name = "METRES", default_value_t = MomentumSettings::default().near, conflicts_with = "free")]
    near: f64,
    /// Distance that all other points of the body keep in a touch, m.
    #[arg(long, value_name = "METRES", default_value_t = MomentumSettings::default().apart, conflicts_with = "free")]
    apart: f64,
}

fn free(text: &str) -> Result<Free, String> {
    let Some((name, bounds)) = text.split_once('=') else {
        return Ok(Free { name: text.to_owned(), bounds: None });
    };
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let ends = bounds.split_once("..").and_then(|(low, high)| Some((number(low)?, number(high)?)));
    match ends {
        Some(bounds) => Ok(Free { name: name.to_owned(), bounds: Some(bounds) }),
        None => Err("give NAME=LOW..HIGH, such as surface.cube.acrylic.friction.mu=0.05..1".to_owned()),
    }
}

fn quantity(text: &str) -> Result<Quantity, String> {
    let names = Quantity::ALL.map(Quantity::name).join(", ");
    let found = Quantity::ALL.into_iter().find(|known| known.name() == text.trim());
    found.ok_or_else(|| format!("give any of {names}"))
}

fn noise(text: &str) -> Result<(Quantity, f64), String> {
    let (name, number) = text.split_once('=').ok_or("give QUANTITY=NUMBER, such as position=0.0005")?;
    let quantity = quantity(name)?;
    let number = number.trim().parse::<f64>().ok().filter(|number| *number > 0.0 && number.is_finite());
    number
        .map(|number| (quantity, number))
        .ok_or_else(|| format!("give a number above zero, {}", quantity.unit()))
}

fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 0.01));
    number
        .trim()
        .parse::<f64>()
        .map(|number| number * unit)
        .map_err(|_| "give a share such as 25% or 0.25".to_owned())
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    if arguments.momentum.momentum {
        return momentum(arguments);
    }
    let fit = run(arguments)?;
    let folder = output(arguments);
    report::write(&fit, &folder).map_err(|reason| unwritable(&folder, &reason))?;
    if arguments.quiet {
        tell_lines(fit.notes.join("\n"));
    } else {
        print(&report::markdown(&fit));
        let folder = folder.display();
        print(&format!("\nwritten: fit.md, parameters.csv, profiles.csv and fit.svg in {folder}\n"));
    }
    Ok(if fit.converged { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn output(arguments: &Arguments) -> PathBuf {
    let stem = arguments.scene.file_stem().unwrap_or_default().to_string_lossy();
    arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}_fit")))
}

fn momentum(arguments: &Arguments) -> Outcome {
    let scene = scene(arguments)?;
    let Momentum { body, flight, clear, longest, near, apart, .. } = &arguments.momentum;
    let settings = MomentumSettings {
        body: body.clone(),
        flight: *flight,
        clear: *clear,
        longest: *longest,
        near: *near,
        apart: *apart,
        confidence: arguments.confidence,
        seed: arguments.seed,
    };
    let found = free_bodies(&scene)
        .and_then(|bodies| inertia_from_momentum(&scene, &load(&arguments.data, &bodies)?, &settings))
        .map_err(of_fit)?;
    let (folder, page) = (output(arguments), found.markdown());
    std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(folder.join("momentum.md"), &page))
        .map_err(|reason| unwritable(&folder, &reason))?;
    if arguments.quiet {
        tell_lines(found.notes.join("\n"));
    } else {
        print(&format!("{page}\nwritten: momentum.md in {}\n", folder.display()));
    }
    Ok(ExitCode::SUCCESS)
}

fn scene(arguments: &Arguments) -> Result<Scene, Failure> {
    Ok(Scene::load(&arguments.scene)?.with_extensions(arguments.allowed.extensions()))
}

fn of_fit(error: FitError) -> Failure {
    if error.0.contains('\n') { error.into() } else { failure(error) }
}

fn run(arguments: &Arguments) -> Result<Fit, Failure> {
    let scene = scene(arguments)?;
    let bar = progress(None, SPINNER, arguments.quiet);
    let mut watch = |doing: &str| {
        show(&bar, doing);
        ControlFlow::Continue(())
    };
    let found = fit_file(&scene, &arguments.data, &settings(arguments), &mut watch);
    bar.finish_and_clear();
    found.map_err(of_fit)
}

fn settings(arguments: &Arguments) -> Settings {
    let mut noise = [None; 6];
    arguments.noise.iter().for_each(|(quantity, number)| noise[*quantity as usize] = Some(*number));
    Settings {
        free: arguments.free.clone(),
        noise,
        of: arguments.of.clone(),
        from: arguments.from,
        horizon: arguments.horizon,
        test: arguments.test,
        starts: if arguments.measured_starts { Starts::Measured } else { Starts::Fitted },
        tries: arguments.tries,
        seed: arguments.seed,
        threads: arguments.threads.unwrap_or_else(Batch::threads_of_this_machine),
        confidence: arguments.confidence,
        profiles: !arguments.no_profiles,
        ..Settings::default()
    }
}
