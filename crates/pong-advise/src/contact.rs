//! Stiffness, damping and friction stiffness of one contact with desired properties.
//!
//! ```text
//! ζ   from the restitution, by the law that never pulls (pong_model::restitution)
//! ω   = (v/δ)·(depth factor of ζ)                 k   = m·ω²
//! c   = 2ζmω + k·T·lag                            k_t = ⅔·k        c_t = 2√(k_t·m) + k_t·T·lag
//! ```
//!
//! A held wrench acts half a frame late, and n frames more if it is delayed. To first order that is a damping
//! of −k·T(½ + n), so as much is added; friction is damped critically so that a sticking contact does not
//! ring.

use crate::bounce::{Accuracy, depth_factor, resolved_step};
use crate::coupling::longest_stable_step;
use pong_engine::EngineError;
use pong_engine::WrenchCoupling;
use pong_model::restitution::{restitution_of_zeta, zeta_for_restitution};

/// Desired properties of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactWish {
    /// Effective mass at the contact, kg: 1/(1/m₁ + 1/m₂) of two bodies.
    pub mass: f64,
    /// Closing speed, m/s.
    pub speed: f64,
    /// Greatest depth at that speed, m.
    pub depth: f64,
    /// Coefficient of restitution: rebound speed over closing speed, above 0, at most 1.
    pub restitution: f64,
    /// Use of the wrench by the host.
    pub coupling: WrenchCoupling,
    /// The host's step or frame, s; `None` to let the adviser choose it.
    pub step: Option<f64>,
    /// Accuracy of depth and rebound.
    pub accuracy: Accuracy,
}

/// Values of a pair of surfaces, and the steps that they need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactAdvice {
    /// k of the pair, N/m.
    pub stiffness: f64,
    /// c of the pair, N·s/m.
    pub damping: f64,
    /// k_t of the pair, N/m.
    pub friction_stiffness: f64,
    /// c_t of the pair, N·s/m.
    pub friction_damping: f64,
    /// Damping ratio ζ = c/(2mω) that gives the restitution.
    pub damping_ratio: f64,
    /// ω = √(k/m), rad/s.
    pub frequency: f64,
    /// Time from touch to release, s.
    pub duration: f64,
    /// Largest force of the bounce, N.
    pub peak_force: f64,
    /// The step for the values, s: the host's, or the longest within the accuracy.
    pub step: f64,
    /// The longest step within the accuracy, s.
    pub accurate_step: f64,
    /// The longest step at which contact and friction are stable with these values, s.
    pub stable_step: f64,
    /// The least depth possible at the host's step within the accuracy, m.
    pub least_depth: f64,
}

/// Computes the values for a desired contact.
///
/// # Errors
/// Values that no contact can have.
pub fn advise_contact(wish: &ContactWish) -> Result<ContactAdvice, EngineError> {
    check(wish)?;
    let zeta = zeta_for_restitution(wish.restitution.min(most_elastic(wish)));
    let mass = wish.mass;
    let frequency = wish.speed / wish.depth * depth_factor(zeta);
    let stiffness = mass * frequency * frequency;
    let resolved = resolved_step(wish.coupling, zeta, &wish.accuracy);
    if resolved == 0.0 {
        let cause = format!("no step keeps to it with a restitution of {}; ask for less", wish.restitution);
        return Err(bad("accuracy", cause));
    }
    let accurate_step = resolved / frequency;
    let step = wish.step.unwrap_or(accurate_step);
    let late = step * wish.coupling.lag();
    let damping = 2.0 * zeta * mass * frequency + stiffness * late;
    let friction_stiffness = 2.0 / 3.0 * stiffness;
    let friction_damping = critical_damping(friction_stiffness, mass, wish.coupling, step);
    let stable = |k, c| longest_stable_step(wish.coupling, k, c, mass);
    Ok(ContactAdvice {
        stiffness,
        damping,
        friction_stiffness,
        friction_damping,
        damping_ratio: zeta,
        frequency,
        duration: duration(zeta) / frequency,
        peak_force: peak_force(zeta) * mass * wish.speed * frequency,
        step,
        accurate_step,
        stable_step: stable(stiffness, damping).min(stable(friction_stiffness, friction_damping)),
        least_depth: wish.speed * depth_factor(zeta) * step / resolved,
    })
}

/// The damping (N·s/m) at which a spring of `stiffness` (N/m) on `mass` (kg) stops ringing: 2√(k·m), plus the
/// damping that the lag of the wrench removes.
pub fn critical_damping(stiffness: f64, mass: f64, coupling: WrenchCoupling, step: f64) -> f64 {
    2.0 * (stiffness * mass).sqrt() + stiffness * step * coupling.lag()
}

/// The largest restitution for which the damping is computed. A lossless contact with a held wrench is on the
/// verge of gaining energy; a margin of an eighth of the accuracy prevents that.
fn most_elastic(wish: &ContactWish) -> f64 {
    match wish.coupling {
        WrenchCoupling::ZeroOrderHold { .. } => 1.0 - 0.125 * wish.accuracy.rebound.min(1.0),
        _ => 1.0,
    }
}

fn check(wish: &ContactWish) -> Result<(), EngineError> {
    let positive = [
        ("mass", wish.mass, "kg"),
        ("speed", wish.speed, "m/s"),
        ("depth", wish.depth, "m"),
        ("step", wish.step.unwrap_or(1.0), "s"),
        ("accuracy of the depth", wish.accuracy.depth, ""),
        ("accuracy of the rebound", wish.accuracy.rebound, ""),
    ];
    for (what, value, unit) in positive {
        if !(value > 0.0 && value.is_finite()) {
            return Err(bad(what, format!("it is {value} {unit}; give a finite number above zero")));
        }
    }
    /// Smallest restitution: below it the contact is a dashpot, and no practical step resolves its rebound.
    const RESTITUTION_MIN: f64 = 0.01;
    if !(RESTITUTION_MIN..=1.0).contains(&wish.restitution) {
        let cause = format!("it is {}; give {RESTITUTION_MIN} to 1", wish.restitution);
        return Err(bad("restitution", cause));
    }
    Ok(())
}

fn bad(what: &str, cause: String) -> EngineError {
    EngineError::BadValue { what: what.to_owned(), cause }
}

/// ω times the time from touch to release: e = exp(−ζ·that time).
fn duration(zeta: f64) -> f64 {
    if zeta > 0.0 { -libm::log(restitution_of_zeta(zeta)) / zeta } else { std::f64::consts::PI }
}

/// Largest force over m·v·ω: where its rate is zero, or at touch if it only falls.
fn peak_force(zeta: f64) -> f64 {
    if zeta >= 0.5 {
        return 2.0 * zeta;
    }
    let s = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
    let angle = libm::atan2(s * (1.0 - 4.0 * zeta * zeta), zeta * (3.0 - 4.0 * zeta * zeta));
    libm::exp(-zeta / s * angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wish() -> ContactWish {
        ContactWish {
            mass: 4.0,
            speed: 0.5,
            depth: 1e-3,
            restitution: 1.0,
            coupling: WrenchCoupling::Stages,
            step: None,
            accuracy: Accuracy::default(),
        }
    }

    /// Without loss ½mv² = ½kδ², the force peaks at kδ and the bounce takes half a period.
    #[test]
    fn an_elastic_bounce_is_half_an_oscillation() {
        let advice = advise_contact(&wish()).unwrap();
        assert!((advice.stiffness / 1e6 - 1.0).abs() < 1e-14);
        assert_eq!(advice.damping, 0.0);
        assert!((advice.peak_force / 1e3 - 1.0).abs() < 1e-14);
        assert!((advice.duration / (std::f64::consts::PI / 500.0) - 1.0).abs() < 1e-14);
    }

    /// Force and depth along the analytic motion of the mass never exceed the advised values, and reach them.
    #[test]
    fn peak_force_and_duration_are_those_of_the_motion() {
        for restitution in [0.9, 0.5, 0.37, 0.2, 0.1] {
            let advice = advise_contact(&ContactWish { restitution, ..wish() }).unwrap();
            let (zeta, omega) = (advice.damping_ratio, advice.frequency);
            assert!((restitution_of_zeta(zeta) - restitution).abs() < 1e-9);
            // A finely stepped Runge-Kutta run of the law itself.
            let acceleration = |d: f64, v: f64| -(advice.stiffness * d + advice.damping * v) / 4.0;
            let (mut d, mut v, mut time, mut deepest, mut peak) = (0.0_f64, 0.5_f64, 0.0, 0.0_f64, 0.0_f64);
            let h = 1e-5 / omega;
            while time == 0.0 || acceleration(d, v) < 0.0 {
                let middle = (d + 0.5 * h * v, v + 0.5 * h * acceleration(d, v));
                peak = peak.max(-4.0 * acceleration(d, v));
                (d, v) = (d + h * middle.1, v + h * acceleration(middle.0, middle.1));
                deepest = deepest.max(d);
                time += h;
            }
            assert!((deepest / 1e-3 - 1.0).abs() < 1e-6, "{restitution}: {deepest}");
            assert!((peak / advice.peak_force - 1.0).abs() < 1e-4, "{restitution}: {peak}");
            assert!((time / advice.duration - 1.0).abs() < 1e-4, "{restitution}: {time}");
        }
    }

    /// At the least depth of a step, that step is exactly the accurate one.
    #[test]
    fn the_least_depth_of_a_step_has_it_as_its_accurate_step() {
        let held = ContactWish {
            coupling: WrenchCoupling::ZeroOrderHold { delay_frames: 0 },
            restitution: 0.4,
            step: Some(5e-3),
            ..wish()
        };
        let advice = advise_contact(&held).unwrap();
        assert!(advice.accurate_step < 5e-3 && advice.least_depth > 1e-3);
        let softer = advise_contact(&ContactWish { depth: advice.least_depth, ..held }).unwrap();
        assert!((softer.accurate_step / 5e-3 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn impossible_wishes_are_refused() {
        for wrong in [
            ContactWish { mass: 0.0, ..wish() },
            ContactWish { speed: f64::NAN, ..wish() },
            ContactWish { depth: f64::INFINITY, ..wish() },
            ContactWish { restitution: 1.1, ..wish() },
            ContactWish { restitution: 0.0, ..wish() },
            ContactWish { step: Some(-1.0), ..wish() },
        ] {
            assert!(matches!(advise_contact(&wrong), Err(EngineError::BadValue { .. })), "{wrong:?}");
        }
    }
}
