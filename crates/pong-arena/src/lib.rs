#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod arena;
mod full;
mod list;
mod table;

pub use arena::Arena;
pub use full::Full;
pub use list::List;
pub use table::Table;
