//! Line segment and capsule (A) – capsule (B): the two ends of both axes yield (docs/theory.md, 2.8).
//!
//! Let x and y be places on the two axes, −½ at end 0 and ½ at end 1, δ(x, y) the sum of the radii minus the
//! distance between the two places, and W = 1 + 2x² + 2y². With the stiffness k, the stored energy is
//! ½k·max δ²/W. It has one maximum, because δ is concave and √W strictly convex. The force k·δ/W acts there.

use super::axis_approach::nearest_of_segments;
use super::round_surface::nearest_on_segment;
use super::{Feature, Interference};
use crate::primitive::{Capsule, LineSegment};
use crate::{Vec3, any_perpendicular, divisor};

/// Contact of a body with two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndContact {
    /// Point, normal and depth.
    pub interference: Interference,
    /// Part of half a spring that acts in this contact, 0…2, no unit.
    pub share: f64,
}

/// Contacts of a segment or a capsule with a round solid: at the two ends of their overlap on A's axis, which
/// carry the load by the lever rule.
pub type OverlapContacts = [Option<EndContact>; 2];

/// Tests a segment against a capsule.
pub fn segment_capsule(segment: &LineSegment, capsule: &Capsule) -> OverlapContacts {
    contacts(&segment.ends, 0.0, capsule)
}

/// Tests a capsule against a capsule.
pub fn capsule_capsule(a: &Capsule, b: &Capsule) -> OverlapContacts {
    contacts(&a.ends, a.radius, b)
}

fn contacts(ends: &[Vec3; 2], radius: f64, capsule: &Capsule) -> OverlapContacts {
    let axes = TwoAxes::new(ends, radius, capsule);
    let Some(load) = axes.load() else { return [None; 2] };
    let overlap = axes.overlap(&load);
    let shares = lever_shares(&overlap, load.at[0]);
    [0, 1].map(|end| {
        let interference = Interference {
            depth: load.depth,
            normal_b: load.normal_b,
            deepest_b: axes.place_a(overlap[end]) - load.normal_b * radius,
            feature: Feature::WHOLE,
        };
        (shares[end] > 0.0).then(|| EndContact { interference, share: 2.0 * shares[end] / load.spread })
    })
}

/// Returns the fractions of a load at `at` that the two ends of an interval around it carry.
pub(super) fn lever_shares([from, to]: &[f64; 2], at: f64) -> [f64; 2] {
    let second = if from < to { (at - from) / divisor(to - from) } else { 0.5 };
    [1.0 - second, second]
}

/// The axes of two bodies with two ends, in B's frame.
#[derive(Clone, Copy, Debug)]
pub struct TwoAxes {
    ends_a: [Vec3; 2],
    ends_b: [Vec3; 2],
    /// Vector from the middle of B's axis to that of A's, m.
    between: Vec3,
    /// Vector from end 0 to end 1 of A's axis, and from end 1 to end 0 of B's, m: the derivatives of the
    /// vector from the place on B to the place on A.
    pub along_b: [Vec3; 2],
    /// Sum of the radii, m.
    reach: f64,
}

/// Places on two axes at which the load acts, or at which its place is searched.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// Places on A's and B's axis, −½ at end 0, ½ at end 1.
    pub at: [f64; 2],
    /// Distance between the two places, m.
    pub distance: f64,
    /// Depth δ, m.
    pub depth: f64,
    /// Unit vector from B's place to A's.
    pub normal_b: Vec3,
    /// W: the stiffness is divided by it, 1…2.
    pub spread: f64,
}

impl TwoAxes {
    /// Creates the axes of a segment or a capsule, given by its ends and radius, and of a capsule.
    pub fn new(ends: &[Vec3; 2], radius: f64, capsule: &Capsule) -> Self {
        let (a, b) = (ends, &capsule.ends);
        Self {
            ends_a: *ends,
            ends_b: capsule.ends,
            between: 0.5 * ((a[0] - b[0]) + (a[1] - b[1])),
            along_b: [a[1] - a[0], b[0] - b[1]],
            reach: radius + capsule.radius,
        }
    }

    /// Returns a place on A's axis, m.
    pub fn place_a(&self, at: f64) -> Vec3 {
        place_on_axis(&self.ends_a, &self.along_b[0], at)
    }

    /// Returns the load; `None` if the two do not touch.
    pub fn load(&self) -> Option<Load> {
        let [on_a, on_b] = nearest_of_segments(&self.ends_a, &self.ends_b);
        if (on_a - on_b).norm() >= self.reach {
            return None;
        }
        let start = [place_on(&self.ends_a, &on_a), place_on(&self.ends_b, &on_b)];
        let lengths = [self.between, self.along_b[0], self.along_b[1]].map(|v| v.norm());
        let coordinates = self.ends_a.iter().chain(&self.ends_b).map(|end| end.amax());
        let size = coordinates.fold(lengths.iter().sum(), f64::max);
        let visit = |at: [f64; 2]| Visit::new(self, at, size);
        // The place on B at the place on A visited last, and how fast it follows.
        let (mut last, mut rate) = (start, 0.0);
        let found = zero_of_rising(start[0], |first| {
            let second = (last[1] + rate * (first - last[0])).clamp(-0.5, 0.5);
            let visit = zero_of_rising(second, |second| {
                let visit = visit([first, second]);
                (visit.slope(1), visit.curvature[1][1], visit)
            });
            last = visit.load.at;
            let [[own, cross], [_, other]] = visit.curvature;
            rate = if last[1].abs() < 0.5 { -cross / divisor(other) } else { 0.0 };
            (visit.slope(0), own + cross * rate, visit)
        });
        let load = match found.crosses {
            true => Load { normal_b: self.normal_where_axes_cross(&found.load), ..found.load },
            false => found.load,
        };
        (load.depth > 0.0).then_some(load)
    }

    /// Returns the part of A's axis that is less than the sum of the radii away from B's axis, as places
    /// from −½ to ½. It contains the place of the load.
    pub fn overlap(&self, load: &Load) -> [f64; 2] {
        // The axis of A, measured from the load: origin + way·along.
        let (along, back) = (self.along_b[0], self.along_b[1]);
        let origin = self.between + along * load.at[0];
        let reach_squared = self.reach * self.reach;
        let part_in_ball = |center: &Vec3| {
            let arm = origin - center;
            non_positive(along.norm_squared(), along.dot(&arm), arm.norm_squared() - reach_squared)
        };
        let length_squared = back.norm_squared();
        let beside = |v: &Vec3| v - back * (back.dot(v) / length_squared);
        let (across, arm) = (beside(&along), beside(&origin));
        let square = across.norm_squared();
        let is_parallel = square <= f64::EPSILON * f64::EPSILON * along.norm_squared();
        let in_side = match is_parallel {
            true if arm.norm_squared() < reach_squared => Some([f64::NEG_INFINITY, f64::INFINITY]),
            true => None,
            false => non_positive(square, across.dot(&arm), arm.norm_squared() - reach_squared),
        };
        let (rate, height) = (back.dot(&along), back.dot(&origin));
        let beside_axis = in_side.and_then(|part| cut(part, rate, height, 0.5 * length_squared));
        let parts = [part_in_ball(&(0.5 * back)), part_in_ball(&(-0.5 * back)), beside_axis];
        let [from, to] = parts
            .into_iter()
            .flatten()
            .fold([0.0_f64; 2], |[from, to], part| [from.min(part[0]), to.max(part[1])]);
        [(load.at[0] + from).max(-0.5), (load.at[0] + to).min(0.5)]
    }

    /// Returns the unit vector from the point of B's axis nearest to a place on A's axis to this place.
    pub fn away_at(&self, at: f64) -> Vec3 {
        let place = self.place_a(at);
        let arm = place - nearest_on_segment(&place, &self.ends_b);
        arm / arm.norm().max(f64::MIN_POSITIVE)
    }

    /// Returns the normal where the two axes cross: as much along them as the yield of the ends asks for,
    /// the rest across both.
    fn normal_where_axes_cross(&self, load: &Load) -> Vec3 {
        let [u, v] = &self.along_b;
        let across = u.cross(v);
        let [uu, vv, uv] = [u.norm_squared(), v.norm_squared(), u.dot(v)];
        let needed = load.at.map(|at| -2.0 * load.depth * at / load.spread);
        let square = across.norm_squared();
        let (along, away) = if square > f64::EPSILON * uu * vv {
            let in_plane = u * (vv * needed[0] - uv * needed[1]) + v * (uu * needed[1] - uv * needed[0]);
            (in_plane / square, across.normalize())
        } else {
            (u * (needed[0] / uu), any_perpendicular(&u.normalize()))
        };
        let rest = 1.0 - along.norm_squared();
        (along + away * rest.max(0.0).sqrt()).normalize()
    }
}

/// Two places with the derivatives of the energy there.
struct Visit {
    load: Load,
    /// True if the distance of the two places is only rounding.
    crosses: bool,
    /// Derivatives of −ln(δ/√W) with respect to the places, times δ, m.
    slopes: [f64; 2],
    /// Derivatives of the slopes where these are zero, m.
    curvature: [[f64; 2]; 2],
    /// Slopes that are only rounding, m.
    rounding: [f64; 2],
}

impl Visit {
    fn new(axes: &TwoAxes, at: [f64; 2], size: f64) -> Self {
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        let load = Load::at(axes, at);
        let pulls = at.map(|at| load.pull() * at);
        if load.distance <= 16.0 * ROUNDING * size {
            let slopes = slopes_at_crossing(&axes.along_b, pulls);
            return Self { load, crosses: true, slopes, curvature: [[0.0; 2]; 2], rounding: [0.0; 2] };
        }
        let lean = |k: usize| load.normal_b.dot(&axes.along_b[k]);
        Self {
            load,
            crosses: false,
            slopes: [0, 1].map(|k| lean(k) + pulls[k]),
            curvature: load.curvature(axes),
            rounding: axes.along_b.map(|along| ROUNDING * size / load.distance * along.norm()),
        }
    }

    /// Returns a slope, zero if it is only rounding.
    fn slope(&self, k: usize) -> f64 {
        if self.slopes[k].abs() <= self.rounding[k] { 0.0 } else { self.slopes[k] }
    }
}

/// Returns the slopes where two axes cross. The normal can have any direction there: of these slopes, the second and
/// then the first is as near to zero as the best of the normals makes it.
fn slopes_at_crossing([u, v]: &[Vec3; 2], pulls: [f64; 2]) -> [f64; 2] {
    let length = v.norm();
    let lean = (-pulls[1] / length).clamp(-1.0, 1.0);
    let aside = (1.0 - lean * lean).max(0.0).sqrt() * u.cross(v).norm() / length;
    let first = lean * u.dot(v) / length + pulls[0];
    let rest = (first.abs() - aside).max(0.0);
    let second = if lean.abs() < 1.0 { 0.0 } else { lean * length + pulls[1] };
    [rest.copysign(first), second]
}

impl Load {
    fn at(axes: &TwoAxes, at: [f64; 2]) -> Self {
        let vector = axes.between + axes.along_b[0] * at[0] + axes.along_b[1] * at[1];
        let distance = vector.norm();
        let normal_b = vector / distance.max(f64::MIN_POSITIVE);
        let spread = 1.0 + 2.0 * (at[0] * at[0] + at[1] * at[1]);
        Self { at, distance, depth: axes.reach - distance, normal_b, spread }
    }

    /// Returns 2δ/W: times a place, it is the slope that the yield of the ends adds, m.
    fn pull(&self) -> f64 {
        2.0 * self.depth.max(0.0) / self.spread
    }

    /// Returns the second derivatives of −ln(δ/√W) with respect to the places where the first are zero,
    /// times δ, m.
    pub fn curvature(&self, axes: &TwoAxes) -> [[f64; 2]; 2] {
        let [u, v] = &axes.along_b;
        let leans = [u, v].map(|along| self.normal_b.dot(along));
        let of = |i: usize, j: usize, product: f64| {
            let yields = if i == j { 1.0 } else { 0.0 } - 2.0 * self.at[i] * self.at[j] / self.spread;
            (product - leans[i] * leans[j]) / self.distance.max(f64::EPSILON * axes.reach)
                + self.pull() * yields
        };
        let cross = of(0, 1, u.dot(v));
        [[of(0, 0, u.norm_squared()), cross], [cross, of(1, 1, v.norm_squared())]]
    }
}

/// Returns the place of a point of a segment, −½…½.
fn place_on(ends: &[Vec3; 2], point: &Vec3) -> f64 {
    let along = ends[1] - ends[0];
    (along.dot(&(point - ends[0])) / along.norm_squared() - 0.5).clamp(-0.5, 0.5)
}

/// Returns the place at −½…½ of an axis, m, from the end that is nearer; `along` is the vector from end 0 to end 1.
pub(super) fn place_on_axis(ends: &[Vec3; 2], along: &Vec3, at: f64) -> Vec3 {
    if at <= 0.0 { ends[0] + along * (at + 0.5) } else { ends[1] + along * (at - 0.5) }
}

/// Returns W at a place −½…½ of an axis: a load there has the stiffness k/W.
pub(super) fn spread(at: f64) -> f64 {
    1.0 + 4.0 * at * at
}

/// Returns the place of a load on a plane below which the ends of an axis have these depths, and its depth; one at least is
/// positive.
pub(super) fn load_of(depths: [f64; 2]) -> (f64, f64) {
    match depths {
        [one, other] if other <= 0.0 => (-0.5, one),
        [one, other] if one <= 0.0 => (0.5, other),
        [one, other] => {
            let at = 0.5 * ((other - one) / (one + other));
            (at, 0.5 * (one + other) + at * (other - one))
        }
    }
}

/// Returns what `visit` finds at the zero of a function that rises from −½ to ½, or at the end of the
/// interval nearest to it. `visit` returns the value, an estimate of the derivative, and what it finds. Newton's
/// steps, halving where they do not shrink or leave the interval in which the zero is.
pub(super) fn zero_of_rising<T>(start: f64, mut visit: impl FnMut(f64) -> (f64, f64, T)) -> T {
    const STEPS: usize = 120;
    const ENOUGH: f64 = 2.0 * f64::EPSILON;
    let (mut low, mut high) = (-0.5, 0.5);
    // Ends of the interval at which the value is known.
    let mut known = [false; 2];
    let (mut at, mut steps) = (start, [f64::INFINITY; 2]);
    for _ in 1..STEPS {
        let (value, slope, found) = visit(at);
        if value == 0.0 {
            return found;
        }
        if value > 0.0 {
            (high, known[1]) = (at, true);
        } else {
            (low, known[0]) = (at, true);
        }
        let newton = at - value / divisor(slope);
        // A step that rounding swallows goes just past the zero, or it is at a kink.
        let newton = if (newton - at).abs() < ENOUGH { at - ENOUGH.copysign(value) } else { newton };
        let middle = 0.5 * (low + high);
        let shrinks = (newton - at).abs() <= 0.5 * steps[0];
        let next = if slope <= 0.0 || newton <= low {
            if value > 0.0 && !known[0] { low } else { middle }
        } else if newton >= high {
            if value < 0.0 && !known[1] { high } else { middle }
        } else if shrinks {
            newton
        } else {
            middle
        };
        if (next - at).abs() <= ENOUGH || high - low <= ENOUGH {
            return found;
        }
        steps = [steps[1], (next - at).abs()];
        at = next;
    }
    visit(at).2
}

/// Returns the interval in which square·x² + 2·half·x + rest is not positive, if any.
pub(super) fn non_positive(square: f64, half: f64, rest: f64) -> Option<[f64; 2]> {
    let root = half * half - square * rest;
    (root >= 0.0).then(|| {
        let sum = -half - root.max(0.0).sqrt().copysign(half);
        let one = sum / square;
        let other = if sum == 0.0 { 0.0 } else { rest / divisor(sum) };
        [one.min(other), one.max(other)]
    })
}

/// Returns the part of an interval in which |height + rate·x| is at most `most`.
fn cut([from, to]: [f64; 2], rate: f64, height: f64, most: f64) -> Option<[f64; 2]> {
    if rate == 0.0 {
        return (height.abs() <= most).then_some([from, to]);
    }
    let ends = [-most, most].map(|limit| (limit - height) / divisor(rate));
    let [from, to] = [from.max(ends[0].min(ends[1])), to.min(ends[0].max(ends[1]))];
    (from <= to).then_some([from, to])
}
