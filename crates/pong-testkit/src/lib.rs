//! Utilities for the tests of several crates, and for the crates of tests: the cases with known answers and
//! the random scenes. No product code uses it.

#![deny(unsafe_code)]

pub mod exceptions;
pub mod heap;
pub mod meshes;
pub mod random;
pub mod ron;
pub mod samples;
#[cfg(feature = "worlds")]
pub mod worlds;

pub use random::Random;
pub use samples::{long_samples, samples};

use std::path::{Path, PathBuf};

/// True if two numbers agree within a relative error.
pub fn is_near(got: f64, expected: f64, relative: f64) -> bool {
    (got - expected).abs() <= relative * expected.abs()
}

/// Panics unless two numbers agree within a relative error.
#[track_caller]
pub fn assert_near(got: f64, expected: f64, relative: f64) {
    assert!(is_near(got, expected, relative), "{got} instead of {expected}");
}

/// An empty folder for one test, below the crate's own scratch folder: `scratch(env!("CARGO_TARGET_TMPDIR"), "name")`.
pub fn scratch(below: &str, test: &str) -> PathBuf {
    let folder = Path::new(below).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the scratch folder can be made");
    folder
}
