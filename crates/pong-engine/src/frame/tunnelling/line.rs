//! Straight path of a point of A since the last commit, and its outcome for an element of B.

use pong_geometry::Vec3;

/// Path of a point of an element of A since the last commit, in B's frame, m.
pub(super) struct Line {
    pub from_b: Vec3,
    pub to_b: Vec3,
}

/// Outcome of a path for one shell of B, with the normal of the side through which the path enters.
pub(super) enum Met {
    /// The path enters and leaves the solid, or passes through the sheet.
    Through(Vec3),
    /// The path enters the solid and ends there.
    Into(Vec3),
}
