//! Plates between two cylinders or cones along eight normals at a time (docs/theory.md, 2.8; `two_frusta.rs`).

use super::end_disc::UPRIGHT;
use crate::simd::{LANES, Numbers, Simd, Vectors, run_at_level};
use crate::{Vec3, any_perpendicular};

/// One of the two bodies, seen from the origin of the search.
pub(super) struct Side {
    /// Middles of the two discs, m.
    pub ends_b: [Vec3; 2],
    /// Radii of the two discs, m.
    pub radii: [f64; 2],
    /// Unit vector from end 0 to end 1.
    pub axis_b: Vec3,
    /// −1 for A, which lies on the plate along −n, and 1 for B; no unit.
    pub sign: f64,
}

/// Eight unit normals, by coordinates.
type Normals = [[f64; LANES]; 3];

/// Returns the energy of the best plate along each of the normals, twice over the stiffness, m².
pub(super) fn energies(bodies: &[Side; 2], normals: &[Vec3; LANES]) -> [f64; LANES] {
    let normals = &by_coordinates(normals);
    run_at_level!(energies_in_lanes(bodies: [Side; 2], normals: Normals) -> [f64; LANES])
}

/// Most steps of a descent, and the part of the energy that a step must save.
pub(super) type Limits = (usize, f64);

/// Descends from eight normals at once by Newton's method on the unit sphere; returns where each came to, with its energy.
/// All end where one comes to a plate that stores nothing.
pub(super) fn descend(bodies: &[Side; 2], starts: &[Vec3; LANES], limits: &Limits) -> [(f64, Vec3); LANES] {
    type Ends = ([f64; LANES], Normals);
    let starts = &by_coordinates(starts);
    let (energies, [x, y, z]) =
        run_at_level!(descend_in_lanes(bodies: [Side; 2], starts: Normals, limits: Limits) -> Ends);
    std::array::from_fn(|lane| (energies[lane], Vec3::new(x[lane], y[lane], z[lane])))
}

fn by_coordinates(vectors: &[Vec3; LANES]) -> Normals {
    [0, 1, 2].map(|i| vectors.map(|vector| vector[i]))
}

#[inline(always)]
fn energies_in_lanes<S: Simd>(simd: S, bodies: &[Side; 2], normals: &Normals) -> [f64; LANES] {
    Plates::new(simd, bodies).along(Vectors::load(simd, normals)).energy.store()
}

#[inline(always)]
fn descend_in_lanes<S: Simd>(
    simd: S,
    bodies: &[Side; 2],
    starts: &Normals,
    &(steps, enough): &Limits,
) -> ([f64; LANES], Normals) {
    /// Longest step, rad.
    const FARTHEST: f64 = 0.3;
    /// Rounding of the energy, relative to its terms.
    const ROUNDING: f64 = 8.0 * f64::EPSILON;
    let plates = Plates::new(simd, bodies);
    let all = |value: f64| Numbers::splat(simd, value);
    let (zero, one) = (all(0.0), all(1.0));
    let (mut normal, mut damping) = (Vectors::load(simd, starts), zero);
    let mut here = plates.about(normal);
    let mut going = u8::MAX;
    for _ in 0..steps {
        let Local { energy, slope: [along_u, along_v], bend: [uu, uv, vv] } = here;
        let apart = simd.bits(energy.at_least(zero)) & !simd.bits(zero.below(energy));
        let size = energy.sqrt() * all(plates.reach);
        let steep = (along_u * along_u + along_v * along_v).sqrt();
        // What is not convex is curved upward.
        let half = (uu - vv) * all(0.5);
        let least = (uu + vv) * all(0.5) - (half * half + uv * uv).sqrt();
        let floor = size * all(1e-6);
        let raise = damping + (floor - least).larger(zero);
        let (raised_u, raised_v) = (uu + raise, vv + raise);
        let determinant = (raised_u * raised_v - uv * uv).larger(floor * floor);
        let step_u = (uv * along_v - raised_v * along_u).over(determinant);
        let step_v = (uv * along_u - raised_u * along_v).over(determinant);
        let saved = -(step_u * along_u + step_v * along_v);
        going &= simd.bits((size * all(f64::EPSILON)).below(steep));
        going &= simd.bits(saved.at_least(energy * all(enough)));
        if going == 0 || apart != 0 {
            break;
        }
        let length = (step_u * step_u + step_v * step_v).sqrt();
        let shorter = all(FARTHEST).over(length).smaller(one);
        let [u, v] = level_with(normal);
        let next = normal + u * (step_u * shorter) + v * (step_v * shorter);
        let next = next.along(next.norm());
        let there = plates.about(next);
        let noise = size * all(ROUNDING);
        let steep_there = (there.slope[0] * there.slope[0] + there.slope[1] * there.slope[1]).sqrt();
        let flatter = simd.and((energy + noise).at_least(there.energy), steep_there.below(steep));
        let taken = going & (simd.bits(there.energy.below(energy - noise)) | simd.bits(flatter));
        going &= taken | simd.bits(all(f64::EPSILON).below(length));
        let is_taken = simd.mask(taken);
        let more = (damping * all(4.0)).larger((raised_u.abs() + raised_v.abs()) * all(0.1));
        damping = Numbers::select(is_taken, damping * all(0.1), more);
        normal = Vectors::select(is_taken, next, normal);
        here = there.or(is_taken, here);
    }
    (here.energy.store(), normal.store())
}

/// Returns two unit vectors across unit vectors and each other (Duff et al., J. Comput. Graph. Tech. 6(1), 2017).
#[inline(always)]
fn level_with<S: Simd>(n: Vectors<S>) -> [Vectors<S>; 2] {
    let (zero, one) = (n.x.all(0.0), n.x.all(1.0));
    let is_up = n.z.at_least(zero);
    let sign = Numbers::select(is_up, one, -one);
    let share = sign * one.over(one + n.z.abs());
    let product = -(n.x * n.y * share);
    let u = Vectors { x: one - sign * n.x * n.x * share, y: sign * product, z: -(sign * n.x) };
    let v = Vectors { x: product, y: sign - n.y * n.y * share, z: -n.y };
    [u, v]
}

/// One of the two bodies, in all lanes.
struct Body<S: Simd> {
    ends: [Vectors<S>; 2],
    axis: Vectors<S>,
    /// Vector across the axis for normals along it.
    across: Vectors<S>,
    /// Arms of the nearest places, −r for A and r for B.
    arms: [Numbers<S>; 2],
    /// Added to the heights of the farthest places: infinite for an apex, which has none, so that it touches nothing.
    absent: [Numbers<S>; 2],
    sign: Numbers<S>,
}

/// A body along eight normals.
#[derive(Clone, Copy)]
struct Seen<S: Simd> {
    up: Vectors<S>,
    sine: Numbers<S>,
    /// Heights of the places 0 to 3.
    heights: [Numbers<S>; 4],
}

struct Plates<S: Simd> {
    bodies: [Body<S>; 2],
    /// Distance of the places from the origin of the search, m, at most.
    reach: f64,
    simd: S,
}

/// Best plates along eight normals.
struct Along<S: Simd> {
    energy: Numbers<S>,
    pressed: [[Numbers<S>; 4]; 2],
    seen: [Seen<S>; 2],
}

/// Energies, and the derivatives of half of them when the normal turns towards the two vectors of [`level_with`].
#[derive(Clone, Copy)]
struct Local<S: Simd> {
    energy: Numbers<S>,
    slope: [Numbers<S>; 2],
    /// Second derivatives: uu, uv, vv.
    bend: [Numbers<S>; 3],
}

impl<S: Simd> Local<S> {
    /// Returns `self` where the mask is set, otherwise `other`.
    #[inline(always)]
    fn or(self, mask: S::Mask, other: Self) -> Self {
        let of = |a, b| Numbers::select(mask, a, b);
        let ([a, b], [c, d]) = (self.slope, other.slope);
        let ([e, f, g], [h, i, j]) = (self.bend, other.bend);
        Self {
            energy: of(self.energy, other.energy),
            slope: [of(a, c), of(b, d)],
            bend: [of(e, h), of(f, i), of(g, j)],
        }
    }
}

impl<S: Simd> Body<S> {
    #[inline(always)]
    fn new(simd: S, side: &Side) -> Self {
        let all = |value: f64| Numbers::splat(simd, value);
        let [first, last] = side.radii;
        let never = |radius: f64| if radius > 0.0 { 0.0 } else { -side.sign * f64::INFINITY };
        Self {
            ends: [Vectors::splat(simd, &side.ends_b[0]), Vectors::splat(simd, &side.ends_b[1])],
            axis: Vectors::splat(simd, &side.axis_b),
            across: Vectors::splat(simd, &any_perpendicular(&side.axis_b)),
            arms: [all(side.sign * first), all(side.sign * last)],
            absent: [all(never(first)), all(never(last))],
            sign: all(side.sign),
        }
    }

    #[inline(always)]
    fn seen(&self, n: Vectors<S>) -> Seen<S> {
        let level = n - self.axis * n.dot(self.axis);
        let length = level.norm();
        let upright = length.all(UPRIGHT);
        let up = Vectors::select(upright.below(length), level.along(length), self.across);
        let sine = length.larger(upright);
        let middles = [n.dot(self.ends[0]), n.dot(self.ends[1])];
        let rises = [self.arms[0] * sine, self.arms[1] * sine];
        let near = [middles[0] + rises[0], middles[1] + rises[1]];
        let far = [middles[0] - rises[0] + self.absent[0], middles[1] - rises[1] + self.absent[1]];
        Seen { up, sine, heights: [near[0], near[1], far[0], far[1]] }
    }
}

impl<S: Simd> Plates<S> {
    #[inline(always)]
    fn new(simd: S, bodies: &[Side; 2]) -> Self {
        let of_side = |side: &Side| {
            let of_ends = [0, 1].map(|end| side.ends_b[end].amax() + side.radii[end]);
            of_ends[0].max(of_ends[1])
        };
        let reach = of_side(&bodies[0]).max(of_side(&bodies[1]));
        Self { bodies: [Body::new(simd, &bodies[0]), Body::new(simd, &bodies[1])], reach, simd }
    }

    #[inline(always)]
    fn along(&self, n: Vectors<S>) -> Along<S> {
        /// A step ends where no other place begins or ends to touch, which happens eight times at most.
        const STEPS: usize = 12;
        let (zero, one) = (n.x.all(0.0), n.x.all(1.0));
        let seen = [self.bodies[0].seen(n), self.bodies[1].seen(n)];
        let [low, high] = [seen[0].heights, seen[1].heights];
        let lowest = low[0].smaller(low[1]).smaller(low[2].smaller(low[3]));
        let highest = high[0].larger(high[1]).larger(high[2].larger(high[3]));
        let mut offset = (lowest + highest) * n.x.all(0.5);
        let mut pressed = [[zero; 4]; 2];
        for _ in 0..STEPS {
            let (mut over, mut count) = (zero, zero);
            for index in 0..4 {
                let (of_a, of_b) = ((offset - low[index]).larger(zero), (high[index] - offset).larger(zero));
                over = over + (of_a - of_b);
                count = count
                    + (Numbers::select(zero.below(of_a), one, zero)
                        + Numbers::select(zero.below(of_b), one, zero));
                [pressed[0][index], pressed[1][index]] = [of_a, of_b];
            }
            let step = over.over(count.larger(one));
            if self.simd.largest(step.abs().eight()) <= f64::EPSILON * self.reach {
                break;
            }
            offset = offset - step;
        }
        let mut energy = zero;
        for (&of_a, &of_b) in pressed[0].iter().zip(&pressed[1]) {
            energy = energy + (of_a * of_a + of_b * of_b);
        }
        Along { energy, pressed, seen }
    }

    #[inline(always)]
    fn about(&self, n: Vectors<S>) -> Local<S> {
        let Along { energy, pressed, seen } = self.along(n);
        let [u, v] = level_with(n);
        let (zero, one) = (n.x.all(0.0), n.x.all(1.0));
        let (mut slope, mut bend, mut mixed, mut count) = ([zero; 2], [zero; 3], [zero; 2], zero);
        for index in 0..2 {
            let (body, Seen { up, sine, .. }) = (&self.bodies[index], seen[index]);
            let up_level = [u.dot(up), v.dot(up)];
            let mut turning = zero;
            for place in 0..4 {
                let (end, pressed) = (body.ends[place % 2], pressed[index][place]);
                let arm = if place < 2 { body.arms[place] } else { -body.arms[place - 2] };
                let at = [u.dot(end) + up_level[0] * arm, v.dot(end) + up_level[1] * arm];
                let touches = Numbers::select(zero.below(pressed), one, zero);
                let (force, part) = (body.sign * pressed, [at[0] * touches, at[1] * touches]);
                slope = [slope[0] + at[0] * force, slope[1] + at[1] * force];
                bend = [bend[0] + part[0] * at[0], bend[1] + part[0] * at[1], bend[2] + part[1] * at[1]];
                mixed = [mixed[0] + part[0], mixed[1] + part[1]];
                turning = turning + force * arm;
                count = count + touches;
            }
            // The height of a rim's lowest place bends by the radius over the sine, across the axis.
            let (around, turning) = (body.axis.cross(up), turning.over(sine));
            let [a, b] = [u.dot(around), v.dot(around)];
            bend = [bend[0] + a * a * turning, bend[1] + a * b * turning, bend[2] + b * b * turning];
        }
        // The best offset follows the normal; the forces of the two sides are in balance.
        let [a, b] = mixed;
        let each = one.over(count.larger(one));
        let bend = [bend[0] - a * a * each - energy, bend[1] - a * b * each, bend[2] - b * b * each - energy];
        Local { energy, slope, bend }
    }
}
