//! Relative pose and velocity of two solids.

use crate::frame::input::motion::Motion;
use pong_geometry::{Transform, Twist};

/// Poses and velocity of two solids, seen from both.
pub(super) struct Relative {
    /// From A's frame to B's, and back.
    pub x_ba: Transform,
    pub x_ab: Transform,
    /// Velocity of A relative to B in B's frame, and of B relative to A in A's frame, as fields of position.
    pub a_in_b: Twist,
    pub b_in_a: Twist,
}

impl Relative {
    pub fn new(motion: &Motion) -> Self {
        let (x_ba, x_ab) = (motion.x_ba, motion.x_ba.inverse());
        let angular = motion.omega_a_b - motion.omega_b_b;
        let linear = motion.linear_b - motion.omega_a_b.cross(&x_ba.translation);
        let a_in_b = Twist { linear, angular };
        let back = |v| -x_ab.vector(&v);
        let b_in_a = Twist { linear: back(a_in_b.at(&x_ba.translation)), angular: back(angular) };
        Self { x_ba, x_ab, a_in_b, b_in_a }
    }
}
