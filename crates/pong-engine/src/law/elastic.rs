//! F = k·δ^p, p = 1 or 3/2: the spring of laws whose stiffness may depend on the depth.

use pong_model::Exponent;

pub(super) fn force(stiffness: f64, exponent: Exponent, depth: f64) -> f64 {
    match exponent {
        Exponent::One => stiffness * depth,
        Exponent::ThreeHalves => stiffness * depth * depth.sqrt(),
    }
}

/// Slope ∂F/∂δ, N/m.
pub(super) fn slope(stiffness: f64, exponent: Exponent, depth: f64) -> f64 {
    match exponent {
        Exponent::One => stiffness,
        Exponent::ThreeHalves => 1.5 * stiffness * depth.sqrt(),
    }
}

pub(super) fn stored(stiffness: f64, exponent: Exponent, depth: f64) -> f64 {
    match exponent {
        Exponent::One => 0.5 * stiffness * depth * depth,
        Exponent::ThreeHalves => 0.4 * stiffness * depth * depth * depth.sqrt(),
    }
}
