//! Square root of a mobility that may be singular.

use nalgebra::{Matrix6, Vector6};

/// Pivots below this share of their diagonal element are zero: such a direction does not move.
const PIVOT_LEAST: f64 = 1e-11;

/// Matrix B of 6 rows with A = B·Bᵀ, A the mobility. Coordinates z with u = B·z measure velocities so that the kinetic
/// energy is ½·|z|².
#[derive(Clone, Debug)]
pub(crate) struct Root {
    /// B; columns from `rank` on are zero.
    pub columns: Matrix6<f64>,
    /// Number of independent directions in which the body moves.
    pub rank: usize,
    /// Rows of the pivots, in order.
    pivots: [usize; 6],
}

impl Root {
    /// Root of a body that no impulse moves.
    pub fn zero() -> Self {
        Self { columns: Matrix6::zeros(), rank: 0, pivots: [0, 1, 2, 3, 4, 5] }
    }

    /// Cholesky factor with pivots of largest relative size, which ends where the rest is zero.
    pub fn of(mobility: &Matrix6<f64>) -> Self {
        let mut rest = *mobility;
        let mut root = Self::zero();
        for column in 0..6 {
            let share = |row: usize| match mobility[(row, row)] {
                full if full > 0.0 => rest[(row, row)] / full,
                _ => 0.0,
            };
            // The first row of the largest share.
            let chosen = (column..6).fold(column, |best, place| {
                if share(root.pivots[place]) > share(root.pivots[best]) { place } else { best }
            });
            root.pivots.swap(column, chosen);
            let row = root.pivots[column];
            if share(row) <= PIVOT_LEAST {
                break;
            }
            let factor = rest.column(row) / rest[(row, row)].sqrt();
            rest -= factor * factor.transpose();
            root.columns.set_column(column, &factor);
            root.rank = column + 1;
        }
        root
    }

    /// A·p: velocity gained by an impulse.
    pub fn velocity(&self, impulse: &Vector6<f64>) -> Vector6<f64> {
        self.columns * self.coordinates_of_impulse(impulse)
    }

    /// Bᵀ·p.
    pub fn coordinates_of_impulse(&self, impulse: &Vector6<f64>) -> Vector6<f64> {
        self.columns.tr_mul(impulse)
    }

    /// Coordinates z with B·z = u, from the rows of the pivots.
    pub fn coordinates(&self, velocity: &Vector6<f64>) -> Vector6<f64> {
        let mut z = Vector6::zeros();
        for column in 0..self.rank {
            let row = self.pivots[column];
            let known: f64 = (0..column).map(|i| self.columns[(row, i)] * z[i]).sum();
            z[column] = (velocity[row] - known) / self.columns[(row, column)];
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_squares_to_its_mobility() {
        let full =
            Matrix6::from_fn(|i, j| 0.3_f64.powi((i as i32 - j as i32).abs()) * ((i + 1) * (j + 1)) as f64);
        let hinge = Vector6::new(0.0, 0.4, 0.0, 0.0, 0.0, 1.0);
        for (mobility, rank) in [(full, 6), (hinge * hinge.transpose() * 10.0, 1), (Matrix6::zeros(), 0)] {
            let root = Root::of(&mobility);
            assert_eq!(root.rank, rank);
            assert!((root.columns * root.columns.transpose() - mobility).amax() <= 1e-12 * mobility.amax());
            let impulse = Vector6::new(1.0, -2.0, 0.5, 0.25, 3.0, -1.0);
            let velocity = root.velocity(&impulse);
            let z = root.coordinates(&velocity);
            assert!((root.columns * z - velocity).amax() <= 1e-12);
        }
    }
}
