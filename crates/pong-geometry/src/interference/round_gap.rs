//! Gap between a round solid and a point, a segment or the axis of a round part (docs/theory.md, 2.9).

use super::axis_approach::Approach;
use super::round_surface::{Nearest, of_capsule, of_frustum};
use crate::Vec3;
use crate::primitive::{Capsule, Frustum, Gap, Round};

impl Round for Capsule {
    fn gap(&self, axis: &[Vec3; 2]) -> Gap {
        if axis[0] == axis[1] { of_place(of_capsule(&axis[0], self)) } else { of_axis(self.approach(axis)) }
    }

    fn width_m(&self) -> f64 {
        2.0 * self.radius
    }
}

impl Round for Frustum {
    fn gap(&self, axis: &[Vec3; 2]) -> Gap {
        if axis[0] == axis[1] { of_place(of_frustum(&axis[0], self)) } else { of_axis(self.approach(axis)) }
    }

    fn width_m(&self) -> f64 {
        width_of_frustum(self)
    }
}

fn of_place(Nearest { distance, normal_b, .. }: Nearest) -> Gap {
    Gap { distance, normal_b }
}

fn of_axis(Approach { distance, normal_b, .. }: Approach) -> Gap {
    Gap { distance, normal_b }
}

/// Returns the least distance, m, between two parallel planes that enclose a frustum. At the least distance
/// the planes lie on the end faces, or one lies along the lateral surface: for directions in between, the
/// distance is a concave function of the angle and has no minimum. So only these two distances are compared.
fn width_of_frustum(frustum: &Frustum) -> f64 {
    let [along, aside] = frustum.wall;
    let normal = frustum.axis * along + crate::any_perpendicular(&frustum.axis) * aside;
    let across_wall = frustum.support(&normal) + frustum.support(&-normal);
    frustum.length.min(across_wall)
}
