//! Distance between a segment (a line segment, or the axis of a round part) and a round solid (capsule,
//! cylinder or cone). If they overlap, it is the minimum translation that separates them (docs/theory.md,
//! 2.8).

use super::round_surface::{Nearest, ROUNDING, nearest_on_segment, of_capsule, of_frustum};
use crate::primitive::{Capsule, Frustum};
use crate::{Vec3, any_perpendicular, divisor};

/// Distance of a segment from a round solid; if they overlap, the minimum translation that separates them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Approach {
    /// Distance from the solid's surface, m; in overlap, minus the length of the minimum translation.
    pub distance: f64,
    /// Unit vector from the solid to the segment; in overlap, the direction of the minimum translation.
    pub normal_b: Vec3,
}

impl Capsule {
    /// Returns the distance or the minimum translation between a segment and the capsule.
    pub(crate) fn approach(&self, segment: &[Vec3; 2]) -> Approach {
        let [at, _] = nearest_of_segments(segment, &self.ends);
        let Nearest { distance, normal_b, .. } = self.nearest_of(&at, segment);
        Approach { distance, normal_b }
    }

    /// Returns the point of the capsule's surface nearest to the point `place` of a segment. If `place` lies
    /// on the capsule's axis, all directions around the axis are equally near. The normal is then
    /// perpendicular to both the axis and the segment, unless these are parallel.
    fn nearest_of(&self, place: &Vec3, segment: &[Vec3; 2]) -> Nearest {
        let nearest = of_capsule(place, self);
        let crosses = self.is_in_axis(nearest.distance + self.radius, place);
        let across = if crosses { self.across(segment) } else { None };
        Nearest { normal_b: across.unwrap_or(nearest.normal_b), ..nearest }
    }

    /// Returns `true` if a point at `distance` (m) from the axis lies on the axis up to rounding. The
    /// direction from the axis to the point is then only rounding, so it gives no normal.
    fn is_in_axis(&self, distance: f64, place: &Vec3) -> bool {
        distance <= 64.0 * f64::EPSILON * place.amax().max(self.ends[0].amax()).max(self.ends[1].amax())
    }

    /// Returns the unit vector perpendicular to the segment and to the capsule's axis; `None` if the two are
    /// parallel.
    fn across(&self, segment: &[Vec3; 2]) -> Option<Vec3> {
        let along = [segment[1] - segment[0], self.ends[1] - self.ends[0]];
        let across = along[0].cross(&along[1]);
        let least = f64::EPSILON * along[0].norm_squared() * along[1].norm_squared();
        (across.norm_squared() > least).then(|| across.normalize())
    }
}

/// Returns the points of two segments nearest to each other. For parallel segments, it is any two of the
/// nearest points.
pub(super) fn nearest_of_segments(segment: &[Vec3; 2], other: &[Vec3; 2]) -> [Vec3; 2] {
    let mut best = (f64::INFINITY, [segment[0], other[0]]);
    let mut offer = |place: Vec3, on_other: Vec3| {
        let square = (place - on_other).norm_squared();
        if square < best.0 {
            best = (square, [place, on_other]);
        }
    };
    if let Some((place, on_other)) = common_perpendicular(segment, other) {
        offer(place, on_other);
    }
    segment.iter().for_each(|end| offer(*end, nearest_on_segment(end, other)));
    other.iter().for_each(|end| offer(nearest_on_segment(end, segment), *end));
    best.1
}

/// Returns the end points of the common perpendicular of two segments, the first on `segment`. `None` if the
/// segments are parallel, or if an end point lies outside its segment.
fn common_perpendicular(segment: &[Vec3; 2], other: &[Vec3; 2]) -> Option<(Vec3, Vec3)> {
    let (u, v, between) = (segment[1] - segment[0], other[1] - other[0], other[0] - segment[0]);
    let across = u.cross(&v);
    let square = across.norm_squared();
    if square <= f64::EPSILON * f64::EPSILON * u.norm_squared() * v.norm_squared() {
        return None;
    }
    let share = between.cross(&v).dot(&across) / square;
    let share_other = between.cross(&u).dot(&across) / square;
    let inside = |share: f64| (0.0..=1.0).contains(&share);
    (inside(share) && inside(share_other)).then(|| (segment[0] + u * share, other[0] + v * share_other))
}

impl Frustum {
    /// Returns the distance or the minimum translation between a segment and the frustum.
    pub(crate) fn approach(&self, segment: &[Vec3; 2]) -> Approach {
        let nearest = least_on_segment(segment, |place| of_frustum(place, self));
        if nearest.distance > 0.0 {
            return Approach { distance: nearest.distance, normal_b: nearest.normal_b };
        }
        TranslationSearch::new(segment, self).shortest()
    }
}

/// Returns the surface point of a convex solid nearest to a segment. The distance along the segment is convex and has the
/// derivative `normal_b·along`, so the zero of the derivative is searched. The search stops at the first point inside.
fn least_on_segment(segment: &[Vec3; 2], nearest: impl Fn(&Vec3) -> Nearest) -> Nearest {
    /// Largest slope that counts as zero, relative to the length of the segment.
    const FLAT: f64 = 4.0 * f64::EPSILON;
    let along = segment[1] - segment[0];
    let flat = FLAT * along.norm();
    let at = |share: f64| nearest(&(segment[0] + along * share));
    let slope_of = |found: &Nearest| found.normal_b.dot(&along);
    let [first, last] = [at(0.0), at(1.0)];
    let [falls, rises] = [slope_of(&first), slope_of(&last)];
    if falls >= -flat || first.distance <= 0.0 {
        return first;
    }
    if rises <= flat || last.distance <= 0.0 {
        return last;
    }
    at(sign_change([falls, rises], |share| {
        let found = at(share);
        let slope = slope_of(&found);
        if slope.abs() <= flat || found.distance <= 0.0 { 0.0 } else { slope }
    }))
}

/// Returns the zero of a function between 0, where its value `first` is negative, and 1, where its value
/// `last` is positive. It is found by the secant method with the Illinois rule: if the same end of the
/// interval is kept twice in a row, the value at that end is halved.
fn sign_change([first, last]: [f64; 2], at: impl Fn(f64) -> f64) -> f64 {
    // Three steps per bit of precision.
    const STEPS: usize = 160;
    let (mut from, mut to) = ((0.0, first), (1.0, last));
    let (mut before, mut was_above, mut widths) = (f64::INFINITY, None, [f64::INFINITY; 2]);
    for step in 0..STEPS {
        let width = to.0 - from.0;
        if width <= 2.0 * f64::EPSILON {
            break;
        }
        // Bisects if two steps have not halved the interval, for example where the function bends sharply.
        let crawls = width > 0.5 * std::mem::replace(&mut widths[step % 2], width);
        let secant = if crawls { 0.5 } else { -from.1 / divisor(to.1 - from.1) };
        let share = (from.0 + width * secant).clamp(from.0 + f64::EPSILON, to.0 - f64::EPSILON);
        let value = at(share);
        if value == 0.0 || (share - before).abs() <= f64::EPSILON {
            return share;
        }
        let is_above = value > 0.0;
        let stays = if was_above == Some(is_above) { 0.5 } else { 1.0 };
        if is_above {
            (to, from.1) = ((share, value), stays * from.1);
        } else {
            (from, to.1) = ((share, value), stays * to.1);
        }
        (before, was_above) = (share, Some(is_above));
    }
    0.5 * (from.0 + to.0)
}

/// Search for the minimum translation of a segment out of a frustum.
///
/// Let h be the support function of the frustum and n a unit vector. When the segment is translated along n,
/// an end p of it leaves the frustum after the length h(n) − n·p. The whole segment leaves after the larger
/// of these lengths of its two ends. At the minimum over n, one of two things holds:
///
/// * One end leaves last: through an end face, or through the nearest generator of the lateral surface.
/// * Both ends leave together: then n is perpendicular to the segment.
struct TranslationSearch<'a> {
    segment: &'a [Vec3; 2],
    frustum: &'a Frustum,
    best: Approach,
}

impl<'a> TranslationSearch<'a> {
    fn new(segment: &'a [Vec3; 2], frustum: &'a Frustum) -> Self {
        let best = Approach { distance: f64::NEG_INFINITY, normal_b: frustum.axis };
        Self { segment, frustum, best }
    }

    fn shortest(mut self) -> Approach {
        let axis = self.frustum.axis;
        self.offer(&-axis);
        self.offer(&axis);
        for end in self.segment {
            let arm = end - self.frustum.ends[0];
            let across = arm - axis * axis.dot(&arm);
            // Orthogonalised twice, because the rounding error of a short vector is relatively large.
            let across = across - axis * axis.dot(&across);
            let aside = across.norm();
            // From a point on the axis, the translation through the lateral surface has the same length in
            // all directions, so any of them is taken.
            let [wall_along, wall_aside] = self.frustum.wall;
            let away = if aside > 0.0 {
                across * (wall_aside / aside.max(f64::MIN_POSITIVE))
            } else {
                any_perpendicular(&axis) * wall_aside
            };
            self.offer(&(axis * wall_along + away).normalize());
        }
        self.offer_across();
        self.best
    }

    /// Keeps the translation along a unit vector if it is shorter than the best one.
    fn offer(&mut self, normal: &Vec3) {
        let [one, other] = self.segment.map(|end| normal.dot(&end));
        let distance = one.min(other) - self.frustum.support(normal);
        if distance > self.best.distance {
            self.best = Approach { distance, normal_b: *normal };
        }
    }

    /// Tries translations perpendicular to the segment. Seen along the segment, the frustum is the convex
    /// hull of two ellipses (its end discs), and the segment is a point. So the minimum translation leads out
    /// of one ellipse, or is along a direction in which both ellipses extend equally far.
    fn offer_across(&mut self) {
        let along = (self.segment[1] - self.segment[0]).normalize();
        let first = self.first_across(&along);
        for end in [0, 1] {
            for toward in [first, -first] {
                if let Some(normal) = self.least_of_end(end, &along, &toward) {
                    self.offer(&normal);
                }
            }
        }
        for normal in self.lateral_normals(&along).into_iter().flatten() {
            self.offer(&normal);
        }
    }

    /// Returns the direction that minimises the translation out of the ellipse of end `end`, among the
    /// directions perpendicular to the segment and within 90° of `toward`. `toward` is a direction of the
    /// ellipse's short axis. `None` if there is no minimum.
    ///
    /// Let t be the tangent of the angle from `toward`, p (`short`) and ρ (`radius`) the short and the long
    /// semi-axis, and (x, y) the ellipse's centre relative to the segment, with x along `toward`. The
    /// derivative of the translation has the sign of y + g(t) with g(t) = (ρ² − p²)·t/√(p² + ρ²t²) − x·t,
    /// where ρ² − p² is `stretch`. The function g is odd, and concave for t > 0. So Newton's method for g(t)
    /// = |y|, started at 0, never passes the first root. The minimum is at this root, on the side opposite to
    /// y.
    fn least_of_end(&self, end: usize, along: &Vec3, toward: &Vec3) -> Option<Vec3> {
        const STEPS: usize = 60;
        /// Tangent of a right angle, within rounding.
        const FAR: f64 = 1.0 / f64::EPSILON;
        let (axis, radius) = (self.frustum.axis, self.frustum.radii[end]);
        let sideways = along.cross(toward);
        let center = self.frustum.ends[end] - self.segment[0];
        let (x, y) = (center.dot(toward), center.dot(&sideways));
        let (slant, short) = (axis.dot(toward), radius * axis.dot(along).abs().max(f64::EPSILON));
        let stretch = radius * slant * radius * slant;
        let mut tangent = 0.0;
        for _ in 0..STEPS {
            let aside = radius * tangent;
            let root = (short * short + aside * aside).sqrt().max(f64::MIN_POSITIVE);
            let missing = y.abs() - (stretch * tangent / root - x * tangent);
            let flatness = short / root;
            let slope = stretch / root * (flatness * flatness) - x;
            if missing <= 0.0 {
                break;
            }
            if slope * FAR <= missing {
                if x > 0.0 {
                    return None;
                }
                tangent = FAR;
                break;
            }
            let step = missing / slope.max(f64::MIN_POSITIVE);
            tangent += step;
            if step <= f64::EPSILON * tangent {
                break;
            }
        }
        Some(unit(toward - sideways * (tangent * y.signum())))
    }

    /// Returns the direction, perpendicular to the segment, from which angles are measured: the short axis of
    /// the ellipses. If the ellipses are circles, it is the direction from the frustum to the segment, so
    /// that rotating both together changes no result.
    fn first_across(&self, along: &Vec3) -> Vec3 {
        let across = |v: &Vec3| v - along * along.dot(v);
        let arm = self.segment[0] - self.frustum.ends[0];
        for (v, least) in [(self.frustum.axis, 1e-9), (arm, 1e-9 * arm.norm())] {
            let part = across(&v);
            if part.norm() > least {
                // Orthogonalised twice, because the rounding error of a short vector along the segment is
                // relatively large.
                return unit(across(&unit(part)));
            }
        }
        any_perpendicular(along)
    }

    /// Returns the two normals of the lateral surface that are perpendicular to the segment; both end circles
    /// extend equally far along them. `None` if there are none.
    fn lateral_normals(&self, along: &Vec3) -> Option<[Vec3; 2]> {
        let across = self.frustum.axis - along * along.dot(&self.frustum.axis);
        // Clamped, so that the divisor is not zero even if a compiler divides before the check.
        let length = across.norm().max(ROUNDING);
        // If the axis is parallel to the segment, the end circles extend equally far in all directions or in
        // none, so no two normals stand out.
        if length <= ROUNDING {
            return None;
        }
        // Orthogonalised twice, because the rounding error of a short vector along the segment is relatively
        // large.
        let toward = across / length;
        let toward = unit(toward - along * along.dot(&toward));
        let share = self.frustum.wall[0] / length;
        let aside = 1.0 - share * share;
        if aside <= 0.0 {
            return None;
        }
        let sideways = along.cross(&toward) * aside.max(0.0).sqrt();
        Some([1.0, -1.0].map(|sign| unit(toward * share + sideways * sign)))
    }
}

/// Normalises a non-zero vector. The length is clamped because a compiler may divide before the caller's
/// check for zero.
fn unit(v: Vec3) -> Vec3 {
    v / v.norm().max(f64::MIN_POSITIVE)
}
