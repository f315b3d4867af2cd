//! Integration tests of the crate.

mod bad_input;
mod batch;
mod common;
mod momentum;
mod recovery;
mod synthetic;
