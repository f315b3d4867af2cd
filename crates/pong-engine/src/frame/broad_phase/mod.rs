//! Broad phase: trees of bounding volumes and boxes give the elements of B that the elements of A may touch.

pub(crate) mod blocks;
pub(crate) mod candidate_pairs;
pub(crate) mod chunk;
pub(crate) mod lone_element;
pub(crate) mod transformed;
