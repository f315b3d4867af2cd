//! Invariances: random contact scenes against twins that must give the same answers.
//!
//! A [`scene::Scene`] is plain data (primitives, surfaces, states of a history), made at random for every tester by
//! [`make`]. A [`twin::Twin`] is the same scene told in another way: turned, moved, cut, scaled, reordered, played otherwise.
//! [`judge`] holds the two against each other frame by frame, [`jump`] recognises where physics itself jumps, [`properties`]
//! are checks of one scene by itself, [`reduce`] makes what disagrees small, and [`survey`] does so for many. What is
//! claimed stands in [`invariances`]; see `docs/invariances.md`.

#![forbid(unsafe_code)]

pub mod allowance;
pub mod base;
pub mod cutting;
pub mod invariances;
pub mod judge;
pub mod jump;
pub mod make;
pub mod play;
pub mod properties;
pub mod random;
pub mod reduce;
pub mod round_part;
pub mod scene;
pub mod survey;
pub mod text;
pub mod twin;

pub use survey::{Order, Survey};
