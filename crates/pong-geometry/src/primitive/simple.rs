//! Point, plane, line segment and ray.

use crate::{Transform, Vec3};

/// A point: a vertex without extent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Place in the movable group's frame, m.
    pub position: Vec3,
}

/// A half space: the solid is `normal · x ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit outward normal.
    pub normal: Vec3,
    /// Distance of the plane from the group's origin along the normal, m.
    pub offset: f64,
}

/// A straight segment between two distinct points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSegment {
    /// The ends, m. End 0 and end 1 are the state keys of its contacts.
    pub ends: [Vec3; 2],
}

/// How a ray answers to what it hits (docs/theory.md, 2.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayResponse {
    /// Depth is measured along the surface's normal and the force acts along it.
    Normal,
    /// Depth is the shortening of the plunger and the force acts along the ray.
    Axial,
}

/// A plunger of stated length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where the plunger is held, m.
    pub origin: Vec3,
    /// Unit direction from the origin to the tip.
    pub direction: Vec3,
    /// Free length, m.
    pub length: f64,
    /// How far behind the origin a surface may lie and still be hit, m; `None` takes the default of what is hit
    /// (0, or the thickness of a triangle or a bore).
    pub reach: Option<f64>,
    /// Which way the force acts.
    pub response: RayResponse,
}

impl Point {
    /// The same point in another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { position: x.point(&self.position) }
    }
}

impl LineSegment {
    /// The same segment in another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: [x.point(&self.ends[0]), x.point(&self.ends[1])] }
    }
}

impl Ray {
    /// From one place to another; `None` if they are one, or farther apart than numbers reach.
    ///
    /// The length is cut to what can be divided by, though no more and no less comes here: a compiler may divide before the
    /// branch, and before a loop around it.
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

    /// The free tip, m.
    #[inline]
    pub fn tip(&self) -> Vec3 {
        self.origin + self.direction * self.length
    }

    /// The same ray in another frame.
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
