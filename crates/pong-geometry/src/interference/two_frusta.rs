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

use super::eight_plates::{descend, energies};
use super::end_disc::UPRIGHT;
use super::least_translation::{Limits, Local, SAME, lattice, newton, offer};
use super::round_surface::of_frustum;
use super::two_ended_round::EndContact;
use super::{Feature, Interference};
use crate::distance::Solid;
use crate::primitive::Frustum;
use crate::simd::LANES;
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
    if !between.meet(&at, [a, b], &center) && Solid::frustum(a).to_within(&Solid::frustum(b), 0.0).is_none() {
        // A plane separates the two, and the search has missed it.
        return [None; 4];
    }
    // U = ½k·Σ(force/k)·depth.
    let force: f64 = at.pressed[0].iter().sum();
    let depth = at.energy / force.max(f64::MIN_POSITIVE);
    [0, 1, 2, 3].map(|index| {
        let (place, pressed) = (between.bodies[0].place(&at.facing[0], index), at.pressed[0][index]);
        let interference =
            Interference { depth, normal_b: normal, deepest_b: place + center, feature: Feature::WHOLE };
        (pressed > 0.0).then_some(EndContact { interference, share: 2.0 * pressed / depth })
    })
}

/// One of the two bodies, seen from the origin of the search.
pub(super) struct Side {
    pub ends: [Vec3; 2],
    pub radii: [f64; 2],
    pub axis: Vec3,
    /// −1 for A, which lies on the plate along −n, and 1 for B.
    pub sign: f64,
}

/// Directions of a body that lies on a plate along one normal.
#[derive(Clone, Copy)]
struct Facing {
    /// Unit vector across the axis, level with the plate.
    around: Vec3,
    /// Unit vector across the axis, towards the normal.
    up: Vec3,
    /// Sine of the angle between axis and normal; at least that of rounding.
    sine: f64,
}

/// Plate of the least energy along one normal.
struct Along {
    /// Twice the energy over the stiffness, m².
    energy: f64,
    /// Depths of the places beyond the plate, per body, m; 0 for those that do not touch.
    pressed: [[f64; 4]; 2],
    facing: [Facing; 2],
}

struct Plate {
    bodies: [Side; 2],
}

impl Side {
    fn new(frustum: &Frustum, center: &Vec3, sign: f64) -> Self {
        let ends = frustum.ends.map(|end| end - center);
        Self { ends, radii: frustum.radii, axis: frustum.axis, sign }
    }

    /// Distance of the places from the origin of the search, m, along an axis of the frame at most.
    pub fn reach(&self) -> f64 {
        (self.ends[0].amax() + self.radii[0]).max(self.ends[1].amax() + self.radii[1])
    }

    #[inline]
    fn facing(&self, n: &Vec3) -> Facing {
        let level = n.cross(&self.axis);
        let sine = level.norm();
        let around =
            if sine > UPRIGHT { level / sine.max(f64::MIN_POSITIVE) } else { any_perpendicular(&self.axis) };
        Facing { around, up: self.axis.cross(&around).normalize(), sine: sine.max(UPRIGHT) }
    }

    /// Arm of a place from the middle of its disc, as a multiple of the vector towards the normal, m. Places 0 and 1 are
    /// those of the two discs nearest to the plate, 2 and 3 those farthest from it.
    #[inline]
    fn arm(&self, index: usize) -> f64 {
        let arm = self.sign * self.radii[index % 2];
        if index < 2 { arm } else { -arm }
    }

    #[inline]
    fn place(&self, facing: &Facing, index: usize) -> Vec3 {
        self.ends[index % 2] + facing.up * self.arm(index)
    }

    /// Heights of the four places along the normal, or `absent` for what the body has not: an apex is one place, not two.
    #[inline]
    fn heights(&self, n: &Vec3, facing: &Facing, absent: f64) -> [f64; 4] {
        let (ends, up) = (self.ends.map(|end| n.dot(&end)), n.dot(&facing.up));
        let far =
            |end: usize| if self.radii[end] > 0.0 { ends[end] + up * self.arm(end + 2) } else { absent };
        [ends[0] + up * self.arm(0), ends[1] + up * self.arm(1), far(0), far(1)]
    }
}

impl Plate {
    /// Returns the plate of the least energy along a unit normal.
    fn along(&self, n: &Vec3) -> Along {
        /// A step ends where no other place begins or ends to touch, which happens eight times at most.
        const STEPS: usize = 12;
        let [a, b] = &self.bodies;
        let facing = [a.facing(n), b.facing(n)];
        // A's places touch the plate if they are below its offset, B's if they are above.
        let low = a.heights(n, &facing[0], f64::INFINITY);
        let high = b.heights(n, &facing[1], f64::NEG_INFINITY);
        let lowest = low.into_iter().fold(f64::INFINITY, f64::min);
        let highest = high.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let mut offset = 0.5 * (lowest + highest);
        if lowest < highest {
            for _ in 0..STEPS {
                let (mut sums, mut counts) = ([0.0; 4], [0.0; 4]);
                for index in 0..4 {
                    let (of_a, of_b) = (offset > low[index], high[index] > offset);
                    let height = |touches: bool, height: f64| if touches { height } else { 0.0 };
                    sums[index] = height(of_a, low[index]) + height(of_b, high[index]);
                    counts[index] = f64::from(u8::from(of_a) + u8::from(of_b));
                }
                let total = |of: [f64; 4]| (of[0] + of[1]) + (of[2] + of[3]);
                let next = total(sums) / f64::max(total(counts), 1.0);
                if next == offset {
                    break;
                }
                offset = next;
            }
        }
        let pressed = [low.map(|low| (offset - low).max(0.0)), high.map(|high| (high - offset).max(0.0))];
        let energy = pressed.iter().flatten().map(|pressed| pressed * pressed).sum();
        Along { energy, pressed, facing }
    }

    /// Returns the normal at which the plate stores least; `None` if a plate separates the bodies.
    fn best_normal(&self, [a, b]: [&Frustum; 2]) -> Option<Vec3> {
        /// Depth, relative to the smallest radius or length, above which the search starts everywhere.
        const SHALLOW: f64 = 0.1;
        /// Cosine above which two of the likely normals lead to one minimum: two minima may be 4° apart.
        const NEAR: f64 = 0.9995;
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
        let best = self.least_from(starts.into_iter(), NEAR)?;
        let size = [a, b].map(|body| body.radii[0].max(body.radii[1]).min(body.length));
        if best.0.sqrt() < SHALLOW * size[0].min(size[1]) {
            return Some(self.descend(&best.1));
        }
        let frame = |axis: &Vec3| {
            let other = axis.cross(&square).try_normalize(1e-9).unwrap_or_else(|| any_perpendicular(axis));
            [*axis, other, axis.cross(&other)]
        };
        let all = lattice(frame(&a.axis)).chain(lattice(frame(&b.axis))).chain([best.1]);
        Some(self.descend(&self.least_from(all, SAME)?.1))
    }

    /// Returns the least energy to which the most promising of `directions` descend in a few steps, and its normal; `None`
    /// if a plate between the two stores nothing. Of directions whose cosine is above `same`, the better one counts.
    fn least_from(&self, mut directions: impl Iterator<Item = Vec3>, same: f64) -> Option<(f64, Vec3)> {
        let mut starts = [(f64::INFINITY, Vec3::zeros()); LANES];
        while let Some(first) = directions.next() {
            let mut normals = [first; LANES];
            normals[1..].iter_mut().zip(directions.by_ref()).for_each(|(lane, normal)| *lane = normal);
            for (energy, normal) in energies(&self.bodies, &normals).into_iter().zip(normals) {
                if energy <= 0.0 {
                    return None;
                }
                offer(&mut starts, (energy, normal), same);
            }
        }
        let normals = starts.map(|(energy, normal)| if energy.is_finite() { normal } else { starts[0].1 });
        let ends = descend(&self.bodies, &normals);
        let least = ends.into_iter().reduce(|least, other| if other.0 < least.0 { other } else { least })?;
        (least.0 > 0.0).then_some(least)
    }

    /// Returns a normal at which the energy is a local minimum, or at which it is zero.
    fn descend(&self, start: &Vec3) -> Vec3 {
        /// Steps, and the longest one, rad.
        const STEPS: usize = 80;
        const FARTHEST: f64 = 0.3;
        let reach = self.bodies[0].reach().max(self.bodies[1].reach());
        newton(start, Limits { steps: STEPS, farthest: FARTHEST, enough: 0.0, known_b: &[] }, |n| {
            let here = self.along(n);
            let (slope_b, bend) = self.derivatives(&here, n);
            Local { value: here.energy, slope_b, bend, less: 0.0, size: here.energy.sqrt() * reach }
        })
    }

    /// Returns `true` if the middle of the load on one body surely lies in the other. `center` is the origin of the search.
    fn meet(&self, at: &Along, [a, b]: [&Frustum; 2], center: &Vec3) -> bool {
        /// Depth, relative to the length of a body, that does not come from rounding.
        const SURELY: f64 = 1e-12;
        let lies_in = |body: usize, other: &Frustum| {
            let load: f64 = at.pressed[body].iter().sum();
            let place = |index: usize| self.bodies[body].place(&at.facing[body], index);
            let moment = (0..4).map(|index| place(index) * at.pressed[body][index]).sum::<Vec3>();
            let middle = moment / load.max(f64::MIN_POSITIVE) + center;
            load > 0.0 && of_frustum(&middle, other).distance < -SURELY * other.length
        };
        lies_in(0, b) || lies_in(1, a)
    }

    /// Returns the derivative of half the energy when the normal turns, in the tangent plane, and the second derivative.
    fn derivatives(&self, at: &Along, n: &Vec3) -> (Vec3, Mat3) {
        let (mut slope, mut bend, mut mixed, mut count) = (Vec3::zeros(), Mat3::zeros(), Vec3::zeros(), 0.0);
        for (body, sign) in [(0, -1.0), (1, 1.0)] {
            let Facing { around, sine, .. } = &at.facing[body];
            let mut turning = 0.0;
            for index in (0..4).filter(|&index| at.pressed[body][index] > 0.0) {
                let (side, pressed) = (&self.bodies[body], at.pressed[body][index]);
                let place = side.place(&at.facing[body], index);
                slope += place * (sign * pressed);
                bend += place * place.transpose();
                // The height of a rim's lowest place bends by the radius over the sine.
                turning += sign * pressed * side.arm(index) / sine;
                mixed -= place;
                count += 1.0;
            }
            bend += around * around.transpose() * turning;
        }
        let along = n.dot(&slope);
        // The best offset follows the normal.
        let bend = bend - mixed * mixed.transpose() / f64::max(count, 1.0) - Mat3::identity() * along;
        (slope - n * along, bend)
    }
}
