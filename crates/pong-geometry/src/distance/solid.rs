//! Convex solids for the distance search. The search needs only their support points.

use crate::primitive::{Capsule, Ellipsoid, Frustum, LineSegment, Point, Polyhedron, Ray, Sphere};
use crate::{Transform, Vec3};

/// Convex solid: all points within a margin of a core. A sphere is a point with a margin, and a capsule is a
/// segment with a margin, so their distances are exact.
#[derive(Clone, Copy, Debug)]
pub struct Solid<'a> {
    core: Core<'a>,
    margin: f64,
}

#[derive(Clone, Copy, Debug)]
enum Core<'a> {
    Point(Vec3),
    Segment([Vec3; 2]),
    Triangle([Vec3; 3]),
    Ellipsoid(Ellipsoid),
    Frustum(Frustum),
    /// Polyhedron in its own frame, with the pose of that frame.
    Polyhedron(&'a Polyhedron, Transform),
    /// Points in their own frame, with a map from that frame.
    Hull(&'a [Vec3], Transform),
}

impl<'a> Solid<'a> {
    fn new(core: Core<'a>, margin: f64) -> Self {
        Self { core, margin }
    }

    /// Creates a solid without extent from a point.
    pub fn point(point: &Point) -> Self {
        Self::new(Core::Point(point.position), 0.0)
    }

    /// Creates a solid without thickness from a line segment.
    pub fn segment(segment: &LineSegment) -> Self {
        Self::new(Core::Segment(segment.ends), 0.0)
    }

    /// Creates a solid without thickness from a ray: the segment of the ray's free length.
    pub fn ray(ray: &Ray) -> Self {
        Self::new(Core::Segment([ray.origin, ray.tip()]), 0.0)
    }

    /// Creates a solid without thickness from a triangle's corners, m.
    pub fn triangle(corners: [Vec3; 3]) -> Self {
        Self::new(Core::Triangle(corners), 0.0)
    }

    /// Creates the solid of a sphere.
    pub fn sphere(sphere: &Sphere) -> Self {
        Self::new(Core::Point(sphere.center), sphere.radius)
    }

    /// Creates the solid of a capsule.
    pub fn capsule(capsule: &Capsule) -> Self {
        Self::new(Core::Segment(capsule.ends), capsule.radius)
    }

    /// Creates the solid of an ellipsoid.
    pub fn ellipsoid(ellipsoid: &Ellipsoid) -> Self {
        Self::new(Core::Ellipsoid(*ellipsoid), 0.0)
    }

    /// Creates the solid of a cylinder or a cone.
    pub fn frustum(frustum: &Frustum) -> Self {
        Self::new(Core::Frustum(*frustum), 0.0)
    }

    /// Creates the solid of a polyhedron, the hull of its vertices. `x` transforms from the polyhedron's
    /// frame.
    pub fn polyhedron(polyhedron: &'a Polyhedron, x: &Transform) -> Self {
        Self::new(Core::Polyhedron(polyhedron, *x), 0.0)
    }

    /// Creates the convex hull of points, m. `x` maps their frame to that of the search; it may be any affine map.
    pub fn hull(points: &'a [Vec3], x: &Transform) -> Self {
        Self::new(Core::Hull(points, *x), 0.0)
    }

    /// Returns the distance around the core that still belongs to the solid, m.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Returns the point of the core that is farthest along a unit direction, m.
    pub fn core_support(&self, direction: &Vec3) -> Vec3 {
        match &self.core {
            Core::Point(point) => *point,
            Core::Segment(ends) => farthest(ends.iter().copied(), direction),
            Core::Triangle(corners) => farthest(corners.iter().copied(), direction),
            Core::Ellipsoid(ellipsoid) => ellipsoid.support(direction),
            Core::Frustum(frustum) => frustum.support_point(direction),
            Core::Polyhedron(polyhedron, x) => {
                let within = x.rotation.tr_mul(direction);
                let vertices = polyhedron.vertices.iter().map(|vertex| vertex.position);
                x.point(&farthest(vertices, &within))
            }
            Core::Hull(points, x) => {
                x.point(&farthest(points.iter().copied(), &x.rotation.tr_mul(direction)))
            }
        }
    }

    /// Returns the point of the core, m, from which the search starts.
    pub fn member(&self) -> Vec3 {
        match &self.core {
            Core::Point(point) => *point,
            Core::Segment([first, _]) | Core::Triangle([first, ..]) => *first,
            Core::Ellipsoid(ellipsoid) => ellipsoid.center,
            Core::Frustum(frustum) => frustum.ends[0],
            Core::Polyhedron(polyhedron, x) => {
                x.point(&polyhedron.vertices.first().map_or(Vec3::zeros(), |vertex| vertex.position))
            }
            Core::Hull(points, x) => x.point(points.first().unwrap_or(&Vec3::zeros())),
        }
    }

    /// Returns centre and radius of a ball around the solid, m. It is not the smallest one.
    pub fn ball(&self) -> (Vec3, f64) {
        let around = |points: &[Vec3]| {
            let center = points.iter().sum::<Vec3>() / points.len() as f64;
            (center, points.iter().map(|point| (point - center).norm()).fold(0.0, f64::max))
        };
        let (center, radius) = match &self.core {
            Core::Point(point) => (*point, 0.0),
            Core::Segment(ends) => around(ends),
            Core::Triangle(corners) => around(corners),
            Core::Ellipsoid(ellipsoid) => (ellipsoid.center, ellipsoid.semi_axes.max()),
            Core::Frustum(frustum) => {
                let (center, half) = around(&frustum.ends);
                (center, half + frustum.radii[0].max(frustum.radii[1]))
            }
            // All of a polyhedron is within its diameter of any vertex.
            Core::Polyhedron(polyhedron, _) => (self.member(), polyhedron.diameter),
            Core::Hull(points, x) => {
                let center = self.member();
                let radius = points.iter().map(|point| (x.point(point) - center).norm()).fold(0.0, f64::max);
                (center, radius)
            }
        };
        (center, radius + self.margin)
    }
}

/// Returns the point that is farthest along a direction; the first of several.
fn farthest(points: impl Iterator<Item = Vec3>, direction: &Vec3) -> Vec3 {
    let mut best = (f64::NEG_INFINITY, Vec3::zeros());
    for point in points {
        let along = point.dot(direction);
        if along > best.0 {
            best = (along, point);
        }
    }
    best.1
}

impl Frustum {
    /// Returns the point of the solid that is farthest along a unit direction, m.
    pub fn support_point(&self, direction: &Vec3) -> Vec3 {
        let radial = direction - self.axis * direction.dot(&self.axis);
        let aside = radial.norm();
        let outward = radial / aside.max(f64::MIN_POSITIVE);
        // Orthogonalised once more, because for a direction near the axis the first difference is mostly
        // rounding. For a direction along the axis it is rounding alone; then the centre of the end circle is
        // a support point.
        let outward = outward - self.axis * outward.dot(&self.axis);
        let length = outward.norm();
        let outward = if length > 0.5 { outward / length.max(0.5) } else { Vec3::zeros() };
        let at = |end: usize| direction.dot(&self.ends[end]) + self.radii[end] * aside;
        let end = if at(1) > at(0) { 1 } else { 0 };
        self.ends[end] + outward * self.radii[end]
    }
}
