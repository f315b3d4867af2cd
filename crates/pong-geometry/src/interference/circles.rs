//! Search for the directions, perpendicular to an axis, along which two round shapes overlap most
//! (docs/theory.md, 2.8). The shapes are the rim of a rod (segment, capsule or pin) and the wall of a bore,
//! or the side of the rod and the circle of a mouth.

use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Bore, Frustum};

/// Circle in space, with its disc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    /// Centre, m.
    pub center_b: Vec3,
    /// Unit normal of its plane.
    pub axis_b: Vec3,
    /// Radius, m; 0 for a point.
    pub radius: f64,
}

impl Circle {
    /// Returns the point of the disc that is farthest along `direction`, a unit vector. If `direction` is
    /// parallel to the disc's axis, all points are equally far, and the result is the centre.
    pub fn farthest(&self, direction: &Vec3) -> Vec3 {
        /// Length up to which the component of `direction` perpendicular to the axis is rounding.
        const LEAST: f64 = 1e-12;
        self.rim_toward(direction, LEAST).unwrap_or(self.center_b)
    }

    /// Returns the ends of the chord in which a line, projected onto the disc's plane, crosses the disc.
    /// `None` unless all points of the disc are equally far along `direction`. `line` is the unit vector
    /// along the line, parallel to the disc's plane; `beside` is the vector from the disc's centre to the
    /// nearest point of the line.
    pub fn chord(&self, direction: &Vec3, line: &Vec3, beside: &Vec3) -> Option<[Vec3; 2]> {
        /// Length up to which the component of `direction` perpendicular to the axis counts as zero: more
        /// than the tolerance of the searches that find `direction`.
        const LEAST: f64 = 1e-10;
        if self.rim_toward(direction, LEAST).is_some() {
            return None;
        }
        let off = beside - self.axis_b * self.axis_b.dot(beside);
        let half = (self.radius * self.radius - off.norm_squared()).max(0.0).sqrt();
        Some([-half, half].map(|along| self.center_b + off + line * along))
    }

    fn rim_toward(&self, direction: &Vec3, least: f64) -> Option<Vec3> {
        // Twice: rounding leaves a part along the axis, which counts beside a small part across.
        let square = |v: &Vec3| v - self.axis_b * self.axis_b.dot(v);
        let across = square(&square(direction));
        let length = across.norm();
        // Clamped, so that the divisor is not zero even if a compiler divides before it compares.
        (length > least).then(|| self.center_b + across * (self.radius / length.max(least)))
    }
}

/// Distance `depth`, m, by which one shape extends beyond another in a direction. `slope` is its derivative
/// when the direction turns about the axis of the search, m/rad.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    pub depth: f64,
    pub slope: f64,
}

/// Search over all directions perpendicular to the unit vector `about_b`.
pub(super) struct Across {
    pub about_b: Vec3,
    /// First of the directions that the search samples. If possible, it follows from the two shapes, so that
    /// rotating both shapes together changes no result.
    pub first_b: Vec3,
}

const C: f64 = 0.923_879_532_511_286_8;
const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
const E: f64 = 0.382_683_432_365_089_8;
/// Cosine and sine of the first four of sixteen directions in a plane, every 22.5°.
const QUARTER: [(f64, f64); 4] = [(1.0, 0.0), (C, E), (D, D), (E, C)];
const COUNT: usize = 16;

impl Across {
    /// Creates a search that starts in the direction of the first of the `preferred` vectors that is not
    /// parallel to `about`, less its component along `about`. If all are parallel, it starts in an arbitrary
    /// fixed direction.
    pub fn new(about: &Vec3, preferred: &[Vec3]) -> Self {
        /// Length of a perpendicular component, relative to the whole vector, up to which it is rounding.
        const LEAST: f64 = 1e-9;
        let parts = preferred.iter().map(|v| (v - about * about.dot(v), v.norm()));
        let part = parts.into_iter().find(|(part, whole)| part.norm() > LEAST * whole);
        let first = part.map_or_else(|| crate::any_perpendicular(about), |(part, _)| part.normalize());
        // Orthogonalised twice to remove rounding.
        Self { about_b: *about, first_b: (first - about * about.dot(&first)).normalize() }
    }

    fn direction(&self, index: usize) -> Vec3 {
        let second = self.about_b.cross(&self.first_b);
        let (x, y) = QUARTER[index % 4];
        let (x, y) = match index / 4 {
            0 => (x, y),
            1 => (-y, x),
            2 => (-x, -y),
            _ => (y, -x),
        };
        self.first_b * x + second * y
    }

    /// Returns the sixteen directions that the search samples.
    pub fn directions(&self) -> [Vec3; COUNT] {
        std::array::from_fn(|index| self.direction(index))
    }

    /// Returns the directions of the two greatest local maxima of the depth, the deepest first. Each is
    /// refined from a local maximum of sixteen samples; the shapes tested here have no more than two. If
    /// there is no maximum, all directions are equivalent, so the result is the first direction alone.
    pub fn greatest(&self, reach: impl Fn(&Vec3) -> Reach) -> [Option<Vec3>; 2] {
        let directions = self.directions();
        let depths = directions.map(|direction| reach(&direction).depth);
        let mut best: [Option<(f64, Vec3)>; 2] = [None; 2];
        for index in 0..COUNT {
            let (before, after) = ((index + COUNT - 1) % COUNT, (index + 1) % COUNT);
            if depths[index] > depths[before] && depths[index] >= depths[after] {
                let way = turned(&reach, [directions[before], directions[index], directions[after]]);
                let found = Some((reach(&way).depth, way));
                let is_deeper =
                    |than: Option<(f64, Vec3)>| than.is_none_or(|(depth, _)| reach(&way).depth > depth);
                if is_deeper(best[0]) {
                    best = [found, best[0]];
                } else if is_deeper(best[1]) {
                    best[1] = found;
                }
            }
        }
        let ways = best.map(|found| found.map(|(_, way)| way));
        // Without a maximum all directions are equivalent.
        [ways[0].or(Some(self.first_b)), ways[1]]
    }

    /// Returns the direction of the greatest depth.
    pub fn deepest(&self, reach: impl Fn(&Vec3) -> Reach) -> Vec3 {
        self.greatest(reach)[0].unwrap_or(self.first_b)
    }
}

/// Depth on every side of the search's axis. With x = side·mirror, across the axis, it is
/// base + side·offset + radius·√(q₀ + q₁·x + q₂·x²), where the last term is concave in x.
pub(super) struct Depths {
    /// Two perpendicular unit vectors across the axis of the search. The last term is the same on sides that
    /// mirror each other at the first of them.
    pub mirror_b: [Vec3; 2],
    /// Constant part, m.
    pub base: f64,
    /// Components of `offset` along the two vectors of `mirror_b`, m.
    pub offset: [f64; 2],
    /// Radius of the circle that is seen as an ellipse, m; negative if this circle is the outer shape.
    pub radius: f64,
    /// q₀, q₁ and q₂.
    pub square: [f64; 3],
}

/// Side of a contact with its load λ, weight times depth, m.
pub(super) type Loaded = (Vec3, f64);

impl Depths {
    /// Returns the perpendicular vectors for `mirror_b`: the first is the part of `slant` across the axis of the
    /// search, or if there is none, perpendicular to the first direction of the search.
    pub fn mirror(across: &Across, slant: &Vec3) -> [Vec3; 2] {
        /// Sine of the tilt up to which a circle counts as not tilted: it changes depths by less than rounding.
        const LEAST: f64 = 1e-9;
        let about = across.about_b;
        let length = slant.norm();
        if length > LEAST {
            let first = slant / length;
            return [first, about.cross(&first)];
        }
        [across.first_b.cross(&about), across.first_b]
    }

    /// Returns the two sides that share the load of one end (docs/theory.md, 2.8), the deeper first; `None` if the
    /// deepest side carries it alone. `shrinks` is A of the theory.
    pub fn shared(&self, shrinks: f64) -> Option<[Loaded; 2]> {
        let moves = 1.0 - shrinks;
        let x = self.mirrored(shrinks)?;
        let (mean, _) = self.mean(x);
        let y = ((1.0 - x) * (1.0 + x)).sqrt().max(f64::EPSILON);
        let sum = mean / (shrinks + moves * x * x);
        let difference = self.offset[1] / (moves * y);
        if !(mean > 0.0 && difference.abs() < sum) {
            return None;
        }
        let [first, second] = self.mirror_b;
        let deeper = if difference < 0.0 { -1.0 } else { 1.0 };
        Some([deeper, -deeper].map(|sign| (first * x + second * (sign * y), 0.5 * (sum + sign * difference))))
    }

    /// Returns the mean depth of two mirrored sides and its derivative by x.
    fn mean(&self, x: f64) -> (f64, f64) {
        let [q0, q1, q2] = self.square;
        let root = (q0 + x * (q1 + x * q2)).max(0.0).sqrt();
        let slope = self.radius * (q1 + 2.0 * q2 * x) / (2.0 * root.max(f64::EPSILON));
        (self.base + self.offset[0] * x + self.radius * root, self.offset[0] + slope)
    }

    /// Returns the x of the greatest mean²/(A + (1 − A)·x²), if it is between −1 and 1.
    fn mirrored(&self, shrinks: f64) -> Option<f64> {
        /// Enough for double precision: two steps at least halve the remaining interval.
        const STEPS: usize = 110;
        let moves = 1.0 - shrinks;
        let rise = |x: f64| {
            let (mean, slope) = self.mean(x);
            if mean > 0.0 { slope * (shrinks + moves * x * x) - moves * x * mean } else { slope }
        };
        let (mut low, mut high) = ((-1.0, rise(-1.0)), (1.0, rise(1.0)));
        if !(low.1 > 0.0 && high.1 < 0.0) {
            return None;
        }
        let mut was_wide = f64::INFINITY;
        for _ in 0..STEPS {
            let wide = high.0 - low.0;
            if !(low.1 > 0.0 && high.1 < 0.0) || wide <= f64::EPSILON {
                break;
            }
            let crawls = wide > 0.5 * was_wide;
            was_wide = if crawls { f64::INFINITY } else { wide };
            let share = if crawls { 0.5 } else { (low.1 / (low.1 - high.1)).clamp(1e-3, 1.0 - 1e-3) };
            let x = low.0 + wide * share;
            let at = rise(x);
            *(if at > 0.0 { &mut low } else { &mut high }) = (x, at);
        }
        Some(if low.1 <= -high.1 { low.0 } else { high.0 })
    }
}

/// Returns λ, weight times depth (m), of two contacts that act on one spring (docs/theory.md, 2.2). `depths`
/// are in m; `cosine` is that of the angle between the two normals.
pub(super) fn shares(depths: [f64; 2], cosine: f64) -> [f64; 2] {
    let [one, two] = depths.map(|depth| depth.max(0.0));
    let g = cosine.max(0.0);
    if g * one >= two {
        [one, 0.0]
    } else if g * two >= one {
        [0.0, two]
    } else {
        let square = (1.0 - g) * (1.0 + g);
        [(one - g * two) / square, (two - g * one) / square]
    }
}

/// Returns the direction of zero slope, between `before` and `after`, at which the depth is greatest. The
/// depth at `middle` must be no less than at `before` and `after`.
fn turned(reach: &impl Fn(&Vec3) -> Reach, [before, middle, after]: [Vec3; 3]) -> Vec3 {
    /// Enough for double precision: two steps at least halve the remaining interval.
    const STEPS: usize = 110;
    let at_middle = reach(&middle).slope;
    let (mut low, mut high) = if at_middle > 0.0 {
        ((middle, at_middle), (after, reach(&after).slope))
    } else {
        ((before, reach(&before).slope), (middle, at_middle))
    };
    let mut was_wide = f64::INFINITY;
    for _ in 0..STEPS {
        let ((from, rises), (to, falls)) = (low, high);
        let is_wide = (to - from).norm_squared();
        if !(rises > 0.0 && falls < 0.0) || is_wide <= f64::EPSILON * f64::EPSILON {
            break;
        }
        // Bisects if the last secant step has not halved the interval, for example where the slope has a
        // step.
        let crawls = is_wide > 0.25 * was_wide;
        was_wide = if crawls { f64::INFINITY } else { is_wide };
        let share = if crawls { 0.5 } else { (rises / (rises - falls)).clamp(1e-3, 1.0 - 1e-3) };
        let between = (from + (to - from) * share).normalize();
        let slope = reach(&between).slope;
        *(if slope > 0.0 { &mut low } else { &mut high }) = (between, slope);
    }
    if low.1.abs() <= high.1.abs() { low.0 } else { high.0 }
}

/// Least A of docs/theory.md, 2.8: that of a straight hole.
pub(super) const SHRINKS: f64 = 0.5;

/// Returns the component of the unit vector `of` that is perpendicular to the unit vector `axis`.
pub(super) fn tilt(of: &Vec3, axis: &Vec3) -> Vec3 {
    // Twice: rounding leaves a part along the axis, which counts beside a small part across.
    let square = |v: &Vec3| v - axis * axis.dot(v);
    square(&square(of))
}

/// Wall of a bore, extended past its mouths.
pub(super) struct Wall<'a>(pub &'a Bore);

impl Wall<'_> {
    fn hole(&self) -> &Frustum {
        &self.0.hole
    }

    /// Returns the unit normal of the wall that points out of the hole, on the side to which `side` points.
    /// `side` is a unit vector perpendicular to the axis.
    pub fn outward(&self, side: &Vec3) -> Vec3 {
        let [along, aside] = self.hole().wall;
        self.hole().axis * along + side * aside
    }

    /// Returns A of docs/theory.md, 2.8: the part of the load of one side that is the same on all sides.
    pub fn shrinks(&self) -> f64 {
        let [along, _] = self.hole().wall;
        (along * along).max(SHRINKS)
    }

    /// Returns the depths on all sides of a circle with a skin (m) around it.
    pub fn depths(&self, circle: &Circle, skin: f64, across: &Across) -> Depths {
        let (hole, arm) = (self.hole(), circle.center_b - self.hole().ends[0]);
        let [along, aside] = hole.wall;
        // A point has no tilt.
        let tilted = if circle.radius > 0.0 { circle.axis_b } else { hole.axis };
        let (level, slant) = (hole.axis.dot(&tilted), tilt(&tilted, &hole.axis));
        let mirror_b = Depths::mirror(across, &slant);
        let [g0, g1] = [along * level, aside * slant.norm()];
        Depths {
            mirror_b,
            base: skin + along * hole.axis.dot(&arm) - aside * hole.radii[0],
            offset: mirror_b.map(|v| aside * v.dot(&arm)),
            radius: circle.radius,
            square: [(1.0 - g0) * (1.0 + g0), -2.0 * g0 * g1, -g1 * g1],
        }
    }

    /// Returns the distance of the point `place` behind the wall on the given side, m; negative in the hole.
    pub fn height(&self, side: &Vec3, place: &Vec3) -> f64 {
        let [_, aside] = self.hole().wall;
        self.outward(side).dot(&(place - self.hole().ends[0])) - self.hole().radii[0] * aside
    }

    /// Returns the distance of a point's projection onto the wall from end `end` of the wall, m; positive
    /// towards the other end.
    pub fn inside(&self, side: &Vec3, place: &Vec3, end: usize) -> f64 {
        let [along, aside] = self.hole().wall;
        // Unit vector along the wall from end 0 to end 1.
        let forward = self.hole().axis * aside - side * along;
        let rim = self.hole().ends[end] + side * self.hole().radii[end];
        let travelled = forward.dot(&(place - rim));
        if end == 0 { travelled } else { -travelled }
    }

    /// Returns the distance by which a circle extends behind the wall on the given side, with its derivative.
    pub fn reach(&self, circle: &Circle, side: &Vec3) -> Reach {
        let [_, aside] = self.hole().wall;
        let place = circle.farthest(&self.outward(side));
        let turning = self.hole().axis.cross(side) * aside;
        Reach { depth: self.height(side, &place), slope: turning.dot(&(place - self.hole().ends[0])) }
    }

    /// Returns the contact of the wall with a point that has a skin of thickness `skin` (m). `None` if the
    /// skin does not reach the wall, or if the point is behind the wall by at least the bore's thickness.
    pub fn pushed(&self, side: &Vec3, place: &Vec3, skin: f64) -> Option<Interference> {
        let height = self.height(side, place);
        let outward = self.outward(side).normalize();
        (height + skin > 0.0 && height < self.0.thickness).then(|| Interference {
            depth: height + skin,
            normal_b: -outward,
            deepest_b: place + outward * skin,
            feature: Feature::face(0),
        })
    }
}
