//! Cases with known answers, run through the whole chain: model file → engine → wrench → integrator.
//!
//! Every expected value follows from a closed form that the case itself computes; nothing is taken from the
//! engine. Sines, logarithms and powers come from a pure-Rust libm, so that the report is the same on every
//! machine of an architecture.
//!
//! ```
//! let case = pong_verify::find("V1").unwrap();
//! let verdict = case.run();
//! assert!(verdict.passes(), "{verdict}");
//! ```
//!
//! | file | holds |
//! |---|---|
//! | `case.rs` | a case with a known answer, and its verdict |
//! | `row.rs` | a quantity, its expected and its measured value |
//! | `scene.rs` | model files → sealed world → simulation |
//! | `measure.rs` | periods, roots, observed orders, rotations |
//! | `cases/` | the cases, one file each or a few that belong together |
//! | `orders/` | orders of contact motions in the step, and their picture |
//! | `report.rs` | the table as text and as Markdown |
//! | `extremes/` | extreme conditions, with their margins |

#![forbid(unsafe_code)]

mod case;
mod cases;
pub mod extremes;
mod measure;
pub mod orders;
pub mod report;
mod row;
mod scene;

pub use case::{Case, Failure, Outcome, Verdict};
pub use cases::{cases, find};
pub use row::{Bound, Row};
