//! Cuts along flat faces of the mesh: a solid of boxes and prisms separates exactly there.
//!
//! VHACD judges a cut by its immediate gain. For a frame or a cup no single cut gains anything, so its first
//! cuts are arbitrary; a cut along a flat face that ends in the material is right even if the gain comes with
//! the next cut.

use crate::cells::Features;
use crate::content::{Cell, content};
use crate::inside::Solid;
use crate::piece::hull;
use pong_import::mesh::{Mesh, bounds};

/// Most planes tried in a cell, those of the largest faces.
const TRIED: usize = 12;
/// Most cells.
const CELLS_MAX: usize = 256;

/// A cell, and the volume by which the hull of its content exceeds the content.
#[derive(Clone, Copy)]
pub(crate) struct Judged {
    pub(crate) cell: Cell,
    excess_m3: f64,
}

/// A solid with the planes to cut it by.
pub(crate) struct Cutting<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) solid: &'a Solid,
    pub(crate) features: &'a Features,
    /// Largest excess that counts as none, m³.
    pub(crate) allowed_m3: f64,
}

impl Cutting<'_> {
    /// Cells bounded by planes of flat faces, cut until their content is convex or no such plane is left.
    pub(crate) fn cells(&self) -> Vec<Judged> {
        let (low, high) = bounds(&self.mesh.vertices);
        let mut open = vec![self.judged(Cell { low, high })];
        let mut done = Vec::new();
        while let Some(next) = open.pop() {
            let room = open.len() + done.len() + 2 <= CELLS_MAX;
            match self.best_halves(&next).filter(|_| room && !self.is_convex(&next)) {
                Some([lower, upper]) => open.extend([upper, lower]),
                None => done.push(next),
            }
        }
        done
    }

    /// True if the content fills its hull.
    pub(crate) fn is_convex(&self, cell: &Judged) -> bool {
        cell.excess_m3 <= self.allowed_m3
    }

    fn judged(&self, cell: Cell) -> Judged {
        let content = content(self.mesh, self.solid, &cell);
        let hull_m3 = hull(&content.points).map_or(content.volume_m3, |piece| piece.volume_m3);
        Judged { cell, excess_m3: hull_m3 - content.volume_m3 }
    }

    /// Halves of least excess; ties go to the largest flat face.
    fn best_halves(&self, judged: &Judged) -> Option<[Judged; 2]> {
        if self.is_convex(judged) {
            return None;
        }
        let Cell { low, high } = judged.cell;
        let mut planes: Vec<(f64, usize, f64)> = Vec::new();
        for axis in 0..3 {
            let margin = 1e-6 * (high[axis] - low[axis]);
            let inside = |at: f64| at > low[axis] + margin && at < high[axis] - margin;
            let flat = self.features.0[axis].iter().filter(|(at, area)| *area > 0.0 && inside(*at));
            planes.extend(flat.map(|&(at, area)| (area, axis, at)));
        }
        planes.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.total_cmp(&b.2)));
        let mut best: Option<(f64, [Judged; 2])> = None;
        for (_, axis, at) in planes.into_iter().take(TRIED) {
            let halves = judged.cell.cut(axis, at).map(|half| self.judged(half));
            let excess = halves[0].excess_m3 + halves[1].excess_m3;
            if best
                .as_ref()
                .is_none_or(|(least, _)| excess < *least - 1e-9 * self.allowed_m3.max(judged.excess_m3))
            {
                best = Some((excess, halves));
            }
        }
        best.map(|(_, halves)| halves)
    }
}
