//! Derivatives of the wrenches of a frame, as Python sees them.

use crate::arrays::{self, Matrix};
use crate::errors::of_engine;
use numpy::{PyArray1, PyArray4, PyArrayMethods};
use pong_engine::{ContactTangent, EngineError, ModelId, PairPotential, PairTangent, TangentMatrix, World};
use pong_geometry::Wrench;
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

/// Incremental potential of the contacts of two movable groups: the energy that they add in a step, as a function of the poses
/// at its end (docs/theory.md, 7).
#[pyclass(frozen, eq, module = "pong.types")]
#[derive(Clone, PartialEq)]
pub(crate) struct Potential(PairPotential);

#[pymethods]
impl Potential {
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

    /// float : Energy, J.
    #[getter]
    fn energy(&self) -> f64 {
        self.0.energy
    }

    /// ndarray : Shape (2, 6): minus the derivatives of the energy by the poses of both groups: force (N) and moment about the
    /// group's origin (N·m), along the common axes.
    #[getter]
    fn wrenches<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        pairs(py, &self.0.wrenches)
    }

    /// ndarray : Shape (2, 2, 6, 6): second derivatives of the energy without the turning of normals and levers, as
    /// `Tangent.stiffness`; symmetric as a whole, without a negative eigenvalue while no damper pulls.
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> PyResult<Blocks<'py>> {
        blocks(py, &self.0.stiffness)
    }

    fn __repr__(&self) -> String {
        format!("<pong.Potential of {} and {}>", self.interface_a(), self.interface_b())
    }
}

/// Derivatives of the wrenches that two movable groups put on each other, by a number of a surface.
#[pyclass(frozen, eq, module = "pong.types")]
#[derive(Clone, PartialEq)]
pub(crate) struct SurfaceSlope(pong_engine::SurfaceSlope);

#[pymethods]
impl SurfaceSlope {
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

    /// ndarray : Shape (2, 6): derivatives of force (N) and moment about the group's origin (N·m) on both groups over the unit of
    /// the number, along the common axes.
    #[getter]
    fn wrenches<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        pairs(py, &self.0.wrenches)
    }

    fn __repr__(&self) -> String {
        format!("<pong.SurfaceSlope of {} and {}>", self.interface_a(), self.interface_b())
    }
}

fn pairs<'py>(py: Python<'py>, wrenches: &[Wrench; 2]) -> PyResult<Matrix<'py>> {
    let row = |Wrench { force, moment }: &Wrench| [force.x, force.y, force.z, moment.x, moment.y, moment.z];
    arrays::fill(py, None, 2, |index| Ok(row(&wrenches[index])))
}

/// Incremental potentials of a step that ends at the states that are set.
pub(crate) fn potentials(py: Python<'_>, world: &mut World, step: f64) -> PyResult<Vec<Potential>> {
    let found = py.detach(move || world.incremental_potentials(step));
    Ok(found.map_err(of_engine)?.into_iter().map(Potential).collect())
}

/// Derivatives of the wrenches by a number of a surface.
pub(crate) fn surface_slopes(
    py: Python<'_>,
    world: &mut World,
    (model, surface, number): (ModelId, &str, &str),
) -> PyResult<Vec<SurfaceSlope>> {
    let found = py.detach(|| world.surface_slopes(model, surface, number));
    Ok(found.map_err(of_engine)?.into_iter().map(SurfaceSlope).collect())
}
