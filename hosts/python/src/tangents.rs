//! Derivatives of the wrenches of a frame, as Python sees them.

use crate::arrays::{self, Matrix};
use crate::errors::of_engine;
use numpy::{PyArray1, PyArray4, PyArrayMethods};
use pong_engine::{ContactTangent, EngineError, PairTangent, TangentMatrix, World};
use pyo3::prelude::*;

/// An array of 2 × 2 matrices of 6 × 6.
type Blocks<'py> = Bound<'py, PyArray4<f64>>;

/// Derivatives of the wrenches that two movable groups put on each other. A wrench is force (N) and moment (N·m) about the
/// group's origin, a pose the translation of this origin (m) and a rotation vector (rad), a twist the velocity of this origin
/// (m/s) and the angular velocity (rad/s), all along the common axes.
#[pyclass(frozen, eq, module = "pong.types")]
#[derive(Clone, PartialEq)]
pub(crate) struct Tangent(PairTangent);

#[pymethods]
impl Tangent {
    /// int : Number of the first Interface.
    #[getter]
    fn interface_a(&self) -> usize {
        self.0.groups[0].index()
    }

    /// int : Number of the second Interface.
    #[getter]
    fn interface_b(&self) -> usize {
        self.0.groups[1].index()
    }

    /// ndarray : Shape (2, 2, 6, 6): `stiffness[i, j]` is minus the derivative of the wrench on group i with respect to the pose of
    /// group j, N/m, N/rad, N and N·m/rad; i and j are 0 for `interface_a` and 1 for `interface_b`.
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> PyResult<Blocks<'py>> {
        blocks(py, &self.0.stiffness)
    }

    /// ndarray : Shape (2, 2, 6, 6): `damping[i, j]` is minus the derivative of the wrench on group i with respect to the twist of
    /// group j, N·s/m, N·s/rad, N·s and N·m·s/rad.
    #[getter]
    fn damping<'py>(&self, py: Python<'py>) -> PyResult<Blocks<'py>> {
        blocks(py, &self.0.damping)
    }

    /// bool : True if central differences gave `stiffness` and `damping`.
    #[getter]
    fn by_differences(&self) -> bool {
        self.0.by_differences
    }

    fn __repr__(&self) -> String {
        format!("<pong.Tangent of {} and {}>", self.interface_a(), self.interface_b())
    }
}

fn blocks<'py>(py: Python<'py>, blocks: &[[TangentMatrix; 2]; 2]) -> PyResult<Blocks<'py>> {
    let number = |index: usize| {
        let (block, within) = (&blocks[index / 72][index / 36 % 2], index % 36);
        block[(within / 6, within % 6)]
    };
    PyArray1::from_vec(py, (0..144).map(number).collect()).reshape([2, 2, 6, 6])
}

/// The function of a world that gives tangents in closed form or by differences.
pub(crate) fn all(differences: bool) -> fn(&mut World) -> Result<Vec<PairTangent>, EngineError> {
    if differences { World::tangents_by_differences } else { |world| world.tangents() }
}

/// Tangents of the last frame of a world, by one of its functions.
pub(crate) fn of_frame(
    py: Python<'_>,
    world: &mut World,
    tangents: impl FnOnce(&mut World) -> Result<Vec<PairTangent>, EngineError> + Send,
) -> PyResult<Vec<Tangent>> {
    let found = py.detach(|| tangents(world));
    Ok(found.map_err(of_engine)?.into_iter().map(Tangent).collect())
}

/// Stiffness and damping of each contact along its normal, then those of its bristle; NaN where they are not known.
pub(crate) fn of_contacts<'py>(py: Python<'py>, world: &World) -> PyResult<Matrix<'py>> {
    let row = |tangent: Option<ContactTangent>| {
        tangent.map_or([f64::NAN; 4], |ContactTangent { normal, tangential }| {
            [normal.stiffness, normal.damping, tangential.stiffness, tangential.damping]
        })
    };
    let rows: Vec<[f64; 4]> = world.contact_tangents().map(row).collect();
    arrays::fill(py, None, rows.len(), |index| Ok(rows[index]))
}
