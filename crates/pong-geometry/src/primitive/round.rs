//! Round parts: capsule, cylinder, cone and bore (docs/theory.md, 2.8).

use crate::{Transform, Vec3};

/// All points within a radius of a straight segment: a cylinder with a hemisphere at each end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Centres of the two hemispheres, m; distinct. End 0 and end 1 are the state keys of their contacts.
    pub ends: [Vec3; 2],
    /// Radius, m, positive.
    pub radius: f64,
}

/// Straight frustum of a cone: the solid of a cylinder (equal radii) or of a cone, or the hole of a bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Centres of the two end circles, m.
    pub ends: [Vec3; 2],
    /// Radius at each end, m; not negative, and not both zero.
    pub radii: [f64; 2],
    /// Unit vector from end 0 to end 1.
    pub axis: Vec3,
    /// Distance between the ends, m. Zero for a disc.
    pub length: f64,
    /// Outward unit normal of the lateral surface in a plane through the axis: axial component, then radial
    /// component (positive).
    pub wall: [f64; 2],
}

/// Inner wall of a round or tapered hole, open at both ends. It pushes towards its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    /// The hole.
    pub hole: Frustum,
    /// Distance behind the wall within which a shape is still pushed back into the hole, m.
    pub thickness: f64,
    /// For each end, true if the hole ends there in a convex edge (mouth) that pushes shapes leaning on it;
    /// false if the hole continues as another bore.
    pub mouths: [bool; 2],
}

impl Bore {
    /// Returns `true` if a signed distance `inside` of one end (any unit) is past that end. At the seam of
    /// two bores in line, a point exactly on the seam belongs to the second bore only.
    #[inline]
    pub(crate) fn is_past(&self, end: usize, inside: f64) -> bool {
        inside < 0.0 || (inside == 0.0 && end == 1 && !self.mouths[end])
    }
}

impl Capsule {
    /// Capsule transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: self.ends.map(|end| x.point(&end)), radius: self.radius }
    }
}

impl Frustum {
    /// Frustum between two distinct points, m, with a radius at each, m, not negative and not both zero.
    pub fn new(ends: [Vec3; 2], radii: [f64; 2]) -> Self {
        let between = ends[1] - ends[0];
        let length = between.norm();
        let widening = radii[1] - radii[0];
        let slant = (length * length + widening * widening).sqrt();
        let wall = [-widening / slant, length / slant];
        Self { ends, radii, axis: between / length, length, wall }
    }

    /// One of the two end circles as a solid disc without thickness.
    pub fn disc(&self, end: usize) -> Self {
        Self {
            ends: [self.ends[end]; 2],
            radii: [self.radii[end]; 2],
            axis: self.axis,
            length: 0.0,
            wall: [0.0, 1.0],
        }
    }

    /// Frustum transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: self.ends.map(|end| x.point(&end)), axis: x.vector(&self.axis), ..*self }
    }

    /// Maximum of `direction · x` over the solid, m, for a unit direction.
    #[inline]
    pub fn support(&self, direction: &Vec3) -> f64 {
        let aside = direction.cross(&self.axis).norm();
        let at = |end: usize| direction.dot(&self.ends[end]) + self.radii[end] * aside;
        at(0).max(at(1))
    }
}
