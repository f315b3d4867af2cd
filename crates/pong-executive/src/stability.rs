//! The longest stable step of a single contact on the bodies at hand (linear stability, translation alone).
//!
//! With m the effective mass, κ = k·dt²/m and γ = c·dt/m:
//!
//! | integrator | stable if and only if |
//! |---|---|
//! | semi-implicit Euler | κ + 2γ < 4 |
//! | Runge-Kutta 4 | ω·dt < 2.828 (undamped) and γ < 2.785 |
//! | zero-order hold, n frames late | k·dt·(½ + n) < c < 2m/dt |
//!
//! Several contacts at once, and contacts off the mass centre, need shorter steps still.

use crate::integrate::Integrator;

/// The longest step (s) at which one contact of stiffness `k` (N/m) and damping `c` (N·s/m) on an effective mass `m`
/// (kg) is stable; 0 if no step is.
pub fn longest_stable_step(integrator: Integrator, k: f64, c: f64, m: f64) -> f64 {
    match integrator {
        // The positive root of k·dt² + 2c·dt − 4m.
        Integrator::SemiImplicitEuler => ((c * c + 4.0 * k * m).sqrt() - c) / k,
        Integrator::RungeKutta4 => {
            let damped = if c > 0.0 { 2.785 * m / c } else { f64::INFINITY };
            (2.828 * (m / k).sqrt()).min(damped)
        }
        Integrator::ZeroOrderHold { delay, .. } if c > 0.0 => {
            (c / (k * (0.5 + f64::from(delay)))).min(2.0 * m / c)
        }
        Integrator::ZeroOrderHold { .. } => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Known answers: dt = 2√(m/k) undamped; κ + 2γ = 4 with damping; kT/2 = c and c = 2m/T for a held wrench.
    #[test]
    fn limits_are_those_of_the_stability_table() {
        let euler = Integrator::SemiImplicitEuler;
        assert!((longest_stable_step(euler, 1e4, 0.0, 1.0) - 0.02).abs() < 1e-15);
        let step = longest_stable_step(euler, 3e4, 70.0, 2.0);
        assert!((3e4 * step * step / 2.0 + 2.0 * 70.0 * step / 2.0 - 4.0).abs() < 1e-12);
        let hold = |delay| Integrator::ZeroOrderHold { substeps: 1, delay };
        assert_eq!(longest_stable_step(hold(0), 1e4, 5.0, 1.0), 1e-3);
        assert!((longest_stable_step(hold(1), 1e4, 15.0, 1.0) - 1e-3).abs() < 1e-18);
        assert_eq!(longest_stable_step(hold(0), 1e4, 0.0, 1.0), 0.0);
        assert_eq!(longest_stable_step(Integrator::RungeKutta4, 1e4, 0.0, 1.0), 0.02828);
    }
}
