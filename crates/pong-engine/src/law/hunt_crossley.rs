//! F = k·δ^e·(1 + χ·δ'),  e = 1 or 3/2, with stiffness k and dissipation χ, s/m.
//!
//! K. H. Hunt and F. R. E. Crossley, "Coefficient of restitution interpreted as damping in vibroimpact", J.
//! Appl. Mech. 42 (1975). The damping scales with the load, so the force is continuous at touch.

use super::elastic;
use pong_model::Exponent;

pub(super) fn force(stiffness: f64, dissipation: f64, exponent: Exponent, depth: f64, rate: f64) -> f64 {
    elastic::force(stiffness, exponent, depth) * (1.0 + dissipation * rate)
}

/// Slopes ∂F/∂δ, N/m, and ∂F/∂δ', N·s/m.
pub(super) fn tangent(
    stiffness: f64,
    dissipation: f64,
    exponent: Exponent,
    depth: f64,
    rate: f64,
) -> (f64, f64) {
    let slope = elastic::slope(stiffness, exponent, depth);
    (slope * (1.0 + dissipation * rate), elastic::force(stiffness, exponent, depth) * dissipation)
}
