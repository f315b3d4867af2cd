//! `pong advise`: limits of a step, and the stiffness and damping that give a desired depth and rebound.

mod arguments;
mod contact;
mod limits;

pub(crate) use arguments::Arguments;

use crate::terminal::{Outcome, print};
use crate::text::{count, number};
use pong_advise::{StepPlan, WrenchCoupling, judge_contact};
use pong_engine::{Laws, World, combine_surfaces};
use pong_executive::Simulation;
use pong_executive::scene::Scene;
use pong_model::{FrictionLaw, Model, NormalLaw, Surface, printable};
use std::path::Path;
use std::process::ExitCode;

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let told = match &arguments.file {
        None => wish_alone(arguments),
        Some(path) if is_scene(path) => scene(arguments, path),
        Some(path) => model(arguments, path),
    };
    print(&told?);
    Ok(ExitCode::SUCCESS)
}

/// True if a file has the format mark of a scene; a file that cannot be read is reported by the reader of
/// models.
fn is_scene(path: &Path) -> bool {
    pong_model::files::read_text(path).is_ok_and(|text| text.contains("\"pong-scene\""))
}

/// Default coupling: a host that names none must not get the most forgiving one.
const UNNAMED: WrenchCoupling = WrenchCoupling::ZeroOrderHold { delay_frames: 0 };

fn wish_alone(arguments: &Arguments) -> Result<String, String> {
    let (mass, coupling) = (arguments.effective_mass()?, arguments.coupling(UNNAMED)?);
    let head =
        format!("Effective mass {} kg, {}\n", number(mass), arguments.stated(arguments.step(), coupling));
    Ok(head + &contact::advice(arguments, mass, arguments.step(), coupling, arguments.speed)?)
}

fn scene(arguments: &Arguments, path: &Path) -> Result<String, String> {
    let scene = Scene::load(path).map(|scene| scene.with_extensions(arguments.allowed.extensions()));
    let mut built = scene.and_then(|scene| scene.build()).map_err(|errors| errors.to_string())?;
    if !arguments.mass.is_empty() {
        return Err("--mass: a scene has masses of its own; leave it out".to_owned());
    }
    let by_scene = built.simulation.step_plan();
    let speed = arguments.speed.or(by_scene.closing_speed);
    let plan = StepPlan {
        step: arguments.step().unwrap_or(by_scene.step),
        coupling: arguments.coupling(by_scene.coupling)?,
        closing_speed: speed,
        fall_speed: by_scene.fall_speed,
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
    text += &acting_at_start(&mut built.simulation, &plan);
    if has_solids(built.simulation.world()) {
        text += "note: solids are judged flat on each other, on the area of the smaller one's largest face or shadow, and \
                 not added up; `pong run` judges what touches (docs/advise.md, Solids)\n";
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

/// Limit of the contacts that act at the start of a scene, from their tangent; empty if nothing touches.
fn acting_at_start(simulation: &mut Simulation, plan: &StepPlan) -> String {
    let Ok(linear) = simulation.linearised() else { return String::new() };
    let held = matches!(plan.coupling, WrenchCoupling::ZeroOrderHold { .. });
    // Between held wrenches the springs are integrated with the motion, and this limit counts them as held.
    if linear.contacts == 0 || (held && !simulation.springs().is_empty()) {
        return String::new();
    }
    let rates = linear.system.largest_rates();
    let contacts = count(linear.contacts, "contact acts", "contacts act");
    let head = format!(
        "At the start {contacts}, M⁻¹K at most {} 1/s² and M⁻¹D at most {} 1/s by the tangent: ",
        number(rates.stiffness),
        number(rates.damping)
    );
    if linear.slipping > 0 {
        return head + "no proof of a step, because friction slips\n";
    }
    let step = linear.system.surely_stable_step(plan.coupling, linear.least_ratio);
    head + &format!("surely stable to {} s as long as these contacts act\n", number(step))
}

/// Returns true if a movable group of a world has solids.
fn has_solids(world: &World) -> bool {
    let scene = world.inspect();
    (0..scene.group_count()).any(|group| !scene.body(group).solids.is_empty())
}

fn model(arguments: &Arguments, path: &Path) -> Result<String, String> {
    let model =
        pong_model::load(path, &arguments.allowed.extensions()).map_err(|errors| errors.to_string())?;
    let (mass, coupling) = (arguments.effective_mass()?, arguments.coupling(UNNAMED)?);
    let mut text = format!(
        "{}: effective mass {} kg, {}\n",
        printable(&model.name),
        number(mass),
        arguments.stated(arguments.step(), coupling)
    );
    if let Some(step) = arguments.step() {
        let plan = StepPlan {
            closing_speed: arguments.speed,
            accuracy: Some(arguments.accuracy()),
            ..StepPlan::new(step, coupling)
        };
        text += &surfaces(&model, mass, &plan, arguments.friction_share(mass)?);
        if model.bodies.iter().any(|body| !body.solids.is_empty()) {
            text += "note: at solids, these are the limits of a contact with the area `stiffness`/`foundation`; k and c \
                     grow with the area (docs/advise.md, Solids)\n";
        }
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

/// Report of every surface of a model against a rigid partner.
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

/// A partner surface that takes its compliance and laws from the other one.
fn rigid() -> Surface {
    Surface {
        name: "rigid".to_owned(),
        stiffness: f64::INFINITY,
        foundation: None,
        area: None,
        normal: NormalLaw::Inherited,
        friction: FrictionLaw::Inherited,
    }
}
