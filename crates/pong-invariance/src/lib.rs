//! Invariances: random contact scenes compared with twins that must give the same answers.
//!
//! A [`scene::Scene`] is plain data (primitives, surfaces, states of a history), generated at random for
//! every tester by [`make`]. A [`twin::Twin`] is an equivalent scene: turned, moved, cut, scaled, reordered,
//! or played differently. [`judge`] compares the two frame by frame, [`jump`] recognises true
//! discontinuities, [`properties`] checks single scenes, [`reduce`] minimises failing scenes, and [`survey`]
//! does so for many. The claims are listed in [`invariances`]; see `docs/invariances.md`.

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
