//! Gap between a point or the axis of a two-ended body and a round solid (docs/theory.md, 2.9).

use super::axis_approach::{Approach, RoundSolid};
use super::round_surface::{Nearest, of_capsule, of_frustum};
use crate::Vec3;
use crate::primitive::{Capsule, Frustum};

/// Capsule, cylinder or cone.
#[derive(Clone, Copy, Debug)]
pub enum Round<'a> {
    /// Capsule.
    Capsule(&'a Capsule),
    /// Cylinder or cone.
    Frustum(&'a Frustum),
}

/// Distance between two bodies and its direction.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// Distance, m; in overlap, minus the length of the minimum translation.
    pub distance: f64,
    /// Unit vector from the round solid to the other body; in overlap, the direction of the minimum
    /// translation.
    pub normal_b: Vec3,
}

impl Round<'_> {
    /// Gap to the axis between two points, which may coincide.
    pub fn gap(&self, axis: &[Vec3; 2]) -> Gap {
        let of_place = |Nearest { distance, normal_b, .. }| Gap { distance, normal_b };
        let of_axis = |Approach { distance, normal_b, .. }| Gap { distance, normal_b };
        let is_place = axis[0] == axis[1];
        match self {
            Self::Capsule(capsule) if is_place => of_place(of_capsule(&axis[0], capsule)),
            Self::Capsule(capsule) => of_axis(capsule.approach(axis)),
            Self::Frustum(frustum) if is_place => of_place(of_frustum(&axis[0], frustum)),
            Self::Frustum(frustum) => of_axis(frustum.approach(axis)),
        }
    }

    /// Least distance between two parallel planes that enclose the solid, m.
    pub fn width_m(&self) -> f64 {
        match self {
            Self::Capsule(capsule) => 2.0 * capsule.radius,
            Self::Frustum(frustum) => width_of_frustum(frustum),
        }
    }
}

/// Width of a frustum. The planes of least distance lie on an end face or along the lateral surface: between
/// these directions the width is concave.
fn width_of_frustum(frustum: &Frustum) -> f64 {
    let [along, aside] = frustum.wall;
    let normal = frustum.axis * along + crate::any_perpendicular(&frustum.axis) * aside;
    let across_wall = frustum.support(&normal) + frustum.support(&-normal);
    frustum.length.min(across_wall)
}
