//! One CSV file, line by line.

use crate::error::LogError;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file with a heading; its lines begin with a time.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    out: BufWriter<File>,
    line: String,
}

impl Table {
    pub fn create(folder: &Path, name: &str, heading: &str) -> Result<Self, LogError> {
        std::fs::create_dir_all(folder).map_err(|reason| LogError::unwritable(folder, &reason))?;
        let path = folder.join(name);
        let file = File::create(&path).map_err(|reason| LogError::unwritable(&path, &reason))?;
        let mut table = Self { path, out: BufWriter::new(file), line: heading.to_owned() };
        table.end()?;
        Ok(table)
    }

    pub fn begin(&mut self, time: f64) {
        self.line.clear();
        let _ = write!(self.line, "{time:?}");
    }

    /// A cell as it stands: a whole number, or a name that is [`quoted`].
    pub fn cell(&mut self, text: impl std::fmt::Display) {
        let _ = write!(self.line, ",{text}");
    }

    pub fn numbers(&mut self, values: &[f64]) {
        for value in values {
            let _ = write!(self.line, ",{value:?}");
        }
    }

    pub fn end(&mut self) -> Result<(), LogError> {
        self.line.push('\n');
        self.out.write_all(self.line.as_bytes()).map_err(|reason| LogError::unwritable(&self.path, &reason))
    }

    pub fn finish(mut self) -> Result<(), LogError> {
        self.out.flush().map_err(|reason| LogError::unwritable(&self.path, &reason))
    }
}

/// A name as CSV writes it.
pub(super) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
