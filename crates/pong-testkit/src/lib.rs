//! What tests of several crates share, and with them the crates whose work is to test: the cases with known answers and the
//! random scenes. Nothing that is tested uses it.

#![deny(unsafe_code)]

pub mod exceptions;
pub mod heap;
pub mod meshes;
pub mod random;
pub mod ron;
#[cfg(feature = "worlds")]
pub mod worlds;

pub use random::Random;

use std::path::{Path, PathBuf};

/// Whether a number is another but for this part of it.
pub fn is_near(got: f64, expected: f64, relative: f64) -> bool {
    (got - expected).abs() <= relative * expected.abs()
}

/// Panics unless a number is another but for this part of it.
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
