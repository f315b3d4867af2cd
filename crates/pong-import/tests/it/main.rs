//! Tests of the importers, on files as written by other programs.

mod common;
mod formats;
mod nodes;
mod round;
