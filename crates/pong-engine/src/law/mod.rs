//! Normal force laws (docs/theory.md, 3): force and stored energy from depth and depth rate.

mod combine;
pub(crate) mod friction;
mod hunt_crossley;
mod linear;
pub(crate) mod registry;

pub(crate) use combine::friction_name;
pub use combine::{CombineError, FrictionProps, NormalProps, PairProps, combine};

use std::fmt::Debug;

/// What a registered normal law is given.
#[derive(Clone, Copy, Debug)]
pub struct NormalInput<'a> {
    /// Depth δ > 0, m.
    pub depth: f64,
    /// Depth rate δ', m/s, positive while closing.
    pub rate: f64,
    /// Stiffness k of the pair.
    pub stiffness: f64,
    /// The law's parameters as the model gives them.
    pub parameters: &'a [f64],
}

/// A normal force law added by the user. It must be pure: the same input gives the same output, from any thread.
pub trait NormalForce: Debug + Send + Sync {
    /// Force of a whole contact (weight 1), N. Negative values are taken as 0: a contact never pulls.
    fn force(&self, input: &NormalInput<'_>) -> f64;

    /// Energy stored at this depth by a whole contact, J: the integral of the elastic part. Used by the ledger.
    fn stored(&self, input: &NormalInput<'_>) -> f64;
}

/// Normal force of a contact of weight `w`, N, never negative.
pub(crate) fn normal_force(props: &PairProps, w: f64, depth: f64, rate: f64) -> f64 {
    let k = props.stiffness;
    let force = match &props.normal {
        NormalProps::Linear { damping, ramp } => linear::force(k, *damping, *ramp, depth, rate),
        NormalProps::HuntCrossley { dissipation, exponent } => {
            hunt_crossley::force(k, *dissipation, *exponent, depth, rate)
        }
        NormalProps::Custom { law, parameters } => {
            law.force(&NormalInput { depth, rate, stiffness: k, parameters })
        }
    };
    (w * force).max(0.0)
}

/// Energy stored by a contact of weight `w`, J.
pub(crate) fn stored_energy(props: &PairProps, w: f64, depth: f64) -> f64 {
    let k = props.stiffness;
    w * match &props.normal {
        NormalProps::Linear { .. } => linear::stored(k, depth),
        NormalProps::HuntCrossley { exponent, .. } => hunt_crossley::stored(k, *exponent, depth),
        NormalProps::Custom { law, parameters } => {
            law.stored(&NormalInput { depth, rate: 0.0, stiffness: k, parameters })
        }
    }
}
