//! One CSV file, line by line.

use crate::error::LogError;
use pong_model::files::NewFile;
use pong_model::printable;
use std::fmt::Write as _;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file with a heading; its lines begin with a time.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    out: BufWriter<NewFile>,
    line: String,
}

impl Table {
    pub fn create(folder: &Path, name: &str, heading: &str) -> Result<Self, LogError> {
        std::fs::create_dir_all(folder).map_err(|reason| LogError::unwritable(folder, &reason))?;
        let path = folder.join(name);
        let file = NewFile::growing(&path).map_err(|reason| LogError::unwritable(&path, &reason))?;
        let mut table = Self { path, out: BufWriter::new(file), line: heading.to_owned() };
        table.end()?;
        Ok(table)
    }

    pub fn begin(&mut self, time: f64) {
        self.line.clear();
        let _ = write!(self.line, "{time:?}");
    }

    /// Writes a cell without escaping: a whole number, or a name by [`csv_name`].
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

    /// Writes the buffered rest.
    pub fn flush(&mut self) -> Result<(), LogError> {
        self.out.flush().map_err(|reason| LogError::unwritable(&self.path, &reason))
    }

    /// Moves the finished file to its final name.
    pub fn finish(self) -> Result<(), LogError> {
        let Self { path, out, .. } = self;
        let whole = out.into_inner().map_err(std::io::IntoInnerError::into_error).and_then(NewFile::finish);
        whole.map_err(|reason| LogError::unwritable(&path, &reason))
    }
}

/// A name in CSV form.
///
/// Control characters are escaped. Spreadsheets take a cell that begins with `=`, `+`, `-` or `@` for a
/// formula and compute it: an apostrophe before it makes it text.
pub fn csv_name(name: &str) -> String {
    let shown = printable(name);
    let formula = if shown.starts_with(['=', '+', '-', '@']) { "'" } else { "" };
    let cell = format!("{formula}{shown}");
    if cell.contains([',', '"']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
}

#[cfg(test)]
mod tests {
    use super::csv_name;

    #[test]
    fn no_name_is_a_formula_a_line_or_a_command() {
        for (name, cell) in [
            ("arm/tip", "arm/tip"),
            ("a-b=c@d", "a-b=c@d"),
            ("say \"a, b\"", "\"say \"\"a, b\"\"\""),
            ("=HYPERLINK(\"x\", 1)", "\"'=HYPERLINK(\"\"x\"\", 1)\""),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("+1", "'+1"),
            ("-1", "'-1"),
            ("\t=1", "\\t=1"),
            ("a\r\nb\x1b[2J", "a\\r\\nb\\u{1b}[2J"),
        ] {
            assert_eq!(csv_name(name), cell, "{name:?}");
        }
    }
}
