//! The committed contact state as a block of bytes.

use super::World;
use crate::error::EngineError;

impl World {
    /// Size of the largest contact state block that this world can have, bytes; fixed by the seal. A buffer of this size is
    /// always large enough to save into.
    pub fn state_size(&self) -> usize {
        self.runtime.state_size()
    }

    /// Size of the block of what is remembered now, bytes: it grows and shrinks with the contacts of the last commit.
    pub fn state_used(&self) -> usize {
        self.runtime.state_used()
    }

    /// Whether anything is remembered: no frame was committed yet, or all was forgotten, if not.
    pub fn has_contact_state(&self) -> bool {
        let memory = &self.runtime.memory;
        memory.poses.knows_any() || memory.records.len() > 0 || (memory.work, memory.dissipated) != (0.0, 0.0)
    }

    /// Saves the committed contact state into a buffer of at least [`state_used`](Self::state_used) bytes. What lies behind
    /// them in the buffer, up to [`state_size`](Self::state_size), becomes zero.
    ///
    /// # Errors
    /// [`EngineError::State`] if the buffer is too small.
    pub fn save_state(&self, out: &mut [u8]) -> Result<(), EngineError> {
        Ok(self.runtime.save_state(out)?)
    }

    /// Saves the committed contact state into a buffer that becomes as long as the block. The last eight bytes are a hash
    /// of all before them.
    pub fn save_state_packed(&self, out: &mut Vec<u8>) {
        out.resize(self.runtime.state_used(), 0);
        self.runtime.save_state(out).expect("the buffer is as long as the block");
    }

    /// Restores a contact state that a world built by the same calls saved: the block alone, or with zeros behind it up to
    /// [`state_size`](Self::state_size). The states of the movable groups are the host's and are not part of it.
    ///
    /// # Errors
    /// [`EngineError::State`] for a block of another world, another format, or that was damaged; what is remembered stays.
    pub fn restore_state(&mut self, block: &[u8]) -> Result<(), EngineError> {
        Ok(self.runtime.restore_state(&self.scene, block)?)
    }
}
