//! Bodies that an impulse on one of them moves together, with the square root of their mobility, which may be singular.

use nalgebra::{DMatrix, DVector, Vector6};

/// Pivots below this share of their diagonal element are zero: such a direction does not move.
const PIVOT_LEAST: f64 = 1e-11;
/// Largest remainder beside the pivots, as a share of the diagonal elements, of a mobility without negative eigenvalue.
const LEFT_MOST: f64 = 1e-9;

/// A free body, or bodies that joints connect.
///
/// With the mobility A = B·Bᵀ, coordinates z with u = B·z measure velocities so that the kinetic energy is ½·|z|².
#[derive(Clone, Debug)]
pub(crate) struct Assembly {
    /// Indices of the bodies, ascending.
    pub bodies: Vec<usize>,
    /// B: six rows for each body, one column for each direction in which the assembly moves.
    columns: DMatrix<f64>,
    /// Row of the pivot of each column.
    pivots: Vec<usize>,
}

impl Assembly {
    /// An assembly with this mobility, six rows for each body; `None` for a mobility with a negative eigenvalue.
    pub fn of(bodies: Vec<usize>, mobility: &DMatrix<f64>) -> Option<Self> {
        let size = mobility.nrows();
        let mut rest = mobility.clone();
        let (mut columns, mut pivots) = (Vec::new(), Vec::new());
        let share = |rest: &DMatrix<f64>, row: usize| match mobility[(row, row)] {
            full if full > 0.0 => rest[(row, row)] / full,
            _ => 0.0,
        };
        // Cholesky factor with pivots of largest share, the first of equal ones.
        for _ in 0..size {
            let row = (0..size)
                .fold(0, |best, row| if share(&rest, row) > share(&rest, best) { row } else { best });
            if share(&rest, row) <= PIVOT_LEAST {
                break;
            }
            let factor = rest.column(row) / rest[(row, row)].sqrt();
            rest.ger(-1.0, &factor, &factor, 1.0);
            rest.row_mut(row).fill(0.0);
            rest.column_mut(row).fill(0.0);
            columns.push(factor);
            pivots.push(row);
        }
        let scale = mobility.diagonal().map(f64::sqrt);
        let is_left = |(row, column)| rest[(row, column)].abs() > LEFT_MOST * scale[row] * scale[column];
        if (0..size).any(|row| (0..size).any(|column| is_left((row, column)))) {
            return None;
        }
        let columns = match columns.is_empty() {
            true => DMatrix::zeros(size, 0),
            false => DMatrix::from_columns(&columns),
        };
        Some(Self { bodies, columns, pivots })
    }

    /// Number of independent directions in which the assembly moves.
    pub fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Six rows of a column of B: those of the body at this place.
    fn column(&self, column: usize, place: usize) -> Vector6<f64> {
        self.columns.fixed_view::<6, 1>(6 * place, column).into_owned()
    }

    /// Adds Bᵀ·p to z, of an impulse on the body at this place.
    pub fn add_coordinates_of_impulse(&self, z: &mut [f64], place: usize, impulse: &Vector6<f64>) {
        for (column, z) in z.iter_mut().enumerate() {
            *z += self.column(column, place).dot(impulse);
        }
    }

    /// Adds B·z to the velocities of the bodies; `velocities` has an entry for each body of the frame.
    pub fn add_velocities(&self, z: &[f64], velocities: &mut [Vector6<f64>]) {
        for (column, z) in z.iter().enumerate() {
            for (place, body) in self.bodies.iter().enumerate() {
                velocities[*body] += self.column(column, place) * *z;
            }
        }
    }

    /// Adds A·p to the velocities of the bodies; both have an entry for each body of the frame.
    pub fn add_gains(&self, impulses: &[Vector6<f64>], velocities: &mut [Vector6<f64>]) {
        for column in 0..self.rank() {
            let parts = self.bodies.iter().enumerate();
            let z: f64 = parts.map(|(place, body)| self.column(column, place).dot(&impulses[*body])).sum();
            for (place, body) in self.bodies.iter().enumerate() {
                velocities[*body] += self.column(column, place) * z;
            }
        }
    }

    /// Coordinates z with B·z = u, from the rows of the pivots; `velocities` has an entry for each body of the frame.
    pub fn coordinates(&self, velocities: &[Vector6<f64>]) -> DVector<f64> {
        let mut z = DVector::zeros(self.rank());
        for column in 0..self.rank() {
            let row = self.pivots[column];
            let known: f64 = (0..column).map(|i| self.columns[(row, i)] * z[i]).sum();
            z[column] = (velocities[self.bodies[row / 6]][row % 6] - known) / self.columns[(row, column)];
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix6;

    fn dynamic(mobility: &Matrix6<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(6, 6, |i, j| mobility[(i, j)])
    }

    #[test]
    fn a_root_squares_to_its_mobility() {
        let full =
            Matrix6::from_fn(|i, j| 0.3_f64.powi((i as i32 - j as i32).abs()) * ((i + 1) * (j + 1)) as f64);
        let hinge = Vector6::new(0.0, 0.4, 0.0, 0.0, 0.0, 1.0);
        for (mobility, rank) in [(full, 6), (hinge * hinge.transpose() * 10.0, 1), (Matrix6::zeros(), 0)] {
            let assembly = Assembly::of(vec![0], &dynamic(&mobility)).unwrap();
            assert_eq!(assembly.rank(), rank);
            let square = &assembly.columns * assembly.columns.transpose();
            assert!((square - dynamic(&mobility)).amax() <= 1e-12 * mobility.amax());
            let impulse = Vector6::new(1.0, -2.0, 0.5, 0.25, 3.0, -1.0);
            let mut velocity = [Vector6::zeros()];
            assembly.add_gains(&[impulse], &mut velocity);
            assert!((velocity[0] - mobility * impulse).amax() <= 1e-12 * mobility.amax());
            let z = assembly.coordinates(&velocity);
            let mut again = [Vector6::zeros()];
            assembly.add_velocities(z.as_slice(), &mut again);
            assert!((again[0] - velocity[0]).amax() <= 1e-12 * mobility.amax());
        }
    }

    #[test]
    fn a_negative_eigenvalue_is_found() {
        let mut mobility = Matrix6::identity();
        for (within, off) in [(true, 0.999), (true, 1.0), (false, 1.001)] {
            mobility[(0, 4)] = off;
            mobility[(4, 0)] = off;
            assert_eq!(Assembly::of(vec![0], &dynamic(&mobility)).is_some(), within, "{off}");
        }
    }
}
