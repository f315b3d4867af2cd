//! Line segment (A) – plane (B): each end is a point that carries half the stiffness and damping.

use super::Interference;
use super::point_plane::point_plane;
use crate::primitive::{LineSegment, Plane, Point};

/// Returns the contact of each end, in the order of the ends.
pub fn line_segment_plane(segment: &LineSegment, plane: &Plane) -> [Option<Interference>; 2] {
    segment.ends.map(|position| point_plane(&Point { position }, plane))
}
