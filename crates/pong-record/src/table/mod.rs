//! The tables of a log: their rows, and the NumPy files that hold them.

mod field;
mod file;
mod header;
mod rows;
mod value;

pub use field::Field;
pub use file::TableFile;
pub use header::header;
pub(crate) use header::write_header;
pub use rows::{ContactRow, EnergyRow, FrameRow, Row, StateRow, TangentRow, WrenchRow};
pub use value::Value;
