//! Contact wrenches for hosts that call once in a long frame and hold the wrench (docs/theory.md, 9).
//!
//! A [`SlowHost`] follows the bodies through the frame on *copies*, with substeps that are short enough for the
//! contacts, and returns for each movable group the one wrench that takes the host's body as near to the end of
//! its copy as the host can come. An energy that neither the host nor the copy may exceed limits the wrench.
//!
//! | file | is |
//! |---|---|
//! | `settings.rs` | settings that hold for a whole run |
//! | `input.rs` | what the host gives for each frame, checked |
//! | `chart.rs` | poses and velocities in six coordinates, along common axes or along the group's |
//! | `body.rs` | one movable group in a frame |
//! | `assembly.rs` | bodies that joints connect, and the square root of their mobility |
//! | `system.rs` | all bodies of a frame |
//! | `contact_set.rs` | contacts of a set of poses, with energy, force and stiffness |
//! | `copies.rs` | the substeps |
//! | `island.rs` | groups that touch each other |
//! | `projection.rs` | reachable velocity nearest to the end of the copies |
//! | `implicit.rs` | one implicit step, which never gains energy |
//! | `guard.rs` | limit of the energy |
//! | `memory.rs`, `block.rs` | what is kept between frames, and as bytes |
//! | `queue.rs` | wrenches on their way to a host that applies them late |
//! | `prediction.rs`, `report.rs` | what the host did otherwise than predicted |
//! | `host.rs`, `frame.rs` | the calls; one frame |

#![forbid(unsafe_code)]

mod assembly;
mod block;
mod body;
mod chart;
mod contact_set;
mod copies;
mod error;
mod frame;
mod guard;
mod host;
mod implicit;
mod input;
mod island;
mod memory;
mod prediction;
mod projection;
mod queue;
mod report;
mod settings;
mod system;

pub use error::SlowError;
pub use host::SlowHost;
pub use input::{Coupling, Dynamics, GroupInput};
pub use report::{FrameStatus, GroupReport, Report};
pub use settings::Settings;
