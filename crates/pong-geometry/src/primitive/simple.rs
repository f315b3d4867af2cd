//! Point, plane, line segment and ray.

use super::facts::{Drawing, Primitive, distance_m, ends_and_middle, on_axis};
use crate::bounding::{Bounded, PointCloud};
use crate::{Transform, Vec3};
use std::borrow::Cow;

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
    /// Ends, m. Their numbers, 0 and 1, are part of the keys of the segment's contacts.
    pub ends: [Vec3; 2],
}

/// Direction in which a ray pushes, and how its depth is measured (docs/theory.md, 2.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayResponse {
    /// Depth is measured along the surface normal, and the force acts along the normal.
    Normal,
    /// Depth is the shortening of the plunger, and the force acts along the ray.
    Axial,
}

/// Plunger of a given length that pushes with its tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Point where the plunger is held, m.
    pub origin: Vec3,
    /// Unit direction from the origin to the tip.
    pub direction: Vec3,
    /// Free length, m.
    pub length: f64,
    /// Distance behind the origin at which a surface is still hit, m. `None` takes the default of the
    /// surface: the thickness of a triangle or a bore, otherwise 0.
    pub reach: Option<f64>,
    /// Direction of the force: along the surface normal or along the ray.
    pub response: RayResponse,
}

impl Point {
    /// Returns the point transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { position: x.point(&self.position) }
    }

    /// Returns the lowest and the highest corner of the point's bounding box, m: both are the point itself.
    #[inline]
    pub fn region(&self, _meets_triangles: bool) -> (Vec3, Vec3) {
        (self.position, self.position)
    }
}

impl LineSegment {
    /// Returns the segment transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: [x.point(&self.ends[0]), x.point(&self.ends[1])] }
    }

    /// Returns the lowest and the highest corner of the segment's bounding box, along the axes of the frame,
    /// m.
    #[inline]
    pub fn region(&self, _meets_triangles: bool) -> (Vec3, Vec3) {
        let [a, b] = &self.ends;
        (a.inf(b), a.sup(b))
    }
}

impl Ray {
    /// Returns the ray from one point to another; `None` if they coincide or their distance is not finite.
    ///
    /// The clamp of the length changes no result: it keeps the divisor from zero if a compiler moves the
    /// division before the branch.
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

    /// Returns the free tip, m.
    #[inline]
    pub fn tip(&self) -> Vec3 {
        self.origin + self.direction * self.length
    }

    /// Returns the ray transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { origin: x.point(&self.origin), direction: x.vector(&self.direction), ..*self }
    }

    /// Returns the lowest and the highest corner of the axis-aligned box around everything that the ray can
    /// hit, m. This includes surfaces up to `reach` behind its origin. If `reach` is `None`, the thickness of
    /// the surface takes its place; the bounding volume of the surface includes it, so the box starts at the
    /// origin.
    #[inline]
    pub fn region(&self, _meets_triangles: bool) -> (Vec3, Vec3) {
        let start = self.origin - self.direction * self.reach.unwrap_or(0.0);
        (start.inf(&self.tip()), start.sup(&self.tip()))
    }
}

impl Plane {
    /// Returns the height of a point above the plane, m; positive outside the solid.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}

/// Implements `Bounded` for shapes that are the convex hull of a fixed number of points.
macro_rules! bounded_by_points {
    ($($thing:ty: $points:expr;)*) => {$(
        impl Bounded for $thing {
            fn support(&self, direction: &Vec3) -> f64 {
                PointCloud(&$points(self)).support(direction)
            }

            fn farthest(&self, from: &Vec3) -> f64 {
                PointCloud(&$points(self)).farthest(from)
            }

            fn representatives(&self, out: &mut Vec<Vec3>) {
                out.extend($points(self));
            }
        }
    )*};
}

bounded_by_points! {
    Point: |point: &Point| [point.position];
    LineSegment: |segment: &LineSegment| segment.ends;
    // A ray also hits surfaces up to `reach` behind its origin. If `reach` is `None`, the bounding volume of
    // the surface includes the default instead.
    Ray: |ray: &Ray| [ray.origin - ray.direction * ray.reach.unwrap_or(0.0), ray.tip()];
}

impl Bounded for Plane {
    fn support(&self, _direction: &Vec3) -> f64 {
        f64::INFINITY
    }

    fn farthest(&self, _from: &Vec3) -> f64 {
        f64::INFINITY
    }

    fn representatives(&self, _out: &mut Vec<Vec3>) {}
}

impl Primitive for Point {
    #[inline]
    fn reference_point(&self, _end: u32) -> Cow<'_, Vec3> {
        Cow::Borrowed(&self.position)
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        [Some(self.position), None, None]
    }

    fn core(&self) -> Option<([Vec3; 2], f64)> {
        Some(([self.position; 2], 0.0))
    }

    fn drawing(&self) -> Option<Drawing> {
        Some(Drawing::Point(self.position))
    }
}

impl Primitive for LineSegment {
    #[inline]
    fn reference_point(&self, end: u32) -> Cow<'_, Vec3> {
        on_axis(&self.ends, end)
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        ends_and_middle(&self.ends)
    }

    fn core(&self) -> Option<([Vec3; 2], f64)> {
        Some((self.ends, 0.0))
    }

    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        vec![("the length", distance_m(&self.ends))]
    }

    fn drawing(&self) -> Option<Drawing> {
        Some(Drawing::Segment(self.ends))
    }
}

impl Primitive for Ray {
    #[inline]
    fn reference_point(&self, _end: u32) -> Cow<'_, Vec3> {
        Cow::Owned(self.tip())
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        [Some(self.origin), None, None]
    }

    fn core(&self) -> Option<([Vec3; 2], f64)> {
        Some(([self.origin; 2], 0.0))
    }

    /// Returns the sizes with their names, without a reach of zero.
    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        let reach = self.reach.filter(|reach| *reach > 0.0).map(|reach| ("the reach", reach));
        [("the length", self.length)].into_iter().chain(reach).collect()
    }

    fn drawing(&self) -> Option<Drawing> {
        Some(Drawing::Ray([self.origin, self.tip()]))
    }
}

impl Primitive for Plane {
    fn drawing(&self) -> Option<Drawing> {
        Some(Drawing::Plane { normal: self.normal, offset: self.offset })
    }
}
