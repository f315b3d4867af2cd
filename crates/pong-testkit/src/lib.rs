//! What tests of several crates share, and with them the crates whose work is to test: the cases with known answers and the
//! random scenes. Nothing that is tested uses it.

#![deny(unsafe_code)]

pub mod heap;
pub mod meshes;
pub mod random;

pub use random::Random;

use std::path::{Path, PathBuf};

/// An empty folder for one test, below the crate's own scratch folder: `scratch(env!("CARGO_TARGET_TMPDIR"), "name")`.
pub fn scratch(below: &str, test: &str) -> PathBuf {
    let folder = Path::new(below).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the scratch folder can be made");
    folder
}
