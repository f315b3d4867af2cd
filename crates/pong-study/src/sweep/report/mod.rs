//! Report of a study: a table in Markdown and in CSV, and a plot.

mod csv;
mod effects;
mod markdown;
mod numbers;
mod plot;

pub use csv::{csv, errors_csv};
pub use markdown::markdown;
pub use plot::svg;

use crate::Result;
use crate::sweep::store::write_whole;
use crate::sweep::study::Study;
use std::path::Path;

/// Writes `trade.md`, `trade.csv`, `errors.csv` and `trade.svg` into a folder.
///
/// # Errors
///
/// A file that cannot be written; the error names it.
pub fn write(study: &Study, folder: &Path) -> Result<()> {
    let files = [
        ("trade.md", markdown(study)),
        ("trade.csv", csv(study)),
        ("errors.csv", errors_csv(study)),
        ("trade.svg", svg(study)),
    ];
    files.iter().try_for_each(|(name, text)| write_whole(&folder.join(name), text.as_bytes()))
}
