//! Stiffness and damping for a wanted bounce (docs/advise.md).

use crate::arrays;
use crate::dynamics::check_names;
use crate::errors::{bad_value, of_engine};
use crate::setup::coupling;
use pong_advise::{Accuracy, ContactWish, GroupMass, Joints, StepPlan};
use pong_engine::World;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

/// Finds the values of a pair of surfaces that give a wanted depth and rebound (docs/advise.md).
///
/// Parameters
/// ----------
/// mass : float
///     Reduced mass of the two bodies, kg.
/// speed : float
///     Closing speed, m/s.
/// depth : float
///     Largest depth wanted, m.
/// restitution : float
///     Wanted ratio of the speeds after and before.
/// coupling : {"stages", "semi_implicit", "zero_order_hold"}, default "stages"
///     Use of a wrench by the host's integrator.
/// delay_frames : int, default 0
///     Frames by which a held wrench comes late.
/// step : float, optional
///     Step of the host, s.
/// depth_accuracy : float, default 0.05
///     Relative error of the depth that is accepted.
/// rebound_accuracy : float, default 0.02
///     Relative error of the rebound that is accepted.
///
/// Returns
/// -------
/// dict[str, float]
///     `stiffness` and `friction_stiffness` (N/m), `damping` and `friction_damping` (N·s/m), `damping_ratio`, `frequency`
///     (Hz), `duration` (s), `peak_force` (N), `step`, `accurate_step` and `stable_step` (s), `least_depth` (m).
///
/// Examples
/// --------
/// >>> advice = pong.advise_contact(mass=1.0, speed=0.5, depth=2e-3, restitution=0.6)
/// >>> advice["stiffness"] > 0.0 and advice["damping"] > 0.0
/// True
#[pyfunction]
#[pyo3(name = "advise_contact")]
#[pyo3(signature = (
    *, mass, speed, depth, restitution, coupling = "stages", delay_frames = 0, step = None,
    depth_accuracy = 0.05, rebound_accuracy = 0.02,
))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub(crate) fn advise_contact<'py>(
    py: Python<'py>,
    mass: f64,
    speed: f64,
    depth: f64,
    restitution: f64,
    coupling: &str,
    delay_frames: u32,
    step: Option<f64>,
    depth_accuracy: f64,
    rebound_accuracy: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let wish = ContactWish {
        mass,
        speed,
        depth,
        restitution,
        coupling: self::coupling("coupling", coupling, delay_frames)?,
        step,
        accuracy: Accuracy { depth: depth_accuracy, rebound: rebound_accuracy },
    };
    let advice = pong_advise::advise_contact(&wish).map_err(of_engine)?;
    let values = [
        ("stiffness", advice.stiffness),
        ("damping", advice.damping),
        ("friction_stiffness", advice.friction_stiffness),
        ("friction_damping", advice.friction_damping),
        ("damping_ratio", advice.damping_ratio),
        ("frequency", advice.frequency),
        ("duration", advice.duration),
        ("peak_force", advice.peak_force),
        ("step", advice.step),
        ("accurate_step", advice.accurate_step),
        ("stable_step", advice.stable_step),
        ("least_depth", advice.least_depth),
    ];
    values.into_py_dict(py)
}

/// Step check of a sealed world, by masses and joints.
pub(crate) fn step_report<'py>(
    py: Python<'py>,
    world: &World,
    masses: &Bound<'py, PyDict>,
    plan: &StepPlan,
) -> PyResult<Bound<'py, PyDict>> {
    let mut known = Vec::new();
    for (name, values) in masses {
        let name: String = name.extract()?;
        let (object, path) = name.split_once('/').unwrap_or((&name, ""));
        let object = world.scene().object(object).map_err(of_engine)?;
        let interface = world.scene().interface(object, path).map_err(of_engine)?;
        let values = values.cast_into::<PyDict>()?;
        known.push((interface, group_mass(&format!("masses[\"{name}\"]"), &values)?));
    }
    let report = pong_advise::step_report(world, plan, &known).map_err(of_engine)?;
    let told = PyDict::new(py);
    told.set_item("stable_step", report.stable_step())?;
    told.set_item("surely_stable_step", report.surely_stable_step())?;
    told.set_item("warnings", report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>())?;
    told.set_item("notes", report.notes.iter().map(ToString::to_string).collect::<Vec<_>>())?;
    told.set_item("not_judged", report.not_judged)?;
    Ok(told)
}

/// Mass, inertia and mass centre of a group; on joints its inverse inertia, with the springs and dampers of its mechanism.
fn group_mass(thing: &str, values: &Bound<'_, PyDict>) -> PyResult<GroupMass> {
    const NAMES: [&str; 7] =
        ["mass", "inertia", "mass_center", "inverse_inertia", "mechanism", "spring_rate", "damper_rate"];
    check_names(thing, values, &NAMES)?;
    let number = |name: &str| -> PyResult<Option<f64>> {
        let given = values.get_item(name)?;
        let what = format!("{thing}: {name}");
        given
            .map(|given| given.extract().map_err(|_| arrays::refused(&what, &given, "give a number")))
            .transpose()
    };
    let cure = "give its mass in kg, or infinity for what does not yield";
    let mass = number("mass")?.ok_or_else(|| bad_value(thing, "`mass` is missing".to_owned(), cure))?;
    let mut told = GroupMass::point(mass);
    if let Some(given) = values.get_item("inertia")? {
        let rows = arrays::rows(&format!("{thing}: inertia"), &given, 3, 3)?;
        told.inertia = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| rows.as_array()[at]);
    }
    if let Some(given) = values.get_item("mass_center")? {
        told.mass_center = arrays::vector::<3>(&format!("{thing}: mass_center"), &given)?;
    }
    if let Some(given) = values.get_item("inverse_inertia")? {
        let rows = arrays::rows(&format!("{thing}: inverse_inertia"), &given, 6, 6)?;
        let inverse_inertia = std::array::from_fn(|i| std::array::from_fn(|j| rows.as_array()[[i, j]]));
        let mechanism = values.get_item("mechanism")?.map_or(Ok(0), |given| given.extract())?;
        told.joints = Some(Joints { inverse_inertia, mechanism });
    }
    told.springs.stiffness = number("spring_rate")?.unwrap_or(0.0);
    told.springs.damping = number("damper_rate")?.unwrap_or(0.0);
    Ok(told)
}
