//! Cylinder or cone (A) on a plane: what its four places store, and how that changes when the plane turns (docs/theory.md,
//! 2.8).
//!
//! With the depths δ of the lowest and the highest place of each disc below a plane, A stores ¼k·F, F = Σ max(0, δ)². When
//! the unit normal n of a plane through the point p turns, the depth n·(p − q) of a place q changes by the product of
//! p − q with the change of n, because a place moves along its rim, square to n.

use super::end_disc::UPRIGHT;
use super::least_translation::Local;
use crate::primitive::Frustum;
use crate::{Vec3, any_perpendicular};

/// A on a plane.
#[derive(Clone, Copy, Debug)]
pub struct OnPlane {
    /// F, m².
    pub energy: f64,
    /// Depths of the lowest places of discs 0 and 1 below the plane, then of the highest, m; 0 above it.
    pub depths: [f64; 4],
    /// Product of the normal and the axis, across both, and its length, the sine of the angle between them.
    level: Vec3,
    sine: f64,
}

impl OnPlane {
    /// Returns A on the plane with a unit normal, below which the centres of its discs are by `middles`, m.
    #[inline]
    pub(super) fn new(frustum: &Frustum, normal: &Vec3, middles: [f64; 2]) -> Self {
        let Frustum { radii, axis, .. } = frustum;
        let level = normal.cross(axis);
        let sine = level.norm();
        let low = |end: usize| (middles[end] + radii[end] * sine).max(0.0);
        // An apex is one place.
        let high =
            |end: usize| if radii[end] > 0.0 { (middles[end] - radii[end] * sine).max(0.0) } else { 0.0 };
        let depths = [low(0), low(1), high(0), high(1)];
        let square = |index: usize| depths[index] * depths[index];
        Self { energy: (square(0) + square(1)) + (square(2) + square(3)), depths, level, sine }
    }

    /// Returns the unit vectors across the axis that are level, and towards the normal.
    #[inline]
    pub(super) fn directions(&self, frustum: &Frustum) -> [Vec3; 2] {
        let axis = &frustum.axis;
        let around = match self.sine > UPRIGHT {
            true => self.level / self.sine.max(f64::MIN_POSITIVE),
            false => any_perpendicular(axis),
        };
        [around, axis.cross(&around)]
    }

    /// Returns the four places, m, in the order of the depths.
    pub fn places(&self, frustum: &Frustum) -> [Vec3; 4] {
        let [_, up] = self.directions(frustum);
        [0, 1, 2, 3].map(|index| place(frustum, &up, index))
    }

    /// Returns the middle of the load, m: of the places with their depths as weights.
    pub(super) fn middle_of_load(&self, frustum: &Frustum) -> Vec3 {
        let [_, up] = self.directions(frustum);
        let load: f64 = self.depths.iter().sum();
        let sum: Vec3 = (0..4).map(|index| place(frustum, &up, index) * self.depths[index]).sum();
        sum / load.max(f64::MIN_POSITIVE)
    }

    /// Returns F, and the derivatives of half of it when the plane turns about a point of it. The size is that of [`size_of`].
    pub(super) fn about(&self, (frustum, size): (&Frustum, f64), point: &Vec3, normal: &Vec3) -> Local {
        let [around, up] = self.directions(frustum);
        let mut slope = Vec3::zeros();
        let mut bend = around * around.transpose() * self.turning(frustum);
        for index in (0..4).filter(|&index| self.depths[index] > 0.0) {
            let arm = point - place(frustum, &up, index);
            slope += arm * self.depths[index];
            bend += arm * arm.transpose();
        }
        let slope_b = slope - normal * normal.dot(&slope);
        Local { value: self.energy, slope_b, bend, less: self.energy, size: self.energy.sqrt() * size }
    }

    /// Returns the sum of depth times second derivative of the height, m², over the places, if the plane turns about the
    /// direction that is level. The height of the lowest place of a disc bends by R/s, with s the sine of the tilt, that of
    /// the highest by −R/s, and while both push, their depths differ by 2R·s.
    #[inline]
    pub(super) fn turning(&self, frustum: &Frustum) -> f64 {
        let of_disc = |disc: usize| {
            let radius = frustum.radii[disc];
            match self.depths[disc + 2] > 0.0 {
                true => 2.0 * radius * radius,
                false => (self.depths[disc] * radius / self.sine.max(UPRIGHT)).min(2.0 * radius * radius),
            }
        };
        of_disc(0) + of_disc(1)
    }
}

/// Returns a place of A, the lowest ones of discs 0 and 1, then the highest. `up` is the unit vector across the axis towards
/// the normal.
#[inline]
pub(super) fn place(frustum: &Frustum, up: &Vec3, index: usize) -> Vec3 {
    let radius = frustum.radii[index % 2];
    frustum.ends[index % 2] + up * if index < 2 { -radius } else { radius }
}

/// Returns the largest coordinate of A, m: rounding of places is relative to it.
pub(super) fn size_of(frustum: &Frustum) -> f64 {
    let Frustum { ends, radii, .. } = frustum;
    ends[0].amax().max(ends[1].amax()) + radii[0].max(radii[1])
}
