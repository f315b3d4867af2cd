//! Capsule, cylinder and cone (A) – plane (B): half a spring at each end sphere of a capsule, and at the
//! lowest and highest point of each disc of a cylinder or a cone (docs/theory.md, 2.8).

use super::Interference;
use super::point_plane::point_plane;
use super::sphere_plane::sphere_plane;
use crate::primitive::{Capsule, Frustum, Plane, Point, Sphere};
use crate::{Vec3, any_perpendicular};

/// Lowest point of each disc, then highest point of each disc: index disc + 2·(0 lowest, 1 highest).
pub type RimContacts = [Option<Interference>; 4];

/// Contact of each end sphere, in the order of the ends.
pub fn capsule_plane(capsule: &Capsule, plane: &Plane) -> [Option<Interference>; 2] {
    capsule.ends.map(|center| sphere_plane(&Sphere { center, radius: capsule.radius }, plane))
}

/// Contacts of the lowest and highest point of each disc. A disc of radius 0, the apex of a cone, has one
/// point.
///
/// Let k be the stiffness, R the radius of a disc, h the depth of its centre and s the sine of its tilt.
/// While both points of the disc push, their energy ¼k((h − Rs)² + (h + Rs)²) = ½k(h² + R²s²) does not depend
/// on the direction of the tilt. So for an upright cylinder it makes no difference which point counts as the
/// lowest.
pub fn frustum_plane(frustum: &Frustum, plane: &Plane) -> RimContacts {
    let down = down_the_discs(frustum, plane);
    let at = |disc: usize, sign: f64| {
        let position = frustum.ends[disc] + down * (sign * frustum.radii[disc]);
        point_plane(&Point { position }, plane)
    };
    let highest = |disc: usize| at(disc, -1.0).filter(|_| frustum.radii[disc] > 0.0);
    [at(0, 1.0), at(1, 1.0), highest(0), highest(1)]
}

/// Unit vector of steepest descent in the planes of the discs. If the solid is upright, that direction is
/// only rounding, and the result is a fixed vector perpendicular to the plane's normal.
fn down_the_discs(frustum: &Frustum, plane: &Plane) -> Vec3 {
    /// Sine of a tilt caused by rounding of unit vectors.
    const UPRIGHT: f64 = 16.0 * f64::EPSILON;
    let level = plane.normal.cross(&frustum.axis);
    let sine = level.norm();
    // Cross products keep a small sine; a difference of two lengths near 1 would lose its digits.
    if sine > UPRIGHT {
        (level / sine.max(f64::MIN_POSITIVE)).cross(&frustum.axis).normalize()
    } else {
        any_perpendicular(&plane.normal)
    }
}
