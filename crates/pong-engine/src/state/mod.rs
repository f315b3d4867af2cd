//! Contact state: everything that the engine remembers between frames (docs/theory.md, 5).

mod block;
mod carry;
mod memory;
mod merge;
mod poses;
mod record;
mod records;
#[cfg(test)]
mod tests;

pub use block::StateError;
pub(crate) use block::{largest_len, needed_len, read_block, write_block};
pub(crate) use carry::{CarryOutcome, Counterparts};
pub(crate) use memory::{ContactMemory, RecordEntry};
pub(crate) use poses::{CommittedPoses, Past};
pub(crate) use record::{ContactKey, ContactRecord, ContactRole, NO_FACE, SolidContactPart};
pub(crate) use records::{RecordRange, Records, RecordsOfKey, SAME_WAY_COSINE_MIN};
