//! Compliance of a body: contacts as rows of a matrix in coordinates in which the body's mass is one.

use crate::mass::{GroupMass, Joints, root_of};
use nalgebra::DMatrix;
use pong_geometry::{Mat3, Vec3};

pub(crate) type Vec6 = nalgebra::SVector<f64, 6>;
pub(crate) type Mat6 = nalgebra::SMatrix<f64, 6, 6>;

type Mat3x6 = nalgebra::SMatrix<f64, 3, 6>;

/// A root S of a body's inverse inertia S·Sᵀ: for a free body the inverse Cholesky factor of its mass matrix,
/// for a body on joints the root of the host's matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mobility {
    /// Rows of the root for the velocity of `center`, 1/√kg.
    linear: Mat3x6,
    /// Rows for the angular velocity; zero where no inertia is known.
    angular: Mat3x6,
    /// Mass centre in the group's frame.
    center: Vec3,
    /// ‖angular‖², 1/(kg·m²).
    spin: f64,
    /// Upper bound of ‖linear·angularᵀ‖; zero for a free body.
    coupled: f64,
}

impl Mobility {
    /// Mobility of a body; `None` if it does not yield.
    pub fn new(mass: &GroupMass) -> Option<Self> {
        if mass.mass.is_infinite() {
            return None;
        }
        let center = Vec3::from(mass.mass_center);
        let (linear, angular) = match &mass.joints {
            Some(joints) => on_joints(joints, &center),
            None => free(mass),
        };
        let squared = angular * angular.transpose();
        let spin = largest_eigenvalue(DMatrix::from_column_slice(3, 3, squared.as_slice()));
        Some(Self { linear, angular, center, spin, coupled: (linear * angular.transpose()).norm() })
    }

    /// Sᵀ·(d, (p − centre) × d): its squared norm is the inverse of the effective mass at p along d.
    pub fn row(&self, direction: &Vec3, at: &Vec3) -> Vec6 {
        self.linear.tr_mul(direction) + self.angular.tr_mul(&(at - self.center).cross(direction))
    }

    /// Sᵀ·(0, d): a moment about the direction d.
    pub fn turn_row(&self, direction: &Vec3) -> Vec6 {
        self.angular.tr_mul(direction)
    }

    /// Adds a spring along a direction at a point.
    pub fn add(&self, sum: &mut Mat6, stiffness: f64, direction: &Vec3, at: &Vec3) {
        let row = self.row(direction, at);
        *sum += stiffness * row * row.transpose();
    }

    /// Adds an isotropic spring: an upper bound of one along any direction.
    pub fn add_bushing(&self, sum: &mut Mat6, stiffness: f64, at: &Vec3) {
        [Vec3::x(), Vec3::y(), Vec3::z()].iter().for_each(|axis| self.add(sum, stiffness, axis, at));
    }

    /// Adds an upper bound of an isotropic spring at any point within a distance of one: with a the rows at
    /// that point and b those of the offset, (a + b)(a + b)ᵀ ≤ (1 + s)·aaᵀ + (1 + 1/s)·bbᵀ for every s > 0.
    pub fn add_bushing_around(&self, sum: &mut Mat6, stiffness: f64, at: &Vec3, reach: f64) {
        let (near, far) = (self.compliance(at).sqrt(), reach * self.spin.sqrt());
        if far == 0.0 || near == 0.0 {
            self.add_bushing(sum, stiffness, at);
        } else {
            self.add_bushing(sum, stiffness * (1.0 + far / near), at);
        }
        let turn = stiffness * reach * reach * if far > 0.0 { 1.0 + near / far } else { 0.0 };
        [Vec3::x(), Vec3::y(), Vec3::z()].iter().for_each(|axis| self.add_rotational(sum, turn, axis));
    }

    /// Adds a rotational spring about an axis, N·m/rad.
    pub fn add_rotational(&self, sum: &mut Mat6, stiffness: f64, axis: &Vec3) {
        let row = self.angular.tr_mul(axis);
        *sum += stiffness * row * row.transpose();
    }

    /// Largest inverse of the effective mass at a point, along any direction, 1/kg.
    pub fn compliance(&self, at: &Vec3) -> f64 {
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| self.row(&axis, at));
        let entries = DMatrix::from_fn(3, 3, |i, j| axes[i].dot(&axes[j]));
        largest_eigenvalue(entries)
    }

    /// Upper bound of [`compliance`](Self::compliance) at all points within a distance of one
    /// (docs/advise.md).
    pub fn compliance_around(&self, at: &Vec3, reach: f64) -> f64 {
        let cross = self.coupled + (at - self.center).norm() * self.spin;
        self.compliance(at) + reach * (2.0 * cross + reach * self.spin)
    }

    /// The largest [`compliance`](Self::compliance) in a box: it is convex in the point, so a corner has it.
    pub fn compliance_in(&self, (low, high): &(Vec3, Vec3)) -> f64 {
        let corner = |code: u32| Vec3::from_fn(|i, _| if code >> i & 1 == 0 { low[i] } else { high[i] });
        (0..8).map(|code| self.compliance(&corner(code))).fold(0.0, f64::max)
    }

    /// True if the compliance depends on the point of contact.
    pub fn has_levers(&self) -> bool {
        self.spin > 0.0
    }

    /// The mass centre in the group's frame.
    pub fn center(&self) -> &Vec3 {
        &self.center
    }
}

fn free(mass: &GroupMass) -> (Mat3x6, Mat3x6) {
    let root = mass.tensor().and_then(root_of);
    let turn = root.and_then(|root| root.try_inverse()).unwrap_or_else(Mat3::zeros);
    let (mut linear, mut angular) = (Mat3x6::zeros(), Mat3x6::zeros());
    linear.fixed_columns_mut::<3>(0).copy_from(&(Mat3::identity() / mass.mass.sqrt()));
    angular.fixed_columns_mut::<3>(3).copy_from(&turn.transpose());
    (linear, angular)
}

/// The symmetric root, with the rows for the velocity moved from the group's origin to the mass centre.
fn on_joints(joints: &Joints, center: &Vec3) -> (Mat3x6, Mat3x6) {
    let eigen = joints.matrix().symmetric_eigen();
    let roots = Mat6::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0).sqrt()));
    let root = eigen.eigenvectors * roots;
    let angular = root.fixed_rows::<3>(3).into_owned();
    let turned = |column: usize| angular.column(column).into_owned().cross(center);
    let carried = Mat3x6::from_fn(|row, column| turned(column)[row]);
    (root.fixed_rows::<3>(0) + carried, angular)
}

/// Largest eigenvalue of a positive semidefinite matrix; infinite beyond the range of numbers, where the
/// iteration would not end.
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
        let mass = GroupMass { inertia: [4.0, 4.0, 1e-3, 0.0, 0.0, 0.0], ..GroupMass::point(3.0) };
        let rod = Mobility::new(&mass).unwrap();
        let mut sum = Mat6::zeros();
        rod.add(&mut sum, 1.0, &Vec3::x(), &(2.0 * Vec3::z()));
        assert!((sum.symmetric_eigenvalues().max() - 4.0 / 3.0).abs() < 1e-14);
        assert!((rod.compliance(&Vec3::zeros()) - 1.0 / 3.0).abs() < 1e-15);
        assert!(Mobility::new(&GroupMass::immovable()).is_none());
    }
}
