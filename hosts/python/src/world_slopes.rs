//! Calls of a sealed world: derivatives of wrenches and of the forces of contacts, incremental potentials.

use crate::arrays::Matrix;
use crate::ids::AddedModel;
use crate::sealed::World;
use crate::tangents::{self, Potential, SurfaceSlope, Tangent};
use pyo3::prelude::*;

#[pymethods]
impl World {
    /// Returns stiffness and damping of each contact, along its normal and of its bristle.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (k, 4)
    ///     Stiffness (N/m) and damping (N·s/m) along the normal, then those of the bristle while it sticks, else 0; in the
    ///     order of `contacts`. NaN for a law of the host, solids, and forces against rolling and spinning.
    fn contact_tangents<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        tangents::of_contacts(py, &self.lock()?.world)
    }

    /// Returns the derivatives of the wrenches of the last frame, between `evaluate` and the commit, for every two groups
    /// that touch (docs/theory.md, 7). The frame stays as it is.
    ///
    /// Parameters
    /// ----------
    /// differences : bool, default False
    ///     Central differences instead of the closed form: for all kinds of contact, and slower.
    ///
    /// Returns
    /// -------
    /// list of Tangent
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     No frame is evaluated, or it is committed.
    /// BadValueError
    ///     A contact has derivatives that are not known in closed form: use `complete_tangents`.
    #[pyo3(signature = (differences = false))]
    fn tangents(&self, py: Python<'_>, differences: bool) -> PyResult<Vec<Tangent>> {
        tangents::of_frame(py, &mut self.lock()?.world, tangents::all(differences))
    }

    /// Returns the same as `tangents`, for every kind of contact: in closed form for two groups whose contacts all have
    /// it, by central differences for others.
    ///
    /// Returns
    /// -------
    /// list of Tangent
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     No frame is evaluated, or it is committed.
    fn complete_tangents(&self, py: Python<'_>) -> PyResult<Vec<Tangent>> {
        tangents::of_frame(py, &mut self.lock()?.world, pong_engine::World::complete_tangents)
    }

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
