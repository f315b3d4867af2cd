//! Point (A) – sphere (B): the depth is the radius less the distance of the point from the centre.
//!
//! Degenerate case: a point at the sphere's centre is pushed along the frame's x axis.

use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::{Point, Sphere};

/// Returns the contact of a point inside a sphere; `None` for a point outside.
pub fn point_sphere(point: &Point, sphere: &Sphere) -> Option<Interference> {
    let as_ball = Sphere { center: point.position, radius: sphere.radius };
    let contact = ball_over_point(&as_ball, &sphere.center, Feature::WHOLE, Vec3::x)?;
    Some(Interference { deepest_b: point.position, ..contact })
}
