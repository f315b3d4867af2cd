//! The programs of `c_examples`, built by its script.

use super::{lib_dir, root, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The script that builds programs into a folder, with the library that cargo built for this test.
pub fn builder(out: &Path) -> Command {
    let mut command = Command::new("bash");
    command.arg(root().join("c_examples/build")).env("LIB_DIR", lib_dir()).env("OUT", out);
    command
}

/// Builds a program against the shared library.
pub fn build(program: &str, out: &Path) -> PathBuf {
    run(builder(out).arg(program));
    out.join("shared").join(program)
}

/// A built program with the library that it was built with.
pub fn command(built: &Path) -> Command {
    let mut command = Command::new(built);
    command.env("LD_LIBRARY_PATH", built.parent().unwrap());
    command
}
