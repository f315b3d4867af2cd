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
//! Newton's method on the unit sphere, from eight normals at a time (`eight_plates.rs`).

use super::eight_plates::{Limits, Side, descend, energies};
use super::end_disc::UPRIGHT;
use super::least_translation::{SAME, lattice, offer};
use super::round_surface::of_frustum;
use super::two_ended_round::EndContact;
use super::{Feature, Interference};
use crate::distance::Solid;
use crate::primitive::Frustum;
use crate::simd::LANES;
use crate::{Vec3, any_perpendicular};

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
        let (place, pressed) = (between.bodies[0].place(&at.up_b[0], index), at.pressed[0][index]);
        let interference =
            Interference { depth, normal_b: normal, deepest_b: place + center, feature: Feature::WHOLE };
        (pressed > 0.0).then_some(EndContact { interference, share: 2.0 * pressed / depth })
    })
}

/// Plate of the least energy along one normal.
struct Along {
    /// Twice the energy over the stiffness, m².
    energy: f64,
    /// Depths of the places beyond the plate, per body, m; 0 for those that do not touch.
    pressed: [[f64; 4]; 2],
    /// Unit vectors across the axes, towards the normal.
    up_b: [Vec3; 2],
}

struct Plate {
    bodies: [Side; 2],
}

impl Side {
    fn new(frustum: &Frustum, center: &Vec3, sign: f64) -> Self {
        let ends = frustum.ends.map(|end| end - center);
        Self { ends_b: ends, radii: frustum.radii, axis_b: frustum.axis, sign }
    }

    /// Returns the unit vector across the axis, towards a normal.
    #[inline]
    fn up(&self, n: &Vec3) -> Vec3 {
        let level = n.cross(&self.axis_b);
        let sine = level.norm();
        let around = if sine > UPRIGHT {
            level / sine.max(f64::MIN_POSITIVE)
        } else {
            any_perpendicular(&self.axis_b)
        };
        self.axis_b.cross(&around).normalize()
    }

    /// Arm of a place from the middle of its disc, as a multiple of the vector towards the normal, m. Places 0 and 1 are
    /// those of the two discs nearest to the plate, 2 and 3 those farthest from it.
    #[inline]
    fn arm(&self, index: usize) -> f64 {
        let arm = self.sign * self.radii[index % 2];
        if index < 2 { arm } else { -arm }
    }

    #[inline]
    fn place(&self, up: &Vec3, index: usize) -> Vec3 {
        self.ends_b[index % 2] + up * self.arm(index)
    }

    /// Heights of the four places along the normal, or `absent` for what the body has not: an apex is one place, not two.
    #[inline]
    fn heights(&self, n: &Vec3, up: &Vec3, absent: f64) -> [f64; 4] {
        let (ends, up) = (self.ends_b.map(|end| n.dot(&end)), n.dot(up));
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
        let up_b = [a.up(n), b.up(n)];
        // A's places touch the plate if they are below its offset, B's if they are above.
        let low = a.heights(n, &up_b[0], f64::INFINITY);
        let high = b.heights(n, &up_b[1], f64::NEG_INFINITY);
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
        Along { energy, pressed, up_b }
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
            return Some(self.bottom(best.1));
        }
        let frame = |axis: &Vec3| {
            let other = axis.cross(&square).try_normalize(1e-9).unwrap_or_else(|| any_perpendicular(axis));
            [*axis, other, axis.cross(&other)]
        };
        let all = lattice(frame(&a.axis)).chain(lattice(frame(&b.axis))).chain([best.1]);
        Some(self.bottom(self.least_from(all, SAME)?.1))
    }

    /// Returns the normal of the minimum beside a normal.
    fn bottom(&self, normal: Vec3) -> Vec3 {
        const MANY: Limits = (80, 0.0);
        descend(&self.bodies, &[normal; LANES], &MANY)[0].1
    }

    /// Returns the least energy to which the most promising of `directions` descend in a few steps, and its normal; `None`
    /// if a plate between the two stores nothing. Of directions whose cosine is above `same`, the better one counts.
    fn least_from(&self, mut directions: impl Iterator<Item = Vec3>, same: f64) -> Option<(f64, Vec3)> {
        const FEW: Limits = (32, 1e-8);
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
        let ends = descend(&self.bodies, &normals, &FEW);
        // Which minimum is the least shows after a few steps; only that one is followed to its bottom.
        let least = ends.into_iter().reduce(|least, other| if other.0 < least.0 { other } else { least })?;
        (least.0 > 0.0).then_some(least)
    }

    /// Returns `true` if the middle of the load on one body surely lies in the other. `center` is the origin of the search.
    fn meet(&self, at: &Along, [a, b]: [&Frustum; 2], center: &Vec3) -> bool {
        /// Depth, relative to the length of a body, that does not come from rounding.
        const SURELY: f64 = 1e-12;
        let lies_in = |body: usize, other: &Frustum| {
            let load: f64 = at.pressed[body].iter().sum();
            let place = |index: usize| self.bodies[body].place(&at.up_b[body], index);
            let moment = (0..4).map(|index| place(index) * at.pressed[body][index]).sum::<Vec3>();
            let middle = moment / load.max(f64::MIN_POSITIVE) + center;
            load > 0.0 && of_frustum(&middle, other).distance < -SURELY * other.length
        };
        lies_in(0, b) || lies_in(1, a)
    }
}
