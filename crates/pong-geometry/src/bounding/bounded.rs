//! Queries on shapes that the fitting of bounding volumes needs: for point clouds, dilated shapes, custom
//! primitives and other volumes.

use super::volume::{Bounded, Volume};
use crate::Vec3;
use crate::primitive::CustomPrimitive;

/// Convex hull of points: a triangle, a mesh, or the vertices of a solid.
#[derive(Clone, Copy, Debug)]
pub struct PointCloud<'a>(pub &'a [Vec3]);

/// Shape dilated by a ball: all points within `reach` metres of it.
///
/// A triangle is dilated by its thickness, the distance behind it within which it pushes. The prism of that
/// thickness would be too small, because the origin of a ray that grazes the triangle may lie beside the
/// prism.
#[derive(Clone, Copy)]
pub struct Dilated<'a> {
    /// Shape that is dilated.
    pub thing: &'a dyn Bounded,
    /// Radius of the ball, m, not negative.
    pub reach: f64,
}

/// User-defined primitive, whose support function alone is used to bound it.
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

/// Signs of the corners of a box, seen from its centre.
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

/// Returns the maximum of numbers; NaN if one of them is NaN, so that an invalid shape is noticed.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::NEG_INFINITY, |most, value| if value <= most || most.is_nan() { most } else { value })
}

/// Returns the maximum of `direction · x` over points, m.
pub(crate) fn support_of_points(points: impl Iterator<Item = Vec3>, direction: &Vec3) -> f64 {
    largest(points.map(|p| direction.dot(&p)))
}

/// Returns the distance from `from` to the farthest of the points, m.
pub(crate) fn farthest_of_points(points: impl Iterator<Item = Vec3>, from: &Vec3) -> f64 {
    largest(points.map(|p| (p - from).norm_squared())).sqrt()
}

/// Appends the points of a sphere that are farthest along the axes of the frame, in both directions.
pub(crate) fn ball_representatives(center: &Vec3, radius: f64, out: &mut Vec<Vec3>) {
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
        out.extend([center + axis * radius, center - axis * radius]);
    }
}

/// Returns the supports along the positive axes of the frame, and along the negative axes.
fn supports_along_axes(support: impl Fn(&Vec3) -> f64) -> (Vec3, Vec3) {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    (Vec3::from(axes.map(|e| support(&e))), Vec3::from(axes.map(|e| support(&-e))))
}

/// Returns the distance from `from` to the farthest corner of the axis-aligned box around a shape, given the
/// shape's support function.
fn farthest_by_support(support: impl Fn(&Vec3) -> f64, from: &Vec3) -> f64 {
    let (along, against) = supports_along_axes(support);
    (along - from).sup(&(against + from)).norm()
}

/// Appends the corners of the axis-aligned box around a shape, given the shape's support function.
fn corners_by_support(support: impl Fn(&Vec3) -> f64, out: &mut Vec<Vec3>) {
    let (along, against) = supports_along_axes(support);
    let corners =
        SIGNS.map(|sign| sign.zip_zip_map(&along, &against, |s, hi, lo| if s > 0.0 { hi } else { -lo }));
    out.extend(corners);
}

/// Returns the maximum of `direction · x` over all shapes, m.
pub(super) fn support(things: &[&dyn Bounded], direction: &Vec3) -> f64 {
    largest(things.iter().map(|thing| thing.support(direction)))
}

/// Returns the representative points of all shapes.
pub(super) fn representatives(things: &[&dyn Bounded]) -> Vec<Vec3> {
    let mut points = Vec::new();
    for thing in things {
        thing.representatives(&mut points);
    }
    points
}
