#![doc = include_str!("../README.md")]
#![deny(unsafe_code)]

mod arena;
mod counts;
mod demand;
mod full;
mod list;
mod system;
mod table;

pub use arena::Arena;
pub use demand::Demand;
pub use full::Full;
pub use list::List;
pub use system::{OutOfMemory, keep_small_blocks_free, require_memory};
pub use table::Table;
