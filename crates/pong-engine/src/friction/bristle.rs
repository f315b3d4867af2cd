//! The reset-integrator bristle in two dimensions, under a varying load.
//!
//! ```text
//! p_s = μ_s·F_n/K      p_k = μ_k·F_n/K      p* = carried p + u
//! sticking:  |p*| ≤ p_s keeps sticking, else slips
//! slipping:  p*·v_t < 0 or |p*| < p_k sticks again, else keeps slipping
//! sticks:  p = p*·min(1, p_s/|p*|)    F_t = −(K·p + c·v_t), its length cut to μ_s·F_n
//! slips:   p = p_k·p*/|p*|            F_t = −K·p
//! ```
//!
//! D. A. Haessig and B. Friedland, "On the modeling and simulation of friction", J. Dyn. Sys. Meas. Control 113
//! (1991), extended to the plane with a radial return, so that after a turn the force swings round to oppose the
//! motion instead of keeping its old heading. Only the limits follow the load, never K: a bristle whose stiffness
//! followed it would make energy.
//!
//! Products with K stand for the lengths p_s and p_k, so that K = 0 needs no case of its own.

use super::{FrictionInput, FrictionOutput};
use pong_geometry::Vec3;

/// One contact's bristle.
pub(super) struct Bristle {
    /// K, N/m.
    pub stiffness: f64,
    /// c, N·s/m.
    pub damping: f64,
    /// μ_k·F_n, N.
    pub kinetic_limit: f64,
    /// μ_s·F_n, N.
    pub static_limit: f64,
}

impl Bristle {
    pub(super) fn evaluate(&self, input: &FrictionInput<'_>) -> FrictionOutput {
        let trial = input.carried + input.slip;
        let pull = self.stiffness * trial.norm();
        let sticks = if input.stuck {
            pull <= self.static_limit
        } else {
            trial.dot(&input.slip_velocity) < 0.0 || pull < self.kinetic_limit
        };
        if sticks { self.stick(&trial, pull, input) } else { self.slip(&trial, pull) }
    }

    fn stick(&self, trial: &Vec3, pull: f64, input: &FrictionInput<'_>) -> FrictionOutput {
        let bristle = if pull > self.static_limit { trial * (self.static_limit / pull) } else { *trial };
        let force = -(bristle * self.stiffness + input.slip_velocity * self.damping);
        let length = force.norm();
        let force = if length > self.static_limit { force * (self.static_limit / length) } else { force };
        FrictionOutput { force, bristle, sticks: true, stored: self.stored(&bristle) }
    }

    fn slip(&self, trial: &Vec3, pull: f64) -> FrictionOutput {
        // A slipping bristle has pull ≥ the kinetic limit; it vanishes only together with the limit.
        let bristle = if pull > 0.0 { trial * (self.kinetic_limit / pull) } else { Vec3::zeros() };
        FrictionOutput {
            force: bristle * -self.stiffness,
            bristle,
            sticks: false,
            stored: self.stored(&bristle),
        }
    }

    fn stored(&self, bristle: &Vec3) -> f64 {
        0.5 * self.stiffness * bristle.norm_squared()
    }
}
