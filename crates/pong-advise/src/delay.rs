//! The critical delay: how late a wrench may act before a contact that lasts gains energy.
//!
//! A mass on a spring and a damper whose force acts a time τ late obeys m·x'' + c·x'(t − τ) + k·x(t − τ) = 0. The delay at
//! which its oscillation neither decays nor grows has a closed form (docs/advise.md, Late wrenches).

use libm::atan2;

/// Critical delay (s) of a contact of stiffness `k` (N/m, above 0) and damping `c` (N·s/m) on an effective mass `m` (kg):
///
/// ```text
/// ω² = (c² + √(c⁴ + 4·m²·k²))/(2·m²),   τ = atan2(c·ω, k)/ω
/// ```
///
/// A contact with a shorter delay loses energy, one with a longer delay gains it; 0 without damping. A wrench that is held
/// over a frame acts half a frame late, and n frames later with n delay frames.
pub fn critical_delay(k: f64, c: f64, m: f64) -> f64 {
    // In units of the rate √(k/m), which keep squares within range.
    let rate = (k / m).sqrt();
    let damping = c / (m * rate);
    let square = damping * damping;
    let omega = (0.5 * (square + (square * square + 4.0).sqrt())).sqrt();
    atan2(damping * omega, 1.0) / (omega * rate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::longest_stable_step;
    use pong_engine::WrenchCoupling;

    /// ω·τ for ζ = 0.02 … 1, found by integrating the delayed equation.
    #[test]
    fn delays_are_those_of_integrated_motions() {
        for (zeta, radians) in
            [(0.02, 0.040), (0.05, 0.100), (0.1, 0.197), (0.2, 0.379), (0.5, 0.711), (1.0, 0.647)]
        {
            let (k, m) = (3e5_f64, 70.0_f64);
            let rate = (k / m).sqrt();
            let delay = critical_delay(k, 2.0 * zeta * m * rate, m);
            assert!((delay * rate - radians).abs() < 1.1e-3, "{zeta}: {}", delay * rate);
        }
        assert_eq!(critical_delay(1e6, 0.0, 10.0), 0.0);
        // Little damping: c/k.
        assert!((critical_delay(1e6, 1.0, 10.0) * 1e6 - 1.0).abs() < 1e-6);
        // Scaling of time, and masses of 1e-6 to 1e9 kg.
        for m in [1e-6, 1.0, 1e9] {
            assert!(
                (critical_delay(1e4 * m, 50.0 * m, m) / critical_delay(1e4, 50.0, 1.0) - 1.0).abs() < 1e-14
            );
        }
    }

    /// The recursion for held wrenches n frames late has the same limit for many short frames: (n + ½)·T.
    #[test]
    fn the_closed_form_is_the_limit_of_the_recursion() {
        for zeta in [0.02, 0.1, 0.3, 1.0] {
            let (k, c, m) = (1e4, 200.0 * zeta, 1.0);
            let exact = critical_delay(k, c, m);
            for (frames, off) in [(5, 1e-2), (20, 1e-3)] {
                let frame =
                    longest_stable_step(WrenchCoupling::ZeroOrderHold { delay_frames: frames }, k, c, m);
                let delay = frame * (f64::from(frames) + 0.5);
                assert!((delay / exact - 1.0).abs() < off, "{zeta} {frames}: {delay} {exact}");
            }
        }
    }
}
