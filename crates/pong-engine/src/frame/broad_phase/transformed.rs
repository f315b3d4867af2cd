//! Primitives of A, transformed into B's frame.

use pong_geometry::primitive::{Capsule, Ellipsoid, Frustum, LineSegment, Point, PrimitiveKind, Ray, Sphere};
use pong_geometry::{Transform, Vec3};
use pong_model::MovableGroup;

/// A primitive of A in B's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum TransformedPrimitive {
    Point(Point),
    Segment(LineSegment),
    Ray(Ray),
    Sphere(Sphere),
    Ellipsoid(Ellipsoid),
    Capsule(Capsule),
    /// A cylinder or a cone.
    Frustum(Frustum),
}

impl TransformedPrimitive {
    /// Placeholder to fill memory.
    pub const NOTHING: Self = Self::Point(Point { position: Vec3::new(0.0, 0.0, 0.0) });

    /// Transforms an element; `None` for kinds that are never A in the tester table.
    #[inline(always)]
    pub fn new(body: &MovableGroup, kind: PrimitiveKind, element: u32, x_ba: &Transform) -> Option<Self> {
        let i = element as usize;
        Some(match kind {
            PrimitiveKind::Point => Self::Point(body.points[i].carried(x_ba)),
            PrimitiveKind::LineSegment => Self::Segment(body.segments[i].carried(x_ba)),
            PrimitiveKind::Ray => Self::Ray(body.rays[i].carried(x_ba)),
            PrimitiveKind::Sphere => Self::Sphere(body.spheres[i].carried(x_ba)),
            PrimitiveKind::Ellipsoid => Self::Ellipsoid(body.ellipsoids[i].carried(x_ba)),
            PrimitiveKind::Capsule => Self::Capsule(body.capsules[i].carried(x_ba)),
            PrimitiveKind::Cylinder | PrimitiveKind::Cone => Self::Frustum(body.frusta[i].carried(x_ba)),
            PrimitiveKind::Triangle
            | PrimitiveKind::Polyhedron
            | PrimitiveKind::Plane
            | PrimitiveKind::Bore
            | PrimitiveKind::Custom => return None,
        })
    }

    /// Least and greatest coordinates of the region of contact, m. Triangles may push an ellipsoid at foot
    /// points outside its own box.
    pub fn bounds(&self, meets_triangles: bool) -> (Vec3, Vec3) {
        let around = |center: &Vec3, half: Vec3| (center - half, center + half);
        match self {
            Self::Point(point) => (point.position, point.position),
            Self::Segment(LineSegment { ends: [a, b] }) => (a.inf(b), a.sup(b)),
            Self::Ray(ray) => {
                // A ray also hits surfaces up to its reach behind its origin. A reach left to the triangle is
                // part of the triangle's box.
                let start = ray.origin - ray.direction * ray.reach.unwrap_or(0.0);
                (start.inf(&ray.tip()), start.sup(&ray.tip()))
            }
            Self::Sphere(sphere) => around(&sphere.center, Vec3::repeat(sphere.radius)),
            Self::Ellipsoid(ellipsoid) => around(&ellipsoid.center, half_sizes(ellipsoid, meets_triangles)),
            Self::Capsule(Capsule { ends: [a, b], radius }) => {
                (a.inf(b).add_scalar(-radius), a.sup(b).add_scalar(*radius))
            }
            Self::Frustum(frustum) => box_of_frustum(frustum),
        }
    }
}

/// Least and greatest coordinates of a frustum, m. Not inlined, as for the ellipsoid.
#[inline(never)]
fn box_of_frustum(frustum: &Frustum) -> (Vec3, Vec3) {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let along = |sign: f64| Vec3::from(axes.map(|axis| sign * frustum.support(&(axis * sign))));
    (along(-1.0), along(1.0))
}

/// Half widths of the box of an ellipsoid, m. Not inlined, so that the cheaper kinds do not pay for its stack
/// frame.
#[inline(never)]
fn half_sizes(ellipsoid: &Ellipsoid, meets_triangles: bool) -> Vec3 {
    let least = if meets_triangles { ellipsoid.reach_of_feet() } else { 0.0 };
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    Vec3::from(axes.map(|axis| ellipsoid.half_width(&axis).max(least)))
}
