//! What tests of several crates share. A dev-dependency only: nothing of the product uses it.

#![forbid(unsafe_code)]

pub mod meshes;

use std::path::{Path, PathBuf};

/// An empty folder for one test, below the crate's own scratch folder: `scratch(env!("CARGO_TARGET_TMPDIR"), "name")`.
pub fn scratch(below: &str, test: &str) -> PathBuf {
    let folder = Path::new(below).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the scratch folder can be made");
    folder
}
