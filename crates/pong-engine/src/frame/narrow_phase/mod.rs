//! Narrow phase: pairs of primitives give contact candidates.

pub(crate) mod candidate;
pub(crate) mod element_pair;
mod nearest_side;
mod on_triangle;
pub(crate) mod pair_table;
mod registered;
mod side_of_bore;
mod side_of_entry;
pub(crate) mod single_element;
pub(crate) mod testers;
