//! Bristle of a patch of two solids: three components, two in the contact plane and one along the normal, which
//! is the lever of the torsion times the angle turned (docs/theory.md, 2.12).

use super::bristle::{BristleForces, Bristles};
use super::force::FrictionOutput;
use pong_geometry::Vec3;
use pong_geometry::simd::{LaneBits, Numbers, Portable, Vectors};

/// Bristle of a patch, and its motion since the last commit. The vectors have three components, in B's axes.
pub(crate) struct PatchBristle {
    /// Deflection at the last commit, in the present contact plane, m.
    pub carried_b: Vec3,
    /// Slip since the last commit, m.
    pub slip_b: Vec3,
    /// Slip velocity, m/s.
    pub slip_velocity_b: Vec3,
    /// Unit normal of the patch.
    pub normal_b: Vec3,
    /// Stiffness, N/m, and damping, N·s/m.
    pub stiffness: f64,
    pub damping: f64,
    /// μ_k·F_n and μ_s·F_n, N.
    pub kinetic_limit: f64,
    pub static_limit: f64,
    /// True if the bristle stuck at the last commit.
    pub stuck: bool,
}

impl PatchBristle {
    /// Force on A, N, new deflection and energy by the law of a bristle in the plane, in which the plane of
    /// the path takes the place of the contact plane.
    pub fn evaluate(&self) -> FrictionOutput {
        let number = |value| Numbers::splat(Portable, value);
        let vector = |value: &Vec3| Vectors::splat(Portable, value);
        let BristleForces { force, bristle, stored, sticks } = Bristles {
            stiffness: number(self.stiffness),
            damping: number(self.damping),
            kinetic_limit: number(self.kinetic_limit),
            static_limit: number(self.static_limit),
            normal: vector(&self.plane_of_path()),
            carried: vector(&self.carried_b),
            slip: vector(&self.slip_b),
            slip_velocity: vector(&self.slip_velocity_b),
            stuck: if self.stuck { LaneBits::MAX } else { 0 },
        }
        .evaluate(Portable);
        let first = |lanes: [[f64; 8]; 3]| Vec3::new(lanes[0][0], lanes[1][0], lanes[2][0]);
        FrictionOutput {
            force_b: first(force.store()),
            bristle_b: first(bristle.store()),
            sticks: sticks & 1 == 1,
            stored: stored.store()[0],
        }
    }

    /// Unit normal of the plane of slip and slip velocity; that of the patch if they are parallel.
    fn plane_of_path(&self) -> Vec3 {
        let across = self.slip_b.cross(&self.slip_velocity_b);
        let length = across.norm();
        // The sum keeps the divisor above zero, ahead of the branch as well.
        let direction = across / (length + f64::MIN_POSITIVE);
        if length > f64::MIN_POSITIVE { direction } else { self.normal_b }
    }
}
