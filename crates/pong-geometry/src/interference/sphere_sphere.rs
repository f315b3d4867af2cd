//! Sphere (A) – sphere (B): the depth is the sum of the radii less the distance of the centres.
//!
//! Degenerate case: concentric spheres push along the frame's x axis.

use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::Sphere;

/// Returns the contact of two spheres; `None` unless they overlap.
pub fn sphere_sphere(a: &Sphere, b: &Sphere) -> Option<Interference> {
    let as_ball = Sphere { center: a.center, radius: a.radius + b.radius };
    let contact = ball_over_point(&as_ball, &b.center, Feature::WHOLE, Vec3::x)?;
    Some(Interference { deepest_b: a.center - contact.normal_b * a.radius, ..contact })
}
