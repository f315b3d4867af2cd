//! Calls of a sealed world: incremental potentials, derivatives by the numbers of a surface.

use crate::ids::AddedModel;
use crate::sealed::World;
use crate::tangents::{self, Potential, SurfaceSlope};
use pyo3::prelude::*;

#[pymethods]
impl World {
    /// Returns the incremental potential of a step for every two groups that touch, between `evaluate` and the commit: the
    /// energy that their contacts add, as a function of the poses that are set, those at the end of the step. For hosts that
    /// find this end as the minimum of an energy. The step starts at the last commit (docs/theory.md, 7).
    ///
    /// Parameters
    /// ----------
    /// step : float
    ///     Length of the step, s.
    ///
    /// Returns
    /// -------
    /// list of Potential
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     No frame is evaluated, or it is committed.
    /// BadValueError
    ///     The step is not positive and finite, or a contact has no potential: two solids, a law of the host, a resistance to
    ///     rolling or spinning.
    fn incremental_potentials(&self, py: Python<'_>, step: f64) -> PyResult<Vec<Potential>> {
        tangents::potentials(py, &mut self.lock()?.world, step)
    }

    /// Returns the derivatives of the wrenches of the last frame by a number of a surface, between `evaluate` and the commit, for
    /// every two groups that touch: a column of the regressor that identifies surfaces from measured wrenches. Poses and
    /// contact state are held. The frame stays as it is.
    ///
    /// Parameters
    /// ----------
    /// model : AddedModel
    ///     Model of the surface.
    /// surface : str
    ///     Name of the surface.
    /// number : str
    ///     Name of the number as in the model format: `stiffness`, `normal.damping`, `friction.mu`, and so on.
    ///
    /// Returns
    /// -------
    /// list of SurfaceSlope
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     No frame is evaluated, or it is committed.
    /// NotFoundError
    ///     The model has no such surface, or the surface does not give the number.
    fn surface_slopes(
        &self,
        py: Python<'_>,
        model: &AddedModel,
        surface: &str,
        number: &str,
    ) -> PyResult<Vec<SurfaceSlope>> {
        tangents::surface_slopes(py, &mut self.lock()?.world, (model.id, surface, number))
    }
}
