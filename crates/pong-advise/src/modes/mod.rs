//! Modes of a linear system: masses of the host, tangents of the world (docs/modes.md).
//!
//! ```text
//! M·ẍ + D·ẋ + K·x = 0        x: displacement of each mass centre and rotation vector of each body, common axes
//! ```
//!
//! K is not symmetric where friction slips or moments act. Frequencies and shapes without damping are those of its
//! symmetric part ½(K + Kᵀ); damping ratios and growing motions are those of the whole K and D.
//!
//! | file | content |
//! |---|---|
//! | `system.rs` | masses, K and D about the mass centres; contacts and springs that carry them |
//! | `undamped.rs` | frequencies and shapes without damping |
//! | `kind.rs` | kinds of modes, errors |
//! | `damped.rs` | eigenvalues with damping, matched to the modes; growing motions |

mod damped;
mod kind;
mod system;
mod undamped;

pub use damped::Growth;
pub use kind::ModeKind;
pub use system::{Carrier, LinearBody, LinearSystem};
pub use undamped::{BodyShape, Mode, Modes};
