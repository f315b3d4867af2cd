//! The tables of a log: their rows, and the NumPy files that hold them.

mod file;
mod header;
mod rows;
mod value;

pub use file::TableFile;
pub use header::header;
pub(crate) use header::write_header;
pub use rows::{ContactRow, EnergyRow, FrameRow, Row, StateRow, WrenchRow};
pub use value::Value;

/// One field of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// NumPy's name of one number of it.
    pub kind: &'static str,
    /// How many numbers it is; 0 for one that is no array.
    pub count: usize,
    /// Bytes.
    pub size: usize,
}
