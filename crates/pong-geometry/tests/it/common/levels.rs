//! The level of instructions, which is one for the whole process. Tests beside one that chooses it do not notice: answers are
//! the same bits at every level.

use pong_geometry::simd::{Level, set_level};
use std::sync::{Mutex, MutexGuard, PoisonError};

static TURN: Mutex<()> = Mutex::new(());

/// The right to choose the level; at its end the best one is chosen again.
pub struct Turn(#[expect(dead_code, reason = "held until the end")] MutexGuard<'static, ()>);

impl Turn {
    /// Waits until no other test chooses levels.
    pub fn wait() -> Self {
        Self(TURN.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        set_level(Level::best());
    }
}
