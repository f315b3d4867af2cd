//! Distance between the axis of a two-ended body and a round solid, or their minimum translation if they
//! overlap (docs/theory.md, 2.8).

use super::Feature;
use super::circles::Circle;
use super::round_surface::{Nearest, ROUNDING, nearest_on_segment, of_capsule, of_frustum};
use crate::primitive::{Capsule, Frustum};
use crate::{Vec3, any_perpendicular, divisor};

/// Separation of a segment and a solid: nearest points, or minimum translation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Approach {
    /// Distance, m; if negative, minus the length of the minimum translation that takes the segment out.
    pub distance: f64,
    /// Unit vector from the solid to the segment; in overlap, the direction of the minimum translation.
    pub normal_b: Vec3,
    /// Nearest, or in overlap deepest, point of the segment, m.
    pub place_b: Vec3,
    /// Feature of the solid that is touched.
    pub feature: Feature,
}

/// Round convex solid, as B of a two-ended body.
pub(crate) trait RoundSolid {
    /// Nearest point of the surface to an end of a segment.
    fn nearest(&self, end: usize, segment: &[Vec3; 2]) -> Nearest;

    /// Separation of a segment and the solid.
    fn approach(&self, segment: &[Vec3; 2]) -> Approach;

    /// Separation of a segment and an end of the solid: a ball or a disc. `None` if their distance certainly
    /// exceeds `reach` (m).
    fn approach_end(&self, end: usize, segment: &[Vec3; 2], reach: f64) -> Option<Approach>;

    /// Vector from end 0 to end 1, of any length.
    fn axis(&self) -> Vec3;
}

impl RoundSolid for Capsule {
    fn nearest(&self, end: usize, segment: &[Vec3; 2]) -> Nearest {
        self.nearest_of(&segment[end], segment)
    }

    fn approach(&self, segment: &[Vec3; 2]) -> Approach {
        let at = nearest_to_segment(segment, &self.ends);
        let Nearest { distance, normal_b, feature } = self.nearest_of(&at, segment);
        Approach { distance, normal_b, place_b: at, feature }
    }

    fn approach_end(&self, end: usize, segment: &[Vec3; 2], _reach: f64) -> Option<Approach> {
        let center = self.ends[end];
        let place = nearest_on_segment(&center, segment);
        let arm = place - center;
        let distance = arm.norm();
        let normal = if self.is_in_axis(distance, &place) {
            self.across(segment).unwrap_or_else(|| any_perpendicular(&(segment[1] - segment[0]).normalize()))
        } else {
            (arm / distance).normalize()
        };
        Some(Approach {
            distance: distance - self.radius,
            normal_b: normal,
            place_b: place,
            feature: Feature::WHOLE,
        })
    }

    fn axis(&self) -> Vec3 {
        self.ends[1] - self.ends[0]
    }
}

impl Capsule {
    /// Nearest point of the surface to a point of a segment. If the axes cross, or one ends in the other, the
    /// normal is perpendicular to both.
    fn nearest_of(&self, place: &Vec3, segment: &[Vec3; 2]) -> Nearest {
        let nearest = of_capsule(place, self);
        let crosses = self.is_in_axis(nearest.distance + self.radius, place);
        let across = if crosses { self.across(segment) } else { None };
        Nearest { normal_b: across.unwrap_or(nearest.normal_b), ..nearest }
    }

    /// Returns `true` if a point at this distance from the axis is on it up to rounding: the direction from
    /// the axis is then noise.
    fn is_in_axis(&self, distance: f64, place: &Vec3) -> bool {
        distance <= 64.0 * f64::EPSILON * place.amax().max(self.ends[0].amax()).max(self.ends[1].amax())
    }

    /// Unit vector perpendicular to both axes, if they are not parallel. It rotates with the bodies.
    fn across(&self, segment: &[Vec3; 2]) -> Option<Vec3> {
        let along = [segment[1] - segment[0], self.axis()];
        let across = along[0].cross(&along[1]);
        let least = f64::EPSILON * along[0].norm_squared() * along[1].norm_squared();
        (across.norm_squared() > least).then(|| across.normalize())
    }
}

/// Point of a segment nearest to another segment. For parallel segments, any of the nearest points.
fn nearest_to_segment(segment: &[Vec3; 2], other: &[Vec3; 2]) -> Vec3 {
    let mut best = (f64::INFINITY, segment[0]);
    let mut offer = |place: Vec3, on_other: &Vec3| {
        let square = (place - on_other).norm_squared();
        if square < best.0 {
            best = (square, place);
        }
    };
    if let Some((place, on_other)) = common_perpendicular(segment, other) {
        offer(place, &on_other);
    }
    segment.iter().for_each(|end| offer(*end, &nearest_on_segment(end, other)));
    other.iter().for_each(|end| offer(nearest_on_segment(end, segment), end));
    best.1
}

/// End points of the common perpendicular of two segments, if both lie between the ends.
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

impl RoundSolid for Frustum {
    fn nearest(&self, end: usize, segment: &[Vec3; 2]) -> Nearest {
        of_frustum(&segment[end], self)
    }

    fn approach(&self, segment: &[Vec3; 2]) -> Approach {
        /// Relative distance below which a segment counts as inside; for a disc no distance can be negative.
        const INSIDE: f64 = 1e-13;
        let inside = INSIDE * self.length.max(self.radii[0]).max(self.radii[1]);
        let (place, nearest) = least_on_segment(segment, inside, |place| of_frustum(place, self));
        if nearest.distance > inside {
            let Nearest { distance, normal_b, feature } = nearest;
            return Approach { distance, normal_b, place_b: place, feature };
        }
        WayOut::new(segment, self).shortest()
    }

    fn approach_end(&self, end: usize, segment: &[Vec3; 2], reach: f64) -> Option<Approach> {
        /// Relative to the coordinates: far above rounding.
        const SLACK: f64 = 1e-9;
        let (center, disc) = (self.ends[end], self.disc(end));
        let [one, other] = segment.map(|place| self.axis.dot(&(place - center)));
        let slack = SLACK * (segment[0].amax() + segment[1].amax() + center.amax() + reach);
        if one.min(other) > reach + slack || one.max(other) < -reach - slack {
            return None;
        }
        if one * other < 0.0 {
            // A search along a segment that passes through a disc would converge slowly.
            let through = segment[0] + (segment[1] - segment[0]) * (one / divisor(one - other));
            if (through - center).norm() < disc.radii[0] - slack {
                return Some(WayOut::new(segment, &disc).shortest());
            }
        }
        Some(disc.approach(segment))
    }

    fn axis(&self) -> Vec3 {
        self.axis
    }
}

/// Point of a segment nearest to a convex solid. The distance is convex along the segment, and its slope is
/// the component of the normal along it. The search stops at any point no farther than `enough` (m).
fn least_on_segment(segment: &[Vec3; 2], enough: f64, nearest: impl Fn(&Vec3) -> Nearest) -> (Vec3, Nearest) {
    /// Relative to the segment: slopes up to this count as zero.
    const FLAT: f64 = 4.0 * f64::EPSILON;
    let along = segment[1] - segment[0];
    let flat = FLAT * along.norm();
    let at = |share: f64| {
        let place = segment[0] + along * share;
        (place, nearest(&place))
    };
    let slope_of = |found: &Nearest| found.normal_b.dot(&along);
    let [first, last] = [at(0.0), at(1.0)];
    let [falls, rises] = [slope_of(&first.1), slope_of(&last.1)];
    if falls >= -flat || first.1.distance <= enough {
        return first;
    }
    if rises <= flat || last.1.distance <= enough {
        return last;
    }
    at(sign_change([falls, rises], |share| {
        let found = at(share).1;
        let slope = slope_of(&found);
        if slope.abs() <= flat || found.distance <= enough { 0.0 } else { slope }
    }))
}

/// Zero between 0 and 1 of a function that changes from non-positive to positive, by the secant method with
/// the Illinois rule: the value at an end that is kept for a second time is halved.
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
        // Bisects where the function bends sharply and secants converge slowly.
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
/// Along a unit vector n the translation is max over the ends p of h(n) − n·p, where h is the support
/// function of the frustum. At the minimum either one end alone is last out, through the nearest lateral
/// surface or end face, or both ends are, and then n is perpendicular to the segment.
struct WayOut<'a> {
    segment: &'a [Vec3; 2],
    frustum: &'a Frustum,
    best: Approach,
}

impl<'a> WayOut<'a> {
    fn new(segment: &'a [Vec3; 2], frustum: &'a Frustum) -> Self {
        let best = Approach {
            distance: f64::NEG_INFINITY,
            normal_b: frustum.axis,
            place_b: segment[0],
            feature: Feature::face(2),
        };
        Self { segment, frustum, best }
    }

    fn shortest(mut self) -> Approach {
        let axis = self.frustum.axis;
        self.offer(&-axis, Feature::face(1));
        self.offer(&axis, Feature::face(2));
        for end in self.segment {
            let arm = end - self.frustum.ends[0];
            let across = arm - axis * axis.dot(&arm);
            // Orthogonalised twice: for a short vector, the rounding error along the axis is relatively
            // large.
            let across = across - axis * axis.dot(&across);
            let aside = across.norm();
            // From a point on the axis all directions through the lateral surface are equivalent.
            let [wall_along, wall_aside] = self.frustum.wall;
            let away = if aside > 0.0 {
                across * (wall_aside / aside.max(f64::MIN_POSITIVE))
            } else {
                any_perpendicular(&axis) * wall_aside
            };
            self.offer(&(axis * wall_along + away).normalize(), Feature::face(0));
        }
        self.offer_across();
        self.best
    }

    /// Considers the translation along a unit vector.
    fn offer(&mut self, normal: &Vec3, feature: Feature) {
        let [one, other] = self.segment;
        let place = if normal.dot(&(other - one)) < 0.0 { other } else { one };
        let distance = normal.dot(place) - self.frustum.support(normal);
        if distance > self.best.distance {
            self.best = Approach { distance, normal_b: *normal, place_b: *place, feature };
        }
    }

    /// Considers translations perpendicular to the segment. Seen along the segment, the solid is the convex
    /// hull of two ellipses and the segment is a point. The minimum leads out of one of the ellipses, or is
    /// where both are equally far out.
    fn offer_across(&mut self) {
        let along = (self.segment[1] - self.segment[0]).normalize();
        let first = self.first_across(&along);
        for end in [0, 1] {
            for toward in [first, -first] {
                if let Some(normal) = self.least_of_end(end, &along, &toward) {
                    self.offer_at(&along, &normal);
                }
            }
        }
        for normal in self.jumps(&along).into_iter().flatten() {
            self.offer_at(&along, &normal);
        }
    }

    /// Direction perpendicular to the segment, within 90° of the short axis of an end's ellipse, that
    /// minimises the translation out of the ellipse.
    ///
    /// With t the tangent of the angle from the short axis, ρ and p the semi-axes and (x, y) the centre
    /// relative to the segment, the derivative of the translation has the sign of
    /// y − x·t + (ρ² − p²)·t/√(p² + ρ²t²). Without y it is odd in t and concave for t > 0, so Newton's method
    /// started at 0 never passes the first point where it equals |y|.
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

    /// Direction perpendicular to the segment along the short axis of the ellipses: the reference for angles.
    /// For circles, a direction that rotates with the two bodies, so that no result depends on their pose.
    fn first_across(&self, along: &Vec3) -> Vec3 {
        let across = |v: &Vec3| v - along * along.dot(v);
        let arm = self.segment[0] - self.frustum.ends[0];
        for (v, least) in [(self.frustum.axis, 1e-9), (arm, 1e-9 * arm.norm())] {
            let part = across(&v);
            if part.norm() > least {
                // Orthogonalised twice: for a short vector, the rounding error along the segment is
                // relatively large.
                return unit(across(&unit(part)));
            }
        }
        any_perpendicular(along)
    }

    /// Directions perpendicular to the segment in which both ends of the solid are equally far out.
    fn jumps(&self, along: &Vec3) -> Option<[Vec3; 2]> {
        let across = self.frustum.axis - along * along.dot(&self.frustum.axis);
        // The lower bounds do not change any accepted result: a compiler may move the division and the root
        // before the checks.
        let length = across.norm().max(ROUNDING);
        // For a solid parallel to the segment, both ends are equally far out in all directions or in none.
        if length <= ROUNDING {
            return None;
        }
        // Orthogonalised twice: for a short vector, the rounding error along the segment is relatively large.
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

    /// Farthest point of each end circle along a unit vector.
    fn farthest(&self, normal: &Vec3) -> [Vec3; 2] {
        let across = normal - self.frustum.axis * self.frustum.axis.dot(normal);
        let aside = across.norm();
        let way = if aside > 0.0 { across / aside.max(f64::MIN_POSITIVE) } else { across };
        [0, 1].map(|end| self.frustum.ends[end] + way * self.frustum.radii[end])
    }

    /// Distance along the segment at which the minimum perpendicular translation touches the solid: at the
    /// end of the solid that is farther out. If both are equally far, it is the point of the lateral surface
    /// between them at which the translation has no tendency to rotate; for a segment along the lateral
    /// surface or an end face, the middle of the overlap.
    fn travelled(&self, along: &Vec3, normal: &Vec3, rounding: f64) -> f64 {
        if let Some(middle) = self.middle_over_face(along, normal) {
            return middle;
        }
        let places = self.farthest(normal);
        let [height, other_height] = places.map(|place| normal.dot(&place));
        let [at, other] = places.map(|place| along.dot(&(place - self.segment[0])));
        let length = along.dot(&(self.segment[1] - self.segment[0]));
        if (height - other_height).abs() > rounding {
            return if height > other_height { at } else { other }.clamp(0.0, length);
        }
        let turning = along.cross(normal);
        let [first, last] = places.map(|place| turning.dot(&(place - self.segment[0])));
        if (first - last).abs() <= rounding {
            return 0.5 * (at.clamp(0.0, length) + other.clamp(0.0, length));
        }
        let share = (first / divisor(first - last)).clamp(0.0, 1.0);
        (at + (other - at) * share).clamp(0.0, length)
    }

    /// Distance along the segment to the middle of its part over an end face, if the face is perpendicular to
    /// `normal` and the segment parallel to it: then all points of the face are equally far out.
    fn middle_over_face(&self, along: &Vec3, normal: &Vec3) -> Option<f64> {
        let [one, other] = self.segment;
        let end = usize::from(self.frustum.axis.dot(normal) > 0.0);
        let (center_b, radius) = (self.frustum.ends[end], self.frustum.radii[end]);
        let arm = one - center_b;
        let face = Circle { center_b, axis_b: self.frustum.axis, radius };
        let chord = face.chord(normal, along, &(arm - along * along.dot(&arm)))?;
        let length = along.dot(&(other - one));
        let [first, last] = chord.map(|place| along.dot(&(place - one)).clamp(0.0, length));
        Some(0.5 * (first + last))
    }

    /// Considers a direction in which both ends of the segment are last out, as along the lateral surface,
    /// though rounding may name one.
    fn offer_at(&mut self, along: &Vec3, normal: &Vec3) {
        /// One minus the cosine between directions that differ only by rounding, or by the square root of it.
        const SAME: f64 = 1e-14;
        let [one, other] = self.segment;
        let distance = normal.dot(one) - self.frustum.support(normal);
        // Error of the coordinates, and of directions found by bisection multiplied by both lengths.
        let lengths = (other - one).norm() + self.frustum.length + self.frustum.radii[0];
        let rounding =
            4.0 * ROUNDING * (one.amax().max(other.amax()).max(self.frustum.ends[0].amax()) + lengths);
        if distance > self.best.distance - rounding {
            let place = one + along * self.travelled(along, normal, rounding);
            // Along the lateral surface the two directions in which both ends are equally far out coincide up
            // to rounding.
            let is_known =
                normal.dot(&self.best.normal_b) > 1.0 - SAME && distance <= self.best.distance + rounding;
            let normal_b = if is_known { self.best.normal_b } else { *normal };
            self.best = Approach { distance, normal_b, place_b: place, feature: Feature::face(0) };
        }
    }
}

/// Normalises a vector that is known to be non-zero. The clamp is for compilers that move the division before
/// the check for zero.
fn unit(v: Vec3) -> Vec3 {
    v / v.norm().max(f64::MIN_POSITIVE)
}
