//! Mass, inertia and position of the mass centre.

use crate::error::{ExecutiveError, Result};
use pong_geometry::{Mat3, Vec3};

/// Tolerated relative error of a moment of inertia in the check that a body with these moments can exist.
const TOLERANCE: f64 = 1e-9;

/// Mass properties of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass, kg.
    pub mass: f64,
    /// Inertia tensor about the mass centre along the axes of the group frame, kg·m².
    pub inertia: Mat3,
    /// The mass centre in the group frame, m.
    pub mass_center: Vec3,
}

impl MassProperties {
    /// Mass properties with the mass centre at the group's origin and principal axes along the group's.
    pub fn principal(mass: f64, moments: [f64; 3]) -> Self {
        let inertia = Mat3::from_diagonal(&Vec3::from(moments));
        Self { mass, inertia, mass_center: Vec3::zeros() }
    }

    /// A solid ball about the group's origin.
    pub fn sphere(mass: f64, radius: f64) -> Self {
        Self::principal(mass, [0.4 * mass * radius * radius; 3])
    }

    /// A solid block about the group's origin; `edges` are its lengths along the three axes, m.
    pub fn cuboid(mass: f64, edges: [f64; 3]) -> Self {
        let [x, y, z] = edges.map(|edge| edge * edge * mass / 12.0);
        Self::principal(mass, [y + z, z + x, x + y])
    }

    /// Returns these mass properties with the mass centre at another point of the group frame.
    pub fn with_mass_center(self, mass_center: Vec3) -> Self {
        Self { mass_center, ..self }
    }

    /// Every reason, as cause and cure, why no rigid body can have these values.
    pub fn faults(&self) -> Vec<(String, String)> {
        let mut faults = Vec::new();
        let mut fault = |cause: String, cure: &str| faults.push((cause, cure.to_owned()));
        if !(self.mass > 0.0 && self.mass.is_finite()) {
            fault(format!("the mass is {} kg", self.mass), "give a finite mass above zero");
        }
        if self.mass_center.iter().any(|x| !x.is_finite()) {
            fault("the mass centre is not finite".to_owned(), "give three finite coordinates");
        }
        let largest = self.inertia.amax();
        if self.inertia.iter().any(|x| !x.is_finite()) {
            fault("the inertia is not finite".to_owned(), "give finite moments");
        } else if (self.inertia - self.inertia.transpose()).amax() > TOLERANCE * largest {
            fault("the inertia tensor is not symmetric".to_owned(), "give Ixy = Iyx, Ixz = Izx, Iyz = Izy");
        } else {
            let mut moments: [f64; 3] = self.inertia.symmetric_eigenvalues().into();
            moments.sort_by(f64::total_cmp);
            let [a, b, c] = moments;
            if a <= TOLERANCE * c || c <= 0.0 {
                fault(
                    format!("the principal moments are {a}, {b}, {c} kg·m²"),
                    "all three must be above zero; mind the sign of the products of inertia",
                );
            } else if a + b < c * (1.0 - TOLERANCE) {
                fault(
                    format!("the principal moments {a}, {b}, {c} kg·m² belong to no body"),
                    "the two smaller ones must add up to at least the largest",
                );
            }
        }
        faults
    }

    /// Refuses values that no rigid body can have.
    pub(crate) fn check(&self, body: &str) -> Result<()> {
        match self.faults().into_iter().next() {
            None => Ok(()),
            Some((cause, cure)) => Err(ExecutiveError::invalid(format!("body `{body}`"), cause, cure)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_bodies_are_refused() {
        let bad = |moments| !MassProperties::principal(1.0, moments).faults().is_empty();
        assert!(bad([1.0, 2.0, 3.1]));
        assert!(bad([1.0, -2.0, 3.0]));
        assert!(bad([0.0, 1.0, 1.0]));
        assert!(!bad([1.0, 2.0, 3.0]));
        assert!(!MassProperties::sphere(0.0, 1.0).faults().is_empty());
        assert!(!MassProperties::sphere(f64::NAN, 1.0).faults().is_empty());
    }

    #[test]
    fn a_cube_has_a_sixth() {
        let cube = MassProperties::cuboid(6.0, [1.0; 3]);
        assert!((cube.inertia - Mat3::identity()).norm() < 1e-15);
    }
}
