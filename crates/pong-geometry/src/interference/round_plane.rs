//! Capsule, cylinder and cone (A) – plane (B) (docs/theory.md, 2.8). Half a spring acts at each end: at the
//! end sphere of a capsule, or at the end disc of a cylinder or a cone, in equal parts at the disc's lowest
//! and highest points.

use super::Interference;
use super::end_disc::UPRIGHT;
use super::point_plane::point_plane;
use super::sphere_plane::sphere_plane;
use crate::primitive::{Capsule, Frustum, Plane, Point, Sphere};
use crate::{Vec3, any_perpendicular};

/// Contacts of the lowest points of discs 0 and 1, then of the highest points of discs 0 and 1.
pub type RimContacts = [Option<Interference>; 4];

/// Returns the contact of each end sphere, in the order of the ends.
pub fn capsule_plane(capsule: &Capsule, plane: &Plane) -> [Option<Interference>; 2] {
    capsule.ends.map(|center| sphere_plane(&Sphere { center, radius: capsule.radius }, plane))
}

/// Returns the contacts of the lowest and highest point of each disc. A disc of radius 0, the apex of a cone,
/// has a lowest point only.
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

/// Returns the unit vector of steepest descent in the planes of the discs. If the axis is parallel to the
/// plane's normal up to rounding, the result is a fixed vector perpendicular to that normal.
fn down_the_discs(frustum: &Frustum, plane: &Plane) -> Vec3 {
    let level = plane.normal.cross(&frustum.axis);
    let sine = level.norm();
    // Cross products keep a small sine; a difference of two lengths near 1 would lose its digits.
    if sine > UPRIGHT {
        (level / sine.max(f64::MIN_POSITIVE)).cross(&frustum.axis).normalize()
    } else {
        any_perpendicular(&plane.normal)
    }
}
