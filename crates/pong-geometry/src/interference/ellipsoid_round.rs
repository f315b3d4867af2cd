//! Ellipsoid (A) – capsule, cylinder and cone (B): the least translation that separates the two (docs/theory.md,
//! 2.6).

use super::circles::{Across, Reach};
use super::ellipsoid_math::{
    nearest_on_ellipse, nearest_on_ellipsoid, second_nearest_on_ellipse, second_nearest_on_ellipsoid,
};
use super::ellipsoid_prepared::{PreparedEllipsoid, Shadow};
use super::least_translation::{Along, Part, SAME, descend, lattice, least_of_many};
use super::round_surface::of_frustum;
use super::{Feature, Interference};
use crate::primitive::{Capsule, Ellipsoid, Frustum};
use crate::{Vec3, any_perpendicular};

/// Tests an ellipsoid against a capsule; `None` if they do not overlap.
///
/// A ball around both ends does not change which translation is the least, so the axis takes the capsule's place, and
/// its radius is added. On the sphere of normals the support function of the axis is linear on two half spheres, one
/// per end, and the least translation is a minimum of one end, or of the ellipsoid's shadow along the axis. Each
/// candidate is an upper bound, so no candidate needs to be checked.
pub fn ellipsoid_capsule(ellipsoid: &Ellipsoid, capsule: &Capsule) -> Option<Interference> {
    let e = PreparedEllipsoid::new(ellipsoid);
    let arms = capsule.ends.map(|end| end - e.center);
    let overlap = |n: &Vec3| e.widened(n).norm() + n.dot(&arms[0]).max(n.dot(&arms[1])) + capsule.radius;
    let mut best: Option<(f64, Vec3)> = None;
    let mut offer = |outward: Vec3| {
        // The foot's normal points out of the ellipsoid: from A to B.
        let normal = -outward.normalize();
        let depth = overlap(&normal);
        if best.is_none_or(|(least, _)| depth < least) {
            best = Some((depth, normal));
        }
        depth > 0.0
    };
    let along = (capsule.ends[1] - capsule.ends[0]).normalize();
    let u = any_perpendicular(&along);
    let shadow = Shadow::new(&e, &u, &along.cross(&u));
    let beside = shadow.components(&arms[0]);
    if !offer(shadow.vector(&nearest_on_ellipse(shadow.semi_axes, beside).normal)) {
        return None;
    }
    if let Some(foot) = second_nearest_on_ellipse(shadow.semi_axes, beside) {
        offer(shadow.vector(&foot.normal));
    }
    for arm in arms {
        let y = ellipsoid.axes.tr_mul(&arm);
        if !offer(ellipsoid.axes * Vec3::from(nearest_on_ellipsoid(&ellipsoid.semi_axes, &y).normal)) {
            return None;
        }
        if let Some(foot) = second_nearest_on_ellipsoid(&ellipsoid.semi_axes, &y) {
            offer(ellipsoid.axes * Vec3::from(foot.normal));
        }
    }
    let (depth, normal) = best?;
    Some(Interference { depth, normal_b: normal, deepest_b: e.deepest(&normal), feature: Feature::WHOLE })
}

/// Tests an ellipsoid against a cylinder or a cone; `None` if they do not overlap.
///
/// The solid is the hull of its end discs. The least translation leads along the axis out of an end face, along a
/// normal of the side (a search over one angle), or along a normal of one rim (a descent over two).
pub fn ellipsoid_frustum(ellipsoid: &Ellipsoid, frustum: &Frustum) -> Option<Interference> {
    let search = Search { e: PreparedEllipsoid::new(ellipsoid), frustum };
    let toward = of_frustum(&ellipsoid.center, frustum).normal_b;
    let mut best = Candidate { depth: f64::INFINITY, normal: toward, feature: Feature::WHOLE };
    if search.overlap(&toward) <= 0.0 {
        return None;
    }
    search.offer(-frustum.axis, Feature::face(1), &mut best);
    search.offer(frustum.axis, Feature::face(2), &mut best);
    for side in search.sides().into_iter().flatten() {
        search.offer(frustum.wall_toward(&side), Feature::face(0), &mut best);
    }
    if !search.is_least(&best) {
        let of_toward = search.e.direction_of(&search.e.shrunk(&toward)).normalize();
        for start in [best.normal, toward, of_toward] {
            search.offer_rim(&start, &mut best);
        }
    }
    if !search.is_least(&best) {
        let directions = search.e.directions().chain(lattice(search.frame()));
        let to_minimum = |start: &Vec3, known: &[Vec3]| search.to_minimum(start, known);
        let found = least_of_many(directions, SAME, |n| search.overlap(n), to_minimum);
        found.into_iter().for_each(|normal| search.offer(normal, search.rim(&normal), &mut best));
    }
    let Candidate { depth, normal, feature } = best;
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: normal,
        deepest_b: search.e.deepest(&normal),
        feature,
    })
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    depth: f64,
    normal: Vec3,
    feature: Feature,
}

/// Search for the least translation of an ellipsoid out of a frustum.
struct Search<'a> {
    e: PreparedEllipsoid,
    frustum: &'a Frustum,
}

impl Search<'_> {
    /// Length of the translation along a unit normal, m.
    fn overlap(&self, n: &Vec3) -> f64 {
        self.e.widened(n).norm() + self.frustum.support_from(n, &self.e.center)
    }

    fn offer(&self, normal: Vec3, feature: Feature, best: &mut Candidate) {
        let depth = self.overlap(&normal);
        if depth < best.depth {
            *best = Candidate { depth, normal, feature };
        }
    }

    /// Tries the minimum to which `start` descends on the rim that touches there.
    fn offer_rim(&self, start: &Vec3, best: &mut Candidate) {
        let normal = self.to_minimum(start, &[]);
        self.offer(normal, self.rim(&normal), best);
    }

    /// Returns the minimum of the translation out of one disc, the one farther along `start`, or a normal beside one of
    /// the minima that are known.
    fn to_minimum(&self, start: &Vec3, known: &[Vec3]) -> Vec3 {
        let end = self.rim(start).index();
        descend(start, known, |n| Along::new(n, &self.e, self.of_disc(end, n)))
    }

    /// Returns the rim that is farther along a normal.
    fn rim(&self, n: &Vec3) -> Feature {
        let aside = n.cross(&self.frustum.axis).norm();
        let [first, last] = self.frustum.radii;
        let over = n.dot(&self.frustum.axis) * self.frustum.length + (last - first) * aside;
        Feature::edge(usize::from(over > 0.0))
    }

    fn of_disc(&self, end: usize, n: &Vec3) -> Part {
        let axis = self.frustum.axis;
        let across = n - axis * axis.dot(n);
        let aside = across.norm().max(f64::MIN_POSITIVE);
        let outward = across / aside;
        let around = axis.cross(&outward);
        let radius = self.frustum.radii[end];
        (self.frustum.ends[end] + outward * radius, around * around.transpose() * (radius / aside))
    }

    /// Returns the two best directions from the axis towards the side by which the ellipsoid may leave.
    fn sides(&self) -> [Option<Vec3>; 2] {
        let [_, aside] = self.frustum.wall;
        let beside = self.e.center - self.frustum.ends[0];
        let across = Across::new(&self.frustum.axis, &[beside, self.e.widen[0], self.e.widen[1]]);
        across.greatest(|side| {
            let normal = self.frustum.wall_toward(side);
            let widened = self.e.widened(&normal);
            let half_width = widened.norm();
            let turning = self.frustum.axis.cross(side) * aside;
            let farthest = self.e.reach(&widened) / half_width - beside;
            let depth = half_width - normal.dot(&beside) + self.frustum.radii[0] * aside;
            Reach { depth: -depth, slope: -turning.dot(&farthest) }
        })
    }

    /// Returns true if the candidate is certainly the least translation: a local minimum below the smallest radius of
    /// curvature.
    fn is_least(&self, candidate: &Candidate) -> bool {
        let Candidate { depth, normal, feature } = candidate;
        if *depth >= self.e.least_radius() {
            return false;
        }
        let touched = self.e.deepest(normal) + normal * *depth;
        if !feature.is_face() {
            // On a rim the farthest point of its disc is where the two touch.
            let end = feature.index();
            let slack = 1e-9 * self.frustum.support_point(normal).amax().max(self.e.largest);
            return (self.of_disc(end, normal).0 - touched).amax() <= slack && self.rim(normal) == *feature;
        }
        match feature.index() {
            0 => {
                let along = self.frustum.axis.dot(&(touched - self.frustum.ends[0]));
                (0.0..=self.frustum.length).contains(&along)
            }
            face => {
                let arm = touched - self.frustum.ends[face - 1];
                arm.cross(&self.frustum.axis).norm() <= self.frustum.radii[face - 1]
            }
        }
    }

    /// Returns the axis and two directions across it, the first towards the ellipsoid.
    fn frame(&self) -> [Vec3; 3] {
        let axis = self.frustum.axis;
        let first = Across::new(&axis, &[self.e.center - self.frustum.ends[0], self.e.widen[0]]).first_b;
        [axis, first, axis.cross(&first)]
    }
}
