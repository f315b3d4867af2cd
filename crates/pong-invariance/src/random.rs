//! Random numbers, shared with the cases with known answers and the engine's tests.

pub use pong_testkit::random::{Random, rotation_about, rotation_between};
