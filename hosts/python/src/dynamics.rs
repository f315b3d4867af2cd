//! Masses, springs and energies of a scene as dictionaries.

use crate::arrays;
use crate::errors::{bad_value, of_executive};
use pong_executive::{BodyId, Energy, MassProperties, Simulation, Spring};
use pong_geometry::{Mat3, Vec3};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

const MASS: [&str; 3] = ["mass", "inertia", "mass_center"];
const SPRING: [&str; 3] = ["stiffness", "damping", "preload"];

/// Mass (kg), inertia about the mass centre (kg·m², three rows) and mass centre (m), along the axes of the group.
pub(crate) fn mass<'py>(
    py: Python<'py>,
    simulation: &Simulation,
    body: BodyId,
) -> PyResult<Bound<'py, PyDict>> {
    let known = mass_of(simulation, body)?;
    let tensor: Vec<[f64; 3]> = known.inertia.row_iter().map(|row| [row[0], row[1], row[2]]).collect();
    let told = PyDict::new(py);
    told.set_item("mass", known.mass)?;
    told.set_item("inertia", tensor)?;
    told.set_item("mass_center", <[f64; 3]>::from(known.mass_center))?;
    Ok(told)
}

fn mass_of(simulation: &Simulation, body: BodyId) -> PyResult<&MassProperties> {
    let (_, known) = simulation.bodies().nth(body.index()).expect("an id of a body of this simulation");
    known.mass().ok_or_else(|| {
        let cause = format!("`{}` is not free, so that no mass has an effect on its motion", known.name);
        bad_value("body", cause, "name a body with motion: Free")
    })
}

pub(crate) fn set_mass(
    simulation: &mut Simulation,
    body: BodyId,
    values: &Bound<'_, PyDict>,
) -> PyResult<()> {
    mass_of(simulation, body)?;
    whole("mass", values, &MASS)?;
    let inertia = arrays::rows("mass: inertia", &value(values, "inertia")?, 3, 3)?;
    let mass = value(values, "mass")?;
    let properties = MassProperties {
        mass: mass.extract().map_err(|_| arrays::refused("mass", &mass, "give a number, kg"))?,
        inertia: Mat3::from_fn(|row, column| inertia.as_array()[[row, column]]),
        mass_center: Vec3::from(arrays::vector::<3>("mass: mass_center", &value(values, "mass_center")?)?),
    };
    simulation.set_mass(body, properties).map_err(of_executive)
}

/// Three translations (N/m, N·s/m, N), then three rotations (N·m/rad, N·m·s/rad, N·m).
pub(crate) fn spring<'py>(
    py: Python<'py>,
    simulation: &Simulation,
    number: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let known = spring_of(simulation, number)?;
    SPRING.into_iter().zip([known.stiffness, known.damping, known.preload]).into_py_dict(py)
}

fn spring_of(simulation: &Simulation, number: usize) -> PyResult<Spring> {
    simulation.springs().get(number).copied().ok_or_else(|| {
        let cause = format!("there is no spring {number}");
        let cure = match simulation.springs().len() {
            0 => "the scene has none; add one to `springs`".to_owned(),
            count => format!("give a number from 0 to {}, in the order of the scene", count - 1),
        };
        bad_value("spring", cause, &cure)
    })
}

pub(crate) fn set_spring(
    simulation: &mut Simulation,
    number: usize,
    values: &Bound<'_, PyDict>,
) -> PyResult<()> {
    let known = spring_of(simulation, number)?;
    whole("spring", values, &SPRING)?;
    let [stiffness, damping, preload] =
        SPRING.map(|name| arrays::vector::<6>(&format!("spring: {name}"), &value(values, name)?));
    let spring = Spring { stiffness: stiffness?, damping: damping?, preload: preload?, ..known };
    simulation.set_spring(number, spring).map_err(of_executive)
}

/// Refuses a dictionary with missing or unknown keys, so that a misspelt key is not ignored.
fn whole(thing: &str, values: &Bound<'_, PyDict>, names: &[&str]) -> PyResult<()> {
    check_names(thing, values, names)?;
    for name in names {
        if !values.contains(name)? {
            let cure = format!("give all of {}, changed or as they were", names.join(", "));
            return Err(bad_value(thing, format!("`{name}` is missing"), &cure));
        }
    }
    Ok(())
}

/// Refuses keys that are no name of a value.
pub(crate) fn check_names(thing: &str, values: &Bound<'_, PyDict>, names: &[&str]) -> PyResult<()> {
    for key in values.keys() {
        let key = key.str()?.to_string();
        if !names.contains(&key.as_str()) {
            let near = values.py().import("difflib")?.call_method1("get_close_matches", (&key, names, 1))?;
            let cure = match near.extract::<Vec<String>>()?.first() {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("give {}", names.join(", ")),
            };
            return Err(bad_value(thing, format!("there is no value `{key}`"), &cure));
        }
    }
    Ok(())
}

/// A value of a dictionary checked by [`whole`].
fn value<'py>(values: &Bound<'py, PyDict>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    values.as_any().get_item(name)
}

/// Energies by name.
pub(crate) fn energies<'py>(py: Python<'py>, energy: &Energy) -> PyResult<Bound<'py, PyDict>> {
    let terms = [
        ("kinetic", energy.kinetic),
        ("potential", energy.potential),
        ("springs", energy.springs),
        ("contacts", energy.contacts),
        ("contact_loss", energy.contact_loss),
        ("spring_loss", energy.spring_loss),
        ("work_in", energy.work_in),
        ("balance", energy.balance()),
    ];
    terms.into_py_dict(py)
}
