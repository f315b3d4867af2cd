//! What a few products without a root or a division say of a ball and a triangle: most triangles near a ball end here.
//!
//! There is one branch at the end: where a ball lies among triangles follows no pattern.

use super::triangle_features::TriangleView;
use crate::Vec3;
use crate::primitive::{Sphere, TriangleSet};

/// A triangle that a ball may touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct InReach {
    /// The triangle, its normal not yet of unit length.
    pub view: TriangleView,
    /// Whether the ball's centre is certainly in front.
    pub in_front: bool,
    /// Of each edge, whether the centre certainly lies beyond it, seen across the triangle.
    pub beyond: [bool; 3],
    /// Of each edge, whether the centre certainly does not.
    pub within: [bool; 3],
}

/// Slack of what is called out of reach: far beyond rounding of depths and heights.
pub(super) const REACH_SLACK: f64 = 1e-9;
/// Slack of a side as a share of what is summed: far beyond rounding, of an outward vector from the unit normal too, and
/// beyond what counts as flat between two faces.
pub(super) const SIDE_SLACK: f64 = 1e-10;

impl InReach {
    /// `None` if the ball certainly touches no feature of the triangle, nor lies within `thickness` (m) behind its plane.
    #[inline(always)]
    pub fn of(sphere: &Sphere, set: &TriangleSet, triangle: u32, thickness: f64) -> Option<Self> {
        let corners = set.corners(triangle);
        let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
        let normal = edges[0].cross(&(corners[2] - corners[0]));
        let arms = corners.map(|corner| sphere.center - corner);
        // Height times length of the normal.
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
            // Distance beyond the edge times lengths of the edge and the normal.
            let beyond = edge.cross(&normal).dot(arm);
            let slack = SIDE_SLACK * taxicab(edge) * taxicab(&normal) * (taxicab(arm) + taxicab(edge));
            (near.beyond[k], near.within[k]) = (beyond > slack, beyond < -slack);
            // In front only what is nearest pushes, but for rounding.
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
