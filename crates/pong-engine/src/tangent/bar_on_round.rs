//! Motion of the contacts of a segment or a capsule with a cylinder or a cone (docs/theory.md, 2.8 and 7).
//!
//! The place x of the load follows from a slope that is zero, G(x, q) = n·u + 4x·δ/W = 0, where q is the relative pose:
//! dx = −(∂G/∂q)/(∂G/∂x). A place at an end of the axis stays there.

use super::two_capsules::{MovesAtEnd, MovingLoad, of_end_of_overlap};
use nalgebra::RowVector6;
use pong_geometry::interference::two_ended_round::BarOnFrustum;
use pong_geometry::pose::{displacement_slopes, turn_slopes};

/// Returns the derivatives of the contact at end `end` of the overlap; `radius` is that of A. `None` where the axis passes
/// through what pushes it, which leaves the normal undetermined.
pub(super) fn moves_on_round(bar: &BarOnFrustum<'_>, radius: f64, end: usize) -> Option<MovesAtEnd> {
    let load = bar.load()?;
    let (at, normal, along, spread) = (load.at, load.normal_b, bar.along_b, load.spread());
    let free = bar.turn_of_normal(&load)?;
    let carried = displacement_slopes(&bar.place(at));
    let pull = 4.0 * at / spread;
    let slope = along.transpose() * (free * carried) + normal.transpose() * turn_slopes(&along)
        - normal.transpose() * carried * pull;
    let curvature = along.dot(&(free * along)) + 4.0 * load.depth / (spread * spread);
    let goes = if at.abs() < 0.5 { -slope / curvature } else { RowVector6::zeros() };
    let vector = carried + along * goes;
    let overlap = bar.overlap(&load);
    let load = MovingLoad {
        at,
        goes,
        spread,
        spreads: goes * (8.0 * at),
        depth: -(normal.transpose() * vector),
        normal_b: normal,
        turned: free * vector,
        along_b: along,
        radius,
    };
    let of_overlap =
        overlap.map(|place| of_end_of_overlap(&bar.place(place), &load, place, &bar.away_at(place)));
    Some(load.moves_at_end(end, &overlap, &of_overlap, &bar.place(overlap[end])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tangent::differences::{Sides, moved};
    use pong_geometry::Vec3;
    use pong_geometry::interference::two_ended_round::{EndContact, capsule_frustum, segment_frustum};
    use pong_geometry::primitive::{Capsule, Frustum, LineSegment};
    use pong_testkit::Random;

    /// Depth, normal, place and weight against central differences of the tester: at the wall, at rims and ends, outside
    /// and sunk in, with the load and the overlap at ends of the axis and between.
    #[test]
    fn moves_of_bars_on_cylinders_and_cones() {
        let mut random = Random::new(9, 0, 0);
        let (mut compared, mut differing) = ([0; 2], 0);
        for case in 0..2000 {
            let radii = [random.between(0.1, 0.5), random.between(0.1, 0.5)];
            let b = Frustum::new([-Vec3::z(), Vec3::z()].map(|end| end * random.between(0.1, 0.5)), radii);
            let radius = if random.chance(0.5) { 0.0 } else { random.between(0.05, 0.3) };
            let u = random.vector(0.8);
            let middle = random.direction() * random.between(0.2, 0.8) + u * random.between(-1.0, 1.0);
            let a = Capsule { ends: [middle - u, middle + u], radius };
            let found = |by: f64, k: usize| {
                let a = moved(&a, k, by);
                match radius > 0.0 {
                    true => capsule_frustum(&a, &b),
                    false => segment_frustum(&LineSegment { ends: a.ends }, &b),
                }
            };
            for end in 0..2 {
                let Some(here) = found(0.0, 0)[end] else { continue };
                let bar = BarOnFrustum::new(&a.ends, a.radius, &b);
                let Some(known) = moves_on_round(&bar, a.radius, end) else { continue };
                for k in 0..6 {
                    let Some(sides) = Sides::new(|by| found(by, k)[end]) else { continue };
                    let normal = here.interference.normal_b;
                    let turn = |side: &EndContact| (side.interference.normal_b - normal).norm();
                    let bends = sides.bends(|side| (side.share - here.share).abs());
                    let [low, _, _, high] = sides.all();
                    let leaps = turn(low).max(turn(high)) > 1e-3 || sides.bends(turn);
                    let features = sides.all().map(|side| side.interference.feature);
                    let changes = features.into_iter().any(|feature| feature != here.interference.feature);
                    if here.interference.depth < 0.02 || bends || leaps || changes {
                        differing += 1;
                        continue;
                    }
                    sides.agree(&known, k, &format!("case {case}, {end}: {here:?} {a:?} {b:?}"));
                    compared[usize::from(radius > 0.0)] += 1;
                }
            }
        }
        assert!(compared.iter().all(|&count| count > 1000), "{compared:?} {differing}");
    }
}
