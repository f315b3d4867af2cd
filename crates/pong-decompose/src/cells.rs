//! Choice of cuts: VHACD finds boxes of voxels whose contents are nearly convex; their walls become planes of cells,
//! moved onto flat faces and vertices of the mesh within one voxel.
//!
//! The cells fill the bounding box without overlap. The hulls of their contents therefore do not overlap
//! either and leave no part of the solid uncovered.

use crate::content::Cell;
use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};
use parry3d_f64::transformation::voxelization::FillMode;
use pong_import::mesh::{Mesh, area_vector, bounds};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Resolution and limits of the search for cuts.
pub(crate) struct Looking {
    /// Voxels along the longest side.
    pub(crate) resolution: u32,
    /// Share of the whole hull's volume that the hull of a piece may exceed its content by.
    pub(crate) concavity: f64,
    pub(crate) pieces_max: usize,
    /// True if the solid has internal cavities.
    pub(crate) hollow: bool,
    /// VHACD's weight of equal volumes (its α).
    pub(crate) balance: f64,
    /// VHACD's weight of cuts along the axis of revolution (its β).
    pub(crate) symmetry: f64,
}

/// Largest resolution at which VHACD tries every fourth plane (its default). Above it the number of planes is
/// kept, so that the time grows in proportion to the voxels.
const FULLY_TRIED: u32 = 100;

/// Cuts move onto flat faces of the mesh within this many voxels: VHACD weighs cuts near such a face nearly alike.
const REACH: f64 = 2.0;
/// Cuts move onto vertices within this many voxels.
const REACH_OF_VERTICES: f64 = 0.5;

/// Voxels from `low` to `high`, both counted in.
#[derive(Clone, Copy, Debug)]
struct Voxels {
    low: [i64; 3],
    high: [i64; 3],
}

/// Positions of voxels.
struct Lattice {
    origin: Vector3<f64>,
    voxel_m: f64,
}

/// Coordinates worth cutting at, along each axis: (coordinate, area of flat faces there), rising.
pub(crate) struct Features(pub(crate) [Vec<(f64, f64)>; 3]);

/// A cut between two sets of boxes.
struct Cut {
    axis: usize,
    at: f64,
    /// Boxes up to this one in the order of their low ends are below.
    below: usize,
}

/// Cells whose contents are nearly convex; `None` if the decomposer gives up.
pub(crate) fn cells(mesh: &Mesh, features: &Features, looking: &Looking) -> Option<Vec<Cell>> {
    let (lattice, boxes) = catch_unwind(AssertUnwindSafe(|| voxel_boxes(mesh, looking))).ok()?;
    let (low, high) = bounds(&mesh.vertices);
    let mut cells = Vec::new();
    split(boxes, Cell { low, high }, &lattice, features, &mut cells);
    Some(cells)
}

fn voxel_boxes(mesh: &Mesh, looking: &Looking) -> (Lattice, Vec<Voxels>) {
    let parameters = VHACDParameters {
        resolution: looking.resolution,
        concavity: looking.concavity,
        // VHACD doubles the number of hulls per level; surplus pieces are joined later.
        max_convex_hulls: looking.pieces_max.min(1 << 16) as u32,
        fill_mode: FillMode::FloodFill { detect_cavities: looking.hollow },
        plane_downsampling: 4 * looking.resolution.div_ceil(FULLY_TRIED),
        alpha: looking.balance,
        beta: looking.symmetry,
        ..VHACDParameters::default()
    };
    let places: Vec<Vector> = mesh.vertices.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
    let found = VHACD::decompose(&parameters, &places, &mesh.triangles, false);
    let parts = found.voxel_parts();
    let lattice = parts.first().map_or(Lattice { origin: Vector3::zeros(), voxel_m: 1.0 }, |part| Lattice {
        origin: Vector3::new(part.origin.x, part.origin.y, part.origin.z),
        voxel_m: part.scale,
    });
    let boxes = parts.iter().filter(|part| !part.is_empty()).map(|part| {
        let mut voxels = Voxels { low: [i64::MAX; 3], high: [i64::MIN; 3] };
        for voxel in part.voxels() {
            for (axis, at) in [voxel.coords.x, voxel.coords.y, voxel.coords.z].into_iter().enumerate() {
                voxels.low[axis] = voxels.low[axis].min(at);
                voxels.high[axis] = voxels.high[axis].max(at);
            }
        }
        voxels
    });
    (lattice, boxes.collect())
}

/// Cuts the cell by planes that pass between boxes, until each cell has one.
fn split(boxes: Vec<Voxels>, cell: Cell, lattice: &Lattice, features: &Features, cells: &mut Vec<Cell>) {
    let Some(cut) = best_cut(&boxes, &cell, lattice, features) else {
        cells.push(cell);
        return;
    };
    let mut boxes = boxes;
    boxes.sort_by_key(|voxels| voxels.low[cut.axis]);
    let above = boxes.split_off(cut.below);
    let [lower, upper] = cell.cut(cut.axis, cut.at);
    split(boxes, lower, lattice, features, cells);
    split(above, upper, lattice, features, cells);
}

/// Cut along the largest flat faces; without flat faces, the cut that divides the boxes most evenly.
fn best_cut(boxes: &[Voxels], cell: &Cell, lattice: &Lattice, features: &Features) -> Option<Cut> {
    let mut best: Option<(f64, usize, Cut)> = None;
    for axis in 0..3 {
        let mut order: Vec<&Voxels> = boxes.iter().collect();
        order.sort_by_key(|voxels| voxels.low[axis]);
        let mut reached = i64::MIN;
        for below in 1..order.len() {
            reached = reached.max(order[below - 1].high[axis]);
            let next = order[below].low[axis];
            if reached >= next {
                continue;
            }
            let (at, flat_m2) = lattice.place(axis, reached, next, cell, features);
            let even = below.min(order.len() - below);
            if best.as_ref().is_none_or(|(area, best_even, _)| (flat_m2, even) > (*area, *best_even)) {
                best = Some((flat_m2, even, Cut { axis, at, below }));
            }
        }
    }
    best.map(|(_, _, cut)| cut)
}

impl Lattice {
    /// Position of a cut between two layers of voxels, and the area of flat faces there.
    fn place(&self, axis: usize, below: i64, above: i64, cell: &Cell, features: &Features) -> (f64, f64) {
        let face = |voxel: i64, side: f64| self.origin[axis] + (voxel as f64 + side) * self.voxel_m;
        let (from, to) = (face(below, 0.5), face(above, -0.5));
        let middle = 0.5 * (from + to);
        let reach = REACH * self.voxel_m;
        let margin = 1e-6 * (cell.high[axis] - cell.low[axis]);
        let allowed = |at: f64, flat_m2: f64| {
            let reach = if flat_m2 > 0.0 { reach } else { REACH_OF_VERTICES * self.voxel_m };
            at >= from - reach
                && at <= to + reach
                && at > cell.low[axis] + margin
                && at < cell.high[axis] - margin
        };
        let along = &features.0[axis];
        let first = along.partition_point(|(at, _)| *at < from - reach);
        let near = along[first..]
            .iter()
            .take_while(|(at, _)| *at <= to + reach)
            .filter(|(at, flat_m2)| allowed(*at, *flat_m2));
        // Flat faces first, then the coordinate nearest to the middle.
        let closer = |a: f64, b: f64| (a - middle).abs() < (b - middle).abs();
        let best = near.copied().reduce(|best, other| match other.1.total_cmp(&best.1) {
            std::cmp::Ordering::Greater => other,
            std::cmp::Ordering::Equal if closer(other.0, best.0) => other,
            _ => best,
        });
        let inside = middle.clamp(cell.low[axis] + margin, cell.high[axis] - margin);
        best.unwrap_or((inside, 0.0))
    }
}

impl Features {
    /// Coordinate of the largest flat faces within reach, else of the nearest vertex, else `at` itself.
    pub(crate) fn near(&self, axis: usize, at: f64, reach_m: f64) -> f64 {
        let along = &self.0[axis];
        let first = along.partition_point(|(other, _)| *other < at - reach_m);
        let near = along[first..].iter().take_while(|(other, _)| *other <= at + reach_m);
        let best = near.copied().reduce(|best, other| match other.1.total_cmp(&best.1) {
            std::cmp::Ordering::Greater => other,
            std::cmp::Ordering::Equal if (other.0 - at).abs() < (best.0 - at).abs() => other,
            _ => best,
        });
        best.map_or(at, |(near, _)| near)
    }

    pub(crate) fn of(mesh: &Mesh) -> Self {
        Self([0, 1, 2].map(|axis| {
            let mut found: Vec<(f64, f64)> = mesh.vertices.iter().map(|place| (place[axis], 0.0)).collect();
            for triangle in 0..mesh.triangles.len() {
                let corners = mesh.corners(triangle);
                if corners.iter().all(|corner| corner[axis] == corners[0][axis]) {
                    found.push((corners[0][axis], 0.5 * area_vector(&corners).norm()));
                }
            }
            found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
            let same = found.chunk_by(|a, b| a.0 == b.0);
            same.map(|chunk| (chunk[0].0, chunk.iter().map(|(_, area)| area).sum())).collect()
        }))
    }
}
