//! The source of random numbers, which the cases with known answers and the tests of the engine have too.

pub use pong_testkit::random::{Random, rotation_about, rotation_between};
