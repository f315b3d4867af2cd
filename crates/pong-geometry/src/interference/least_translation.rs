//! Search for the least translation that separates an ellipsoid (A) from another convex solid (B)
//! (docs/theory.md, 2.6).
//!
//! With the support functions h_A about the centre x of A and h_B, the translation along a unit normal n has the
//! length D(n) = h_A(n) + h_B(n) − n·x. This is the support function of the sum of the two bodies, seen from x, and
//! its gradient G(n) is the point of the sum that is farthest along n. The least D is found by Newton's method on
//! the unit sphere, with the derivatives
//!
//! ```text
//! first: G − D·n,    second: ∇²h_A + ∇²h_B − D    (in the tangent plane)
//! ```
//!
//! Let ρ be the smallest radius of curvature of the ellipsoid. Where D < ρ, D has at most one stationary normal:
//! the ellipsoid is the sum of a ball of radius ρ and a convex body, and the point that the ball's centre would be
//! is outside the sum of the other two. So a minimum below ρ is the least. Otherwise the search starts again from
//! directions spread over the sphere.

use super::ellipsoid_prepared::PreparedEllipsoid;
use crate::{Mat3, Vec3, any_perpendicular};

/// Sum of two bodies along one normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along {
    /// Length of the translation, D, m; negative if the bodies are apart along the normal.
    pub overlap: f64,
    /// Point of the sum farthest along the normal, seen from A's centre, G, m.
    pub farthest_b: Vec3,
    /// Radii of curvature of the sum there, m.
    pub radii: Mat3,
}

/// Part of a body in an [`Along`]: farthest point and radii of curvature.
pub(super) type Part = (Vec3, Mat3);

impl Along {
    /// Adds the parts of an ellipsoid and of another body along the unit normal `n`.
    pub fn new(n: &Vec3, a: &PreparedEllipsoid, (reach, radii): Part) -> Self {
        let (reach_a, radii_a) = a.part(n);
        let farthest_b = reach_a + reach - a.center;
        Self { overlap: n.dot(&farthest_b), farthest_b, radii: radii_a + radii }
    }
}

impl PreparedEllipsoid {
    /// Returns the point farthest along a unit normal, relative to the centre, and the radii of curvature there.
    pub(super) fn part(&self, n: &Vec3) -> Part {
        let widened = self.widened(n);
        let half_width = widened.norm();
        let reach = self.reach(&widened) / half_width;
        let squares = self.widen.iter().map(|w| w * w.transpose()).sum::<Mat3>();
        (reach, (squares - reach * reach.transpose()) / half_width)
    }

    /// Smallest radius of curvature, m.
    pub(super) fn least_radius(&self) -> f64 {
        self.smallest * (self.smallest / self.largest)
    }

    /// Returns directions that are spread over the unit sphere, and as many that are the normals of points spread over
    /// the ellipsoid. They turn with it.
    pub(super) fn directions(&self) -> impl Iterator<Item = Vec3> {
        let sizes = self.widen.map(|w| w.norm());
        let frame = [0, 1, 2].map(|i| self.widen[i] / sizes[i]);
        let narrowed = [0, 1, 2].map(|i| frame[i] / sizes[i]);
        lattice(frame).chain(lattice(narrowed))
    }
}

/// Returns 26 unit vectors: along the vectors of `frame`, and along the sums of two and three of them.
pub(super) fn lattice(frame: [Vec3; 3]) -> impl Iterator<Item = Vec3> {
    const SIGNS: [f64; 3] = [0.0, 1.0, -1.0];
    (1..27).map(move |code| {
        let sum = frame[0] * SIGNS[code % 3] + frame[1] * SIGNS[code / 3 % 3] + frame[2] * SIGNS[code / 9];
        sum.normalize()
    })
}

/// Returns a normal at which D is a local minimum, by descent from `start`, or one beside a minimum of `known`. The descent
/// ends early where the bodies are apart. `along` evaluates D near a normal.
pub(super) fn descend(start: &Vec3, known: &[Vec3], along: impl Fn(&Vec3) -> Along) -> Vec3 {
    newton(start, Limits { steps: 60, farthest: 0.5, enough: 0.0, known_b: known }, |normal| {
        let Along { overlap, farthest_b, radii } = along(normal);
        let size = farthest_b.norm() + radii.amax();
        Local { value: overlap, slope_b: farthest_b - normal * overlap, bend: radii, less: overlap, size }
    })
}

/// Value of a function of a unit vector, and its derivatives when the vector turns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    pub value: f64,
    /// First derivative, in the tangent plane.
    pub slope_b: Vec3,
    /// Second derivative in a direction u of the tangent plane: u·(bend·u) − less.
    pub bend: Mat3,
    pub less: f64,
    /// Size of the terms of which `slope_b` and `bend` are sums; it tells how large rounding is.
    pub size: f64,
}

impl Local {
    /// Returns Newton's step in the tangent plane, and the sum of the two curvatures, to which `damping` is added. A function
    /// that is not convex is curved upward first, so that the step goes downhill.
    pub(super) fn downhill(&self, normal: &Vec3, damping: f64) -> (Vec3, f64) {
        let Self { slope_b, bend, less, size, .. } = self;
        let u = any_perpendicular(normal);
        let v = normal.cross(&u);
        let (of_u, of_v) = (bend * u, bend * v);
        let (uu, uv, vv) = (u.dot(&of_u) - less, u.dot(&of_v), v.dot(&of_v) - less);
        // Smaller eigenvalue: raised to a positive one where the function is not convex.
        let least = 0.5 * (uu + vv) - (0.25 * (uu - vv) * (uu - vv) + uv * uv).sqrt();
        let floor = 1e-6 * size;
        let raise = damping + if least < floor { floor - least } else { 0.0 };
        let (uu, vv) = (uu + raise, vv + raise);
        let (along_u, along_v) = (u.dot(slope_b), v.dot(slope_b));
        // Both eigenvalues are at least the floor, but the difference of large products may be rounding.
        let determinant = (uu * vv - uv * uv).max(floor * floor).max(f64::MIN_POSITIVE);
        let step = u * ((uv * along_v - vv * along_u) / determinant)
            + v * ((uv * along_u - uu * along_v) / determinant);
        (step, uu.abs() + vv.abs())
    }
}

/// Where a search by Newton's method ends.
pub(super) struct Limits<'a> {
    /// Most steps.
    pub steps: usize,
    /// Longest step, rad; longer ones are shortened.
    pub farthest: f64,
    /// A step that would lower the value by less than about this part of it is not taken.
    pub enough: f64,
    /// Minima that are known. A search that comes near one of them ends there.
    pub known_b: &'a [Vec3],
}

/// True beside one of the minima that are known: less than 0.026° away.
fn is_near(known: &[Vec3], normal: &Vec3) -> bool {
    const JOINED: f64 = 1.0 - 1e-7;
    known.iter().any(|minimum| minimum.dot(normal) > JOINED)
}

/// Returns a unit vector at which a function is a local minimum, or at which it is not positive, or where the limits end
/// the search.
pub(super) fn newton(start: &Vec3, limits: Limits<'_>, at: impl Fn(&Vec3) -> Local) -> Vec3 {
    let Limits { steps, farthest, enough, known_b } = limits;
    /// Rounding of the value, relative to the size of its terms.
    const ROUNDING: f64 = 8.0 * f64::EPSILON;
    let (mut normal, mut damping) = (*start, 0.0);
    let mut here = at(&normal);
    for _ in 0..steps {
        let Local { value, slope_b, size, .. } = here;
        if value <= 0.0 || is_near(known_b, &normal) || slope_b.norm() <= f64::EPSILON * size {
            break;
        }
        let (step, curvature) = here.downhill(&normal, damping);
        if -step.dot(&slope_b) < enough * value {
            break;
        }
        let length = step.norm();
        // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
        let shorter = farthest / length.max(f64::MIN_POSITIVE);
        let step = if length > farthest { step * shorter } else { step };
        let next = (normal + step).normalize();
        let there = at(&next);
        let noise = ROUNDING * size;
        // Near the minimum the function is flat to rounding, and the slope decides.
        let flatter = there.value <= value + noise && there.slope_b.norm() < slope_b.norm();
        if there.value < value - noise || flatter {
            (normal, here) = (next, there);
            damping *= 0.1;
        } else if length <= f64::EPSILON {
            break;
        } else {
            damping = (4.0 * damping).max(0.1 * curvature);
        }
    }
    normal
}

/// Cosine above which two directions of a [`lattice`] lead to one minimum.
pub(super) const SAME: f64 = 0.9;

/// Adds a direction to the least ones, with its value. The list is sorted, and of directions whose cosine is above `same`
/// only the better one is in it.
pub(super) fn offer(starts: &mut [(f64, Vec3)], (value, direction): (f64, Vec3), same: f64) {
    let near = starts.iter().position(|(_, other)| other.dot(&direction) > same).unwrap_or(starts.len() - 1);
    if value >= starts[near].0 {
        return;
    }
    let place = starts.iter().position(|(other, _)| value < *other).unwrap_or(near);
    starts[place..=near].rotate_right(1);
    starts[place] = (value, direction);
}

/// Returns the best of the normals to which the most promising of `directions` descend. `overlap` is D,
/// `to_minimum` the descent; it is told the minima that others came to. Of directions whose cosine is above `same`, the
/// better one counts.
pub(super) fn least_of_many(
    directions: impl Iterator<Item = Vec3>,
    same: f64,
    overlap: impl Fn(&Vec3) -> f64,
    to_minimum: impl Fn(&Vec3, &[Vec3]) -> Vec3,
) -> Option<Vec3> {
    /// Number of descents.
    const DESCENTS: usize = 8;
    let mut starts = [(f64::INFINITY, Vec3::zeros()); DESCENTS];
    for direction in directions {
        offer(&mut starts, (overlap(&direction), direction), same);
    }
    let mut known = [Vec3::zeros(); DESCENTS];
    let mut best: Option<(f64, Vec3)> = None;
    for (index, (_, start)) in starts.iter().filter(|(value, _)| value.is_finite()).enumerate() {
        let normal = to_minimum(start, &known[..index]);
        known[index] = normal;
        let value = overlap(&normal);
        // What ended beside a known minimum is not at its bottom, but may be no higher to rounding.
        if best.is_none_or(|(least, _)| value < least) && !is_near(&known[..index], &normal) {
            best = Some((value, normal));
        }
    }
    best.map(|(_, normal)| normal)
}
