//! Properties of a single scene that docs/theory.md, 2.4, 4 and 5 promise: sides, memory and friction.

pub mod friction;
pub mod memory;
pub mod potential;
pub mod sides;
pub mod tangent;

use crate::base::Base;
use crate::judge::{Verdict, told};
use crate::play::Answer;

/// A difference between two answers to one scene.
fn differs(base: &Base, frame: usize, relative: f64, what: &str, other: &Answer) -> Verdict {
    let says = format!("{what}\nfirst:{}\nthen: {}", told(&base.answers[frame]), told(other));
    Verdict::differs(frame, relative, says)
}
