//! Errors of a run against the reference.

use crate::sweep::record::{Record, vector};
use serde::{Deserialize, Serialize};

/// Quantity to compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Contact wrench over time.
    Wrench,
    /// Its integral over the run.
    Impulse,
    /// Its greatest size.
    Peak,
    /// Change of kinetic, potential and spring energy over the run.
    Energy,
    /// Final poses of the bodies.
    Pose,
}

impl Quantity {
    /// All quantities, in the order of every table.
    pub const ALL: [Self; 5] = [Self::Wrench, Self::Impulse, Self::Peak, Self::Energy, Self::Pose];

    /// Its name in tables and on the command line.
    pub fn name(self) -> &'static str {
        ["wrench", "impulse", "peak", "energy", "pose"][self as usize]
    }
}

/// Errors of a run, each relative to the scale of its quantity in the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    #[serde(with = "crate::sweep::store::numbers")]
    relative: [f64; 5],
    /// Largest final distance of a body from its position in the reference, m.
    pub position_m: f64,
    /// Greatest angle between a body's final orientation and that in the reference, rad.
    pub angle_rad: f64,
}

impl Errors {
    /// The relative error of one quantity: 0.01 is one per cent. Infinite where the reference is zero.
    pub fn of(&self, quantity: Quantity) -> f64 {
        self.relative[quantity as usize]
    }

    /// The largest error of some quantities.
    pub fn worst(&self, of: &[Quantity]) -> f64 {
        of.iter().map(|quantity| self.of(*quantity)).fold(0.0, f64::max)
    }

    /// Errors from relative errors in the order of [`Quantity::ALL`].
    pub fn new(relative: [f64; 5]) -> Self {
        Self { relative, ..Self::default() }
    }
}

/// Scales for relative errors.
struct Scales {
    force: f64,
    moment: f64,
    force_impulse: f64,
    moment_impulse: f64,
    energy: f64,
    travel: f64,
}

impl Scales {
    /// Moments are relative to the larger of the peak moment and the peak force times a radius of gyration:
    /// bodies with almost no moment would otherwise be judged by rounding errors.
    fn of(reference: &Record, radii: &[f64]) -> Self {
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let radius = most(&mut radii.iter().copied());
        let force = most(&mut reference.peaks.iter().map(|peaks| peaks[0]));
        let force_impulse = most(&mut reference.efforts.iter().map(|efforts| efforts[0]));
        Self {
            force,
            moment: most(&mut reference.peaks.iter().map(|peaks| peaks[1])).max(force * radius),
            force_impulse,
            moment_impulse: most(&mut reference.efforts.iter().map(|efforts| efforts[1]))
                .max(force_impulse * radius),
            energy: reference.energy_scale,
            travel: travel(reference, radii),
        }
    }
}

/// Largest displacement of a body from its start, including rotation (angle times radius of gyration).
fn travel(reference: &Record, radii: &[f64]) -> f64 {
    let mut greatest = 0.0_f64;
    for instant in 0..reference.instants() {
        for (body, radius) in radii.iter().enumerate() {
            let (distance, angle) = apart(reference.row(instant, body), reference.row(0, body));
            greatest = greatest.max(distance + radius * angle);
        }
    }
    greatest
}

/// Distance (m) and angle (rad) between two poses of rows.
fn apart(a: &[f64], b: &[f64]) -> (f64, f64) {
    let distance = (vector(&a[6..]) - vector(&b[6..])).norm();
    let ([w, p @ ..], [v, q @ ..]) = (&a[9..13], &b[9..13]) else { return (distance, 0.0) };
    let (p, q) = (vector(p), vector(q));
    // The rotation from b to a: conjugate of b times a.
    let (real, imaginary) = (w * v + p.dot(&q), p * *v - q * *w - q.cross(&p));
    (distance, 2.0 * libm::atan2(imaginary.norm(), real.abs()))
}

/// The relative error; 0 if both are 0.
fn relative(error: f64, scale: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / scale }
}

/// Errors of a run against the reference. The grid of the reference is that of the run, or a refinement of
/// it. `radii` are radii of gyration of the bodies, m; 0 for those that are not free.
pub(crate) fn errors(run: &Record, reference: &Record, radii: &[f64]) -> Errors {
    let scales = Scales::of(reference, radii);
    let (position_m, pose, angle_rad) = pose(run, reference, radii);
    let relative = [
        wrench(run, reference, &scales),
        impulse(run, reference, &scales),
        peak(run, reference, &scales),
        relative((run.energy_change - reference.energy_change).abs(), scales.energy),
        relative(pose, scales.travel),
    ];
    Errors { relative, position_m, angle_rad }
}

/// Root mean square over time, for the body with the largest one.
fn wrench(run: &Record, reference: &Record, scales: &Scales) -> f64 {
    let stride = (reference.per_frame / run.per_frame) as usize;
    let instants = run.instants().max(2) - 1;
    let mut worst = 0.0_f64;
    for body in 0..run.bodies {
        let mut squares = [0.0; 2];
        for instant in 1..run.instants() {
            let (own, other) = (run.row(instant, body), reference.row(instant * stride, body));
            for (place, square) in squares.iter_mut().enumerate() {
                *square += (vector(&own[3 * place..]) - vector(&other[3 * place..])).norm_squared();
            }
        }
        let [force, moment] = squares.map(|square| (square / instants as f64).sqrt());
        worst = worst.max(relative(force, scales.force)).max(relative(moment, scales.moment));
    }
    worst
}

fn impulse(run: &Record, reference: &Record, scales: &Scales) -> f64 {
    let pairs = run.impulses.iter().zip(&reference.impulses);
    let of_body = |(own, other): (&[f64; 6], &[f64; 6])| {
        let off = |place: usize| (vector(&own[3 * place..]) - vector(&other[3 * place..])).norm();
        relative(off(0), scales.force_impulse).max(relative(off(1), scales.moment_impulse))
    };
    pairs.map(of_body).fold(0.0, f64::max)
}

fn peak(run: &Record, reference: &Record, scales: &Scales) -> f64 {
    let pairs = run.peaks.iter().zip(&reference.peaks);
    let of_body = |(own, other): (&[f64; 2], &[f64; 2])| {
        let off = |place: usize| (own[place] - other[place]).abs();
        relative(off(0), scales.force).max(relative(off(1), scales.moment))
    };
    pairs.map(of_body).fold(0.0, f64::max)
}

/// Largest distance, distance with rotation, and angle, at the end.
fn pose(run: &Record, reference: &Record, radii: &[f64]) -> (f64, f64, f64) {
    let (last, other) = (run.instants() - 1, reference.instants() - 1);
    let mut worst = (0.0_f64, 0.0_f64, 0.0_f64);
    for (body, radius) in radii.iter().enumerate() {
        let (distance, angle) = apart(run.row(last, body), reference.row(other, body));
        worst = (worst.0.max(distance), worst.1.max(distance + radius * angle), worst.2.max(angle));
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.5;

    /// A body pushed with 10 N that moves 1 m in a frame, twice, and ends rotated by `angle` about z.
    fn moved(angle: f64) -> Record {
        let row = |x: f64, angle: f64| {
            let (sine, cosine) = (libm::sin(0.5 * angle), libm::cos(0.5 * angle));
            [10.0, 0.0, 0.0, 0.0, 0.0, 1.0, x, 0.0, 0.0, cosine, 0.0, 0.0, sine]
        };
        Record {
            bodies: 1,
            per_frame: 1,
            rows: [row(0.0, 0.0), row(1.0, 0.0), row(2.0, angle)].concat(),
            impulses: vec![[20.0, 0.0, 0.0, 0.0, 0.0, 4.0]],
            efforts: vec![[20.0, 4.0]],
            peaks: vec![[10.0, 8.0]],
            energy_change: 5.0,
            energy_scale: 50.0,
            incomplete: 0,
        }
    }

    /// With one quantity changed, its error is the difference over the scale, and all others are zero.
    #[test]
    fn every_error_is_the_difference_over_its_scale() {
        let reference = moved(0.4);
        let off = |change: &dyn Fn(&mut Record)| {
            let mut run = reference.clone();
            change(&mut run);
            errors(&run, &reference, &[RADIUS])
        };
        assert_eq!(off(&|_| {}), Errors::default());
        let check = |found: Errors, quantity: Quantity, expected: f64| {
            for other in Quantity::ALL {
                let wanted = if other == quantity { expected } else { 0.0 };
                assert!((found.of(other) - wanted).abs() < 1e-12, "{quantity:?}: {found:?}, not {expected}");
            }
        };
        // One of two instants is off by 5 N, of 10 N; by 6 N·m, of 8 N·m.
        let force = |run: &mut Record| (run.rows[13 + 1], run.rows[13 + 2]) = (3.0, 4.0);
        check(off(&force), Quantity::Wrench, 12.5_f64.sqrt() / 10.0);
        check(off(&|run| run.rows[26 + 5] += 6.0), Quantity::Wrench, 18.0_f64.sqrt() / 8.0);
        // The impulse of moments is relative to that of forces at the radius of gyration: 10 N·m·s.
        check(off(&|run| run.impulses[0][1] = 2.0), Quantity::Impulse, 2.0 / 20.0);
        check(off(&|run| run.impulses[0][5] += 3.0), Quantity::Impulse, 3.0 / 10.0);
        // A peak that is too low is as wrong as one too high.
        check(off(&|run| run.peaks[0][0] -= 1.0), Quantity::Peak, 1.0 / 10.0);
        check(off(&|run| run.peaks[0][1] += 2.0), Quantity::Peak, 2.0 / 8.0);
        check(off(&|run| run.energy_change -= 4.0), Quantity::Energy, 4.0 / 50.0);
        // It moves 2 m and rotates by 0.4 rad at a radius of 0.5 m.
        let displaced = off(&|run| run.rows[26 + 7] = 0.11);
        check(displaced, Quantity::Pose, 0.11 / 2.2);
        assert_eq!((displaced.position_m, displaced.angle_rad), (0.11, 0.0));
        let turned = errors(&moved(0.62), &reference, &[RADIUS]);
        check(turned, Quantity::Pose, 0.22 * RADIUS / 2.2);
        assert!((turned.angle_rad - 0.22).abs() < 1e-15 && turned.position_m == 0.0);
    }

    /// A quaternion and its negative are one orientation.
    #[test]
    fn a_turn_is_measured_the_short_way() {
        let reference = moved(0.4);
        let mut run = moved(0.5);
        run.rows[26 + 9..26 + 13].iter_mut().for_each(|x| *x = -*x);
        let found = errors(&run, &reference, &[RADIUS]);
        assert!((found.angle_rad - 0.1).abs() < 1e-15, "{found:?}");
    }
}
