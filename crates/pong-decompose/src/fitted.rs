//! Cells cut where the hull of their content protrudes most, until none protrudes by more than a given
//! distance.
//!
//! No voxels are involved, so small holes in a large body are found. The time is bounded: each cut tries at
//! most six planes, and there are as many cuts as pieces.

use crate::cells::Features;
use crate::content::{Cell, content};
use crate::flats;
use crate::hulls::{hulls_of, tell_flat};
use crate::inside::Solid;
use crate::join::join;
use crate::piece::{Piece, hull};
use crate::seams::Pool;
use crate::solids::SolidMesh;
use nalgebra::Vector3;
use pong_import::mesh::{Mesh, bounds};
use pong_import::{Finding, Findings};
use std::collections::BinaryHeap;

/// Relative accuracy of the largest distance found.
const CLOSE: f64 = 0.02;
/// Most points of a hull that are examined; hulls of smaller cells are examined more closely.
const PLACES_MAX: usize = 100_000;
/// Contents that lack no more than this share of their box or hull are convex.
const EXACT_SHARE: f64 = 1e-9;
/// Two planes that leave distances within this share of each other are equally good.
const ALIKE: f64 = 0.01;

/// Options of the fit.
pub(crate) struct Fitting {
    /// Largest accepted protrusion of a piece, m.
    pub(crate) fit_m: f64,
    pub(crate) pieces_max: usize,
    pub(crate) near_m: f64,
}

/// A cell, and the point of its content's hull that is farthest from the solid.
struct Fitted {
    cell: Cell,
    protrusion_m: f64,
    at: Vector3<f64>,
    excess_m3: f64,
    is_empty: bool,
}

struct Cutting<'a> {
    mesh: &'a Mesh,
    solid: &'a Solid,
    features: Features,
    fit_m: f64,
}

/// Pieces, and the number of joints that added volume.
pub(crate) fn pieces(
    solid: &SolidMesh,
    fitting: &Fitting,
    pool: &mut Pool,
    file: &str,
    progress: &mut dyn FnMut(&str),
    findings: &mut Findings,
) -> Option<(Vec<Piece>, usize)> {
    let Some(inside) = Solid::new(&solid.mesh) else {
        let cause = "the mesh has no inside".to_owned();
        let cure = "use a TriangleMesh (`pong import`)".to_owned();
        findings.faults.push(Finding { path: file.to_owned(), rule: "decomposer-failed", cause, cure });
        return None;
    };
    let features = Features::of(&solid.mesh);
    let cutting = Cutting { mesh: &solid.mesh, solid: &inside, features, fit_m: fitting.fit_m };
    let cells = cutting.cells(fitting.pieces_max, progress);
    let worst_m = cells.iter().map(|fitted| fitted.protrusion_m).fold(0.0, f64::max);
    if worst_m > fitting.fit_m {
        let cause = format!(
            "{} pieces protrude by up to {worst_m:.2e} m, more than {} m",
            cells.len(),
            fitting.fit_m
        );
        findings.note(file, "not-fitted", cause, "--pieces-max allows more pieces");
    }
    progress(&format!("joining {} pieces", cells.len()));
    let contents = cells.iter().map(|fitted| content(&solid.mesh, &inside, &fitted.cell).points);
    let found = hulls_of(contents.filter(|points| !points.is_empty()).collect(), pool, file);
    let (mut pieces, flat) = findings.ok(found)?;
    let forced = join(&mut pieces, fitting.pieces_max, fitting.near_m);
    tell_flat(flat, file, findings);
    Some((pieces, forced))
}

impl Cutting<'_> {
    fn cells(&self, pieces_max: usize, progress: &mut dyn FnMut(&str)) -> Vec<Fitted> {
        let (low, high) = bounds(&self.mesh.vertices);
        // A solid of boxes and prisms separates exactly along its flat faces.
        let along = flats::Cutting {
            mesh: self.mesh,
            solid: self.solid,
            features: &self.features,
            allowed_m3: EXACT_SHARE * (high - low).product(),
        };
        let by_flats = along.cells();
        if by_flats.len() <= pieces_max && by_flats.iter().all(|judged| along.is_convex(judged)) {
            return by_flats.iter().map(|judged| self.fitted(judged.cell)).collect();
        }
        let mut open = vec![self.fitted(Cell { low, high })];
        let mut done = Vec::new();
        while open.len() + done.len() < pieces_max {
            let farthest = |(_, a): &(usize, &Fitted), (_, b): &(usize, &Fitted)| {
                a.protrusion_m.total_cmp(&b.protrusion_m)
            };
            // The first of equal ones.
            let Some((index, worst)) = open.iter().enumerate().rev().max_by(farthest) else { break };
            if worst.protrusion_m <= self.fit_m {
                break;
            }
            progress(&format!("{} pieces, up to {:.2e} m out", open.len() + done.len(), worst.protrusion_m));
            let worst = open.remove(index);
            match self.best_halves(&worst) {
                Some(halves) => open.extend(halves),
                None => done.push(worst),
            }
        }
        open.extend(done);
        open
    }

    /// Halves from the plane that leaves the least distance; the first plane wins ties (within `ALIKE`).
    fn best_halves(&self, fitted: &Fitted) -> Option<[Fitted; 2]> {
        let mut best: Option<([f64; 2], [Fitted; 2])> = None;
        for (axis, at) in self.planes(fitted) {
            let halves = fitted.cell.cut(axis, at).map(|half| self.fitted(half));
            // A cut that only trims the cell leaves its hull unchanged.
            if halves.iter().any(|half| half.is_empty) {
                continue;
            }
            let [one, other] = &halves;
            let left = [one.protrusion_m.max(other.protrusion_m), one.excess_m3 + other.excess_m3];
            let is_better = best.as_ref().is_none_or(|([least_m, least_m3], _)| {
                let alike_m = ALIKE * least_m.max(self.fit_m);
                left[0] < least_m - alike_m
                    || (left[0] <= least_m + alike_m && left[1] < least_m3 - ALIKE * fitted.excess_m3)
            });
            if is_better {
                best = Some((left, halves));
            }
        }
        best.map(|(_, halves)| halves)
    }

    /// Planes through the farthest point and through the solid's nearest point to it, moved onto nearby flat
    /// faces and vertices.
    fn planes(&self, fitted: &Fitted) -> Vec<(usize, f64)> {
        let Cell { low, high } = fitted.cell;
        let mut planes: Vec<(usize, f64)> = Vec::new();
        for place in [fitted.at, self.solid.nearest(&fitted.at)] {
            for axis in 0..3 {
                let at = self.features.near(axis, place[axis], 0.5 * self.fit_m);
                let margin = 1e-6 * (high[axis] - low[axis]);
                if at > low[axis] + margin && at < high[axis] - margin && !planes.contains(&(axis, at)) {
                    planes.push((axis, at));
                }
            }
        }
        planes
    }

    fn fitted(&self, cell: Cell) -> Fitted {
        let content = content(self.mesh, self.solid, &cell);
        let middle = 0.5 * (cell.low + cell.high);
        let mut fitted = Fitted {
            cell,
            protrusion_m: 0.0,
            at: middle,
            excess_m3: 0.0,
            is_empty: content.points.is_empty(),
        };
        if let Ok(piece) = hull(&content.points) {
            fitted.excess_m3 = piece.volume_m3 - content.volume_m3;
            if fitted.excess_m3 > EXACT_SHARE * piece.volume_m3 {
                (fitted.protrusion_m, fitted.at) = self.farthest(&piece.triangles());
            }
        }
        fitted
    }

    /// Largest distance of these triangles from the solid above `fit_m`, and its point. Distances change no
    /// faster than positions (Lipschitz constant 1): the triangle with the largest upper bound is split next,
    /// until no bound exceeds the largest distance found.
    fn farthest(&self, hull: &Mesh) -> (f64, Vector3<f64>) {
        let mut best = (0.0, hull.vertices[0]);
        let mut triangles: Vec<[Vector3<f64>; 3]> = Vec::new();
        // Bit patterns of non-negative floats sort like the numbers.
        let mut open: BinaryHeap<(u64, usize)> = BinaryHeap::new();
        let look = |corners: [Vector3<f64>; 3], best: &mut (f64, Vector3<f64>)| {
            let middle = corners.iter().sum::<Vector3<f64>>() / 3.0;
            let reach_m = corners.iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max);
            let distance_m = self.solid.outside_by_m(&middle);
            if distance_m > best.0 {
                *best = (distance_m, middle);
            }
            (distance_m + reach_m).to_bits()
        };
        for corners in (0..hull.triangles.len()).map(|triangle| hull.corners(triangle)) {
            open.push((look(corners, &mut best), triangles.len()));
            triangles.push(corners);
        }
        while let Some((bound, index)) = open.pop() {
            let enough_m = ((1.0 + CLOSE) * best.0).max(self.fit_m);
            if f64::from_bits(bound) <= enough_m || triangles.len() >= PLACES_MAX {
                break;
            }
            let [a, b, c] = triangles[index];
            let [ab, bc, ca] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
            for corners in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
                open.push((look(corners, &mut best), triangles.len()));
                triangles.push(corners);
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::piece::box_between;

    /// A box with a square hole through it: all four walls of the hole are found, and nothing protrudes.
    #[test]
    fn a_square_hole_is_cut_along_its_walls() {
        let blocks: Vec<[i32; 3]> =
            (0..25).map(|k| [k % 5, k / 5, 0]).filter(|block| *block != [2, 2, 0]).collect();
        let mut mesh = Mesh::default();
        for triangle in pong_testkit::meshes::blocks(&blocks, 1.0) {
            let corners = triangle.map(|corner| {
                let place = Vector3::from(corner);
                let found = mesh.vertices.iter().position(|other| *other == place);
                found.unwrap_or_else(|| (mesh.vertices.push(place), mesh.vertices.len() - 1).1) as u32
            });
            mesh.triangles.push(corners);
            mesh.look_of.push(0);
        }
        let solid = Solid::new(&mesh).unwrap();
        let cutting = Cutting { features: Features::of(&mesh), mesh: &mesh, solid: &solid, fit_m: 0.05 };
        let (distance_m, at) = cutting.farthest(&box_between([0.0; 3], [5.0, 5.0, 1.0]).triangles());
        // The middle of the hole is ½ from its walls.
        assert!(distance_m > 0.48 && distance_m <= 0.5, "{distance_m}");
        assert!((at - Vector3::new(2.5, 2.5, at.z)).norm() < 0.03, "{at}");
        let cells = cutting.cells(16, &mut |_| ());
        assert!(cells.len() <= 8 && cells.iter().all(|fitted| fitted.protrusion_m <= 0.05));
    }
}
