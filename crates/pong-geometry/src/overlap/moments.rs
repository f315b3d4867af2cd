//! Moments of a volume up to the second order.

use crate::{Mat3, Vec3};

/// Moments of a volume about a reference point, along the axes of B's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Volume ∫ dV, m³.
    pub volume: f64,
    /// First moment ∫ y dV, m⁴; y is the position from the reference point.
    pub first_b: Vec3,
    /// Second moment ∫ y yᵀ dV, m⁵.
    pub second: Mat3,
}

impl Moments {
    /// Adds the tetrahedron of the reference point and a triangle. The corners of the triangle are positions
    /// from the reference point, m. The tetrahedron counts positive if they run counter-clockwise, seen from
    /// the side away from the reference point; otherwise negative.
    #[inline]
    pub(super) fn add(&mut self, [a, b, c]: [Vec3; 3]) {
        let volume = a.dot(&b.cross(&c)) / 6.0;
        let sum = a + b + c;
        self.volume += volume;
        self.first_b += sum * (volume / 4.0);
        let squares = a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose();
        self.second += squares * (volume / 20.0);
    }

    /// Returns the moments about another reference point. `step` is the position of the present reference
    /// point from that point, m.
    #[inline]
    pub(super) fn about(&self, step: &Vec3) -> Self {
        let first_b = self.first_b + step * self.volume;
        let mixed = self.first_b * step.transpose();
        let second = self.second + mixed + mixed.transpose() + step * (step * self.volume).transpose();
        Self { volume: self.volume, first_b, second }
    }

    /// Returns the centroid, as a position from the reference point, m.
    pub fn centroid(&self) -> Vec3 {
        self.first_b / self.volume
    }
}
