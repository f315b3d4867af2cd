//! Point (A) – sphere (B): centre distance.
//!
//! Degenerate case: a point at the sphere's centre is pushed along the frame's x axis.

use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::{Point, Sphere};

/// Contact of a point below a sphere's surface.
pub fn point_sphere(point: &Point, sphere: &Sphere) -> Option<Interference> {
    let as_ball = Sphere { center: point.position, radius: sphere.radius };
    let contact = ball_over_point(&as_ball, &sphere.center, Feature::WHOLE, Vec3::x)?;
    Some(Interference { deepest_b: point.position, ..contact })
}
