//! Shares where some normals are more than 90° apart: those pairs do not couple.
//!
//! λ ≥ 0,  G·λ − δ ≥ 0,  λ·(G·λ − δ) = 0  with G_ij = max(0, n_i·n_j), G_ii = 1: a linear complementarity problem.
//! G has no negative entry and a positive diagonal, so xᵀGx > 0 for every x ≥ 0, x ≠ 0 (strictly copositive), and
//! Lemke's method ends with a solution (R. W. Cottle, J.-S. Pang, R. E. Stone, "The Linear Complementarity
//! Problem", theorem 4.4.9). The deepest contact enters first. There need not be a potential, nor continuity, nor a
//! unique solution; the pivots decide, always the same way.
//!
//! The tableau of n contacts has n·(2n + 2) numbers. They come from an arena that was sized beforehand.

use super::{Sharer, coupling};
use pong_arena::{Arena, Demand, Full};

/// What the tableau of so many contacts takes.
pub(super) fn tableau(contacts: usize) -> Demand {
    let columns = contacts.saturating_mul(2).saturating_add(2);
    Demand::default().and::<u32>(contacts).and::<f64>(contacts.saturating_mul(columns))
}

/// Fills in the λ of every contact.
///
/// # Errors
/// [`Full`] if the tableau does not fit into the scratch memory: nothing is filled in.
pub(super) fn share(contacts: &mut [Sharer], scratch: &Arena) -> Result<(), Full> {
    let mut tableau = Tableau::new(contacts, scratch)?;
    tableau.solve();
    for (i, contact) in contacts.iter_mut().enumerate() {
        contact.lambda = tableau.lambda(i);
    }
    Ok(())
}

/// Lemke's tableau: w − G·λ − 1·z₀ = −δ. Columns: w (n), λ (n), z₀, right side.
struct Tableau<'a> {
    n: usize,
    /// Row after row.
    cells: &'a mut [f64],
    /// Which variable each row solves for.
    basis: &'a mut [u32],
}

impl<'a> Tableau<'a> {
    fn new(contacts: &[Sharer], scratch: &'a Arena) -> Result<Self, Full> {
        let n = contacts.len();
        // Both are asked for before either may be refused: the arena's peak then tells the whole need.
        let (basis, cells) = (scratch.slice(n, 0), scratch.slice(n * (2 * n + 2), 0.0));
        let mut tableau = Self { n, cells: cells?, basis: basis? };
        for i in 0..n {
            tableau.basis[i] = i as u32;
            let row = tableau.row_mut(i);
            row[i] = 1.0;
            for j in 0..n {
                row[n + j] = if i == j { -1.0 } else { -coupling(&contacts[i], &contacts[j]) };
            }
            row[2 * n] = -1.0;
            row[2 * n + 1] = -contacts[i].depth;
        }
        Ok(tableau)
    }

    fn columns(&self) -> usize {
        2 * self.n + 2
    }

    fn row(&self, row: usize) -> &[f64] {
        let columns = self.columns();
        &self.cells[row * columns..(row + 1) * columns]
    }

    fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let columns = self.columns();
        &mut self.cells[row * columns..(row + 1) * columns]
    }

    fn solve(&mut self) {
        let n = self.n as u32;
        let artificial = 2 * n;
        let right = 2 * self.n + 1;
        // z₀ enters where the right side is most negative: at the deepest contact.
        let mut row = 0;
        for i in 1..self.n {
            if self.row(i)[right] < self.row(row)[right] {
                row = i;
            }
        }
        let mut entering = artificial;
        // The bound only guards against cycling among contacts that differ by rounding.
        for _ in 0..64 * (self.n + 1) {
            let leaving = self.basis[row];
            self.pivot(row, entering);
            if leaving == artificial {
                return;
            }
            entering = if leaving < n { leaving + n } else { leaving - n };
            match self.ratio_test(entering as usize) {
                Some(next) => row = next,
                None => return,
            }
        }
    }

    /// The row that limits the entering variable; z₀ leaves as soon as it may, other ties go to the lower row.
    fn ratio_test(&self, entering: usize) -> Option<usize> {
        const PIVOT_MIN: f64 = 1e-12;
        let right = 2 * self.n + 1;
        let artificial = 2 * self.n as u32;
        let rows = self.cells.chunks_exact(self.columns()).enumerate();
        let mut best: Option<(usize, f64)> = None;
        for (i, row) in rows.filter(|(_, row)| row[entering] > PIVOT_MIN) {
            let ratio = row[right] / row[entering];
            let wins = match best {
                None => true,
                Some((_, least)) => ratio < least || (ratio == least && self.basis[i] == artificial),
            };
            if wins {
                best = Some((i, ratio));
            }
        }
        best.map(|(row, _)| row)
    }

    fn pivot(&mut self, row: usize, entering: u32) {
        let columns = self.columns();
        let column = entering as usize;
        let (before, rest) = self.cells.split_at_mut(row * columns);
        let (pivot_row, after) = rest.split_at_mut(columns);
        let factor = 1.0 / pivot_row[column];
        pivot_row.iter_mut().for_each(|x| *x *= factor);
        for other in before.chunks_exact_mut(columns).chain(after.chunks_exact_mut(columns)) {
            let factor = other[column];
            other.iter_mut().zip(&*pivot_row).for_each(|(x, p)| *x -= factor * p);
        }
        self.basis[row] = entering;
    }

    fn lambda(&self, contact: usize) -> f64 {
        let variable = (self.n + contact) as u32;
        let row = self.basis.iter().position(|&solved| solved == variable);
        row.map_or(0.0, |row| self.row(row)[2 * self.n + 1].max(0.0))
    }
}
