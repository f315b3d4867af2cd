//! The step adviser: what a fixed step can hold, and which stiffness and damping give a wanted depth and rebound.
//!
//! Masses and steps are the host's and serve advice alone (docs/advise.md); the engine knows of neither. Of a sealed world the
//! adviser reads what [`pong_engine::World::inspect`] shows: [`step_report`] before anything touches, [`acting_report`] and
//! [`pressed_report`] of a frame. [`advise_contact`] needs no world.
//!
//! | file | tells |
//! |---|---|
//! | `coupling.rs` | the longest stable step of one contact, by how its force is used |
//! | `bounce.rs` | closed forms of a bounce; how far a bounce at a given step is from them |
//! | `contact.rs` | stiffness and damping from depth, restitution, mass and speed |
//! | `mass.rs`, `spring.rs` | what the host tells of masses and step; what surfaces are to a step |
//! | `mobility.rs`, `places.rs` | how a body yields at a place; the places where its primitives can be touched |
//! | `together.rs` | a bound of what can act on one movable group at once, levers and inertia included |
//! | `spring_rates.rs` | the same of springs and dampers of the host |
//! | `acting.rs` | the same of what acts in a frame, exactly |
//! | `term.rs`, `asking.rs` | the terms of a contact; which of them asks for a short step |
//! | `setting.rs`, `limits.rs` | the world and the masses that are known; what a step can hold of them |
//! | `pressed.rs` | single contacts of a frame, each as deep and as hard pressed as it is |
//! | `stored.rs` | energy in the springs of a frame's contacts |
//! | `check.rs`, `warn.rs` | every pair of movable groups against the host's step; the warnings and notes |

#![forbid(unsafe_code)]

mod acting;
mod asking;
mod bounce;
mod check;
mod contact;
mod coupling;
mod limits;
mod mass;
mod mobility;
mod places;
mod pressed;
mod setting;
mod spring;
mod spring_rates;
mod stored;
mod term;
mod together;
mod warn;

/// What a [`step_report`] keeps of a pair of movable groups at most, bytes: whoever must not run out of memory after the seal
/// has it leave so much ([`pong_engine::WorldBuilder::leave_room_per_pair`]).
pub const BYTES_PER_PAIR: usize = 1024;

pub use acting::{ActingReport, acting_report};
pub use bounce::{Accuracy, BounceError, bounce_error, depth_factor, resolved_step};
pub use check::{StepReport, step_report, step_report_with};
pub use contact::{ContactAdvice, ContactWish, advise_contact, critical_damping};
pub use coupling::longest_stable_step;
pub use limits::{BounceLimit, GroupLimits, PairLimits, SpringLimit, judge_contact};
pub use mass::{GroupMass, Joints, SpringRates, StepPlan};
pub use pong_engine::WrenchCoupling;
pub use pressed::pressed_report;
pub use spring::Spring;
pub use spring_rates::{HostSpring, HostSpringEnd, spring_rates};
pub use stored::{StoredEnergy, stored_energy};
pub use warn::{StepNote, StepWarning};
