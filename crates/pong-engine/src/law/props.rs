//! Combined values of two surfaces.

use super::friction::FrictionForce;
use super::normal::NormalForce;
use pong_model::Exponent;
use std::sync::Arc;

/// Values of an ordered pair of surfaces.
#[derive(Clone, Debug)]
pub struct PairProps {
    /// A's share s_A of the depth, 0…1.
    pub share_a: f64,
    /// Stiffness k, N/m (N/m^1.5 with the exponent 3/2).
    pub stiffness: f64,
    /// Normal law with the pair's damping.
    pub normal: NormalProps,
    /// Friction law with the pair's values.
    pub friction: FrictionProps,
}

/// Normal law of a pair.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub enum NormalProps {
    Linear { damping: f64, ramp: f64 },
    HuntCrossley { dissipation: f64, exponent: Exponent },
    PowerLaw { damping: f64, exponent: Exponent, damping_exponent: f64 },
    Custom { law: Arc<dyn NormalForce>, parameters: Vec<f64> },
}

impl NormalProps {
    /// Exponent of the depth in the spring's force; 1 for a host's law.
    pub fn exponent(&self) -> Exponent {
        match self {
            Self::HuntCrossley { exponent, .. } | Self::PowerLaw { exponent, .. } => *exponent,
            Self::Linear { .. } | Self::Custom { .. } => Exponent::One,
        }
    }
}

/// Friction law of a pair.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub enum FrictionProps {
    None,
    Bristle {
        stiffness: f64,
        damping: f64,
        mu_kinetic: f64,
        mu_static: f64,
        /// Lengths of the rolling and the spinning resistance, m.
        rolling: f64,
        spinning: f64,
    },
    Coulomb {
        mu: f64,
        slip_speed: f64,
    },
    Custom {
        law: Arc<dyn FrictionForce>,
        stiffness: f64,
        parameters: Vec<f64>,
    },
}

impl PairProps {
    /// Returns true if contacts of the pair resist rolling or spinning.
    pub(crate) fn has_resistance(&self) -> bool {
        // Bits are compared, not numbers: a compiler may compare before it has tested the law, and what stands in
        // place of the lengths then may be no number.
        match self.friction {
            FrictionProps::Bristle { rolling, spinning, .. } => {
                (rolling.to_bits() | spinning.to_bits()) << 1 != 0
            }
            _ => false,
        }
    }
}

/// Reason why two surfaces cannot be combined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CombineError {
    /// Cause of the failure.
    pub cause: String,
    /// Suggested remedy.
    pub cure: String,
}
