//! Contact state: all that the engine remembers between frames (physics contract, section 5).

mod block;
mod growing;
#[allow(dead_code)] // Until its callers have moved over.
mod memory;
#[allow(dead_code)]
mod merge;
#[cfg(test)]
mod tests;

pub use block::StateError;
pub(crate) use block::{block_len, fnv1a};
// Until its callers have moved over to `memory::ContactMemory`, `block::read_block` and `block::write_block`, which
// take no memory after sealing: then these two lines go, and growing.rs.
pub(crate) use growing::{ContactMemory, read_block, write_block};
pub(crate) use memory::{ContactKey, ContactRecord, NO_FACE, PairPose, Role};
