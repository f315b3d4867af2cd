//! F = k·δ + c·S(δ/ramp)·δ',  S(x) = 3x² − 2x³ on 0…1.
//!
//! Kelvin-Voigt element with stiffness k and damping c; the caller cuts the force at zero, so it never pulls.
//! Without a ramp the damping force steps to c·δ' at touch. With a ramp it grows until the depth is `ramp`,
//! m.

pub(super) fn force(stiffness: f64, damping: f64, ramp: f64, depth: f64, rate: f64) -> f64 {
    stiffness * depth + damping * ramp_factor(depth, ramp) * rate
}

pub(super) fn stored(stiffness: f64, depth: f64) -> f64 {
    0.5 * stiffness * depth * depth
}

/// Slopes ∂F/∂δ, N/m, and ∂F/∂δ', N·s/m.
pub(super) fn tangent(stiffness: f64, damping: f64, ramp: f64, depth: f64, rate: f64) -> (f64, f64) {
    // Avoids a division by a ramp of zero.
    if depth >= ramp {
        return (stiffness, damping);
    }
    let x = depth / ramp;
    let slope = 6.0 * x * (1.0 - x) / ramp;
    (stiffness + damping * slope * rate, damping * ramp_factor(depth, ramp))
}

fn ramp_factor(depth: f64, ramp: f64) -> f64 {
    if depth >= ramp {
        return 1.0;
    }
    let x = depth / ramp;
    x * x * (3.0 - 2.0 * x)
}
