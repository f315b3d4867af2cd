//! Shape queries for fitting bounding volumes: primitives, point clouds and other volumes.

use super::volume::{Bounded, Volume};
use crate::Vec3;
use crate::primitive::{
    Bore, Capsule, CustomPrimitive, Ellipsoid, Frustum, LineSegment, Plane, Point, Polyhedron, Ray, Sphere,
};

/// Convex hull of points: a triangle, a mesh, or the vertices of a solid.
#[derive(Clone, Copy, Debug)]
pub struct PointCloud<'a>(pub &'a [Vec3]);

/// Shape dilated by a ball: all points within `reach` metres of it.
///
/// A triangle that pushes whatever is up to `thickness` behind it is bounded as dilated by that thickness.
/// Its prism alone is too small: the origin of a grazing ray that still hits may lie beside the prism.
#[derive(Clone, Copy)]
pub struct Dilated<'a> {
    /// Shape that is dilated.
    pub thing: &'a dyn Bounded,
    /// Radius of the ball, m, not negative.
    pub reach: f64,
}

/// User-defined primitive, bounded by its support function alone.
#[derive(Clone, Copy, Debug)]
pub struct CustomBounds<'a>(pub &'a dyn CustomPrimitive);

impl Bounded for PointCloud<'_> {
    fn support(&self, direction: &Vec3) -> f64 {
        support_of_points(self.0.iter().copied(), direction)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        farthest_of_points(self.0.iter().copied(), from)
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        out.extend_from_slice(self.0);
    }
}

impl Bounded for Polyhedron {
    fn support(&self, direction: &Vec3) -> f64 {
        support_of_points(self.vertices.iter().map(|v| v.position), direction)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        farthest_of_points(self.vertices.iter().map(|v| v.position), from)
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        out.extend(self.vertices.iter().map(|v| v.position));
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
    // A ray also hits surfaces up to `reach` behind its origin. If the triangle defines that distance, the
    // triangle is dilated by it instead.
    Ray: |ray: &Ray| [ray.origin - ray.direction * ray.reach.unwrap_or(0.0), ray.tip()];
}

impl Bounded for Sphere {
    fn support(&self, direction: &Vec3) -> f64 {
        direction.dot(&self.center) + self.radius
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        (self.center - from).norm() + self.radius
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        ball_representatives(&self.center, self.radius, out);
    }
}

impl Bounded for Ellipsoid {
    fn support(&self, direction: &Vec3) -> f64 {
        direction.dot(&self.center) + self.half_width(direction)
    }

    /// Upper bound of the distance from q to the farthest point y of `Σ(yᵢ/aᵢ)² ≤ 1`, both in the principal
    /// frame, by duality: for every λ ≥ max aᵢ², `|y − q|² ≤ λ + Σ qᵢ²·λ/(λ − aᵢ²)`, with equality at the
    /// minimum. So the bound is valid at whichever λ the search stops.
    fn farthest(&self, from: &Vec3) -> f64 {
        const BISECTIONS: usize = 40;
        let q = self.axes.tr_mul(&(from - self.center));
        let largest = self.semi_axes.max();
        if q == Vec3::zeros() {
            return largest;
        }
        let squares = self.semi_axes.component_mul(&self.semi_axes);
        // λ = largest² + excess: this gives λ − aᵢ² without cancellation.
        let below = self.semi_axes.map(|a| (largest - a) * (largest + a));
        let sum = |term: &dyn Fn(usize) -> f64| -> f64 { (0..3).filter(|&i| q[i] != 0.0).map(term).sum() };
        let (mut low, mut high) = (0.0, largest * q.norm());
        for _ in 0..BISECTIONS {
            let excess = 0.5 * (low + high);
            let slope = sum(&|i| squares[i] * (q[i] / (excess + below[i])) * (q[i] / (excess + below[i])));
            *(if slope > 1.0 { &mut low } else { &mut high }) = excess;
        }
        let lambda = largest * largest + high;
        (lambda + sum(&|i| q[i] * (q[i] * lambda / (high + below[i])))).sqrt()
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        for i in 0..3 {
            let arm = self.axes.column(i) * self.semi_axes[i];
            out.extend([self.center + arm, self.center - arm]);
        }
    }
}

impl Bounded for Capsule {
    fn support(&self, direction: &Vec3) -> f64 {
        PointCloud(&self.ends).support(direction) + self.radius
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        PointCloud(&self.ends).farthest(from) + self.radius
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.ends.iter().for_each(|end| ball_representatives(end, self.radius, out));
    }
}

impl Bounded for Frustum {
    fn support(&self, direction: &Vec3) -> f64 {
        Frustum::support(self, direction)
    }

    /// The farthest point lies on one of the end circles, diametrically opposite to `from` seen from the
    /// axis.
    fn farthest(&self, from: &Vec3) -> f64 {
        let of_circle = |end: usize| {
            let arm = from - self.ends[end];
            let along = self.axis.dot(&arm);
            let aside = (arm - self.axis * along).norm() + self.radii[end];
            (along * along + aside * aside).sqrt()
        };
        largest([0, 1].map(of_circle).into_iter())
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        let across = crate::any_perpendicular(&self.axis);
        let other = self.axis.cross(&across);
        for (end, radius) in self.ends.iter().zip(self.radii) {
            out.extend([across, -across, other, -other].map(|arm| end + arm * radius));
        }
    }
}

impl Bore {
    /// Region in which a bore may push: the hole dilated by the thickness. The offset wall alone is too
    /// small: the origin of a grazing ray that still hits may lie beside it, as may a shape that passes
    /// through the wall near a mouth.
    fn pushed(&self) -> Dilated<'_> {
        Dilated { thing: &self.hole, reach: self.thickness }
    }
}

impl Bounded for Bore {
    fn support(&self, direction: &Vec3) -> f64 {
        self.pushed().support(direction)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        self.pushed().farthest(from)
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.hole.representatives(out);
    }
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

impl Bounded for Dilated<'_> {
    fn support(&self, direction: &Vec3) -> f64 {
        self.thing.support(direction) + self.reach
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        self.thing.farthest(from) + self.reach
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.thing.representatives(out);
    }
}

impl Bounded for CustomBounds<'_> {
    fn support(&self, direction: &Vec3) -> f64 {
        self.0.support(direction)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        farthest_by_support(|direction| self.0.support(direction), from)
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        corners_by_support(|direction| self.0.support(direction), out);
    }
}

impl Bounded for Volume {
    fn support(&self, direction: &Vec3) -> f64 {
        match self {
            Self::Unbounded => f64::INFINITY,
            Self::Aabb { center, half } => direction.dot(center) + direction.abs().dot(half),
            Self::Sphere { center, radius } => direction.dot(center) + radius,
            Self::Obb { center, axes, half } => {
                direction.dot(center) + axes.tr_mul(direction).abs().dot(half)
            }
            Self::Custom(custom) => custom.support(direction),
        }
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        match self {
            Self::Unbounded => f64::INFINITY,
            Self::Aabb { center, half } => ((center - from).abs() + half).norm(),
            Self::Sphere { center, radius } => (center - from).norm() + radius,
            Self::Obb { center, axes, half } => (axes.tr_mul(&(center - from)).abs() + half).norm(),
            Self::Custom(custom) => farthest_by_support(|direction| custom.support(direction), from),
        }
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        match self {
            Self::Unbounded => {}
            Self::Aabb { center, half } => out.extend(SIGNS.map(|sign| center + half.component_mul(&sign))),
            Self::Sphere { center, radius } => ball_representatives(center, *radius, out),
            Self::Obb { center, axes, half } => {
                out.extend(SIGNS.map(|sign| center + axes * half.component_mul(&sign)));
            }
            Self::Custom(custom) => corners_by_support(|direction| custom.support(direction), out),
        }
    }
}

/// Corners of a box of half extents 1.
const SIGNS: [Vec3; 8] = [
    Vec3::new(-1.0, -1.0, -1.0),
    Vec3::new(1.0, -1.0, -1.0),
    Vec3::new(-1.0, 1.0, -1.0),
    Vec3::new(1.0, 1.0, -1.0),
    Vec3::new(-1.0, -1.0, 1.0),
    Vec3::new(1.0, -1.0, 1.0),
    Vec3::new(-1.0, 1.0, 1.0),
    Vec3::new(1.0, 1.0, 1.0),
];

/// Maximum of numbers; NaN if one of them is NaN, so that an invalid shape is noticed.
pub(super) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::NEG_INFINITY, |most, value| if value <= most || most.is_nan() { most } else { value })
}

fn support_of_points(points: impl Iterator<Item = Vec3>, direction: &Vec3) -> f64 {
    largest(points.map(|p| direction.dot(&p)))
}

fn farthest_of_points(points: impl Iterator<Item = Vec3>, from: &Vec3) -> f64 {
    largest(points.map(|p| (p - from).norm_squared())).sqrt()
}

fn ball_representatives(center: &Vec3, radius: f64, out: &mut Vec<Vec3>) {
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
        out.extend([center + axis * radius, center - axis * radius]);
    }
}

/// Supports along the positive and along the negative axes of the frame.
fn supports_along_axes(support: impl Fn(&Vec3) -> f64) -> (Vec3, Vec3) {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    (Vec3::from(axes.map(|e| support(&e))), Vec3::from(axes.map(|e| support(&-e))))
}

/// Distance to the farthest corner of the box given by the support function.
fn farthest_by_support(support: impl Fn(&Vec3) -> f64, from: &Vec3) -> f64 {
    let (along, against) = supports_along_axes(support);
    (along - from).sup(&(against + from)).norm()
}

/// Corners of the box given by the support function.
fn corners_by_support(support: impl Fn(&Vec3) -> f64, out: &mut Vec<Vec3>) {
    let (along, against) = supports_along_axes(support);
    let corners =
        SIGNS.map(|sign| sign.zip_zip_map(&along, &against, |s, hi, lo| if s > 0.0 { hi } else { -lo }));
    out.extend(corners);
}

/// Support of the union of all shapes.
pub(super) fn support(things: &[&dyn Bounded], direction: &Vec3) -> f64 {
    largest(things.iter().map(|thing| thing.support(direction)))
}

/// Representative points of all shapes.
pub(super) fn representatives(things: &[&dyn Bounded]) -> Vec<Vec3> {
    let mut points = Vec::new();
    for thing in things {
        thing.representatives(&mut points);
    }
    points
}
