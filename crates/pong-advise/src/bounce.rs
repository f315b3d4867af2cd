//! One bounce of a mass m at speed v on the linear law that never pulls, F = max(0, kδ + cδ').
//!
//! With ω = √(k/m), ζ = c/(2mω), s = √(1 − ζ²), q = √(ζ² − 1), until the force would pull:
//!
//! ```text
//! deepest   δ = (v/ω)·exp(−(ζ/s)·atan2(s, ζ))         ζ > 1:  (v/ω)·exp(−(ζ/q)·ln(ζ + q))
//! rebound   e of pong_model::restitution
//! ```
//!
//! Any step deviates from these forms: touch falls between two evaluations, so the force begins up to a step
//! late. The deviation is found by simulating the bounce at that step from several phases of touch. All is in
//! units of ω and v.

use pong_engine::WrenchCoupling;
use pong_model::restitution::restitution_of_zeta;
use std::collections::VecDeque;

/// Largest relative errors of a bounce against its closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Error of the greatest depth.
    pub depth: f64,
    /// Error of the rebound speed.
    pub rebound: f64,
}

impl Default for Accuracy {
    /// Depth within 5 %, rebound within 2 %.
    fn default() -> Self {
        Self { depth: 0.05, rebound: 0.02 }
    }
}

/// Relative errors of a bounce against its closed form, at the worst phase of touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BounceError {
    /// Error of the greatest depth at an evaluation.
    pub depth: f64,
    /// Error of the rebound speed.
    pub rebound: f64,
}

impl BounceError {
    /// True if both errors are within these.
    pub fn is_within(&self, accuracy: &Accuracy) -> bool {
        self.depth <= accuracy.depth && self.rebound <= accuracy.rebound
    }
}

/// Greatest depth of a bounce over v/ω, for a damping ratio.
pub fn depth_factor(zeta: f64) -> f64 {
    if zeta < 1.0 {
        let s = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
        return libm::exp(-(zeta / s) * libm::atan2(s, zeta));
    }
    let q = ((zeta - 1.0) * (zeta + 1.0)).sqrt();
    if q == 0.0 {
        return libm::exp(-1.0);
    }
    libm::exp(-(zeta / q) * libm::log1p(q + (zeta - 1.0)))
}

/// Number of phases of touch simulated.
const PHASES: u32 = 24;

/// Errors of a bounce at a step of ω·dt. The damping is that of ζ, plus the damping that the lag of the
/// coupling removes (see [`crate::advise_contact`]).
pub fn bounce_error(coupling: WrenchCoupling, zeta: f64, omega_step: f64) -> BounceError {
    let expected = (depth_factor(zeta), restitution_of_zeta(zeta));
    let gamma = (2.0 * zeta + omega_step * coupling.lag()) * omega_step;
    let mut worst = BounceError { depth: 0.0, rebound: 0.0 };
    for phase in 0..PHASES {
        let start = -omega_step * (f64::from(phase) + 0.5) / f64::from(PHASES);
        let Some((depth, rebound)) = bounce(coupling, omega_step, gamma, start) else {
            return BounceError { depth: f64::INFINITY, rebound: f64::INFINITY };
        };
        worst.depth = worst.depth.max((depth / expected.0 - 1.0).abs());
        worst.rebound = worst.rebound.max((rebound / expected.1 - 1.0).abs());
    }
    worst
}

/// Share of the accuracy for the phases simulated; the rest is for those between them.
const USED: f64 = 0.8;

/// The longest step, as ω·dt, up to which every bounce is within an accuracy.
pub fn resolved_step(coupling: WrenchCoupling, zeta: f64, accuracy: &Accuracy) -> f64 {
    /// Factor from one step tried to the next.
    const LONGER: f64 = 1.1;
    let used = Accuracy { depth: USED * accuracy.depth, rebound: USED * accuracy.rebound };
    let holds = |step: f64| bounce_error(coupling, zeta, step).is_within(&used);
    let mut step = 4e-3 / (1.0 + zeta);
    while !holds(step) {
        step *= 0.25;
        if step < 1e-7 {
            return 0.0;
        }
    }
    while holds(LONGER * step) {
        step *= LONGER;
    }
    step
}

/// Greatest depth and rebound speed of one bounce from `depth` ≤ 0 at speed 1, γ = c·dt/m, κ = step²; `None`
/// if it does not end.
fn bounce(coupling: WrenchCoupling, step: f64, gamma: f64, depth: f64) -> Option<(f64, f64)> {
    let mut mass = Mass { depth, speed: 1.0, coupling, step, gamma, waiting: VecDeque::new() };
    let mut deepest = 0.0_f64;
    let most = 200.0 * (1.0 + gamma / step) / step + 100.0;
    let mut steps = 0.0;
    while mass.depth > 0.0 || mass.speed >= 0.0 || mass.waiting.iter().any(|push| *push != 0.0) {
        mass.advance();
        deepest = deepest.max(mass.depth);
        steps += 1.0;
        if steps > most || !mass.depth.is_finite() {
            return None;
        }
    }
    Some((deepest, -mass.speed))
}

/// A mass, seen from the surface.
struct Mass {
    depth: f64,
    speed: f64,
    coupling: WrenchCoupling,
    step: f64,
    gamma: f64,
    /// Queue of delayed decelerations.
    waiting: VecDeque<f64>,
}

impl Mass {
    /// Deceleration, ω·v.
    fn push(&self, depth: f64, speed: f64) -> f64 {
        if depth > 0.0 { (depth + self.gamma / self.step * speed).max(0.0) } else { 0.0 }
    }

    fn advance(&mut self) {
        let (h, now) = (self.step, self.push(self.depth, self.speed));
        match self.coupling {
            WrenchCoupling::Stages => self.runge_kutta(),
            WrenchCoupling::SemiImplicit => {
                self.speed -= h * now;
                self.depth += h * self.speed;
            }
            WrenchCoupling::ZeroOrderHold { delay_frames: late } => {
                self.waiting.push_back(now);
                let late = self.waiting.len() > late as usize;
                let push = if late { self.waiting.pop_front().unwrap_or(0.0) } else { 0.0 };
                self.depth += h * (self.speed - 0.5 * h * push);
                self.speed -= h * push;
            }
        }
    }

    fn runge_kutta(&mut self) {
        let h = self.step;
        let (mut moved, mut slowed) = (0.0, 0.0);
        let (mut depth, mut speed) = (self.depth, self.speed);
        for (weight, next) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
            let push = self.push(depth, speed);
            moved += weight * speed;
            slowed += weight * push;
            (depth, speed) = (self.depth + next * h * speed, self.speed - next * h * push);
        }
        self.depth += h / 6.0 * moved;
        self.speed -= h / 6.0 * slowed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [WrenchCoupling; 4] = [
        WrenchCoupling::Stages,
        WrenchCoupling::SemiImplicit,
        WrenchCoupling::ZeroOrderHold { delay_frames: 0 },
        WrenchCoupling::ZeroOrderHold { delay_frames: 2 },
    ];

    #[test]
    fn the_deepest_place_is_that_of_a_damped_oscillation() {
        assert_eq!(depth_factor(0.0), 1.0);
        assert!((depth_factor(1.0) - libm::exp(-1.0)).abs() < 1e-15);
        // Continuous through critical damping; heavy damping stops the mass within m·v/c.
        assert!((depth_factor(1.0 - 1e-9) / depth_factor(1.0 + 1e-9) - 1.0).abs() < 1e-8);
        assert!((depth_factor(50.0) * 100.0 - 1.0).abs() < 1e-2);
    }

    /// Every scheme approaches both closed forms as the step shrinks, and four times the step is not better.
    #[test]
    fn short_steps_meet_the_closed_forms() {
        for coupling in ALL {
            for zeta in [0.0, 0.1, 0.5, 1.0, 1.7] {
                let [fine, coarse] = [1e-3, 4e-3].map(|step| bounce_error(coupling, zeta, step));
                assert!(fine.depth < 5e-3 && fine.rebound < 2e-2, "{coupling:?} {zeta} {fine:?}");
                assert!(fine.rebound <= coarse.rebound, "{coupling:?} {zeta} {fine:?} {coarse:?}");
            }
        }
    }

    #[test]
    fn three_times_the_resolved_step_is_too_long() {
        let accuracy = Accuracy::default();
        for coupling in ALL {
            for zeta in [0.0, 0.05, 0.3, 0.6, 1.0, 1.7] {
                let step = resolved_step(coupling, zeta, &accuracy);
                println!("{coupling:?} {zeta} {step}");
                assert!(step > 0.0 && bounce_error(coupling, zeta, step).is_within(&accuracy));
                let coarse = bounce_error(coupling, zeta, 3.0 * step);
                assert!(!coarse.is_within(&accuracy), "{coupling:?} {zeta} {step} {coarse:?}");
            }
        }
    }
}
