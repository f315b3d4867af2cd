//! Limits of a step by one contact, and by all that can act on one movable group at once.

use crate::bounce::{Accuracy, BounceError, bounce_error, resolved_step};
use crate::coupling::{longest_stable_step, surely_stable_step};
use crate::mass::StepPlan;
use crate::setting::Known;
use crate::spring::{Spring, springs};
use pong_engine::{PairProps, WrenchCoupling};

/// One spring on one mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringLimit {
    /// The spring and damper of a whole contact.
    pub spring: Spring,
    /// The least effective mass that it can act on, kg: at the point with the longest lever.
    pub mass: f64,
    /// The longest step at which it is stable, s; 0 if no step is.
    pub stable_step: f64,
}

/// Accuracy of a bounce at the host's step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BounceLimit {
    /// ω = √(k/m), rad/s.
    pub frequency: f64,
    /// The ratio c/(2mω), less the damping removed by the lag of the coupling; below zero the contact gains
    /// energy.
    pub damping_ratio: f64,
    /// Errors of a bounce against its closed form at the host's step.
    pub error: BounceError,
}

/// Single contacts between two movable groups.
#[derive(Clone, Debug, PartialEq)]
pub struct PairLimits {
    /// `object/path` of the two.
    pub groups: [String; 2],
    /// Effective mass at a contact in line with both mass centres, kg; that of the bounce.
    pub mass: f64,
    /// The normal spring with the shortest stable step.
    pub normal: SpringLimit,
    /// The friction spring with the shortest stable step, if there is friction.
    pub friction: Option<SpringLimit>,
    /// The longest step at which one contact with its friction is surely stable, wherever it is, s; 0 if
    /// there is none.
    pub stable_step: f64,
    /// `model/surface` of both for the normal spring, and for the friction spring.
    pub surfaces: [[String; 2]; 2],
    /// Area of solids that lie flat on each other, m², for the normal spring and for the friction spring; `None` for
    /// other contacts.
    pub areas: [Option<f64>; 2],
    /// The bounce with the largest error; `None` if no accuracy is asked for, or for laws without a closed
    /// form.
    pub bounce: Option<BounceLimit>,
}

/// All contacts that can act on one movable group at once (defined in `together.rs`).
#[derive(Clone, Debug, PartialEq)]
pub struct GroupLimits {
    /// `object/path`.
    pub group: String,
    /// Its mass, kg.
    pub mass: f64,
    /// Primitives that can be in contact at once, at most.
    pub contacts: usize,
    /// Stiffest mode, as the stiffness and damping of an equivalent contact in line with the mass centre.
    pub spring: Spring,
    /// The least damping over stiffness of any spring among them, s.
    pub least_damped: f64,
    /// The longest step at which every mode is surely stable, s; 0 if there is none.
    pub stable_step: f64,
}

/// Limits of a step by one contact with these values on an effective mass (kg); `groups` are the names of the
/// two bodies.
///
/// # Errors
/// The reason why it cannot be judged.
pub fn judge_contact(
    groups: [String; 2],
    props: &PairProps,
    mass: f64,
    plan: &StepPlan,
) -> Result<PairLimits, &'static str> {
    let springs = springs(props, mass, plan.closing_speed)?;
    let known = [Known { springs, surfaces: groups.clone(), least_masses: [mass; 2], area: None }];
    Ok(pair_limits(groups, mass, &known, plan).expect("one contact is known"))
}

pub(crate) fn pair_limits(
    groups: [String; 2],
    mass: f64,
    known: &[Known],
    plan: &StepPlan,
) -> Option<PairLimits> {
    let limit = |spring: Spring, mass: f64| {
        let (k, c) = (spring.stiffness, spring.damping);
        SpringLimit { spring, mass, stable_step: longest_stable_step(plan.coupling, k, c, mass) }
    };
    let normal = known.iter().map(|known| (limit(known.springs.normal, known.least_masses[0]), known));
    let (normal, of_normal) = least(normal.collect())?;
    let with_friction =
        known.iter().filter_map(|known| Some((limit(known.springs.friction?, known.least_masses[1]), known)));
    let friction = least(with_friction.collect());
    let named = [of_normal, friction.map_or(of_normal, |(_, known)| known)];
    let (surfaces, areas) = (named.map(|known| known.surfaces.clone()), named.map(|known| known.area));
    let friction = friction.map(|(limit, _)| limit);
    let whole = known.iter().map(|known| whole_contact(known, plan.coupling));
    let stable_step =
        friction.map_or(normal.stable_step, |friction| normal.stable_step.min(friction.stable_step));
    let stable_step = whole.fold(stable_step, f64::min);
    let known: Vec<_> = known.iter().map(|known| known.springs).collect();
    let by_formula = known.iter().filter(|made| made.bounces_by_formula);
    let bounces = by_formula.filter_map(|made| bounce_limit(made.normal, mass, plan));
    let bounce = bounces.max_by(|x, y| x.error.rebound.total_cmp(&y.error.rebound));
    Some(PairLimits { groups, mass, normal, friction, stable_step, surfaces, areas, bounce })
}

/// The longest step (s) at which a contact with its friction is surely stable. With Y the compliance at the
/// contact, its stiffest mode has at most max(k, k_t)·Y, and at most the sum of k·Y along the normal and
/// k_t·Y along the surface; dampers alike.
fn whole_contact(known: &Known, coupling: WrenchCoupling) -> f64 {
    let Some(friction) = known.springs.friction else { return f64::INFINITY };
    let [normal_mass, mass] = known.least_masses;
    let normal = known.springs.normal;
    let most = |along: f64, across: f64| (along.max(across) / mass).min(along / normal_mass + across / mass);
    let stiffness = most(normal.stiffness, friction.stiffness);
    let damping = most(normal.damping, friction.damping);
    surely_stable_step(coupling, stiffness, damping, known.springs.least_damped())
}

/// The spring with the shortest stable step; of two equal ones the stiffer.
fn least(limits: Vec<(SpringLimit, &Known)>) -> Option<(SpringLimit, &Known)> {
    limits.into_iter().min_by(|(x, _), (y, _)| {
        let by_step = x.stable_step.total_cmp(&y.stable_step);
        by_step.then(y.spring.stiffness.total_cmp(&x.spring.stiffness))
    })
}

/// Beyond this damping ratio (restitution 0.01) hardly anything bounces.
const ZETA_MAX: f64 = 5.0;

/// Steps of ω·dt below this resolve every bounce.
const SURELY_FINE: f64 = 1e-4;

fn bounce_limit(spring: Spring, mass: f64, plan: &StepPlan) -> Option<BounceLimit> {
    plan.accuracy?;
    let frequency = (spring.stiffness / mass).sqrt();
    let omega_step = frequency * plan.step;
    let damping_ratio = 0.5 * (spring.damping / (mass * frequency) - omega_step * plan.coupling.lag());
    if damping_ratio > ZETA_MAX {
        return None;
    }
    let error = if damping_ratio < 0.0 {
        // With negative damping the rebound is exp(π|ζ|), and so is the square root of the energy (V28).
        let gain = libm::expm1(-std::f64::consts::PI * damping_ratio);
        BounceError { depth: gain, rebound: gain }
    } else if omega_step < SURELY_FINE {
        BounceError { depth: 0.0, rebound: 0.0 }
    } else {
        bounce_error(plan.coupling, damping_ratio, omega_step)
    };
    Some(BounceLimit { frequency, damping_ratio, error })
}

impl BounceLimit {
    /// The longest step within an accuracy, s.
    pub fn accurate_step(&self, coupling: WrenchCoupling, accuracy: &Accuracy) -> f64 {
        resolved_step(coupling, self.damping_ratio.max(0.0), accuracy) / self.frequency
    }
}
