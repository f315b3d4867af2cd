//! Measured data: records of poses, velocities and wrenches over time (docs/fit.md).
//!
//! | file | is |
//! |---|---|
//! | `record.rs` | the data |
//! | `csv.rs` | a text file read |
//! | `log.rs` | a response log read |
//! | `checks.rs` | gaps, units, order of quaternions, axes of angular velocities |
//! | `interval.rs` | successive measurements |
//! | `readings.rs` | order of quaternions without angular velocities |

mod checks;
mod csv;
mod interval;
mod log;
mod readings;
mod record;

pub use checks::check;
pub use csv::parse;
pub use interval::Checked;
pub use record::{Data, Noise, Quantity, Record, Row};

use crate::error::{FitError, Result};
use std::path::Path;

/// Reads a CSV file, or the folder of a response log. `bodies` are the bodies that may be meant.
///
/// # Errors
/// A file that cannot be read, and every fault of its text.
pub fn load(path: &Path, bodies: &[String]) -> Result<Data> {
    if path.is_dir() {
        return log::load(path, bodies);
    }
    let file = path.display();
    match std::fs::read_to_string(path) {
        Ok(text) => parse(&text, &file.to_string(), bodies),
        Err(reason) => {
            Err(FitError::new(file, reason, "name a CSV file or the folder of a response log (docs/fit.md)"))
        }
    }
}
