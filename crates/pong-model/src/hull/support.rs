//! Supporting plane along a face that is too narrow, or too small, to define its own plane.
//!
//! Rounding moves the vertices of such a face as little as those of a large one, but may turn its plane by
//! any angle, and at a distance the plane would cut into the solid. If the vertices moved by less than the
//! tolerance, a better plane exists: the one before rounding. Among the planes with normal n, the best one
//! has equal distances to the highest vertex p of the solid and to the lowest vertex c of the face, namely
//! half of n·p − n·c. Over the normals near a given one this is a convex function, and its minimum is a
//! linear program in two tilts. It is solved by cutting planes: for each normal tried, the tree of all
//! vertices gives the highest one, and the pair (p, c) is a lower bound for all other normals (Kelley, 1960).

use super::places::Places;
use super::polygon::{mean, unit};
use nalgebra::Matrix3;
use pong_geometry::Vec3;

/// Largest tangent by which a normal is tilted along either axis in one search.
const REACH: f64 = 2.0;
/// Number of searches, each around the normal found by the one before, in case a more distant normal is
/// better.
const TURNS: usize = 4;
/// Tangent of the tilt above which the search is repeated.
const FAR: f64 = 0.25;
/// Length of a unit normal after the largest tilts: 1, 2 and 2 along three axes.
const LONGEST: f64 = 3.0;
/// Maximum number of normals tried in one search; the hardest of the random solids in
/// `tests/it/convex_families.rs` took 36.
const CUTS: usize = 100;
/// Improvement, as a fraction of the tolerance, below which the search ends.
const ENOUGH: f64 = 1e-3;
/// Rounding of a distance, in tolerances: the diameter is a million of them.
const ROUNDING: f64 = 1e-7;

/// Plane: unit normal and offset along it.
pub(super) type Plane = (Vec3, f64);

/// Lower bound of the distance for all tilts, `distance ≥ at + along · tilt`; or a bound of the tilt alone,
/// without the distance.
#[derive(Clone, Copy)]
struct Cut {
    along: [f64; 2],
    at: f64,
    with_distance: bool,
}

impl Cut {
    /// Amount by which a tilt and a distance violate the bound.
    fn missed(&self, [x, y, distance]: [f64; 3]) -> f64 {
        self.at + self.along[0] * x + self.along[1] * y - if self.with_distance { distance } else { 0.0 }
    }

    fn row(&self) -> [f64; 3] {
        [self.along[0], self.along[1], if self.with_distance { -1.0 } else { 0.0 }]
    }
}

/// Linear program: the tilt with the smallest distance that satisfies all cuts.
struct Program {
    cuts: Vec<Cut>,
    /// Both tilts and the distance.
    lowest: [f64; 3],
}

impl Program {
    /// Starts with the limits of the tilts and a non-negative distance.
    fn new() -> Self {
        let bound = |along| Cut { along, at: -REACH, with_distance: false };
        let mut cuts = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(bound).to_vec();
        cuts.push(Cut { along: [0.0; 2], at: 0.0, with_distance: true });
        Self { cuts, lowest: [0.0; 3] }
    }

    /// Adds a cut. Returns `false` if no minimum is left, which means that the precision is exhausted.
    ///
    /// If the cut excludes the previous minimum, the new minimum lies on this cut and on two of the other
    /// cuts.
    fn add(&mut self, cut: Cut) -> bool {
        if cut.missed(self.lowest) > ROUNDING {
            let mut lowest: Option<[f64; 3]> = None;
            for (index, first) in self.cuts.iter().enumerate() {
                for second in &self.cuts[..index] {
                    let Some(place) = common([&cut, first, second]) else { continue };
                    if lowest.is_none_or(|l| is_lower(&place, &l))
                        && self.cuts.iter().all(|cut| cut.missed(place) <= ROUNDING)
                    {
                        lowest = Some(place);
                    }
                }
            }
            let Some(lowest) = lowest else { return false };
            self.lowest = lowest;
        }
        self.cuts.push(cut);
        true
    }
}

/// Compares by distance, and at equal distance by tilt.
fn is_lower(a: &[f64; 3], b: &[f64; 3]) -> bool {
    let tilt = |p: &[f64; 3]| p[0] * p[0] + p[1] * p[1];
    (a[2] - b[2]).abs() <= ROUNDING && tilt(a) < tilt(b) || a[2] < b[2] - ROUNDING
}

/// Intersection of three cuts.
fn common(cuts: [&Cut; 3]) -> Option<[f64; 3]> {
    let rows = cuts.map(Cut::row).concat();
    let place = Matrix3::from_row_slice(&rows).try_inverse()? * Vec3::from(cuts.map(|cut| -cut.at));
    place.iter().all(|x| x.is_finite()).then_some(place.into())
}

/// Plane that was tried, midway between the highest vertex of the solid and the lowest one of the face, and
/// its distance from both.
#[derive(Clone, Copy)]
struct Tried {
    plane: Plane,
    distance: f64,
}

/// Plane nearest to the vertices that a face must hold, among the planes with no vertex of the solid farther
/// in front; and `true` if its distance is within the tolerance. The search starts at the normal `around`.
pub(super) fn plane(
    held: &[Vec3],
    (vertices, tree): (&[Vec3], &Places),
    around: Vec3,
    tolerance: f64,
) -> (Plane, bool) {
    let mut chart = Chart {
        held,
        vertices,
        tree,
        middle: mean(held),
        tolerance,
        center: around,
        axes: [Vec3::zeros(); 2],
    };
    let (mut best, mut tilt) = chart.best();
    for _ in 1..TURNS {
        if best.distance <= tolerance || tilt < FAR {
            break;
        }
        chart.center = best.plane.0;
        (best, tilt) = chart.best();
    }
    (best.plane, best.distance <= tolerance)
}

/// Planes along a face whose normals are a given one tilted along two axes.
struct Chart<'a> {
    held: &'a [Vec3],
    vertices: &'a [Vec3],
    tree: &'a Places,
    middle: Vec3,
    tolerance: f64,
    center: Vec3,
    axes: [Vec3; 2],
}

impl Chart<'_> {
    /// Best plane, and the larger of its tilts.
    fn best(&mut self) -> (Tried, f64) {
        let across = unit(&self.center.cross(&if self.center.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() }));
        self.axes = [across, self.center.cross(&across)];
        let mut program = Program::new();
        let mut best: Option<(Tried, f64)> = None;
        for _ in 0..CUTS {
            let [x, y, least] = program.lowest;
            let (tried, cut) = self.tried(x, y);
            if best.is_none_or(|(best, _)| tried.distance < best.distance) {
                best = Some((tried, x.abs().max(y.abs())));
            }
            let enough = cut.missed([x, y, least]) <= ENOUGH;
            if enough || least > LONGEST || !program.add(cut) {
                break;
            }
        }
        best.unwrap_or_else(|| (self.tried(0.0, 0.0).0, 0.0))
    }

    /// Plane of a tilt, and the bound that it gives for all other tilts.
    fn tried(&self, x: f64, y: f64) -> (Tried, Cut) {
        let normal = self.center + self.axes[0] * x + self.axes[1] * y;
        let length = normal.norm();
        let highest = self.tree.highest((&normal, 0.0), f64::NEG_INFINITY, |_| true);
        let highest = highest.map_or(self.middle, |(_, vertex)| self.vertices[vertex as usize]);
        let height = |place: &Vec3| normal.dot(&(place - self.middle));
        let lower = |a: &&Vec3, b: &&Vec3| height(a).total_cmp(&height(b));
        let lowest = self.held.iter().min_by(lower).copied().unwrap_or(self.middle);
        let half = (highest - lowest) * 0.5;
        let offset = normal.dot(&self.middle) + height(&(lowest + half));
        let plane = (normal / length, offset / length);
        let in_tolerances = half / self.tolerance;
        let along = self.axes.map(|axis| axis.dot(&in_tolerances));
        let cut = Cut { along, at: self.center.dot(&in_tolerances), with_distance: true };
        (Tried { plane, distance: normal.dot(&half) / length }, cut)
    }
}
