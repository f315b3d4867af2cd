//! Half spaces.

use crate::Vec3;

/// Half space: `normal_b · x ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Unit outward normal.
    pub normal_b: Vec3,
    /// Distance of the plane from the frame's origin along the normal, m.
    pub offset: f64,
}

impl HalfSpace {
    /// Returns the depth of a point below the plane, m; negative outside.
    #[inline]
    pub fn depth(&self, x: &Vec3) -> f64 {
        self.offset - self.normal_b.dot(x)
    }

    /// Returns the half space on the other side of the plane.
    pub fn opposite(&self) -> Self {
        Self { normal_b: -self.normal_b, offset: -self.offset }
    }
}
