//! Displacement of A between two commits, and the work of a force over it.

use crate::frame::input::motion::SinceCommit;
use pong_geometry::{Transform, Vec3};

/// Displacement of A since the last commit at a point fixed in A. Positions are in B's frame, m.
pub(crate) struct Displacement {
    before_b: Vec3,
    now_b: Vec3,
    /// Rotation vector, rad.
    pub rotation_b: Vec3,
    /// Origin of A's frame, at the last commit and now.
    pub origin_before_b: Vec3,
    pub origin_now_b: Vec3,
}

impl Displacement {
    /// Displacement at a point given in A's frame.
    pub fn new(since: &SinceCommit, x_ba: &Transform, reference: &Vec3) -> Self {
        Self {
            before_b: since.x_ba.point(reference),
            now_b: x_ba.point(reference),
            rotation_b: since.rotation(),
            origin_before_b: since.x_ba.translation,
            origin_now_b: x_ba.translation,
        }
    }

    /// Half of the trapezoidal work of a force at `point` over the displacement, J: the half of now if
    /// `at_end`, otherwise that of the last commit.
    pub fn half_work(&self, point: &Vec3, force: &Vec3, at_end: bool) -> f64 {
        let arm = point - if at_end { self.now_b } else { self.before_b };
        0.5 * (force.dot(&(self.now_b - self.before_b)) + arm.cross(force).dot(&self.rotation_b))
    }
}
