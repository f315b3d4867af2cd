//! The step adviser: what a fixed step can hold, and which stiffness and damping give a wanted depth and rebound.
//!
//! No frame reads anything from here: masses and steps are the host's, and they serve advice alone (theory manual,
//! section 8).
//!
//! | file | tells |
//! |---|---|
//! | `coupling.rs` | the longest stable step of one contact, by how its force is used |
//! | `bounce.rs` | closed forms of a bounce; how far a bounce at a given step is from them |
//! | `contact.rs` | stiffness and damping from depth, restitution, mass and speed |
//! | `mass.rs`, `spring.rs` | what the host tells of masses and step; what surfaces are to a step |
//! | `check.rs`, `warn.rs` | every pair of movable groups against the host's step; the warnings of the seal |

mod bounce;
mod check;
mod contact;
mod coupling;
mod mass;
mod spring;
mod warn;

pub use bounce::{Accuracy, BounceError, bounce_error, depth_factor, resolved_step};
pub(crate) use check::Setting;
pub use check::{BounceLimit, PairLimits, SpringLimit, StepReport, judge_contact};
pub use contact::{ContactAdvice, ContactWish, advise_contact};
pub use coupling::{Coupling, longest_stable_step};
pub use mass::{GroupMass, StepPlan};
pub use spring::Spring;
pub(crate) use warn::warnings;
