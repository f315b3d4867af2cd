//! The reset-integrator bristle in two dimensions, under a varying load.
//!
//! ```text
//! p_s = μ_s·F_n/K      p_k = μ_k·F_n/K      p* = carried p + u
//! sticking:  |p*| ≤ p_s keeps sticking, p = p*;              else breaks away, p on the circle p_k
//! slipping:  |p*| ≤ p_k, p = p*;                             else p on the circle p_k
//!            sticks again where p*·v_t < 0 or |p*| < p_k, as soon as |K·p + c·v_t| ≤ μ_k·F_n
//! F_t = −cut(K·p + c·v_t), its length cut to μ_s·F_n while sticking, to μ_k·F_n in every other step
//! ```
//!
//! D. A. Haessig and B. Friedland, "On the modeling and simulation of friction", J. Dyn. Sys. Meas. Control 113
//! (1991), extended to the plane. Where the bristle stands on the circle p_k is told by `slip_path.rs`.
//!
//! Only the limits follow the load, never K: a bristle whose stiffness followed it would make energy. One force law
//! serves sticking and slipping, and what sticks again is held by the kinetic limit until its force has come inside it.
//! So the force is a continuous function of p, v_t and F_n, and steps at break-away alone: a contact that stands on its
//! limit has the same force whichever side of it rounding takes (theory manual, section 4).
//!
//! Products with K stand for the lengths p_s and p_k, so that K = 0 needs no case of its own.

use super::force::{FrictionInput, FrictionOutput};
use super::slip_path::on_circle;
use pong_geometry::Vec3;

/// What rounding may do to a force that stands on its limit, as a part of the limit: a carried bristle and the product
/// with K are off by a few times 1e-16. Friction may exceed its limit by no more than this.
const LIMIT_ROUNDING: f64 = 1e-13;

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
    #[inline(always)]
    pub(super) fn evaluate(&self, input: &FrictionInput<'_>) -> FrictionOutput {
        let trial = input.carried_b + input.slip_b;
        let pull = self.stiffness * trial.norm();
        let holds = input.stuck && pull <= self.static_limit * (1.0 + LIMIT_ROUNDING);
        let (bristle, limit) = if holds {
            (shortened(trial, pull, self.static_limit), self.static_limit)
        } else if !input.stuck && pull <= self.kinetic_limit {
            (trial, self.kinetic_limit)
        } else {
            let left_at = if input.stuck { self.static_limit } else { self.kinetic_limit };
            let (left_at, radius) = (left_at / self.stiffness, self.kinetic_limit / self.stiffness);
            (on_circle(input, left_at, radius), self.kinetic_limit)
        };
        let pushed = bristle * self.stiffness + input.slip_velocity_b * self.damping;
        let length = pushed.norm();
        FrictionOutput {
            force_b: -shortened(pushed, length, limit),
            bristle_b: bristle,
            sticks: holds || (!input.stuck && self.sticks_again(&trial, pull, length, input)),
            stored: 0.5 * self.stiffness * bristle.norm_squared(),
        }
    }

    /// Whether what slipped sticks: its motion has turned back or no longer fills the circle, and the static limit would
    /// leave its force as it is.
    #[inline(always)]
    fn sticks_again(&self, trial: &Vec3, pull: f64, length: f64, input: &FrictionInput<'_>) -> bool {
        let turned_back = trial.dot(&input.slip_velocity_b) < 0.0;
        let within = pull < self.kinetic_limit * (1.0 - LIMIT_ROUNDING);
        (turned_back || within) && length <= self.kinetic_limit * (1.0 + LIMIT_ROUNDING)
    }
}

/// A vector of the given length, shortened to at most `limit`.
///
/// The quotient is 1, exactly, where nothing is cut, and is computed in any case: behind a branch a compiler may compute it
/// before the branch, and then nothing over nothing would be an invalid operation.
#[inline(always)]
pub(crate) fn shortened(vector: Vec3, length: f64, limit: f64) -> Vec3 {
    let longer = if length > limit { length } else { limit };
    vector * (limit / longer.max(f64::MIN_POSITIVE))
}
