//! Sphere and ellipsoid.

use super::facts::{Curved, Drawing, Primitive, box_around};
use crate::bounding::{Bounded, ball_representatives};
use crate::{Mat3, Transform, Vec3};
use std::borrow::Cow;

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
    /// Returns the sphere transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { center: x.point(&self.center), radius: self.radius }
    }

    /// Returns the lowest and the highest corner of the sphere's bounding box, along the axes of the frame,
    /// m.
    #[inline]
    pub fn region(&self, _meets_triangles: bool) -> (Vec3, Vec3) {
        box_around(&self.center, Vec3::repeat(self.radius))
    }
}

impl Ellipsoid {
    /// Returns the ellipsoid transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { center: x.point(&self.center), axes: x.rotation * self.axes, semi_axes: self.semi_axes }
    }

    /// Returns the lowest and the highest corner of the box, along the axes of the frame, around everything
    /// that the ellipsoid can touch, m. If `meets_triangles`, the box may be larger than the bounding box,
    /// because triangles may push an ellipsoid at foot points outside it.
    #[inline]
    pub fn region(&self, meets_triangles: bool) -> (Vec3, Vec3) {
        box_around(&self.center, self.half_sizes(meets_triangles))
    }

    /// Returns the half sizes of the box of [`region`](Self::region), m. The function is not inlined, so that
    /// the cheaper kinds do not pay for its stack frame.
    #[inline(never)]
    fn half_sizes(&self, meets_triangles: bool) -> Vec3 {
        let least = if meets_triangles { self.reach_of_feet() } else { 0.0 };
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        Vec3::from(axes.map(|axis| self.half_width(&axis).max(least)))
    }

    /// Returns half the width along a unit direction, `√Σ(aᵢ nᵢ)²`, m.
    #[inline]
    pub fn half_width(&self, direction: &Vec3) -> f64 {
        self.axes.tr_mul(direction).component_mul(&self.semi_axes).norm()
    }

    /// Returns the surface point farthest along a unit direction, m.
    #[inline]
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let scaled = self.axes.tr_mul(direction).component_mul(&self.semi_axes);
        let half_width = scaled.norm();
        self.center + self.axes * scaled.component_mul(&self.semi_axes) / half_width
    }

    /// Returns the radius, m, of a sphere around the centre. The convex hull of this sphere and the ellipsoid
    /// contains every foot point of a face that may push the ellipsoid.
    ///
    /// A face pushes if it contains the foot point: the projection of the ellipsoid's deepest point onto the
    /// plane of the face. The foot point of a slender, oblique ellipsoid may lie outside the ellipsoid, so
    /// that a triangle pushes without touching it.
    ///
    /// * Centre in the plane: the foot point is at most the difference of the largest and the smallest
    ///   semi-axis away from the centre.
    /// * Centre behind the plane: its depth, at most the thickness, adds at a right angle. The default
    ///   thickness is the smallest semi-axis; the bounding volume of the triangle covers a larger thickness.
    /// * Centre in front of the plane: the foot point lies between the deepest point and the foot point of
    ///   the first case.
    pub fn reach_of_feet(&self) -> f64 {
        let (smallest, largest) = (self.semi_axes.min(), self.semi_axes.max());
        ((largest - smallest) * (largest - smallest) + smallest * smallest).sqrt()
    }

    /// Smallest semi-axis, m.
    pub fn smallest_semi_axis(&self) -> f64 {
        self.semi_axes.min()
    }
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

    /// Returns an upper bound of the distance from `from` to the farthest point of the ellipsoid, m.
    ///
    /// In the principal frame let q be the given point and y a point with `Σ(yᵢ/aᵢ)² ≤ 1`. By duality
    /// `|y − q|² ≤ λ + Σ qᵢ²·λ/(λ − aᵢ²)` for every λ ≥ max aᵢ², with equality at the minimum over λ. The
    /// bound is therefore valid at whichever λ the search stops.
    fn farthest(&self, from: &Vec3) -> f64 {
        const BISECTIONS: usize = 40;
        let q = self.axes.tr_mul(&(from - self.center));
        let largest = self.semi_axes.max();
        if q == Vec3::zeros() {
            return largest;
        }
        let squares = self.semi_axes.component_mul(&self.semi_axes);
        // λ = largest² + excess, because λ − aᵢ² then has no cancellation.
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

impl Primitive for Sphere {
    #[inline]
    fn reference_point(&self, _end: u32) -> Cow<'_, Vec3> {
        Cow::Borrowed(&self.center)
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        [Some(self.center), None, None]
    }

    fn core(&self) -> Option<([Vec3; 2], f64)> {
        Some(([self.center; 2], self.radius))
    }

    fn smallest_radius_m(&self) -> Option<f64> {
        Some(self.radius)
    }

    fn least_width_m(&self) -> f64 {
        2.0 * self.radius
    }

    fn curved(&self) -> Option<&dyn Curved> {
        Some(self)
    }

    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        vec![("the radius", self.radius)]
    }

    fn drawing(&self) -> Option<Drawing> {
        let semi_axes = Vec3::repeat(self.radius);
        Some(Drawing::Ball { center: self.center, axes: Mat3::identity(), semi_axes })
    }
}

impl Primitive for Ellipsoid {
    #[inline]
    fn reference_point(&self, _end: u32) -> Cow<'_, Vec3> {
        Cow::Borrowed(&self.center)
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        [Some(self.center), None, None]
    }

    fn smallest_radius_m(&self) -> Option<f64> {
        Some(self.smallest_semi_axis())
    }

    fn least_width_m(&self) -> f64 {
        2.0 * self.semi_axes.min()
    }

    fn curved(&self) -> Option<&dyn Curved> {
        Some(self)
    }

    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        vec![("a semi-axis", self.semi_axes.min()), ("a semi-axis", self.semi_axes.max())]
    }

    fn drawing(&self) -> Option<Drawing> {
        let Self { center, axes, semi_axes } = *self;
        Some(Drawing::Ball { center, axes, semi_axes })
    }
}

/// The path of the passing sphere's centre is tested against the larger of the two radii, here and for each semi-axis
/// of an ellipsoid, because a large sphere can pass through a small one that lies beside the path.
impl Curved for Sphere {
    fn passed(&self, from: &Vec3, to: &Vec3, radius: f64) -> Option<Vec3> {
        let radius = self.radius.max(radius);
        let unit = |p: &Vec3| (p - self.center) / radius;
        through_unit_ball(&unit(from), &unit(to))
    }
}

impl Curved for Ellipsoid {
    fn passed(&self, from: &Vec3, to: &Vec3, radius: f64) -> Option<Vec3> {
        let scale = Mat3::from_diagonal(&self.semi_axes.map(|a| 1.0 / a.max(radius)));
        let to_axes = scale * self.axes.transpose();
        let unit = |p: &Vec3| to_axes * (p - self.center);
        let at = through_unit_ball(&unit(from), &unit(to))?;
        Some((to_axes.transpose() * at).normalize())
    }
}

/// Returns the point at which a path enters the unit ball; `None` if it does not, or if an end of the path is
/// inside.
fn through_unit_ball(from: &Vec3, to: &Vec3) -> Option<Vec3> {
    let path = to - from;
    let (square, along, room) = (path.norm_squared(), from.dot(&path), from.norm_squared() - 1.0);
    let root = along * along - square * room;
    let outside = room >= 0.0 && to.norm_squared() >= 1.0;
    // Also rejects a path of length zero, and NaN.
    let enters = root > 0.0 && along < 0.0;
    if !outside || !enters {
        return None;
    }
    let at = (-along - root.max(0.0).sqrt()) / square.max(f64::MIN_POSITIVE);
    (at < 1.0).then(|| from + path * at)
}
