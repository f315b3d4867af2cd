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
    use pong_geometry::interference::two_ended_round::{EndContact, capsule_frustum, segment_frustum};
    use pong_geometry::primitive::{Capsule, Frustum, LineSegment};
    use pong_geometry::{Quat, Transform, Vec3};
    use pong_testkit::Random;

    fn moved(a: &Capsule, k: usize, by: f64) -> Capsule {
        let t = Vec3::ith(k % 3, by);
        let (shift, turn) =
            if k < 3 { (t, Quat::identity()) } else { (Vec3::zeros(), Quat::from_scaled_axis(t)) };
        a.carried(&Transform { rotation: turn.to_rotation_matrix().into_inner(), translation: shift })
    }

    /// Depth, normal, place and weight against central differences of the tester: at the wall, at rims and ends, outside
    /// and sunk in, with the load and the overlap at ends of the axis and between.
    #[test]
    fn moves_of_bars_on_cylinders_and_cones() {
        const STEP: f64 = 1e-5;
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
                    let sides = [-2.0, -1.0, 1.0, 2.0].map(|side| found(side * STEP, k)[end]);
                    let [Some(low), Some(less), Some(more), Some(high)] = sides else { continue };
                    let slope = |of: &dyn Fn(&EndContact) -> f64| {
                        (8.0 * (of(&more) - of(&less)) - (of(&high) - of(&low))) / (12.0 * STEP)
                    };
                    let halves = [&high, &low].map(|side| (side.share - here.share).abs());
                    let bends = (halves[0] - halves[1]).abs() > 0.1 * (halves[0] + halves[1]);
                    let turns = [&high, &low]
                        .map(|side| (side.interference.normal_b - here.interference.normal_b).norm());
                    let leaps = turns[0].max(turns[1]) > 1e-3
                        || (turns[0] - turns[1]).abs() > 0.1 * (turns[0] + turns[1]);
                    let features = sides.iter().flatten().map(|side| side.interference.feature);
                    let changes = features.into_iter().any(|feature| feature != here.interference.feature);
                    if here.interference.depth < 0.02 || bends || leaps || changes {
                        differing += 1;
                        continue;
                    }
                    let place = |axis: usize| slope(&|c| c.interference.deepest_b[axis]);
                    let normal = |axis: usize| slope(&|c| c.interference.normal_b[axis]);
                    let off = [
                        known.moves.depth[k] - slope(&|c| c.interference.depth),
                        known.weight[k] - slope(&|c| c.share),
                        (known.moves.normal.column(k) - Vec3::from([0, 1, 2].map(normal))).norm(),
                        (known.moves.deepest.column(k) - Vec3::from([0, 1, 2].map(place))).norm(),
                    ];
                    let limit = 1e-4 * (1.0 + known.weight.amax() + known.moves.deepest.amax());
                    assert!(
                        off.iter().all(|off| off.abs() < limit),
                        "case {case}, {end}, {k}: {off:?} {here:?} {a:?} {b:?}"
                    );
                    compared[usize::from(radius > 0.0)] += 1;
                }
            }
        }
        assert!(compared.iter().all(|&count| count > 1000), "{compared:?} {differing}");
    }
}
