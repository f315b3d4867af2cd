//! Energies of an end position that a contact adds in a step of length T: the normal spring with its damper, and a
//! bristle with radial return (docs/theory.md, 7).

use super::props::{FrictionProps, NormalProps, PairProps};
use pong_model::Exponent;

/// Normal energy of a contact of weight 1, J, and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NormalIncrement {
    pub energy: f64,
    /// Derivative with respect to the depth at the end: the normal force, N.
    pub force: f64,
    /// Derivative with respect to the depth at the start, N.
    pub by_start: f64,
    /// Second derivative with respect to the depth at the end, N/m.
    pub stiffness: f64,
}

/// Force F(x) = k·x^p + (c/T)·x^q·(x − δ₀) at the depth x, cut at zero.
struct Force {
    stiffness: f64,
    exponent: f64,
    /// c/T, N/m^(1+q).
    damping: f64,
    damping_exponent: f64,
    /// Depth δ₀ at the start, m.
    start: f64,
}

/// ∫F dx up to the depth at the end, with F the force of the normal law and δ' = (x − δ₀)/T; the ramp of a damping
/// counts as 0. `None` for a host's law.
pub(crate) fn normal_increment(
    props: &PairProps,
    depth: f64,
    start: f64,
    step: f64,
) -> Option<NormalIncrement> {
    let power = |exponent: Exponent| exponent.value();
    let (exponent, damping, damping_exponent) = match &props.normal {
        NormalProps::Linear { damping, .. } => (1.0, *damping, 0.0),
        NormalProps::HuntCrossley { dissipation, exponent } => {
            (power(*exponent), props.stiffness * dissipation, power(*exponent))
        }
        NormalProps::PowerLaw { damping, exponent, damping_exponent } => {
            (power(*exponent), *damping, *damping_exponent)
        }
        NormalProps::Custom { .. } => return None,
    };
    let damping = damping / step;
    let force = Force { stiffness: props.stiffness, exponent, damping, damping_exponent, start };
    Some(force.integrated_to(depth))
}

impl Force {
    fn integrated_to(&self, depth: f64) -> NormalIncrement {
        let from = self.zero();
        if depth <= from {
            return NormalIncrement { energy: 0.0, force: 0.0, by_start: 0.0, stiffness: 0.0 };
        }
        let (q, pow) = (self.damping_exponent, libm::pow);
        NormalIncrement {
            energy: self.antiderivative(depth) - self.antiderivative(from),
            force: self.at(depth),
            by_start: -self.damping * (pow(depth, q + 1.0) - pow(from, q + 1.0)) / (q + 1.0),
            stiffness: self.stiffness * self.exponent * pow(depth, self.exponent - 1.0)
                + self.damping * (pow(depth, q) + q * pow(depth, q - 1.0) * (depth - self.start)),
        }
    }

    fn at(&self, x: f64) -> f64 {
        self.stiffness * libm::pow(x, self.exponent)
            + self.damping * libm::pow(x, self.damping_exponent) * (x - self.start)
    }

    fn antiderivative(&self, x: f64) -> f64 {
        let (p, q) = (self.exponent + 1.0, self.damping_exponent + 1.0);
        self.stiffness * libm::pow(x, p) / p
            + self.damping * libm::pow(x, q) * (x / (q + 1.0) - self.start / q)
    }

    /// Depth above which the force pushes: the zero of k·x^(p−q) − (c/T)·(δ₀ − x), which rises with x; 0 if there is
    /// none.
    fn zero(&self) -> f64 {
        let rise = self.exponent - self.damping_exponent;
        let (mut low, mut high) = (0.0, self.start.max(0.0));
        let is_over = |x: f64| self.stiffness * libm::pow(x, rise) > self.damping * (self.start - x);
        if is_over(low) {
            return 0.0;
        }
        // Bisection to the last bit: a double has 53.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if is_over(middle) { &mut high } else { &mut low }) = middle;
        }
        low
    }
}

/// Spring that a bristle is in one step: energy ½K·|p + u|² up to the force limit L, then L·|p + u| − L²/(2K).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BristleIncrement {
    /// Stiffness K of a contact that has the whole bristle, N/m.
    pub stiffness: f64,
    /// Part of the bristle of the last commit in p, no unit.
    pub carried: f64,
    /// True if K follows from the share of the contact; false if from its load.
    pub is_shared: bool,
}

/// The spring of a friction law in a step of length `step`, s, for the limit `limit`, N: a bristle with its damper,
/// K = k_t + c_t/T and p = carried·k_t/K; Coulomb's law, whose force grows to its limit up to the slip speed. `None` for
/// a host's law and for none.
pub(crate) fn bristle_increment(law: &FrictionProps, limit: f64, step: f64) -> Option<BristleIncrement> {
    match law {
        FrictionProps::Bristle { stiffness: own, damping, .. } => {
            let stiffness = own + damping / step;
            let carried = own / stiffness.max(f64::MIN_POSITIVE);
            Some(BristleIncrement { stiffness, carried, is_shared: true })
        }
        FrictionProps::Coulomb { slip_speed, .. } => {
            let stiffness = limit / (slip_speed * step);
            Some(BristleIncrement { stiffness, carried: 0.0, is_shared: false })
        }
        FrictionProps::None | FrictionProps::Custom { .. } => None,
    }
}
