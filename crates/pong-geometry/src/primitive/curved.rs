//! Sphere and ellipsoid.

use crate::{Mat3, Transform, Vec3};

/// Sphere (solid).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, m.
    pub center: Vec3,
    /// Radius, m, positive.
    pub radius: f64,
}

/// Ellipsoid (solid).
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
    /// Sphere transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { center: x.point(&self.center), radius: self.radius }
    }
}

impl Ellipsoid {
    /// Ellipsoid transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { center: x.point(&self.center), axes: x.rotation * self.axes, semi_axes: self.semi_axes }
    }

    /// Half the width along a unit direction, `√Σ(aᵢ nᵢ)²`, m.
    #[inline]
    pub fn half_width(&self, direction: &Vec3) -> f64 {
        self.axes.tr_mul(direction).component_mul(&self.semi_axes).norm()
    }

    /// Surface point farthest along a unit direction, m.
    #[inline]
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let scaled = self.axes.tr_mul(direction).component_mul(&self.semi_axes);
        let half_width = scaled.norm();
        self.center + self.axes * scaled.component_mul(&self.semi_axes) / half_width
    }

    /// Distance from the centre within which a triangle may push the ellipsoid without overlapping it, m.
    ///
    /// A face pushes if it contains the foot point: the projection of the deepest point onto its plane. For a
    /// slender, oblique ellipsoid most of that projection line is outside the ellipsoid. With the centre in
    /// the plane, the foot point is as far from the centre as the deepest point is lateral, at most the
    /// difference of the largest and smallest semi-axes. With the centre behind the plane, the thickness adds
    /// to it. The default thickness is the smallest semi-axis; a larger one is covered by the volume of the
    /// triangle.
    pub fn reach_of_feet(&self) -> f64 {
        let (smallest, largest) = (self.semi_axes.min(), self.semi_axes.max());
        ((largest - smallest) * (largest - smallest) + smallest * smallest).sqrt()
    }

    /// Smallest semi-axis, m.
    pub fn smallest_semi_axis(&self) -> f64 {
        self.semi_axes.min()
    }
}
