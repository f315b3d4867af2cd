//! Stiffness and damping for a wanted bounce (docs/advise.md).

use crate::builder::coupling;
use crate::errors::of_engine;
use pong_advise::{Accuracy, ContactWish};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

/// Values of a pair of surfaces, by name, that give a wanted depth and rebound.
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
