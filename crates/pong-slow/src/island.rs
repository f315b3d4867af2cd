//! Islands: bodies that touch each other, directly or through others. A body that contact does not move joins none.

use crate::body::Body;
use nalgebra::{DMatrix, DVector, Vector6};

/// Bodies of an island, in order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Island {
    pub bodies: Vec<usize>,
}

/// Islands of the bodies that contact moves, in order of their first body.
pub(crate) fn islands(bodies: &[Body], touched: &[(usize, usize)]) -> Vec<Island> {
    let mut root: Vec<usize> = (0..bodies.len()).collect();
    fn find(root: &[usize], mut body: usize) -> usize {
        while root[body] != body {
            body = root[body];
        }
        body
    }
    for &(a, b) in touched {
        if bodies[a].moves() && bodies[b].moves() {
            let (a, b) = (find(&root, a), find(&root, b));
            // The lowest body names the island.
            root[a.max(b)] = a.min(b);
        }
    }
    let mut islands: Vec<Island> = Vec::new();
    let mut index = vec![usize::MAX; bodies.len()];
    for body in (0..bodies.len()).filter(|body| bodies[*body].moves()) {
        let first = find(&root, body);
        if index[first] == usize::MAX {
            index[first] = islands.len();
            islands.push(Island { bodies: Vec::new() });
        }
        islands[index[first]].bodies.push(body);
    }
    islands
}

impl Island {
    /// Place of a body in the island.
    pub fn place(&self, body: usize) -> Option<usize> {
        self.bodies.binary_search(&body).ok()
    }

    /// Number of coordinates.
    pub fn size(&self) -> usize {
        6 * self.bodies.len()
    }

    /// Six coordinates of a body in a vector of the island.
    pub fn of(z: &DVector<f64>, place: usize) -> Vector6<f64> {
        z.fixed_rows::<6>(6 * place).into_owned()
    }

    /// Adds a row of weight `weight` (N/m) to a matrix and returns its coordinates: `row` in the coordinates z of the
    /// island.
    pub fn coordinates(&self, bodies: &[Body], row: &crate::contact_set::Row) -> DVector<f64> {
        let mut coordinates = DVector::zeros(self.size());
        for (body, on) in [(row.a, &row.on_a), (row.b, &row.on_b)] {
            if let Some(place) = self.place(body) {
                let mut part = coordinates.fixed_rows_mut::<6>(6 * place);
                part += bodies[body].root.coordinates_of_impulse(on);
            }
        }
        coordinates
    }

    /// Solves (1 + S)·z = right, S symmetric without negative eigenvalues.
    pub fn solve(mut stiffness: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
        for i in 0..stiffness.nrows() {
            stiffness[(i, i)] += 1.0;
        }
        let solved = stiffness.cholesky().map(|factor| factor.solve(right));
        // Positive definite but for overflow.
        solved.unwrap_or_else(|| DVector::zeros(right.len()))
    }
}
