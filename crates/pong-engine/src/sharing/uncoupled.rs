//! Shares where some normals are more than 90° apart: those pairs do not couple.
//!
//! λ ≥ 0,  G·λ − δ ≥ 0,  λ·(G·λ − δ) = 0  with G_ij = max(0, n_i·n_j), G_ii = 1: a linear complementarity problem.
//! G has no negative entry and a positive diagonal, so xᵀGx > 0 for every x ≥ 0, x ≠ 0 (strictly copositive), and
//! Lemke's method ends with a solution (R. W. Cottle, J.-S. Pang, R. E. Stone, "The Linear Complementarity
//! Problem", theorem 4.4.9). The deepest contact enters first. There need not be a potential, nor continuity, nor a
//! unique solution; the pivots decide, always the same way.

use super::{Sharer, coupling};

/// Fills in the λ of every contact.
pub(super) fn share(contacts: &mut [Sharer]) {
    let mut tableau = Tableau::new(contacts);
    tableau.solve();
    let lambdas: Vec<f64> = (0..contacts.len()).map(|i| tableau.lambda(i)).collect();
    for (contact, lambda) in contacts.iter_mut().zip(lambdas) {
        contact.lambda = lambda;
    }
}

/// Lemke's tableau: w − G·λ − 1·z₀ = −δ. Columns: w (n), λ (n), z₀, right side.
struct Tableau {
    n: usize,
    rows: Vec<Vec<f64>>,
    /// Which variable each row solves for.
    basis: Vec<usize>,
}

impl Tableau {
    fn new(contacts: &[Sharer]) -> Self {
        let n = contacts.len();
        let rows = (0..n)
            .map(|i| {
                let mut row = vec![0.0; 2 * n + 2];
                row[i] = 1.0;
                for j in 0..n {
                    row[n + j] = if i == j { -1.0 } else { -coupling(&contacts[i], &contacts[j]) };
                }
                row[2 * n] = -1.0;
                row[2 * n + 1] = -contacts[i].depth;
                row
            })
            .collect();
        Self { n, rows, basis: (0..n).collect() }
    }

    fn solve(&mut self) {
        let artificial = 2 * self.n;
        let right = artificial + 1;
        // z₀ enters where the right side is most negative: at the deepest contact.
        let mut row = 0;
        for i in 1..self.n {
            if self.rows[i][right] < self.rows[row][right] {
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
            entering = if leaving < self.n { leaving + self.n } else { leaving - self.n };
            match self.ratio_test(entering) {
                Some(next) => row = next,
                None => return,
            }
        }
    }

    /// The row that limits the entering variable; z₀ leaves as soon as it may, other ties go to the lower row.
    fn ratio_test(&self, entering: usize) -> Option<usize> {
        const PIVOT_MIN: f64 = 1e-12;
        let right = 2 * self.n + 1;
        let mut best: Option<(usize, f64)> = None;
        for (i, row) in self.rows.iter().enumerate().filter(|(_, row)| row[entering] > PIVOT_MIN) {
            let ratio = row[right] / row[entering];
            let wins = match best {
                None => true,
                Some((_, least)) => ratio < least || (ratio == least && self.basis[i] == 2 * self.n),
            };
            if wins {
                best = Some((i, ratio));
            }
        }
        best.map(|(row, _)| row)
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let factor = 1.0 / self.rows[row][column];
        self.rows[row].iter_mut().for_each(|x| *x *= factor);
        let pivot_row = self.rows[row].clone();
        let (before, after) = self.rows.split_at_mut(row);
        for other in before.iter_mut().chain(&mut after[1..]) {
            let factor = other[column];
            other.iter_mut().zip(&pivot_row).for_each(|(x, p)| *x -= factor * p);
        }
        self.basis[row] = column;
    }

    fn lambda(&self, contact: usize) -> f64 {
        let row = self.basis.iter().position(|&variable| variable == self.n + contact);
        row.map_or(0.0, |row| self.rows[row][2 * self.n + 1].max(0.0))
    }
}
