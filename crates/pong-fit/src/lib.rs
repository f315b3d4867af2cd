//! Parameters of a scene identified from measurements (docs/fit.md).
//!
//! | file | is |
//! |---|---|
//! | `parameter/` | names resolved to numbers of a scene, set together |
//! | `batch.rs` | many short runs in one call, on all cores |
//! | `data/` | measured data read and checked |
//! | `probe.rs` | contacts of a body at measured poses |
//! | `settings.rs` | settings; scales of the search |
//! | `trials.rs` | residuals of records |
//! | `solve.rs` | bounded least squares |
//! | `intervals.rs` | curvature, bootstrap, profiles |
//! | `fit.rs` | the whole procedure |
//! | `momentum.rs` | inertia without a law of contact |
//! | `random.rs`, `watch.rs` | random numbers; progress |
//! | `paste.rs`, `report.rs` | texts to paste; page, tables, plot |

#![forbid(unsafe_code)]

mod batch;
mod data;
mod error;
mod fit;
mod intervals;
mod momentum;
mod parameter;
mod paste;
mod probe;
mod random;
pub mod report;
mod settings;
mod solve;
mod trials;
mod watch;

pub use batch::{Batch, Case, Outcome, Sample};
pub use data::{Checked, Data, Noise, Quantity, Record, Row, check, load, parse};
pub use error::{FitError, Result};
pub use fit::{Errors, Estimate, Fit, Try, fit, fit_file, fit_text, free_bodies};
pub use intervals::Profile;
pub use momentum::{MomentumInertia, MomentumSettings, inertia_from_momentum};
pub use parameter::Parameter;
pub use settings::{Free, Settings, Starts};
pub use watch::Watch;
