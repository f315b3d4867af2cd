//! Ellipsoid (A) – ellipsoid (B): the least translation that separates the two (docs/theory.md, 2.6).

use super::ellipsoid_prepared::PreparedEllipsoid;
use super::least_translation::{Along, SAME, descend, least_of_many};
use super::{Feature, Interference};
use crate::primitive::Ellipsoid;
use crate::{Mat3, Vec3};

/// Tests two ellipsoids against each other; `None` if they do not overlap.
pub fn ellipsoid_ellipsoid(a: &Ellipsoid, b: &Ellipsoid) -> Option<Interference> {
    let between = a.center - b.center;
    if between.norm() >= a.semi_axes.max() + b.semi_axes.max() {
        return None;
    }
    let (of_a, of_b) = (PreparedEllipsoid::new(a), PreparedEllipsoid::new(b));
    let overlap = |n: &Vec3| of_a.widened(n).norm() + of_b.widened(n).norm() - n.dot(&between);
    let along = |n: &Vec3| {
        let (reach, radii) = of_b.part(n);
        Along::new(n, &of_a, (reach + b.center, radii))
    };
    let mut normal = descend(&first_direction([&of_a, &of_b], &between), &[], along);
    if overlap(&normal) >= of_a.least_radius() + of_b.least_radius() {
        let directions = of_a.directions().chain(of_b.directions()).chain([normal]);
        let to_minimum = |start: &Vec3, known: &[Vec3]| descend(start, known, along);
        normal = least_of_many(directions, SAME, overlap, to_minimum).unwrap_or(normal);
    }
    let depth = overlap(&normal);
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: normal,
        deepest_b: of_a.deepest(&normal),
        feature: Feature::WHOLE,
    })
}

/// Returns the normal, at the place in the direction of `between`, of the ellipsoid whose squared support function is
/// the sum of those of the two.
fn first_direction(bodies: [&PreparedEllipsoid; 2], between: &Vec3) -> Vec3 {
    let squares = bodies.iter().flat_map(|body| &body.widen).map(|w| w * w.transpose()).sum::<Mat3>();
    let inverse = squares.try_inverse().unwrap_or_else(Mat3::identity);
    (inverse * between).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| {
        let shortest =
            (0..3).reduce(|i, j| if bodies[0].widen[j].norm() < bodies[0].widen[i].norm() { j } else { i });
        bodies[0].widen[shortest.unwrap_or(0)].normalize()
    })
}
