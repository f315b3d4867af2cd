//! Source of the checks: the machine, or a record of one.

use std::path::Path;

/// Text files by their absolute path.
pub trait Files {
    /// The text without trailing white space; `None` if the file does not exist or cannot be read.
    fn text(&self, path: &str) -> Option<String>;
}

/// The files of the machine that the program runs on.
pub struct ThisMachine;

impl Files for ThisMachine {
    fn text(&self, path: &str) -> Option<String> {
        let bytes = std::fs::read(Path::new(path)).ok()?;
        Some(String::from_utf8_lossy(&bytes).trim_end().to_owned())
    }
}
