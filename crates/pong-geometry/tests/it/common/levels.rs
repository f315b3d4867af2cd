//! Instruction-set level, which is global in the process. Tests that run beside one that changes it are not
//! affected: results are bit-identical at every level.

use pong_geometry::simd::{Level, set_level};
use std::sync::{Mutex, MutexGuard, PoisonError};

static TURN: Mutex<()> = Mutex::new(());

/// Exclusive right to set the level; when dropped, the best level is restored.
pub struct Turn(#[expect(dead_code, reason = "held until the end")] MutexGuard<'static, ()>);

impl Turn {
    /// Waits until no other test sets levels.
    pub fn wait() -> Self {
        Self(TURN.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        set_level(Level::best());
    }
}
