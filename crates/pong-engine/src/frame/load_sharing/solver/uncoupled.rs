//! Load sharing if some normals are more than 90° apart; such pairs of contacts do not couple. Symbols as in
//! the parent module: depth δ_i, normal n_i, load λ_i.
//!
//! λ ≥ 0,  G·λ − δ ≥ 0,  λ·(G·λ − δ) = 0  with G_ij = max(0, n_i·n_j), G_ii = 1: a linear complementarity
//! problem. G has no negative entry and a positive diagonal, so xᵀGx > 0 for every x ≥ 0, x ≠ 0 (strictly
//! copositive), and Lemke's method ends with a solution (R. W. Cottle, J.-S. Pang, R. E. Stone, "The Linear
//! Complementarity Problem", theorem 4.4.9).
//!
//! The solution need not be unique, need not change continuously with the depths, and need not follow from a
//! potential. If there are several solutions, the order of the pivots selects one. This order is fixed: the
//! deepest contact enters first.
//!
//! *Rounding.* For two normals at a small angle θ, as in a plate cut into pieces, the method divides by 1 −
//! (n_1·n_2)² ≈ θ². The normals are rounded to 1e-15, and the square of this must still be significant, so
//! the tableau uses double-double numbers ([`Twofold`]).
//!
//! *Memory.* For n contacts the tableau has n·(n + 2) numbers, in an arena of known size. The columns of the
//! basic variables are unit vectors and are omitted.

use super::shared_contact::{Coupling, SharedContact, deepest_of};
use super::twofold::Twofold;
use pong_arena::{Arena, Demand, Full};

/// Scratch memory of the tableau for this many contacts.
pub(super) fn tableau(contacts: usize) -> Demand {
    let columns = contacts.saturating_add(2);
    let cells = contacts.saturating_mul(columns);
    Demand::default().and::<u32>(contacts).and::<u32>(contacts.saturating_add(1)).and::<Twofold>(cells)
}

/// Computes the load λ of every contact.
///
/// # Errors
/// [`Full`] if the tableau does not fit into the scratch memory; then no λ is written.
pub(super) fn share(contacts: &mut [SharedContact], scratch: &Arena) -> Result<(), Full> {
    // In units of the largest depth no product overflows or underflows.
    let unit = contacts[deepest_of(contacts)].depth;
    let mut tableau = Tableau::new(contacts, unit, scratch)?;
    tableau.solve();
    for (i, contact) in contacts.iter_mut().enumerate() {
        contact.lambda = tableau.lambda(i) * unit;
    }
    Ok(())
}

/// Lemke's tableau of w − G·λ − 1·z₀ = −δ, with the slack variables w and the artificial variable z₀. Each
/// row is solved for one basic variable; the nonbasic variables are zero. The variables are numbered in the
/// order w_1…w_n, λ_1…λ_n, z₀. The columns are those of the nonbasic variables, then the right-hand side.
struct Tableau<'a> {
    n: usize,
    /// Cells in row-major order.
    cells: &'a mut [Twofold],
    /// Basic variable of each row.
    basis: &'a mut [u32],
    /// Nonbasic variable of each column.
    zero: &'a mut [u32],
}

impl<'a> Tableau<'a> {
    fn new(contacts: &[SharedContact], unit: f64, scratch: &'a Arena) -> Result<Self, Full> {
        let n = contacts.len();
        // All slices are requested before any is checked, so that the arena's peak shows the total demand.
        let (basis, zero) = (scratch.slice(n, 0), scratch.slice(n + 1, 0));
        let cells = scratch.slice(n * (n + 2), Twofold::default());
        let mut tableau = Self { n, cells: cells?, basis: basis?, zero: zero? };
        tableau.zero[n] = 2 * n as u32;
        for i in 0..n {
            tableau.basis[i] = i as u32;
            tableau.zero[i] = (n + i) as u32;
            let row = tableau.row_mut(i);
            for j in 0..n {
                row[j] = if i == j { Twofold::from(-1.0) } else { -cosine(&contacts[i], &contacts[j]) };
            }
            row[n] = Twofold::from(-1.0);
            row[n + 1] = Twofold::from(-contacts[i].depth / unit);
        }
        Ok(tableau)
    }

    fn columns(&self) -> usize {
        self.n + 2
    }

    fn row(&self, row: usize) -> &[Twofold] {
        let columns = self.columns();
        &self.cells[row * columns..(row + 1) * columns]
    }

    fn row_mut(&mut self, row: usize) -> &mut [Twofold] {
        let columns = self.columns();
        &mut self.cells[row * columns..(row + 1) * columns]
    }

    fn solve(&mut self) {
        let n = self.n as u32;
        let artificial = 2 * n;
        let right = self.n + 1;
        // z₀ enters where the right-hand side is most negative, at the deepest contact.
        let mut row = 0;
        for i in 1..self.n {
            if self.row(i)[right] < self.row(row)[right] {
                row = i;
            }
        }
        let mut column = self.n;
        // Limited, because contacts that differ only by rounding could replace each other endlessly.
        for _ in 0..64 * (self.n + 1) {
            let leaving = self.basis[row];
            self.pivot(row, column);
            if leaving == artificial {
                return;
            }
            let entering = if leaving < n { leaving + n } else { leaving - n };
            let Some(next) = self.zero.iter().position(|&variable| variable == entering) else { return };
            column = next;
            match self.ratio_test(column) {
                Some(next) => row = next,
                None => return,
            }
        }
    }

    /// Row whose basic variable is the first to reach zero when the variable of column `entering` grows;
    /// `None` if none does. Of several such rows, that of z₀ is taken, otherwise the lowest.
    fn ratio_test(&self, entering: usize) -> Option<usize> {
        /// Least pivot: square of the angle by which rounding may rotate equal normals.
        const PIVOT_MIN: f64 = 1e-29;
        let right = self.n + 1;
        let artificial = 2 * self.n as u32;
        let rows = self.cells.chunks_exact(self.columns()).enumerate();
        let mut best: Option<(usize, Twofold)> = None;
        for (i, row) in rows.filter(|(_, row)| row[entering].value() > PIVOT_MIN) {
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

    /// Pivots: solves a row for the variable of a column; the row's old variable becomes nonbasic.
    fn pivot(&mut self, row: usize, column: usize) {
        let columns = self.columns();
        let (before, rest) = self.cells.split_at_mut(row * columns);
        let (pivot_row, after) = rest.split_at_mut(columns);
        let factor = Twofold::from(1.0) / pivot_row[column];
        pivot_row[column] = Twofold::from(1.0);
        pivot_row.iter_mut().for_each(|x| *x = *x * factor);
        for other in before.chunks_exact_mut(columns).chain(after.chunks_exact_mut(columns)) {
            let factor = std::mem::take(&mut other[column]);
            other.iter_mut().zip(&*pivot_row).for_each(|(x, p)| *x = *x - factor * *p);
        }
        std::mem::swap(&mut self.basis[row], &mut self.zero[column]);
    }

    fn lambda(&self, contact: usize) -> f64 {
        let variable = (self.n + contact) as u32;
        let row = self.basis.iter().position(|&solved| solved == variable);
        row.map_or(0.0, |row| self.row(row)[self.n + 1].value().max(0.0))
    }
}

/// Coupling max(0, n₁·n₂) of two contacts, in double-double precision.
fn cosine(a: &SharedContact, b: &SharedContact) -> Twofold {
    let coupling = Coupling::new(a, b);
    if coupling.is_near { Twofold::sum(1.0, -coupling.gap) } else { Twofold::from(coupling.cosine) }
}
