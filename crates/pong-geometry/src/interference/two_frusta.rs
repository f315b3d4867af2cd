//! Cylinder and cone (A) – cylinder and cone (B): a plate between the two (docs/theory.md, 2.8).
//!
//! Each body stands on a rigid plate without weight between them, as on a plane: with half a spring at the lowest and
//! the highest place of each of its two discs, of twice the stiffness of the pair. The plate lies where it stores
//! least: let n be its normal, o its offset, p the places of A and q those of B,
//!
//! ```text
//! U = min over n and o of ½k·(Σ max(0, o − n·p)² + Σ max(0, n·q − o)²)
//! ```
//!
//! Forces and moments of the two sides are then in balance, so that the forces at A's places are the wrench on B as
//! well. For one normal the best offset is a root of a rising piecewise linear function. The normal is found by
//! Newton's method on the unit sphere.

use super::least_translation::{Local, SAME, lattice, least_of_many, newton};
use super::round_surface::of_frustum;
use super::two_ended_round::EndContact;
use super::{Feature, Interference};
use crate::distance::Solid;
use crate::primitive::Frustum;
use crate::{Mat3, Vec3, any_perpendicular};

/// Contacts at A's lowest places of discs 0 and 1, then at the highest; all have the same depth, and their shares of half
/// a spring may exceed 1.
pub type PlateContacts = [Option<EndContact>; 4];

/// Tests two cylinders or cones against each other.
pub fn two_frusta(a: &Frustum, b: &Frustum) -> PlateContacts {
    let center = (a.ends[0] + a.ends[1] + b.ends[0] + b.ends[1]) * 0.25;
    let between = Plate { bodies: [Side::new(a, &center, -1.0), Side::new(b, &center, 1.0)] };
    let Some(normal) = between.best_normal([a, b]) else { return [None; 4] };
    let at = between.along(&normal);
    if at.energy <= 0.0 {
        return [None; 4];
    }
    if !at.meet([a, b], &center) && Solid::frustum(a).to_within(&Solid::frustum(b), 0.0).is_none() {
        // A plane separates the two, and the search has missed it.
        return [None; 4];
    }
    // U = ½k·Σ(force/k)·depth.
    let force: f64 = at.places[0].iter().map(|place| place.pressed).sum();
    let depth = at.energy / force.max(f64::MIN_POSITIVE);
    [0, 1, 2, 3].map(|index| {
        let Place { pressed, place, .. } = at.places[0][index];
        let interference =
            Interference { depth, normal_b: normal, deepest_b: place + center, feature: Feature::WHOLE };
        (pressed > 0.0).then_some(EndContact { interference, share: 2.0 * pressed / depth })
    })
}

/// One of the two bodies, seen from the origin of the search.
struct Side {
    ends: [Vec3; 2],
    radii: [f64; 2],
    axis: Vec3,
    /// −1 for A, which lies on the plate along −n, and 1 for B.
    sign: f64,
}

/// Place of a body at which it may touch the plate.
#[derive(Clone, Copy, Debug)]
struct Place {
    place: Vec3,
    /// Depth beyond the plate, m; 0 if it does not touch.
    pressed: f64,
    /// Second derivative of the height along the normal, in the direction `around` of the disc, m.
    bend: f64,
}

/// Plate of the least energy along one normal.
struct Along {
    /// Twice the energy over the stiffness, m².
    energy: f64,
    places: [[Place; 4]; 2],
    /// Direction in which each disc's lowest place turns, per body.
    around: [Vec3; 2],
}

struct Plate {
    bodies: [Side; 2],
}

impl Side {
    fn new(frustum: &Frustum, center: &Vec3, sign: f64) -> Self {
        let ends = frustum.ends.map(|end| end - center);
        Self { ends, radii: frustum.radii, axis: frustum.axis, sign }
    }

    /// Returns the four places, and the direction around the axis; `pressed` is not set.
    fn places(&self, n: &Vec3) -> ([Place; 4], Vec3) {
        /// Sine of an angle between two unit vectors that can come from rounding alone.
        const UPRIGHT: f64 = 16.0 * f64::EPSILON;
        let level = n.cross(&self.axis);
        let sine = level.norm();
        let around =
            if sine > UPRIGHT { level / sine.max(f64::MIN_POSITIVE) } else { any_perpendicular(&self.axis) };
        // Across the axis towards n.
        let up = self.axis.cross(&around).normalize();
        let at = |index: usize| {
            let (end, lowest) = (index % 2, index < 2);
            let sign = if lowest { self.sign } else { -self.sign };
            let radius = self.radii[end];
            let bend = sign * radius / sine.max(UPRIGHT);
            Place { place: self.ends[end] + up * (sign * radius), pressed: 0.0, bend }
        };
        ([0, 1, 2, 3].map(at), around)
    }

    /// True for a place that the body has: an apex is one place, not two.
    fn has(&self, index: usize) -> bool {
        index < 2 || self.radii[index % 2] > 0.0
    }
}

impl Plate {
    /// Returns the plate of the least energy along a unit normal.
    fn along(&self, n: &Vec3) -> Along {
        /// A step ends where no other place begins or ends to touch, which happens eight times at most.
        const STEPS: usize = 12;
        let [(mut of_a, around_a), (mut of_b, around_b)] = self.bodies.each_ref().map(|side| side.places(n));
        let heights = [&of_a, &of_b].map(|places| places.map(|place| n.dot(&place.place)));
        let has = |body: usize, index: usize| self.bodies[body].has(index);
        let lowest = (0..4).filter(|&i| has(0, i)).map(|i| heights[0][i]).fold(f64::INFINITY, f64::min);
        let highest = (0..4).filter(|&i| has(1, i)).map(|i| heights[1][i]).fold(f64::NEG_INFINITY, f64::max);
        let mut offset = 0.5 * (lowest + highest);
        if lowest < highest {
            for _ in 0..STEPS {
                let (mut sum, mut count) = (0.0, 0.0);
                for (index, (low, high)) in heights[0].iter().zip(&heights[1]).enumerate() {
                    for (body, height, over) in [(0, low, offset - low), (1, high, high - offset)] {
                        if has(body, index) && over > 0.0 {
                            sum += height;
                            count += 1.0;
                        }
                    }
                }
                let next = sum / f64::max(count, 1.0);
                if next == offset {
                    break;
                }
                offset = next;
            }
        }
        let mut energy = 0.0;
        for index in 0..4 {
            let over = [offset - heights[0][index], heights[1][index] - offset];
            for (body, place) in [(0, &mut of_a[index]), (1, &mut of_b[index])] {
                place.pressed = if has(body, index) { over[body].max(0.0) } else { 0.0 };
                energy += place.pressed * place.pressed;
            }
        }
        Along { energy, places: [of_a, of_b], around: [around_a, around_b] }
    }

    /// Returns the normal at which the plate stores least; `None` if a plate separates the bodies.
    fn best_normal(&self, [a, b]: [&Frustum; 2]) -> Option<Vec3> {
        /// Depth, relative to the smallest radius or length, above which the search starts everywhere.
        const SHALLOW: f64 = 0.1;
        /// Cosine above which two of the likely normals lead to one minimum: two minima may be 4° apart.
        const NEAR: f64 = 0.9995;
        /// Steps of a descent.
        const FEW: usize = 24;
        const MANY: usize = 80;
        let first =
            [0.5, 0.0, 1.0].map(|at| of_frustum(&(a.ends[0] + (a.ends[1] - a.ends[0]) * at), b).normal_b);
        let back =
            [0.5, 0.0, 1.0].map(|at| -of_frustum(&(b.ends[0] + (b.ends[1] - b.ends[0]) * at), a).normal_b);
        let square = a.axis.cross(&b.axis).try_normalize(1e-9).unwrap_or(first[0]);
        let likely = [square, -square, a.axis, -a.axis, b.axis, -b.axis];
        let mut starts = [Vec3::zeros(); 12];
        starts[..3].copy_from_slice(&first);
        starts[3..6].copy_from_slice(&back);
        starts[6..].copy_from_slice(&likely);
        if starts.iter().any(|n| self.along(n).energy <= 0.0) {
            return None;
        }
        let energy = |n: &Vec3| self.along(n).energy;
        // Which minimum is the least shows after a few steps; only that one is followed to its bottom.
        let descend = |n: &Vec3| self.descend(n, FEW);
        let best = self.descend(&least_of_many(starts.into_iter(), NEAR, energy, descend)?, MANY);
        let size = [a, b].map(|body| body.radii[0].max(body.radii[1]).min(body.length));
        let depth = self.along(&best).energy.sqrt();
        if depth < SHALLOW * size[0].min(size[1]) {
            return Some(best);
        }
        let frame = |axis: &Vec3| {
            let other = axis.cross(&square).try_normalize(1e-9).unwrap_or_else(|| any_perpendicular(axis));
            [*axis, other, axis.cross(&other)]
        };
        let all = lattice(frame(&a.axis)).chain(lattice(frame(&b.axis))).chain([best]);
        Some(self.descend(&least_of_many(all, SAME, energy, descend)?, MANY))
    }

    /// Returns a normal at which the energy is a local minimum, or at which it is zero, or the one after `steps` steps.
    fn descend(&self, start: &Vec3, steps: usize) -> Vec3 {
        /// Longest step, rad.
        const FARTHEST: f64 = 0.3;
        newton(start, steps, FARTHEST, |n| {
            let here = self.along(n);
            let reach = here.places.iter().flatten().map(|place| place.place.amax()).fold(0.0, f64::max);
            let (slope_b, bend) = here.derivatives(n);
            Local { value: here.energy, slope_b, bend, less: 0.0, size: here.energy.sqrt() * reach }
        })
    }
}

impl Along {
    /// Returns `true` if the middle of the load on one body surely lies in the other. `center` is the origin of the search.
    fn meet(&self, [a, b]: [&Frustum; 2], center: &Vec3) -> bool {
        /// Depth, relative to the length of a body, that does not come from rounding.
        const SURELY: f64 = 1e-12;
        let lies_in = |places: &[Place; 4], other: &Frustum| {
            let load: f64 = places.iter().map(|place| place.pressed).sum();
            let moment = places.iter().map(|place| place.place * place.pressed).sum::<Vec3>();
            let middle = moment / load.max(f64::MIN_POSITIVE) + center;
            load > 0.0 && of_frustum(&middle, other).distance < -SURELY * other.length
        };
        lies_in(&self.places[0], b) || lies_in(&self.places[1], a)
    }

    /// Returns the derivative of half the `energy` when the normal turns, in the tangent plane, and the second derivative.
    fn derivatives(&self, n: &Vec3) -> (Vec3, Mat3) {
        let (mut slope, mut bend, mut mixed, mut count) = (Vec3::zeros(), Mat3::zeros(), Vec3::zeros(), 0.0);
        for (body, sign) in [(0, -1.0), (1, 1.0)] {
            let around = self.around[body] * self.around[body].transpose();
            for Place { place, pressed, bend: radius } in &self.places[body] {
                if *pressed > 0.0 {
                    slope += place * (sign * pressed);
                    bend += place * place.transpose() + around * (sign * pressed * radius);
                    mixed -= place;
                    count += 1.0;
                }
            }
        }
        let along = n.dot(&slope);
        // The best offset follows the normal.
        let bend = bend - mixed * mixed.transpose() / f64::max(count, 1.0) - Mat3::identity() * along;
        (slope - n * along, bend)
    }
}
