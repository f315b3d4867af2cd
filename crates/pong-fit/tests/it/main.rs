//! Integration tests of the crate.

mod batch;
mod common;
