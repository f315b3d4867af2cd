//! Oriented bounding box. For given axes it is exact: it follows from the supports along the axes. The search
//! for the axes starts from the better of the frame's axes and the principal axes, and continues by coarse,
//! then fine rotations.

use super::bounded::{representatives, support};
use super::principal_axes::{orthonormal, plane_rotation, principal_axes};
use super::volume::{Bounded, Volume};
use crate::{Mat3, Vec3};

/// Returns the smallest box found around the shapes, without margin.
pub(super) fn fit_obb(things: &[&dyn Bounded]) -> Volume {
    let mut best = Candidate::along(Mat3::identity(), things);
    let points = representatives(things);
    if points.len() > 1 {
        best.take_if_smaller(principal_axes(&points), things);
    }
    best.turn_by_coarse_steps(things);
    best.refine(things);
    let center = best.axes * best.mid;
    Volume::Obb { center, axes: best.axes, half: best.half }
}

struct Candidate {
    axes: Mat3,
    /// Centre in the axes of the box, m.
    mid: Vec3,
    half: Vec3,
    score: f64,
}

impl Candidate {
    fn along(axes: Mat3, things: &[&dyn Bounded]) -> Self {
        let direction = |i: usize| axes.column(i).into_owned();
        let max = Vec3::from_fn(|i, _| support(things, &direction(i)));
        let min = Vec3::from_fn(|i, _| -support(things, &-direction(i)));
        let half = (max - min) * 0.5;
        Self { axes, mid: (max + min) * 0.5, half, score: score(&half) }
    }

    fn take_if_smaller(&mut self, axes: Mat3, things: &[&dyn Bounded]) -> bool {
        let other = Self::along(axes, things);
        let smaller = other.score < self.score;
        if smaller {
            *self = other;
        }
        smaller
    }

    /// Returns the axes of the box, rotated about one of them.
    fn turned(&self, axis: usize, half_angle_tangent: f64) -> Mat3 {
        let square = half_angle_tangent * half_angle_tangent;
        let (cosine, sine) = ((1.0 - square) / (1.0 + square), 2.0 * half_angle_tangent / (1.0 + square));
        orthonormal(&(self.axes * plane_rotation((axis + 1) % 3, (axis + 2) % 3, cosine, sine)))
    }

    /// Tries large rotations about each axis of the box, because a cube or a cylinder has no preferred
    /// principal axes.
    fn turn_by_coarse_steps(&mut self, things: &[&dyn Bounded]) {
        // Tangents of half of 22.5° and 45°.
        const HALF_ANGLE_TANGENTS: [f64; 4] = [0.199, -0.199, 0.414, -0.414];
        for axis in 0..3 {
            for tangent in HALF_ANGLE_TANGENTS {
                self.take_if_smaller(self.turned(axis, tangent), things);
            }
        }
    }

    /// Rotates about the axes of the box by smaller and smaller angles, as long as the box shrinks. Each
    /// angle is tried up to `ROUNDS` times.
    fn refine(&mut self, things: &[&dyn Bounded]) {
        const HALVINGS: usize = 20;
        const ROUNDS: usize = 4;
        let mut tangent = 0.1;
        for _ in 0..HALVINGS {
            for _ in 0..ROUNDS {
                let turns =
                    [(0, tangent), (0, -tangent), (1, tangent), (1, -tangent), (2, tangent), (2, -tangent)];
                let before = self.score;
                for (axis, tangent) in turns {
                    self.take_if_smaller(self.turned(axis, tangent), things);
                }
                if self.score == before {
                    break;
                }
            }
            tangent *= 0.5;
        }
    }
}

/// Returns the volume of the box after it is thickened by a thousandth of its size. Flat and thin shapes have
/// boxes of zero volume; with the thickening the box of least area or length wins.
fn score(half: &Vec3) -> f64 {
    let thickening = 1e-3 * half.norm();
    half.add_scalar(thickening).product()
}
