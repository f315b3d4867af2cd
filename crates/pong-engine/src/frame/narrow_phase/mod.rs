//! Pairs of primitives: contacts as contact testers find them.

pub(crate) mod candidate;
mod nearest_side;
mod side_of_entry;
pub(crate) mod testers;
