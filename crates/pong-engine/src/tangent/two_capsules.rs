//! Motion of the contacts of a segment or a capsule with a capsule (docs/theory.md, 2.8 and 7).
//!
//! The places x of the load on the two axes follow from slopes that are zero, G(x, q) = 0, where q is the relative
//! pose: dx = −(∂G/∂x)⁻¹·∂G/∂q. A place at an end of an axis stays there.

use super::moves::Moves;
use nalgebra::{Matrix3x6, RowVector6};
use pong_geometry::interference::two_capsules::{Load, TwoAxes};
use pong_geometry::pose::{displacement_slopes, turn_slopes};
use pong_geometry::{Mat3, Vec3};

/// Derivatives of one of the two contacts with respect to (u, φ).
pub(super) struct MovesAtEnd {
    pub moves: Moves,
    /// Depth by the motion of A at the contact alone.
    pub pressing: RowVector6<f64>,
    /// Weight.
    pub weight: RowVector6<f64>,
}

/// Returns the derivatives of the contact at end `end` of the overlap; `radius` is that of A. `None` where the axes
/// cross, which leaves the normal undetermined.
pub(super) fn moves_at_end(axes: &TwoAxes, radius: f64, end: usize) -> Option<MovesAtEnd> {
    /// Distance of the axes, relative to the depth, below which most digits of the normal are rounding.
    const CROSSING: f64 = 1e-9;
    let load = axes.load()?;
    let Load { at, distance, depth, normal_b: normal, spread } = load;
    if distance < CROSSING * depth {
        return None;
    }
    let [along, back] = axes.along_b;
    let in_plane = Mat3::identity() - normal * normal.transpose();
    let carried = displacement_slopes(&axes.place_a(at[0]));
    let held = Held { normal: in_plane * carried / distance, depth: -(normal.transpose() * carried) };
    let pull = |k: usize| held.depth * (2.0 * at[k] / spread);
    let slopes = [
        along.transpose() * held.normal + normal.transpose() * turn_slopes(&along) + pull(0),
        back.transpose() * held.normal + pull(1),
    ];
    let places = follow(&load.curvature(axes), &at, &slopes);
    let vector = carried + along * places[0] + back * places[1];
    let turned = in_plane * vector / distance;
    let spreads = (places[0] * at[0] + places[1] * at[1]) * 4.0;

    let overlap = axes.overlap(&load);
    let load = MovingLoad {
        at: at[0],
        goes: places[0],
        spread,
        spreads,
        depth: -(normal.transpose() * vector),
        normal_b: normal,
        turned,
        along_b: along,
        radius,
    };
    let of_overlap =
        overlap.map(|place| of_end_of_overlap(&axes.place_a(place), &load, place, &axes.away_at(place)));
    Some(load.moves_at_end(end, &overlap, &of_overlap, &axes.place_a(overlap[end])))
}

/// A load on A's axis with its derivatives.
pub(super) struct MovingLoad {
    /// Its place on A's axis, −½…½, and the derivatives.
    pub at: f64,
    pub goes: RowVector6<f64>,
    /// W and its derivatives.
    pub spread: f64,
    pub spreads: RowVector6<f64>,
    /// Derivatives of the depth.
    pub depth: RowVector6<f64>,
    /// Normal and its derivatives.
    pub normal_b: Vec3,
    pub turned: Matrix3x6<f64>,
    /// Vector along A's axis, m.
    pub along_b: Vec3,
    /// Radius of A, m.
    pub radius: f64,
}

impl MovingLoad {
    /// Returns the derivatives of the contact at end `end` of the overlap, which is at `place_b`, m.
    pub fn moves_at_end(
        &self,
        end: usize,
        overlap: &[f64; 2],
        of_overlap: &[RowVector6<f64>; 2],
        place_b: &Vec3,
    ) -> MovesAtEnd {
        let (length, lengthens) = (overlap[1] - overlap[0], of_overlap[1] - of_overlap[0]);
        // The share of this end is its lever over the length of the overlap.
        let (share, of_share) = if length > 0.0 {
            let other = 1 - end;
            let sign = if end == 1 { 1.0 } else { -1.0 };
            let share = sign * (self.at - overlap[other]) / length;
            (share, ((self.goes - of_overlap[other]) * sign - lengthens * share) / length)
        } else {
            (0.5, RowVector6::zeros())
        };
        let at_contact = displacement_slopes(place_b);
        let deepest = at_contact + self.along_b * of_overlap[end] - self.turned * self.radius;
        MovesAtEnd {
            pressing: -(self.normal_b.transpose() * at_contact),
            moves: Moves { depth: self.depth, normal: self.turned, deepest },
            weight: (of_share - self.spreads * (share / self.spread)) * (2.0 / self.spread),
        }
    }
}

/// Derivatives of the load with its places held.
struct Held {
    normal: Matrix3x6<f64>,
    depth: RowVector6<f64>,
}

/// Derivatives of the places of the load.
fn follow(curvature: &[[f64; 2]; 2], at: &[f64; 2], slopes: &[RowVector6<f64>; 2]) -> [RowVector6<f64>; 2] {
    let [[own, cross], [_, other]] = *curvature;
    let none = RowVector6::zeros();
    match at.map(|place| place.abs() < 0.5) {
        [true, true] => {
            let square = own * other - cross * cross;
            [(slopes[1] * cross - slopes[0] * other) / square, (slopes[0] * cross - slopes[1] * own) / square]
        }
        [true, false] => [-slopes[0] / own, none],
        [false, true] => [none, -slopes[1] / other],
        [false, false] => [none; 2],
    }
}

/// Derivatives of an end of the overlap: where A's axis leaves the reach of B in the direction `away`, at an end of the axis,
/// or at the load. `place` is its place on the axis, `place_b` the point, m.
pub(super) fn of_end_of_overlap(
    place_b: &Vec3,
    load: &MovingLoad,
    place: f64,
    away: &Vec3,
) -> RowVector6<f64> {
    let rate = away.dot(&load.along_b);
    if place.abs() >= 0.5 || rate == 0.0 {
        return RowVector6::zeros();
    }
    if place == load.at {
        return load.goes;
    }
    -(away.transpose() * displacement_slopes(place_b)) / pong_geometry::divisor(rate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tangent::differences::{Sides, moved};
    use pong_geometry::interference::two_capsules::capsule_capsule;
    use pong_geometry::primitive::Capsule;
    use pong_testkit::Random;

    /// Depth, normal, place and weight against central differences of the tester: in the middle of both axes, with
    /// places at ends, and with the overlap at ends.
    #[test]
    fn moves_of_two_capsules() {
        let mut random = Random::new(8, 0, 0);
        let mut compared = 0;
        for case in 0..2000 {
            let radii = [random.between(0.05, 0.3), random.between(0.05, 0.3)];
            let (u, v) = (random.vector(0.6), random.vector(0.6));
            let middle = u * random.between(-1.1, 1.1)
                + v * random.between(-1.1, 1.1)
                + random.direction() * (0.95 * (radii[0] + radii[1]));
            let b = Capsule { ends: [-v, v], radius: radii[1] };
            let a = Capsule { ends: [middle - u, middle + u], radius: radii[0] };
            let found = |by: f64, k: usize| capsule_capsule(&moved(&a, k, by), &b);
            for end in 0..2 {
                let Some(here) = found(0.0, 0)[end] else { continue };
                let axes = TwoAxes::new(&a.ends, a.radius, &b);
                let Some(known) = moves_at_end(&axes, a.radius, end) else { continue };
                for k in 0..6 {
                    let Some(sides) = Sides::new(|by| found(by, k)[end]) else { continue };
                    let bends = sides.bends(|side| (side.share - here.share).abs());
                    if here.interference.depth < 0.02 || bends {
                        continue;
                    }
                    sides.agree(&known, k, &format!("case {case}, {end}"));
                    compared += 1;
                }
            }
        }
        assert!(compared > 2000, "{compared}");
    }
}
