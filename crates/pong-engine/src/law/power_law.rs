//! F = k·δ^p + c·δ^q·δ',  p = 1 or 3/2, 0 ≤ q ≤ p.
//!
//! q = 0 is the linear law's damper, q = p the Hunt-Crossley law with χ = c/k; in between, the restitution
//! depends on speed and mass (docs/theory.md, 3). The caller cuts the force at zero.

use super::elastic;
use pong_model::Exponent;

/// Damper of the law: c, N·s/m^(1+q), and q.
#[derive(Clone, Copy)]
pub(super) struct Damper {
    pub damping: f64,
    pub exponent: f64,
}

impl Damper {
    /// Damping c·δ^q at a depth, N·s/m.
    fn at(self, depth: f64) -> f64 {
        self.damping * power(depth, self.exponent)
    }
}

pub(super) fn force(stiffness: f64, exponent: Exponent, damper: Damper, depth: f64, rate: f64) -> f64 {
    elastic::force(stiffness, exponent, depth) + damper.at(depth) * rate
}

/// Slopes ∂F/∂δ, N/m, and ∂F/∂δ', N·s/m.
pub(super) fn tangent(
    stiffness: f64,
    exponent: Exponent,
    damper: Damper,
    depth: f64,
    rate: f64,
) -> (f64, f64) {
    let damping = damper.at(depth);
    // q·c·δ^(q − 1); unbounded at touch for q < 1, where the force is zero.
    let rise = damper.exponent * damping / depth.max(f64::MIN_POSITIVE);
    (elastic::slope(stiffness, exponent, depth) + rise * rate, damping)
}

/// Damping of two surfaces in series, N·s/m^(1+q), with A's share `share_a` of depth and depth rate: the
/// powers that the two dampers dissipate add.
pub(super) fn series_damping(c_a: f64, c_b: f64, share_a: f64, exponent: f64) -> f64 {
    let share_b = 1.0 - share_a;
    c_a * share_a * share_a * power(share_a, exponent) + c_b * share_b * share_b * power(share_b, exponent)
}

/// x^q for x ≥ 0; by square roots for the exponents of known laws.
fn power(x: f64, q: f64) -> f64 {
    match q {
        0.0 => 1.0,
        0.25 => x.sqrt().sqrt(),
        0.5 => x.sqrt(),
        1.0 => x,
        1.5 => x * x.sqrt(),
        _ => libm::pow(x, q),
    }
}
