//! Report of a frame.

use pong_engine::{Continuation, World};
use pong_executive::tunnelling_in_words;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

/// Report of a frame.
#[pyclass(frozen, eq, module = "pong.types", get_all)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct FrameReport {
    /// int : Incomplete or missed parts, as the bits of `pong.Status`.
    status: u32,
    /// int : Contacts listed.
    contacts: u32,
    /// int : Contacts that would have been listed without the limit.
    contacts_wanted: u32,
}

impl From<pong_engine::FrameReport> for FrameReport {
    fn from(report: pong_engine::FrameReport) -> Self {
        let pong_engine::FrameReport { status, contacts, contacts_wanted } = report;
        Self { status: status.bits(), contacts, contacts_wanted }
    }
}

#[pymethods]
impl FrameReport {
    /// bool : True if nothing was left out or missed.
    #[getter]
    fn is_complete(&self) -> bool {
        self.status == 0
    }

    fn __repr__(&self) -> String {
        let Self { status, contacts, contacts_wanted } = self;
        format!("<pong.FrameReport status={status} contacts={contacts} contacts_wanted={contacts_wanted}>")
    }
}

/// Counts of a continued run, by name.
pub(crate) fn continued<'py>(py: Python<'py>, of: &Continuation) -> PyResult<Bound<'py, PyDict>> {
    let counts = [
        ("objects", of.objects),
        ("pairs", of.pairs),
        ("contacts", of.contacts),
        ("objects_left", of.objects_left),
        ("pairs_left", of.pairs_left),
        ("contacts_left", of.contacts_left),
    ];
    let told = counts.into_py_dict(py)?;
    told.set_item("energy_left", of.energy_left)?;
    Ok(told)
}

/// Description of the first tunnelling event since the last commit, with the number of events.
pub(crate) fn tunnelling(world: &World) -> Option<String> {
    let event = world.tunnelling()?;
    Some(format!("{} (1 of {})", tunnelling_in_words(world)?, event.count))
}
