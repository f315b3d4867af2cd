//! How a body yields: contacts as rows of a matrix in coordinates in which the body's mass is one.

use crate::mass::{GroupMass, root_of};
use nalgebra::DMatrix;
use pong_geometry::{Mat3, Vec3};

pub(crate) type Vec6 = nalgebra::SVector<f64, 6>;
pub(crate) type Mat6 = nalgebra::SMatrix<f64, 6, 6>;

/// The inverse root of a mass matrix M = C·Cᵀ about the mass centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mobility {
    inverse_root: f64,
    /// Inverse of the Cholesky factor of the inertia; zero where it is not known.
    turn: Mat3,
    center: Vec3,
}

impl Mobility {
    /// `None` for what does not yield.
    pub fn new(mass: &GroupMass) -> Option<Self> {
        if mass.mass.is_infinite() {
            return None;
        }
        let root = mass.tensor().and_then(root_of);
        let turn = root.and_then(|root| root.try_inverse()).unwrap_or_else(Mat3::zeros);
        Some(Self { inverse_root: 1.0 / mass.mass.sqrt(), turn, center: mass.mass_center.into() })
    }

    /// C⁻¹·(d, (p − centre) × d): |that|² is 1/m and the lever's share, the inverse of the effective mass.
    pub fn row(&self, direction: &Vec3, at: &Vec3) -> Vec6 {
        let linear = direction * self.inverse_root;
        let angular = self.turn * (at - self.center).cross(direction);
        Vec6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
    }

    /// Adds a spring along a direction at a place.
    pub fn add(&self, sum: &mut Mat6, stiffness: f64, direction: &Vec3, at: &Vec3) {
        let row = self.row(direction, at);
        *sum += stiffness * row * row.transpose();
    }

    /// Adds a spring as stiff in every direction: no less than one along any of them.
    pub fn add_bushing(&self, sum: &mut Mat6, stiffness: f64, at: &Vec3) {
        [Vec3::x(), Vec3::y(), Vec3::z()].iter().for_each(|axis| self.add(sum, stiffness, axis, at));
    }

    /// Largest inverse of the effective mass at any place no further than this from the mass centre, 1/kg.
    pub fn max_compliance(&self, reach: f64) -> f64 {
        let turn = self.turn.transpose() * self.turn;
        self.inverse_root * self.inverse_root
            + reach * reach * largest_eigenvalue(DMatrix::from_column_slice(3, 3, turn.as_slice()))
    }

    /// The mass centre in the group's frame.
    pub fn center(&self) -> &Vec3 {
        &self.center
    }
}

/// Of a symmetric matrix that has no negative one; infinite beyond the range of numbers, where no search would end.
pub(crate) fn largest_eigenvalue(matrix: DMatrix<f64>) -> f64 {
    if matrix.iter().any(|x| !x.is_finite()) {
        return f64::INFINITY;
    }
    if matrix.is_empty() { 0.0 } else { matrix.symmetric_eigenvalues().max().max(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rod of 3 kg and 4 m struck at its end: 1/m + l²/I = 1/3 + 4/4 = 4/3, a quarter of the mass.
    #[test]
    fn a_rod_struck_at_its_end_weighs_a_quarter() {
        let mass = GroupMass { mass: 3.0, inertia: [4.0, 4.0, 1e-3, 0.0, 0.0, 0.0], mass_center: [0.0; 3] };
        let rod = Mobility::new(&mass).unwrap();
        let mut sum = Mat6::zeros();
        rod.add(&mut sum, 1.0, &Vec3::x(), &(2.0 * Vec3::z()));
        assert!((sum.symmetric_eigenvalues().max() - 4.0 / 3.0).abs() < 1e-14);
        assert!((rod.max_compliance(0.0) - 1.0 / 3.0).abs() < 1e-15);
        assert!(Mobility::new(&GroupMass::immovable()).is_none());
    }
}
