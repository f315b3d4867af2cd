//! Quick rejection of sphere-triangle pairs by a few products, without roots or divisions. Most triangles
//! near a sphere are rejected here.
//!
//! The test has a single branch, at its end, because a processor cannot predict where a sphere lies relative
//! to each of many triangles.

use super::triangle_features::TriangleView;
use crate::Vec3;
use crate::primitive::{Sphere, TriangleSet};

/// Triangle that a sphere may touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct InReach {
    /// Triangle, with a normal that is not normalised yet.
    pub view: TriangleView,
    /// True if the sphere's centre is in front of the triangle by more than rounding.
    pub in_front: bool,
    /// For each edge, true if the centre, projected onto the triangle's plane, is beyond the edge by more
    /// than rounding.
    pub beyond: [bool; 3],
    /// For each edge, true if the projected centre is on the triangle's side of the edge by more than
    /// rounding.
    pub within: [bool; 3],
}

/// Relative margin of the reach: far above the rounding of depths and heights.
pub(super) const REACH_SLACK: f64 = 1e-9;
/// Relative margin of the comparison on which side of an edge a point lies. It is far above rounding,
/// including that of an outward vector computed from the unit normal, and above the sine at which two faces
/// count as convex.
pub(super) const SIDE_SLACK: f64 = 1e-10;

impl InReach {
    /// Returns the triangle if the sphere may touch one of its features, or may be less than `thickness` (m)
    /// behind its plane. `None` if neither is possible even with rounding.
    #[inline(always)]
    pub fn of(sphere: &Sphere, set: &TriangleSet, triangle: u32, thickness: f64) -> Option<Self> {
        let corners = set.corners(triangle);
        let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
        let normal = edges[0].cross(&(corners[2] - corners[0]));
        let arms = corners.map(|corner| sphere.center - corner);
        // Height times the length of the normal.
        let height = normal.dot(&arms[0]);
        let slack = REACH_SLACK * (sphere.radius + taxicab(&arms[0]) + taxicab(&sphere.center));
        let in_front = height > slack * taxicab(&normal);
        let reach = if in_front { sphere.radius } else { sphere.radius.max(thickness) } + slack;
        let (height_square, reach_square) = (height * height, reach * reach * normal.norm_squared());
        let mut near = Self {
            view: TriangleView { index: triangle, corners, normal },
            in_front,
            beyond: [false; 3],
            within: [false; 3],
        };
        let mut is_far = height_square > reach_square;
        for k in 0..3 {
            let (edge, arm) = (&edges[k], &arms[k]);
            // Distance beyond the edge times the lengths of the edge and the normal.
            let beyond = edge.cross(&normal).dot(arm);
            let slack = SIDE_SLACK * taxicab(edge) * taxicab(&normal) * (taxicab(arm) + taxicab(edge));
            (near.beyond[k], near.within[k]) = (beyond > slack, beyond < -slack);
            // If the centre is in front, only the nearest feature can push, up to rounding.
            let edge_square = edge.norm_squared();
            let square = height_square * edge_square + beyond * beyond;
            is_far |= in_front & near.beyond[k] & (square > reach_square * edge_square);
        }
        if is_far { None } else { Some(near) }
    }
}

#[inline(always)]
fn taxicab(v: &Vec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}
