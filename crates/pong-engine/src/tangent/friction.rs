//! Derivatives of the friction force of one contact, in the axes (e, f, n) of its plane.

use super::moves::plane_axes;
use crate::law::FrictionProps;
use crate::law::friction::Bristles;
use nalgebra::SMatrix;
use pong_geometry::Vec3;
use pong_geometry::simd::{Derivatives, Dual, LaneBits, Numbers, Vectors};

/// Variables of the friction force: carried bristle (2), slip (2), slip velocity (2), normal force, share of the
/// tangential spring.
pub(super) const VARIABLES: usize = 8;
const CARRIED: usize = 0;
const SLIP: usize = 2;
const VELOCITY: usize = 4;
const LOAD: usize = 6;
const SHARE: usize = 7;

/// Input of the friction of a contact. Vectors are in B's frame, in the contact plane.
pub(super) struct Rubbing {
    pub normal_b: Vec3,
    /// Bristle of the last commit, carried into the contact plane, m.
    pub carried_b: Vec3,
    pub slip_b: Vec3,
    pub slip_velocity_b: Vec3,
    /// Normal force, N.
    pub pressed: f64,
    /// Share of the tangential spring.
    pub share: f64,
    /// True if the bristle stuck at the last commit.
    pub stuck: bool,
}

/// Friction force along e and f, N, and its derivatives with respect to the variables.
pub(super) struct FrictionSlopes {
    pub force: [f64; 2],
    pub slopes: SMatrix<f64, 2, VARIABLES>,
}

type Level = Derivatives<VARIABLES>;
type Number = Numbers<Level>;

impl Rubbing {
    /// Derivatives by a built-in law; `None` for a host's law.
    pub fn slopes(&self, law: &FrictionProps) -> Option<FrictionSlopes> {
        match law {
            FrictionProps::None => Some(FrictionSlopes { force: [0.0; 2], slopes: SMatrix::zeros() }),
            FrictionProps::Coulomb { mu, slip_speed } => Some(self.of_coulomb(*mu, *slip_speed)),
            FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static, .. } => {
                Some(self.of_bristle([*stiffness, *damping], [*mu_kinetic, *mu_static]))
            }
            FrictionProps::Custom { .. } => None,
        }
    }

    fn of_bristle(&self, [stiffness, damping]: [f64; 2], [kinetic, fixed]: [f64; 2]) -> FrictionSlopes {
        let of_share = |factor: f64| number(factor * self.share, SHARE, factor);
        let of_load = |factor: f64| number(factor * self.pressed, LOAD, factor);
        let forces = Bristles::<Level> {
            stiffness: of_share(stiffness),
            damping: of_share(damping),
            kinetic_limit: of_load(kinetic),
            static_limit: of_load(fixed),
            normal: Vectors::splat(Derivatives, &Vec3::z()),
            carried: self.in_plane(&self.carried_b, CARRIED),
            slip: self.in_plane(&self.slip_b, SLIP),
            slip_velocity: self.in_plane(&self.slip_velocity_b, VELOCITY),
            stuck: if self.stuck { LaneBits::MAX } else { 0 },
        }
        .evaluate(Derivatives);
        of_numbers([forces.force.x, forces.force.y])
    }

    /// F = −μ·F_n·v/max(|v|, v_ε).
    fn of_coulomb(&self, mu: f64, slip_speed: f64) -> FrictionSlopes {
        let velocity = self.in_plane(&self.slip_velocity_b, VELOCITY);
        let speed = velocity.norm().larger(Number::splat(Derivatives, slip_speed));
        let force = -(velocity * number(mu * self.pressed, LOAD, mu).over(speed));
        of_numbers([force.x, force.y])
    }

    /// A vector of the contact plane in the axes (e, f, n), whose two components are variables.
    fn in_plane(&self, vector: &Vec3, first: usize) -> Vectors<Level> {
        let axes = plane_axes(&self.normal_b);
        let part = |k: usize| number(axes[k].dot(vector), first + k, 1.0);
        Vectors { x: part(0), y: part(1), z: Number::splat(Derivatives, 0.0) }
    }
}

fn number(value: f64, index: usize, slope: f64) -> Number {
    Numbers::of(Derivatives, Dual::variable(value, index, slope))
}

fn of_numbers(parts: [Number; 2]) -> FrictionSlopes {
    let parts = parts.map(|part| part.eight());
    FrictionSlopes {
        force: parts.map(|part| part.value),
        slopes: SMatrix::from_fn(|row, column| parts[row].slopes[column]),
    }
}
