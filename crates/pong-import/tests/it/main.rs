//! Tests of the importers, on files as other programs write them.

mod common;
mod formats;
mod nodes;
mod round;
