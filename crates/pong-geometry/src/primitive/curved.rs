//! Sphere and ellipsoid.

use crate::{Mat3, Transform, Vec3};

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, m.
    pub center: Vec3,
    /// Radius, m, positive.
    pub radius: f64,
}

/// An ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Centre, m.
    pub center: Vec3,
    /// Columns are the principal axes.
    pub axes: Mat3,
    /// Semi-axis along each column of `axes`, m, positive, in any order.
    pub semi_axes: Vec3,
}

impl Sphere {
    /// The same sphere in another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { center: x.point(&self.center), radius: self.radius }
    }
}

impl Ellipsoid {
    /// The same ellipsoid in another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { center: x.point(&self.center), axes: x.rotation * self.axes, semi_axes: self.semi_axes }
    }

    /// Half the width along a unit direction, `√Σ(aᵢ nᵢ)²`, m.
    #[inline]
    pub fn half_width(&self, direction: &Vec3) -> f64 {
        self.axes.tr_mul(direction).component_mul(&self.semi_axes).norm()
    }

    /// The surface point farthest along a unit direction, m.
    #[inline]
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let scaled = self.axes.tr_mul(direction).component_mul(&self.semi_axes);
        let half_width = scaled.norm();
        self.center + self.axes * scaled.component_mul(&self.semi_axes) / half_width
    }

    /// How far from its centre a triangle may lie that pushes it, beside those that it overlaps, m.
    ///
    /// A face pushes where it holds the foot of the deepest point: the point straight above, in the plane of the face. Of a
    /// slender ellipsoid that lies askew, most of the way up is outside of it. With the centre in the plane the foot is as far
    /// from the centre as the deepest point is aside, at most the difference of the largest and the smallest semi-axis. With
    /// the centre behind, it is farther up by no more than the thickness; the default one is the smallest semi-axis, and for
    /// any other the volume of the triangle has room.
    pub fn reach_of_feet(&self) -> f64 {
        let (smallest, largest) = (self.semi_axes.min(), self.semi_axes.max());
        ((largest - smallest) * (largest - smallest) + smallest * smallest).sqrt()
    }

    /// The smallest semi-axis, m.
    pub fn smallest_semi_axis(&self) -> f64 {
        self.semi_axes.min()
    }
}
