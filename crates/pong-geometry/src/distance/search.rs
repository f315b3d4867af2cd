//! Search for the nearest points of the cores of two solids, after Gilbert, Johnson and Keerthi (1988).

use super::simplex::{Corner, Nearest};
use super::solid::Solid;
use crate::Vec3;

/// Distance of two solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Smallest distance of the two solids, m. Zero if they overlap, or touch within rounding.
    pub distance: f64,
    /// Nearest points of the first and the second solid, m, in the frame of both solids. If the solids
    /// overlap, an arbitrary point of each.
    pub points_b: [Vec3; 2],
    /// Upper bound of the error of the distance, m: the true distance is at least `distance − gap`.
    pub gap: f64,
}

/// Maximum number of steps. Two polyhedra need about as many as they have vertices near each other; smooth
/// solids converge linearly.
const STEPS: usize = 200;
/// Distance of two cores up to which they count as overlapping, relative to the coordinates. It is
/// accumulated rounding.
const OVERLAP: f64 = 1e-14;
/// Difference of the upper and lower bound of the distance at which the search ends, relative to the
/// coordinates. It is the rounding of one product.
const CLOSED: f64 = 8.0 * f64::EPSILON;
/// Number of consecutive steps without a smaller distance after which the search ends.
const IDLE: usize = 16;

/// Returns the distance of two solids; `None` if it exceeds `limit`, m.
///
/// In every step, the nearest point of the simplex gives an upper bound of the distance of the cores. The
/// support plane perpendicular to that point's direction gives a lower bound. The best bounds over all steps
/// count.
pub(super) fn search(a: &Solid<'_>, b: &Solid<'_>, limit: f64) -> Option<Distance> {
    let margin = a.margin() + b.margin();
    let corner = |towards_a: &Vec3| {
        let points_b = [a.core_support(&-towards_a), b.core_support(towards_a)];
        Corner { difference_b: points_b[0] - points_b[1], points_b }
    };
    let between = a.member() - b.member();
    let start = if between.norm() > 0.0 { between.normalize() } else { Vec3::x() };
    let mut nearest = Nearest::corner(corner(&start));
    let (mut best, mut least, mut size, mut idle) = (nearest, 0.0_f64, coordinates(&nearest.corners[0]), 0);
    for _ in 0..STEPS {
        if best.distance <= margin.max(OVERLAP * size) {
            return Some(overlap(&best));
        }
        let next = corner(&nearest.direction_b);
        size = size.max(coordinates(&next));
        least = least.max(nearest.direction_b.dot(&next.difference_b));
        if least - margin > limit {
            return None;
        }
        if best.distance - least <= CLOSED * size || idle == IDLE {
            break;
        }
        let Some(found) = nearest.with(next) else { return Some(overlap(&best)) };
        idle = if found.distance < best.distance { 0 } else { idle + 1 };
        // A later simplex replaces the best one even if its distance is only equal within rounding, because
        // its direction is more accurate.
        if found.distance <= best.distance + CLOSED * size {
            best = found;
        }
        nearest = found;
    }
    Some(apart(&best, [a.margin(), b.margin()], least))
}

/// Returns the largest coordinate of the points of a corner, m.
fn coordinates(corner: &Corner) -> f64 {
    corner.points_b[0].amax().max(corner.points_b[1].amax())
}

fn overlap(nearest: &Nearest) -> Distance {
    Distance { distance: 0.0, points_b: nearest.points(), gap: 0.0 }
}

/// Returns the distance of two solids whose cores do not overlap: the distance of the cores less the margins.
fn apart(nearest: &Nearest, margins: [f64; 2], least: f64) -> Distance {
    let [p, q] = nearest.points();
    let towards_a = nearest.direction_b;
    Distance {
        distance: (nearest.distance - margins[0] - margins[1]).max(0.0),
        points_b: [p - towards_a * margins[0], q + towards_a * margins[1]],
        gap: (nearest.distance - least).max(0.0),
    }
}
