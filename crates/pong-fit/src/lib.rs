//! Parameters of a scene identified from measurements (docs/fit.md).

#![forbid(unsafe_code)]

mod batch;
mod data;
mod error;
mod parameter;
mod solve;

pub use batch::{Batch, Case, Outcome, Sample};
pub use data::{Checked, Data, Noise, Quantity, Record, Row, check, parse};
pub use error::{FitError, Result};
pub use parameter::Parameter;
