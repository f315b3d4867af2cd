//! Sphere (A) – sphere (B): centre distance.
//!
//! Degenerate case: concentric spheres push along the frame's x axis.

use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::Sphere;

/// Contact of two overlapping spheres.
pub fn sphere_sphere(a: &Sphere, b: &Sphere) -> Option<Interference> {
    let as_ball = Sphere { center: a.center, radius: a.radius + b.radius };
    let contact = ball_over_point(&as_ball, &b.center, Feature::WHOLE, Vec3::x)?;
    Some(Interference { deepest_b: a.center - contact.normal_b * a.radius, ..contact })
}
