//! Capsule, cylinder and cone (A) – plane (B): half a spring at each ball of a capsule, and at the lowest and the highest place
//! of each disc of a cylinder or a cone (docs/theory.md, 2.8).

use super::Interference;
use super::point_plane::point_plane;
use super::sphere_plane::sphere_plane;
use crate::primitive::{Capsule, Frustum, Plane, Point, Sphere};
use crate::{Vec3, any_perpendicular};

/// Of each disc the lowest place, then of each disc the highest: place number disc + 2·(0 lowest, 1 highest).
pub type RimContacts = [Option<Interference>; 4];

/// The contact of each ball, in the order of the ends.
pub fn capsule_plane(capsule: &Capsule, plane: &Plane) -> [Option<Interference>; 2] {
    capsule.ends.map(|center| sphere_plane(&Sphere { center, radius: capsule.radius }, plane))
}

/// The contacts of the lowest and the highest place of each disc. A disc without a radius, the tip of a cone, is one place.
///
/// As long as both places of a disc push, their energies ¼k((h − Rs)² + (h + Rs)²) = ½k(h² + R²s²), with h the depth of the
/// centre and s the sine of the tilt, do not depend on which way the disc tilts: so which place of a standing disc is the
/// lowest makes no difference.
pub fn frustum_plane(frustum: &Frustum, plane: &Plane) -> RimContacts {
    let down = down_the_discs(frustum, plane);
    let at = |disc: usize, way: f64| {
        let position = frustum.ends[disc] + down * (way * frustum.radii[disc]);
        point_plane(&Point { position }, plane)
    };
    let highest = |disc: usize| at(disc, -1.0).filter(|_| frustum.radii[disc] > 0.0);
    [at(0, 1.0), at(1, 1.0), highest(0), highest(1)]
}

/// Unit vector in the planes of the discs that goes down most steeply. A disc that stands goes down nowhere: then always the same
/// one across the normal, not one that rounding tells.
fn down_the_discs(frustum: &Frustum, plane: &Plane) -> Vec3 {
    /// Sine of a tilt that some roundings of a unit vector make.
    const UPRIGHT: f64 = 16.0 * f64::EPSILON;
    let level = plane.normal.cross(&frustum.axis);
    let sine = level.norm();
    // A product of two products, as a difference of two lengths near 1 would lose the digits of a small sine.
    if sine > UPRIGHT {
        (level / sine.max(f64::MIN_POSITIVE)).cross(&frustum.axis).normalize()
    } else {
        any_perpendicular(&plane.normal)
    }
}
