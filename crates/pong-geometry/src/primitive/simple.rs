//! Point, plane, line segment and ray.

use crate::{Transform, Vec3};

/// Point: a vertex without extent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Position in the group frame, m.
    pub position: Vec3,
}

/// Half space: the solid is `normal · x ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit outward normal.
    pub normal: Vec3,
    /// Distance of the plane from the group's origin along the normal, m.
    pub offset: f64,
}

/// Straight segment between two distinct points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSegment {
    /// The ends, m. End 0 and end 1 are the state keys of its contacts.
    pub ends: [Vec3; 2],
}

/// Response of a ray to the surface it hits (docs/theory.md, 2.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayResponse {
    /// Depth is measured along the surface normal, and the force acts along the normal.
    Normal,
    /// Depth is the shortening of the plunger, and the force acts along the ray.
    Axial,
}

/// Plunger of given length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Point where the plunger is held, m.
    pub origin: Vec3,
    /// Unit direction from the origin to the tip.
    pub direction: Vec3,
    /// Free length, m.
    pub length: f64,
    /// Distance behind the origin at which a surface is still hit, m; `None` takes the default of the surface
    /// (0, or the thickness of a triangle or a bore).
    pub reach: Option<f64>,
    /// Direction of the force: along the surface normal or along the ray.
    pub response: RayResponse,
}

impl Point {
    /// Point transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { position: x.point(&self.position) }
    }
}

impl LineSegment {
    /// Segment transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: [x.point(&self.ends[0]), x.point(&self.ends[1])] }
    }
}

impl Ray {
    /// Ray from one point to another; `None` if they coincide or their distance is not finite.
    ///
    /// The clamp of the length has no effect on the result: a compiler may move the division before the
    /// branch, where the length may be zero.
    #[inline]
    pub fn between(from: &Vec3, to: &Vec3) -> Option<Self> {
        let path = to - from;
        let length = path.norm();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let direction = path / length.clamp(f64::MIN_POSITIVE, f64::MAX);
        Some(Self { origin: *from, direction, length, reach: None, response: RayResponse::Normal })
    }

    /// Free tip, m.
    #[inline]
    pub fn tip(&self) -> Vec3 {
        self.origin + self.direction * self.length
    }

    /// Ray transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { origin: x.point(&self.origin), direction: x.vector(&self.direction), ..*self }
    }
}

impl Plane {
    /// Signed distance of a point above the plane (positive outside the solid), m.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}
