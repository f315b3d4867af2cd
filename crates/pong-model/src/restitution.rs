//! Damping from a desired restitution e, the rebound speed divided by the impact speed.
//!
//! Linear law, F = max(0, k·δ + c·δ'), damping ratio ζ = c/(2·√(k·m)); the contact ends where the force would
//! begin to pull:
//!
//! ```text
//! ζ < 1:  e = exp(−(ζ/s)·atan2(2ζs, 2ζ² − 1)),        s = √(1 − ζ²)
//! ζ = 1:  e = exp(−2)
//! ζ > 1:  e = exp(−(ζ/q)·ln((ζ + q)/(ζ − q))),        q = √(ζ² − 1)
//! ```
//!
//! Hunt-Crossley law, F = k·δ^n·(1 + χ·δ') with any exponent n, impact speed v and rebound speed e·v:
//!
//! ```text
//! ln((1 + χv)/(1 − χev)) = χv·(1 + e)
//! ```
//!
//! Both equations are solved by bisection, which gives the same bits on every machine. The power law has no closed
//! form: see `power_law.rs`.

mod power_law;

pub use power_law::{Impact, power_law_damping, restitution_of_power_law};

/// Number of bisections after which an interval of doubles cannot shrink further.
const HALVINGS: usize = 200;

/// Restitution of the linear law that never pulls, as a function of the damping ratio.
pub fn restitution_of_zeta(zeta: f64) -> f64 {
    if zeta < 1.0 {
        let s = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
        return libm::exp(-(zeta / s) * libm::atan2(2.0 * zeta * s, 2.0 * zeta * zeta - 1.0));
    }
    let q = ((zeta - 1.0) * (zeta + 1.0)).sqrt();
    // Uses ζ − q = 1/(ζ + q), and ln((1+u)/(1−u)) with u = q/ζ, which keeps its precision near ζ = 1.
    if q == 0.0 {
        return libm::exp(-2.0);
    }
    libm::exp(-2.0 * (zeta / q) * libm::log1p(q + (zeta - 1.0)))
}

/// Damping ratio ζ of the linear law that gives the restitution `e`, 0 < e ≤ 1.
pub fn zeta_for_restitution(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    let mut high = 1.0;
    while restitution_of_zeta(high) > e {
        high *= 2.0;
    }
    bisect(0.0, high, |zeta| restitution_of_zeta(zeta) > e)
}

/// Dissipation χ (s/m) of the Hunt-Crossley law that gives the restitution `e`, 0 < e ≤ 1, at impact speed
/// `speed` (m/s).
pub fn chi_for_restitution(e: f64, speed: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // With x = χ·v: the root of g(x) = ln(1+x) − ln(1−e·x) − x·(1+e), which is negative between 0 and the
    // root.
    let low = 0.5 * (1.5 * (1.0 - e) * (1.0 + e) / (1.0 + e * e * e));
    bisect(low, 1.0 / e, |x| excess(x, e) < 0.0) / speed
}

/// g(x)/x²; by its series where the logarithms would cancel.
fn excess(x: f64, e: f64) -> f64 {
    if x >= 0.1 {
        return (libm::log1p(x) - libm::log1p(-e * x) - x * (1.0 + e)) / (x * x);
    }
    // Σ ((−1)^(k+1) + e^k)·x^(k−2)/k from k = 2; 1 − e^k = (1 − e)·(1 + e + … + e^(k−1)).
    let (mut sum, mut power, mut geometric, mut x_power) = (0.0, e, 1.0 + e, 1.0);
    for k in 2..24 {
        power *= e;
        let coefficient = if k % 2 == 0 { -(1.0 - e) * geometric } else { 1.0 + power };
        sum += coefficient * x_power / f64::from(k);
        geometric += power;
        x_power *= x;
    }
    sum
}

/// Point between `low` and `high` up to which `below` holds.
fn bisect(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_restitution_inverts_the_law_that_never_pulls() {
        assert!((zeta_for_restitution(0.5) - 0.25528).abs() < 5e-6);
        assert!((zeta_for_restitution(0.25) - 0.5973).abs() < 5e-5);
        assert!((restitution_of_zeta(1.0) - 0.135335283).abs() < 1e-9);
        assert!((restitution_of_zeta(2.0) - 0.04777).abs() < 5e-6);
        for e in [1e-6, 1e-3, 0.05, 0.1353, 0.1354, 0.3, 0.9, 0.999, 1.0 - 1e-9] {
            let back = restitution_of_zeta(zeta_for_restitution(e));
            assert!((back - e).abs() < 1e-12 + 1e-10 * e, "{e} {back}");
        }
    }

    #[test]
    fn hunt_crossley_restitution_inverts_the_exact_law() {
        assert!((chi_for_restitution(0.593624, 1.0) - 1.0).abs() < 1e-5);
        assert!((chi_for_restitution(0.099982, 2.0) - 5.0).abs() < 1e-3);
        assert!((chi_for_restitution(0.01, 1.0) - 100.0).abs() < 1e-9);
        for e in [0.1_f64, 0.2, 0.5, 0.9, 0.99, 0.9999] {
            let x = chi_for_restitution(e, 1.0);
            let residue = ((1.0 + x) / (1.0 - e * x)).ln() - x * (1.0 + e);
            assert!(residue.abs() < 1e-10 && x > (1.0 - e), "{e} {x} {residue}");
        }
    }
}
