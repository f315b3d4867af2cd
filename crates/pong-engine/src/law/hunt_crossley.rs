//! F = k·δ^e·(1 + χ·δ'),  e = 1 or 3/2.
//!
//! K. H. Hunt and F. R. E. Crossley, "Coefficient of restitution interpreted as damping in vibroimpact",
//! J. Appl. Mech. 42 (1975). The damping scales with the load, so the force has no step at touch.

use pong_model::Exponent;

pub(super) fn force(stiffness: f64, dissipation: f64, exponent: Exponent, depth: f64, rate: f64) -> f64 {
    let elastic = match exponent {
        Exponent::One => stiffness * depth,
        Exponent::ThreeHalves => stiffness * depth * depth.sqrt(),
    };
    elastic * (1.0 + dissipation * rate)
}

/// ∂F/∂δ, N/m, and ∂F/∂δ', N·s/m.
pub(super) fn tangent(
    stiffness: f64,
    dissipation: f64,
    exponent: Exponent,
    depth: f64,
    rate: f64,
) -> (f64, f64) {
    let slope = match exponent {
        Exponent::One => stiffness,
        Exponent::ThreeHalves => 1.5 * stiffness * depth.sqrt(),
    };
    let elastic = force(stiffness, 0.0, exponent, depth, 0.0);
    (slope * (1.0 + dissipation * rate), elastic * dissipation)
}

pub(super) fn stored(stiffness: f64, exponent: Exponent, depth: f64) -> f64 {
    match exponent {
        Exponent::One => 0.5 * stiffness * depth * depth,
        Exponent::ThreeHalves => 0.4 * stiffness * depth * depth * depth.sqrt(),
    }
}
