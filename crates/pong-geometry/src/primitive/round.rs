//! Round parts: capsule, cylinder, cone and bore (docs/theory.md, 2.8).

use crate::{Transform, Vec3};

/// Everything within a radius of a straight segment: a cylinder with half a ball at each end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Centres of the two balls, m; distinct. End 0 and end 1 are the state keys of their contacts.
    pub ends: [Vec3; 2],
    /// Radius, m, positive.
    pub radius: f64,
}

/// A straight frustum of a cone: the solid of a cylinder (equal radii) and of a cone, and the hole of a bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Centres of the two circles in which it ends, m.
    pub ends: [Vec3; 2],
    /// Radius at each end, m; not negative, and not both zero.
    pub radii: [f64; 2],
    /// Unit vector from end 0 to end 1.
    pub axis: Vec3,
    /// Distance of the ends, m. Zero for a disc.
    pub length: f64,
    /// Unit outward normal of the wall, in a plane through the axis: its part along the axis, and its part away from it (positive).
    pub wall: [f64; 2],
}

/// The inner wall of a round or tapered hole, open at both ends. It pushes towards its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    /// The hole.
    pub hole: Frustum,
    /// How far behind the wall something is still pushed back into the hole, m.
    pub thickness: f64,
    /// Of each end, whether the hole ends there in a convex edge that pushes what leans on it. Where the hole goes on as another
    /// bore it does not.
    pub mouths: [bool; 2],
}

impl Bore {
    /// Whether what is so far inside of one end is past it, in any unit. Where two bores meet that run the same way, what is in
    /// the seam belongs to the second alone.
    #[inline]
    pub(crate) fn is_past(&self, end: usize, inside: f64) -> bool {
        inside < 0.0 || (inside == 0.0 && end == 1 && !self.mouths[end])
    }
}

impl Capsule {
    /// The same capsule in another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: self.ends.map(|end| x.point(&end)), radius: self.radius }
    }
}

impl Frustum {
    /// Between two distinct places, m, with a radius at each, m, not negative and not both zero.
    pub fn new(ends: [Vec3; 2], radii: [f64; 2]) -> Self {
        let between = ends[1] - ends[0];
        let length = between.norm();
        let widening = radii[1] - radii[0];
        let slant = (length * length + widening * widening).sqrt();
        let wall = [-widening / slant, length / slant];
        Self { ends, radii, axis: between / length, length, wall }
    }

    /// One of the two circles in which it ends, as a solid without thickness.
    pub fn disc(&self, end: usize) -> Self {
        Self {
            ends: [self.ends[end]; 2],
            radii: [self.radii[end]; 2],
            axis: self.axis,
            length: 0.0,
            wall: [0.0, 1.0],
        }
    }

    /// The same frustum in another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: self.ends.map(|end| x.point(&end)), axis: x.vector(&self.axis), ..*self }
    }

    /// Largest `direction · x` over the solid, m, of a unit direction.
    #[inline]
    pub fn support(&self, direction: &Vec3) -> f64 {
        let aside = direction.cross(&self.axis).norm();
        let at = |end: usize| direction.dot(&self.ends[end]) + self.radii[end] * aside;
        at(0).max(at(1))
    }
}
