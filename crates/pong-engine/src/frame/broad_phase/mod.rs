//! Which elements of B the elements of A may touch, by trees of bounding volumes and boxes.

pub(crate) mod blocks;
pub(crate) mod candidate_pairs;
pub(crate) mod chunk;
pub(crate) mod lone_element;
pub(crate) mod transformed;
