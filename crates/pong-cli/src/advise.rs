//! `pong advise`: what a step can hold, and which stiffness and damping give a wanted depth and rebound.

mod contact;
mod limits;

use crate::folders::AllowedFolders;
use crate::terminal::{print, tell_lines};
use crate::text::number;
use pong_advise::{Accuracy, StepPlan, WrenchCoupling, judge_contact};
use pong_engine::{Laws, combine_surfaces};
use pong_executive::scene::Scene;
use pong_model::{FrictionLaw, Model, NormalLaw, Surface, printable};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Tells which stiffness, damping and friction follow from a wanted depth and rebound, how long a step may be, and what
/// goes wrong first (docs/advise.md). Asked for a scene, its masses, step and integrator are taken from there.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A scene, or a model whose surfaces are judged against a rigid partner; none for a wish alone.
    #[arg(value_name = "SCENE.ron|MODEL.ron", required_unless_present_all = ["depth", "mass"])]
    file: Option<PathBuf>,
    /// Mass, kg; given twice, of the two bodies. One alone meets what does not yield.
    #[arg(long, value_name = "KG", action = clap::ArgAction::Append)]
    mass: Vec<f64>,
    /// Frames a second in which the host calls the engine, Hz.
    #[arg(long, value_name = "HZ", conflicts_with = "step")]
    rate: Option<f64>,
    /// The step or frame instead, s.
    #[arg(long, value_name = "S")]
    step: Option<f64>,
    /// How the wrench is used.
    #[arg(long, value_enum)]
    coupling: Option<CouplingName>,
    /// With `held`: how many whole frames the wrench comes late.
    #[arg(long, value_name = "FRAMES", default_value_t = 0)]
    late: u32,
    /// Closing speed, m/s. Needed for a wish and for contacts as stiff as they are deep; of a scene the largest at its
    /// start, if it is left out.
    #[arg(long, value_name = "M/S")]
    speed: Option<f64>,
    /// The greatest depth wanted at that speed, m.
    #[arg(long, value_name = "M", requires = "restitution")]
    depth: Option<f64>,
    /// The rebound speed wanted, over the closing speed.
    #[arg(long, value_name = "E", requires = "depth")]
    restitution: Option<f64>,
    /// How many contacts carry the body together; each gets its share.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    contacts: u32,
    /// Mass that friction feels along the surface, kg, if it is another than the effective mass: of a body that rolls
    /// 1/(1/m + r²/I), of a ball 2/7 of its mass. Of a model alone.
    #[arg(long, value_name = "KG", conflicts_with = "depth")]
    friction_mass: Option<f64>,
    /// How near the depth must come, %.
    #[arg(long, value_name = "%", default_value_t = 5.0)]
    depth_within: f64,
    /// How near the rebound must come, %.
    #[arg(long, value_name = "%", default_value_t = 2.0)]
    rebound_within: f64,
    #[command(flatten)]
    allowed: AllowedFolders,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum CouplingName {
    /// Evaluated at every stage of a Runge-Kutta method.
    Stages,
    /// Evaluated once a step (semi-implicit Euler).
    Step,
    /// Held over a frame.
    Held,
}

pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let told = match &arguments.file {
        None => wish_alone(arguments),
        Some(path) if is_scene(path) => scene(arguments, path),
        Some(path) => model(arguments, path),
    };
    match told {
        Ok(text) => {
            print(&text);
            ExitCode::SUCCESS
        }
        Err(reason) => {
            tell_lines(&reason);
            ExitCode::FAILURE
        }
    }
}

/// Whether a file says that it is a scene; what cannot be read is told by the reader of models.
fn is_scene(path: &Path) -> bool {
    pong_model::files::read_text(path).is_ok_and(|text| text.contains("\"pong-scene\""))
}

impl Arguments {
    fn coupling(&self, otherwise: WrenchCoupling) -> WrenchCoupling {
        match self.coupling {
            None => otherwise,
            Some(CouplingName::Stages) => WrenchCoupling::Stages,
            Some(CouplingName::Step) => WrenchCoupling::SemiImplicit,
            Some(CouplingName::Held) => WrenchCoupling::ZeroOrderHold { delay_frames: self.late },
        }
    }

    fn step(&self) -> Option<f64> {
        self.rate.map(|rate| 1.0 / rate).or(self.step)
    }

    fn accuracy(&self) -> Accuracy {
        Accuracy { depth: 0.01 * self.depth_within, rebound: 0.01 * self.rebound_within }
    }

    /// 1/(1/m₁ + 1/m₂).
    fn effective_mass(&self) -> Result<f64, String> {
        if self.mass.is_empty() || self.mass.len() > 2 {
            return Err(format!("--mass: {} are given; give that of one body, or of both", self.mass.len()));
        }
        if let Some(wrong) = self.mass.iter().find(|mass| mass.is_nan() || **mass <= 0.0) {
            return Err(format!("--mass: it is {wrong} kg; give a mass above zero"));
        }
        Ok(1.0 / self.mass.iter().map(|mass| 1.0 / mass).sum::<f64>())
    }

    /// What one contact feels along the surface, over the effective mass.
    fn friction_share(&self, mass: f64) -> Result<f64, String> {
        match self.friction_mass {
            Some(wrong) if wrong.is_nan() || wrong <= 0.0 => {
                Err(format!("--friction-mass: it is {wrong} kg; give a mass above zero"))
            }
            Some(along) => Ok(along / mass / f64::from(self.contacts)),
            None => Ok(1.0 / f64::from(self.contacts)),
        }
    }

    /// How masses, frame and coupling are stated above every answer.
    fn stated(&self, step: Option<f64>, coupling: WrenchCoupling) -> String {
        let step = step.map_or("step of the adviser's choice".to_owned(), |step| {
            format!("step {} s ({} Hz)", number(step), number(1.0 / step))
        });
        format!("{step}, wrench {coupling}")
    }
}

/// Any coupling that is not named: the most forgiving must not be assumed.
const UNNAMED: WrenchCoupling = WrenchCoupling::ZeroOrderHold { delay_frames: 0 };

fn wish_alone(arguments: &Arguments) -> Result<String, String> {
    let (mass, coupling) = (arguments.effective_mass()?, arguments.coupling(UNNAMED));
    let head =
        format!("Effective mass {} kg, {}\n", number(mass), arguments.stated(arguments.step(), coupling));
    Ok(head + &contact::advice(arguments, mass, arguments.step(), coupling, arguments.speed)?)
}

fn scene(arguments: &Arguments, path: &Path) -> Result<String, String> {
    let scene = Scene::load(path).map(|scene| scene.with_extensions(arguments.allowed.extensions()));
    let built = scene.and_then(|scene| scene.build()).map_err(|errors| errors.to_string())?;
    if !arguments.mass.is_empty() {
        return Err("--mass: a scene has masses of its own; leave it out".to_owned());
    }
    let by_scene = built.simulation.step_plan();
    let speed = arguments.speed.or(by_scene.closing_speed);
    let plan = StepPlan {
        step: arguments.step().unwrap_or(by_scene.step),
        coupling: arguments.coupling(by_scene.coupling),
        closing_speed: speed,
        accuracy: Some(arguments.accuracy()),
    };
    let report = built.simulation.step_report(&plan).map_err(|error| error.to_string())?;
    let mut text =
        format!("{}: {}", printable(&built.name), arguments.stated(Some(plan.step), plan.coupling));
    text += &match (arguments.speed, speed) {
        (Some(speed), _) => format!(", closing at {} m/s\n", number(speed)),
        (None, Some(speed)) => format!(", closing at {} m/s (the scene's start)\n", number(speed)),
        (None, None) => ", closing speed not known: give --speed\n".to_owned(),
    };
    text += &limits::told(&report, &plan, 1.0 / f64::from(arguments.contacts));
    for warning in &report.warnings {
        text += &format!("warning: {}\n", printable(&warning.to_string()));
    }
    for note in &report.notes {
        text += &format!("note: {}\n", printable(&note.to_string()));
    }
    if arguments.depth.is_some() {
        for pair in &report.pairs {
            text += &format!(
                "`{}` and `{}`, {} kg\n",
                printable(&pair.groups[0]),
                printable(&pair.groups[1]),
                number(pair.mass)
            );
            text += &contact::advice(arguments, pair.mass, Some(plan.step), plan.coupling, speed)?;
        }
    }
    Ok(text)
}

fn model(arguments: &Arguments, path: &Path) -> Result<String, String> {
    let model =
        pong_model::load(path, &arguments.allowed.extensions()).map_err(|errors| errors.to_string())?;
    let (mass, coupling) = (arguments.effective_mass()?, arguments.coupling(UNNAMED));
    let mut text = format!(
        "{}: effective mass {} kg, {}\n",
        printable(&model.name),
        number(mass),
        arguments.stated(arguments.step(), coupling)
    );
    if let Some(step) = arguments.step() {
        let plan =
            StepPlan { step, coupling, closing_speed: arguments.speed, accuracy: Some(arguments.accuracy()) };
        text += &surfaces(&model, mass, &plan, arguments.friction_share(mass)?);
    } else if arguments.depth.is_none() {
        return Err(
            "--rate: give the host's frames a second, or a wanted --depth and --restitution".to_owned()
        );
    }
    if arguments.depth.is_some() {
        text += &contact::advice(arguments, mass, arguments.step(), coupling, arguments.speed)?;
    }
    Ok(text)
}

/// Every surface of a model against a rigid partner.
fn surfaces(model: &Model, mass: f64, plan: &StepPlan, friction_share: f64) -> String {
    let mut report = pong_advise::StepReport::default();
    for surface in &model.surfaces {
        let judged = combine_surfaces(surface, &rigid(), None, &Laws::default())
            .map_err(|error| error.cause)
            .and_then(|props| {
                let groups = [surface.name.clone(), "rigid".to_owned()];
                judge_contact(groups, &props, mass, plan).map_err(str::to_owned)
            });
        match judged {
            Ok(limits) => report.pairs.push(limits),
            Err(cause) => report.not_judged.push(format!("`{}`: {cause}", surface.name)),
        }
    }
    limits::told(&report, plan, friction_share)
}

/// What leaves all to a surface: its yield, its laws.
fn rigid() -> Surface {
    Surface {
        name: "rigid".to_owned(),
        stiffness: f64::INFINITY,
        normal: NormalLaw::Inherited,
        friction: FrictionLaw::Inherited,
    }
}
