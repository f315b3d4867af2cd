//! Description of an FMU that an importer reads before loading it: `modelDescription.xml` of both versions,
//! and a page for people.

mod common;
mod fmi2;
mod fmi3;
mod page;
mod xml;

pub(crate) use common::counts;
pub(crate) use page::page;

use crate::unit::Unit;
use crate::version::Fmi;

/// The description of a unit.
pub(crate) fn describe(unit: &Unit, fmi: Fmi, identifier: &str, token: &str) -> String {
    match fmi {
        Fmi::V2 => fmi2::describe(unit, identifier, token),
        Fmi::V3 => fmi3::describe(unit, identifier, token),
    }
}
