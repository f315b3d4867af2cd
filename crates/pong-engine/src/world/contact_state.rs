//! Committed contact state as a block of bytes.

use super::World;
use crate::error::EngineError;

impl World {
    /// Size of the largest contact state block of this world, bytes; fixed by the seal. A buffer of this size
    /// is always large enough for a save.
    pub fn state_size(&self) -> usize {
        self.runtime.state_size()
    }

    /// Size of the current contact state block, bytes; it varies with the contacts of the last commit.
    pub fn state_used(&self) -> usize {
        self.runtime.state_used()
    }

    /// Returns true if there is any contact state: the history of a pair, a contact record, or work or
    /// dissipation in the ledger. False before the first commit.
    pub fn has_contact_state(&self) -> bool {
        let memory = &self.runtime.memory;
        memory.poses.knows_any()
            || !memory.records.is_empty()
            || (memory.work, memory.dissipated) != (0.0, 0.0)
    }

    /// Saves the committed contact state into a buffer of at least [`state_used`](Self::state_used) bytes.
    /// The rest of the buffer, up to [`state_size`](Self::state_size), is zeroed.
    ///
    /// # Errors
    /// [`EngineError::State`] if the buffer is too small.
    pub fn save_state(&self, out: &mut [u8]) -> Result<(), EngineError> {
        Ok(self.runtime.save_state(out)?)
    }

    /// Saves the committed contact state into a buffer, which is resized to the block. The last eight bytes
    /// are a hash of all before them.
    pub fn save_state_packed(&self, out: &mut Vec<u8>) {
        out.resize(self.runtime.state_used(), 0);
        self.runtime.save_state(out).expect("the buffer is as long as the block");
    }

    /// Restores a contact state saved by a world that was built by the same calls: the block alone, or
    /// followed by zeros up to [`state_size`](Self::state_size). The states of the movable groups belong to
    /// the host and are not part of it.
    ///
    /// # Errors
    /// [`EngineError::State`] for a block of another world or another format, or a damaged one; the contact
    /// state is unchanged then.
    pub fn restore_state(&mut self, block: &[u8]) -> Result<(), EngineError> {
        Ok(self.runtime.restore_state(&self.scene, block)?)
    }
}
