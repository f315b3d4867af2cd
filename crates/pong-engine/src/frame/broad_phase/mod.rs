//! Broad phase: trees of bounding volumes and boxes give the elements of B that the elements of A may touch.

pub(crate) mod blocks;
pub(crate) mod chunk;
pub(crate) mod element_search;
pub(crate) mod group_search;
pub(crate) mod transformed;
pub(crate) mod traversal;
