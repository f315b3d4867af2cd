//! The step adviser: limits of a fixed step, and the stiffness and damping that give a desired depth and
//! rebound.
//!
//! Masses and steps are the host's and serve advice alone (docs/advise.md); the engine does not use them. The
//! adviser reads a sealed world by [`pong_engine::World::inspect`]: [`step_report`] before anything touches,
//! [`acting_report`] and [`pressed_report`] for a frame. [`advise_contact`] needs no world.
//!
//! | file | content |
//! |---|---|
//! | `coupling.rs` | the longest stable step of one contact, by the use of its force |
//! | `delay.rs` | the critical delay of one contact |
//! | `bounce.rs` | closed forms of a bounce; error of a bounce at a given step |
//! | `contact.rs` | stiffness and damping from depth, restitution, mass and speed |
//! | `mass.rs`, `spring.rs` | the host's masses and step; springs and dampers of surfaces |
//! | `mobility.rs`, `places.rs` | compliance of a body at a point; the points where its primitives can be touched |
//! | `footprint.rs`, `solids.rs` | the largest shadow of a solid; contacts of solids before they touch |
//! | `together.rs` | a bound of the contacts that can act on one movable group at once, with levers and inertia |
//! | `spring_rates.rs` | the same of springs and dampers of the host |
//! | `acting.rs` | the same of the contacts in a frame, exactly |
//! | `term.rs`, `asking.rs` | the terms of a contact; the term that limits the step |
//! | `setting.rs`, `limits.rs` | the world and the known masses; the limits of a step |
//! | `pressed.rs` | single contacts of a frame, each at its depth and normal force |
//! | `stored.rs` | energy in the springs of a frame's contacts |
//! | `interface/` | stiffness and damping between two sets of groups at a preload, and the loads up to which they hold |
//! | `modes/` | frequencies, damping ratios and shapes of masses on a tangent |
//! | `check.rs`, `warn.rs` | every pair of movable groups against the host's step; the warnings and notes |

#![forbid(unsafe_code)]

mod acting;
mod asking;
mod bounce;
mod check;
mod contact;
mod coupling;
mod delay;
mod footprint;
mod interface;
mod limits;
mod mass;
mod mobility;
mod modes;
mod places;
mod pressed;
mod rows;
mod setting;
mod solids;
mod spring;
mod spring_rates;
mod stored;
mod term;
mod together;
mod warn;
mod yielding;

/// Upper bound of the memory of a [`step_report`] per pair of movable groups, bytes: a caller that must not
/// run out of memory after the seal reserves it ([`pong_engine::WorldBuilder::leave_room_per_pair`]).
pub const BYTES_PER_PAIR: usize = 1024;

pub use acting::{ActingReport, acting_report};
pub use bounce::{Accuracy, BounceError, bounce_error, depth_factor, resolved_step};
pub use check::{StepReport, step_report, step_report_with};
pub use contact::{ContactAdvice, ContactWish, advise_contact, critical_damping};
pub use coupling::longest_stable_step;
pub use delay::critical_delay;
pub use interface::{Ending, LinearInterface, LoadLimit, contact_name};
pub use limits::{BounceLimit, GroupLimits, PairLimits, SpringLimit, judge_contact};
pub use mass::{GroupMass, Joints, SpringRates, StepPlan};
pub use modes::{BodyShape, Carrier, Growth, LinearBody, LinearSystem, Mode, ModeKind, Modes};
pub use pong_engine::WrenchCoupling;
pub use pressed::pressed_report;
pub use spring::Spring;
pub use spring_rates::{HostSpring, HostSpringEnd, spring_rates};
pub use stored::{StoredEnergy, stored_energy};
pub use warn::{StepNote, StepWarning};
