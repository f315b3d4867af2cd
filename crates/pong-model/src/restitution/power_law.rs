//! Restitution of F = max(0, k·δ^p + c·δ^q·δ'), and the damping c for a desired restitution.
//!
//! With r = (q + 1)/(p + 1) the restitution depends on r and on one dimensionless group Γ (docs/theory.md,
//! 3):
//!
//! ```text
//! Γ = c·(q + 1)^(r − 1)·k^(−r)·m^(r − 1)·v^(2r − 1)
//! y" = −max(0, y^a + Γ·y'),   a = 1/r − 1,   y(0) = 0,   y'(0) = 1,   e = −y' where the force ends
//! ```
//!
//! The equation of motion is integrated in two parts, each over a fixed interval:
//!
//! ```text
//! compression   by the phase φ, 0 to π/2:   y' = ρ·cos φ,  √(2r)·y^(1/(2r)) = ρ·sin φ
//! rebound       by Q = −Γ·y'/y^a, 0 to 1:   the share of the spring's force that the damper takes
//! ```
//!
//! ln ρ keeps its relative precision where the loss is small.

use super::{chi_for_restitution, restitution_of_zeta, zeta_for_restitution};
use std::f64::consts::FRAC_PI_2;

/// Impact and its restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Rebound speed over impact speed, 0 < e ≤ 1; no unit.
    pub e: f64,
    /// Impact speed, m/s.
    pub speed: f64,
    /// Effective mass at the contact, kg.
    pub mass: f64,
}

/// Damping c, N·s/m^(1+q), of a contact of stiffness `k` (N/m^p) and exponents p and q that gives the
/// restitution of an impact.
pub fn power_law_damping(k: f64, p: f64, q: f64, impact: &Impact) -> f64 {
    let Impact { e, speed, mass } = *impact;
    let r = (q + 1.0) / (p + 1.0);
    let scale = libm::pow(k, r) * libm::pow((q + 1.0) * mass, 1.0 - r);
    damping_group(r, e) * scale * libm::pow(speed, 1.0 - 2.0 * r)
}

/// Restitution of a law with r = (q + 1)/(p + 1) at the group Γ; 0.4 ≤ r ≤ 1.
pub fn restitution_of_power_law(r: f64, group: f64) -> f64 {
    if group == 0.0 { 1.0 } else { libm::exp(-speed_loss(r, group)) }
}

/// Group Γ that gives the restitution `e`, 0 < e ≤ 1.
fn damping_group(r: f64, e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // Laws with a closed form.
    if r == 0.5 {
        return 2.0 * zeta_for_restitution(e);
    }
    if r == 1.0 {
        return chi_for_restitution(e, 1.0);
    }
    let wanted = -libm::log(e);
    // ln(−ln e) is nearly linear in ln Γ where the loss is small, and flattens beyond.
    let excess = |ln_group: f64| libm::log(speed_loss(r, libm::exp(ln_group)) / wanted);
    let start = libm::log(wanted);
    let (mut low, mut high) = (start - 2.0, start + 2.0);
    while excess(low) > 0.0 {
        low -= 2.0;
    }
    while excess(high) < 0.0 {
        high += 0.5 * wanted.max(4.0);
    }
    libm::exp(root(low, high, excess))
}

/// Function value in [`root`] that counts as zero: the error of the integrals.
const ZERO: f64 = 1e-10;

/// Root of an increasing function between two values of opposite sign, by false position with the Illinois
/// rule: the value at an end that is kept is halved.
fn root(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high) = (function(low), function(high));
    let mut stayed = 0;
    for _ in 0..super::HALVINGS {
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        let value = function(middle);
        if value.abs() <= ZERO {
            return middle;
        }
        if value < 0.0 {
            (low, at_low) = (middle, value);
            at_high *= if stayed == 1 { 0.5 } else { 1.0 };
            stayed = 1;
        } else {
            (high, at_high) = (middle, value);
            at_low *= if stayed == -1 { 0.5 } else { 1.0 };
            stayed = -1;
        }
    }
    0.5 * (low + high)
}

/// Restitution below which the formula for a strong damper, Γ^(−1/r), is exact to eight digits.
const HARDLY_ANY: f64 = 1e-10;

/// Computes −ln e at a positive group.
fn speed_loss(r: f64, group: f64) -> f64 {
    if r == 0.5 {
        return -libm::log(restitution_of_zeta(0.5 * group));
    }
    let strong = libm::log(group) / r;
    if strong > -libm::log(HARDLY_ANY) {
        return strong;
    }
    let damper = group * libm::pow(2.0 * r, 1.0 - r);
    let compressed = compression(r, damper);
    let a = 1.0 / r - 1.0;
    // κ = Γ²·y^(1 − a) at the greatest depth.
    let ln_kappa = 2.0 * libm::log(group) + (1.0 - a) * r * (2.0 * compressed - libm::log(2.0 * r));
    let [ln_kappa, rebound] = rebound(r, ln_kappa);
    0.5 * libm::log1p(2.0 * r * libm::exp(ln_kappa)) - compressed - rebound
}

/// Computes ln ρ at the greatest depth. The variable of integration is φ^(2r), in which the slope is finite
/// at first touch.
fn compression(r: f64, damper: f64) -> f64 {
    let power = 2.0 * r - 1.0;
    let slope = |s: f64, [ln_rho]: [f64; 1]| {
        let damper = damper * libm::exp(power * ln_rho);
        let phase = libm::pow(s, 0.5 / r);
        let (sine, cosine) = (libm::sin(phase), libm::cos(phase));
        let shape = if phase > 0.0 { libm::pow(sine / phase, power) } else { 1.0 };
        let turning = 1.0 + damper * libm::pow(sine, power + 1.0) * cosine;
        [-damper * shape * cosine * cosine / (2.0 * r * turning)]
    };
    let [ln_rho] = integral(slope, libm::pow(FRAC_PI_2, 2.0 * r), [0.0]);
    ln_rho
}

/// Computes ln κ at the end of the force, and the change of ln ρ up to there.
fn rebound(r: f64, ln_kappa: f64) -> [f64; 2] {
    let a = 1.0 / r - 1.0;
    let slope = |share: f64, [ln_kappa, _]: [f64; 2]| {
        let kappa = libm::exp(ln_kappa);
        let squared = share * share;
        let turning = kappa * (1.0 - share) + a * squared;
        // The spring has no force left.
        if turning == 0.0 {
            return [0.0, 0.0];
        }
        [(a - 1.0) * share / turning, -kappa * squared / ((squared + 2.0 * r * kappa) * turning)]
    };
    integral(slope, 1.0, [ln_kappa, 0.0])
}

/// Error of a step relative to the integrated quantity.
const STEP_ERROR: f64 = 1e-11;
/// Step limit; the hardest integral takes a tenth of it.
const STEPS: usize = 20_000;

/// Integrates from 0 to `end` with the Dormand-Prince pair of orders 5 and 4; the steps depend on the numbers
/// only.
fn integral<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    end: f64,
    start: [f64; N],
) -> [f64; N] {
    let (mut at, mut state, mut step) = (0.0, start, 1e-3 * end);
    for _ in 0..STEPS {
        let last = at + step >= end;
        let width = if last { end - at } else { step };
        let (next, error) = dormand_prince(&slope, at, state, width);
        let share = (0..N)
            .map(|i| error[i].abs() / (STEP_ERROR * state[i].abs().max(next[i].abs()).max(f64::MIN_POSITIVE)))
            .fold(0.0, |worst: f64, x| if x > worst || x.is_nan() { x } else { worst });
        if share <= 1.0 {
            (at, state) = (at + width, next);
            if last {
                break;
            }
        }
        // NaN comes from a step that is far too long.
        let factor = if share.is_finite() { 0.9 * libm::pow(share.max(1e-4), -0.2) } else { 0.1 };
        step = width * factor.clamp(0.1, 5.0);
    }
    state
}

/// Nodes of the stages, their weights, and the weights of the difference between the two orders.
const NODES: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
const STAGES: [[f64; 6]; 7] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
const DIFFERENCE: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// State after a step, and the estimate of its error.
fn dormand_prince<const N: usize>(
    slope: &impl Fn(f64, [f64; N]) -> [f64; N],
    at: f64,
    state: [f64; N],
    width: f64,
) -> ([f64; N], [f64; N]) {
    let mut slopes = [[0.0; N]; 7];
    let mut next = state;
    for stage in 0..7 {
        let weighted =
            |i: usize| (0..stage).map(|before| STAGES[stage][before] * slopes[before][i]).sum::<f64>();
        next = std::array::from_fn(|i| state[i] + width * weighted(i));
        slopes[stage] = slope(at + NODES[stage] * width, next);
    }
    let error = |i: usize| (0..7).map(|stage| DIFFERENCE[stage] * slopes[stage][i]).sum::<f64>();
    (next, std::array::from_fn(|i| width * error(i)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Group Γ of exponents p and q for k = m = v = 1 and damping `c`.
    fn group(p: f64, q: f64, c: f64) -> (f64, f64) {
        let r = (q + 1.0) / (p + 1.0);
        (r, c * libm::pow(q + 1.0, r - 1.0))
    }

    /// x" = −max(0, x^p + c·x^q·x') integrated in time by another program (eighth order, error 1e-8) up to
    /// the rebound.
    #[test]
    fn restitution_is_that_of_the_equation_of_motion() {
        for (p, q, c, e) in [
            (1.0, 0.6, 0.01, 0.991_218_692),
            (1.0, 0.6, 0.5, 0.673_414_024),
            (1.0, 0.6, 3.0, 0.206_133_015),
            (1.5, 1.0, 0.5, 0.684_011_146),
            (1.5, 1.0, 3.0, 0.215_034_892),
            (1.5, 0.5, 3.0, 0.133_716_622),
            (1.5, 0.0, 0.5, 0.468_038_545),
            (1.5, 0.0, 3.0, 0.045_192_221),
            (1.5, 1.45, 3.0, 0.295_236_384),
        ] {
            let (r, group) = group(p, q, c);
            let got = restitution_of_power_law(r, group);
            assert!((got - e).abs() < 1e-8, "{p} {q} {c}: {got} {e}");
        }
    }

    /// r = 1/2 has the closed form of the linear law, r = 1 that of Hunt and Crossley; in between the
    /// restitution is continuous.
    #[test]
    fn the_ends_are_the_laws_with_closed_forms() {
        for e in [1e-6, 0.01, 0.3, 0.58, 0.9, 0.999_99] {
            for (r, closed) in [(0.5, 2.0 * zeta_for_restitution(e)), (1.0, chi_for_restitution(e, 1.0))] {
                assert_eq!(damping_group(r, e), closed);
                for near in [r - 1e-7, r + 1e-7, r - 1e-13] {
                    if near < 1.0 {
                        let got = damping_group(near, e);
                        assert!((got / closed - 1.0).abs() < 1e-5, "{e} {near}: {got} {closed}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_damping_gives_the_restitution_asked_for() {
        for r in [0.4, 0.45, 0.6, 0.8, 0.95, 0.999_999] {
            for e in [1e-12, 1e-6, 0.01, 0.3, 0.6, 0.9, 1.0 - 1e-6, 1.0 - 1e-9] {
                let back = restitution_of_power_law(r, damping_group(r, e));
                assert!(
                    (back - e).abs() < 1e-7 * e && (back - e).abs() < 1e-6 * (1.0 - e) + 1e-16,
                    "{r} {e}: {back}"
                );
            }
            assert_eq!(damping_group(r, 1.0), 0.0);
        }
    }

    /// Where the loss is small, 1 − e is proportional to v^(2r − 1) and m^(r − 1), over two decades each.
    #[test]
    fn the_loss_follows_the_powers_of_speed_and_mass() {
        for (p, q) in [(1.0, 0.6), (1.5, 1.0), (1.5, 0.5), (1.5, 0.25)] {
            let r = (q + 1.0) / (p + 1.0);
            let impact = Impact { e: 1.0 - 1e-6, speed: 2.0, mass: 0.04 };
            let damping = power_law_damping(1e6, p, q, &impact);
            let loss = |speed: f64, mass: f64| {
                let scale = libm::pow(1e6, -r) * libm::pow((q + 1.0) * mass, r - 1.0);
                1.0 - restitution_of_power_law(r, damping * scale * libm::pow(speed, 2.0 * r - 1.0))
            };
            let by_speed = (loss(20.0, 0.04) / loss(0.2, 0.04)).log10() / 2.0;
            let by_mass = (loss(2.0, 0.4) / loss(2.0, 0.004)).log10() / 2.0;
            assert!((by_speed - (2.0 * r - 1.0)).abs() < 1e-5, "{p} {q}: {by_speed}");
            assert!((by_mass - (r - 1.0)).abs() < 1e-5, "{p} {q}: {by_mass}");
        }
    }
}
