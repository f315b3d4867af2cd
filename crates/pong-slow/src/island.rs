//! Islands: assemblies whose bodies touch each other, directly or through others. A body that contact does not move joins
//! none.

use crate::contact_set::Row;
use crate::system::{System, connected};
use nalgebra::{DMatrix, DVector, Vector6};

/// Assemblies of an island, and their bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Island {
    /// Indices of the bodies, ascending.
    pub bodies: Vec<usize>,
    /// Assemblies, and the place of the first coordinate of each in z.
    pub assemblies: Vec<(usize, usize)>,
    /// Number of coordinates z.
    size: usize,
}

/// Islands of the bodies that contact moves, in order of their first body.
pub(crate) fn islands(system: &System, touched: &[(usize, usize)]) -> Vec<Island> {
    let neighbours = system.assemblies.iter().flat_map(|assembly| assembly.bodies.windows(2));
    let mut pairs: Vec<(usize, usize)> = neighbours.map(|pair| (pair[0], pair[1])).collect();
    pairs.extend_from_slice(touched);
    let sets = connected(system.bodies.len(), &pairs, |body| system.moves(body));
    sets.into_iter().map(|bodies| Island::of(system, bodies)).collect()
}

impl Island {
    fn of(system: &System, bodies: Vec<usize>) -> Self {
        let mut homes: Vec<usize> = bodies.iter().filter_map(|&body| system.home(body)).collect();
        homes.sort_unstable();
        homes.dedup();
        let mut size = 0;
        let mut assemblies = Vec::with_capacity(homes.len());
        for assembly in homes {
            assemblies.push((assembly, size));
            size += system.assemblies[assembly].rank();
        }
        Self { bodies, assemblies, size }
    }

    /// Returns true if a body is one of the island.
    pub fn has(&self, body: usize) -> bool {
        self.bodies.binary_search(&body).is_ok()
    }

    /// Returns true if a contact acts on a body of the island.
    pub fn touches(&self, row: &Row) -> bool {
        self.has(row.a) || self.has(row.b)
    }

    /// Number of coordinates z.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Adds B·z to the velocities of all bodies.
    pub fn add_velocities(&self, system: &System, z: &DVector<f64>, velocities: &mut [Vector6<f64>]) {
        for &(assembly, start) in &self.assemblies {
            let assembly = &system.assemblies[assembly];
            assembly.add_velocities(&z.as_slice()[start..start + assembly.rank()], velocities);
        }
    }

    /// Bᵀ·p: coordinates z of impulses on bodies.
    pub fn coordinates<'i>(
        &self,
        system: &System,
        impulses: impl IntoIterator<Item = (usize, &'i Vector6<f64>)>,
    ) -> DVector<f64> {
        let mut coordinates = DVector::zeros(self.size);
        for (body, impulse) in impulses {
            let home = system.home(body);
            if let Some(&(assembly, start)) =
                self.assemblies.iter().find(|(assembly, _)| home == Some(*assembly))
            {
                let end = start + system.assemblies[assembly].rank();
                let part = &mut coordinates.as_mut_slice()[start..end];
                system.add_coordinates_of_impulse(part, body, impulse);
            }
        }
        coordinates
    }

    /// Opening of a contact per coordinate z.
    pub fn row(&self, system: &System, row: &Row) -> DVector<f64> {
        self.coordinates(system, [(row.a, &row.on_a), (row.b, &row.on_b)])
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
