//! The straight line of a place of A since the last commit, and what it did to something of B.

use pong_geometry::Vec3;

/// A place of an element of A and its line since the last commit, in B's frame, m.
pub(super) struct Line {
    pub from_b: Vec3,
    pub to_b: Vec3,
}

/// What a line did to one shell of B.
pub(super) enum Met {
    /// Into it and out again, or through it, coming in by a side with this normal.
    Through(Vec3),
    /// Into it, where it still is.
    Into(Vec3),
}
