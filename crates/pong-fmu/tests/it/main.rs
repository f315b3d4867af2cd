//! Tests of FMUs, as an importer sees them.

mod calls;
mod description;
mod support;
