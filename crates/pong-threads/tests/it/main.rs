//! Tests of the pool of workers.

mod common;
mod phases;
mod trouble;
