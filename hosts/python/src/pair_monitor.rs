//! Begin and end of contact, and peaks over several frames, as Python sees them. Pairs and Interfaces are told by their numbers,
//! as in the array of contacts.

use crate::arrays::{self, WRENCH};
use crate::errors::PhaseError;
use pyo3::prelude::*;

/// Begin or end of contact between two movable groups.
#[pyclass(frozen, eq, module = "pong.types", get_all)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct ContactChange {
    /// int : Number of the pair of Objects.
    pair: usize,
    /// int : Number of the Interface of the Object that was named first in the pair.
    interface_a: usize,
    /// int : Number of the other Interface.
    interface_b: usize,
    /// bool : True where contact begins, false where it ends.
    begins: bool,
}

#[pymethods]
impl ContactChange {
    fn __repr__(&self) -> String {
        let Self { pair, interface_a, interface_b, begins } = self;
        let what = if *begins { "begins" } else { "ends" };
        format!("<pong.ContactChange pair {pair}: {interface_a} and {interface_b}, contact {what}>")
    }
}

impl From<pong_engine::ContactChange> for ContactChange {
    fn from(change: pong_engine::ContactChange) -> Self {
        let [interface_a, interface_b] = change.interfaces.map(|id| id.index());
        Self { pair: change.pair.index(), interface_a, interface_b, begins: change.begins }
    }
}

/// Contact between two movable groups over a window of several frames.
#[pyclass(frozen, eq, module = "pong.types", get_all)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct PairPeaks {
    /// int : Number of the pair of Objects.
    pair: usize,
    /// int : Number of the Interface of the Object that was named first in the pair.
    interface_a: usize,
    /// int : Number of the other Interface.
    interface_b: usize,
    /// bool : True if they touch in the frame last observed.
    touches: bool,
    /// int : Number of begins of contact in the window.
    begins: u32,
    /// int : Number of its ends.
    ends: u32,
    /// float : Largest sum of the normal forces of all their contacts in a frame, N.
    peak_normal_force: f64,
    /// list of float : Mean over the window of the wrench on the first group: force (3, N) and moment (3, N·m) about its
    /// origin, along the common axes.
    mean: [f64; WRENCH],
    /// float : Time of the frames in which they touched, s.
    contact_time: f64,
}

#[pymethods]
impl PairPeaks {
    fn __repr__(&self) -> String {
        let Self { pair, interface_a, interface_b, peak_normal_force, .. } = self;
        format!(
            "<pong.PairPeaks pair {pair}: {interface_a} and {interface_b}, at most {peak_normal_force} N>"
        )
    }
}

impl From<pong_engine::PairPeaks> for PairPeaks {
    fn from(peaks: pong_engine::PairPeaks) -> Self {
        let [interface_a, interface_b] = peaks.interfaces.map(|id| id.index());
        Self {
            pair: peaks.pair.index(),
            interface_a,
            interface_b,
            touches: peaks.touches,
            begins: peaks.begins,
            ends: peaks.ends,
            peak_normal_force: peaks.peak_normal_force,
            mean: arrays::wrench_row(&peaks.mean),
            contact_time: peaks.contact_time,
        }
    }
}

/// The refusal where nothing was started.
pub(crate) fn no_monitor() -> PyErr {
    PhaseError::new_err("pair monitor: there is none; make one with `start_pair_monitor`")
}
