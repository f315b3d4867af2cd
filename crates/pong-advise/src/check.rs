//! Check of every pair of movable groups against the host's step: single contacts, and all that can act on
//! one group at once.

use crate::asking::{BY_SPRINGS, of_group};
use crate::coupling::surely_stable_with;
use crate::limits::{GroupLimits, PairLimits, pair_limits};
use crate::mass::{GroupMass, SpringRates, StepPlan};
use crate::setting::Setting;
use crate::spring::Spring;
use crate::together::{Load, pair_load};
use crate::warn::{StepNote, StepWarning, notes, warnings};
use pong_engine::{EngineError, InterfaceId, World};
use std::collections::{BTreeMap, BTreeSet};

/// Findings of the adviser.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Pairs of movable groups of which at least one yields.
    pub pairs: Vec<PairLimits>,
    /// Movable groups that yield and can be touched.
    pub groups: Vec<GroupLimits>,
    /// Pairs and groups that could not be judged, and why.
    pub not_judged: Vec<String>,
    /// Failures at the step, instability first.
    pub warnings: Vec<StepWarning>,
    /// Possible but unproven failures at the step.
    pub notes: Vec<StepNote>,
}

impl StepReport {
    /// The longest step at which every single contact is surely stable, with its friction and wherever its
    /// primitives can be touched, s; infinite if there are none.
    pub fn stable_step(&self) -> f64 {
        self.pairs.iter().map(|pair| pair.stable_step).fold(f64::INFINITY, f64::min)
    }

    /// The step at which the scene is surely stable for any set of simultaneous contacts, s; infinite if
    /// nothing can touch.
    pub fn surely_stable_step(&self) -> f64 {
        self.groups.iter().map(|group| group.stable_step).fold(self.stable_step(), f64::min)
    }
}

/// Limits of a step in a sealed world, by the known masses. Of a movable group that is named twice the later
/// mass counts.
///
/// # Errors
/// A mass of another world's movable group, or values that no plan or group can have.
pub fn step_report(
    world: &World,
    plan: &StepPlan,
    masses: &[(InterfaceId, GroupMass)],
) -> Result<StepReport, EngineError> {
    step_report_with(world, plan, masses, &[])
}

/// [`step_report`], with the limits by springs of the host for bodies without contact, given by name.
///
/// # Errors
/// As [`step_report`].
pub fn step_report_with(
    world: &World,
    plan: &StepPlan,
    masses: &[(InterfaceId, GroupMass)],
    others: &[(String, GroupMass)],
) -> Result<StepReport, EngineError> {
    plan.check()?;
    for (name, mass) in others {
        mass.check(name)?;
    }
    Ok(report(&Setting::new(world, masses)?, plan, others))
}

fn report(setting: &Setting<'_>, plan: &StepPlan, others: &[(String, GroupMass)]) -> StepReport {
    let mut report = StepReport::default();
    let mut untold = BTreeSet::new();
    let mut loads: BTreeMap<usize, (Load, f64)> = BTreeMap::new();
    for pair in setting.scene.pairs() {
        let names = [pair.first, pair.second].map(|body| setting.scene.group_name(body));
        if setting.met(pair).is_empty() {
            continue;
        }
        let unknown = [pair.first, pair.second].map(|body| setting.masses[body].is_none());
        if unknown != [false, false] {
            untold
                .extend(names.into_iter().zip(unknown).filter(|(_, unknown)| *unknown).map(|(name, _)| name));
            continue;
        }
        let Some(mass) = setting.effective_mass(pair) else { continue };
        let (known, causes) = setting.known(pair, mass, plan);
        let not_judged = causes.iter().map(|cause| format!("`{}` and `{}`: {cause}", names[0], names[1]));
        report.not_judged.extend(not_judged);
        report.pairs.extend(pair_limits(names, mass, &known, plan));
        let ratio = known.iter().map(|known| known.springs.least_damped()).fold(f64::INFINITY, f64::min);
        let load = pair_load(setting, pair, mass, plan, &[]);
        for body in [pair.first, pair.second] {
            let (sum, least) = loads.entry(body).or_insert((Load::default(), f64::INFINITY));
            (*sum, *least) = (sum.plus(load), least.min(ratio));
        }
    }
    for (body, known) in setting.masses.iter().enumerate() {
        if known.is_some_and(|known| !known.springs.is_zero()) {
            loads.entry(body).or_insert((Load::default(), f64::INFINITY));
        }
    }
    // Groups that share joints move together: a load on one acts on all.
    let of_mechanism = |body: usize| {
        let all = setting.mechanism_of(body).into_iter().filter_map(|other| loads.get(&other));
        all.fold((Load::default(), f64::INFINITY), |(sum, least), (load, ratio)| {
            (sum.plus(*load), least.min(*ratio))
        })
    };
    let limits = loads.keys().filter_map(|&body| group_limits(setting, body, of_mechanism(body), plan));
    report.groups = limits.collect();
    report.groups.extend(others.iter().filter_map(|(name, mass)| springs_alone(name, mass, plan)));
    report.not_judged.dedup();
    report.not_judged.extend(untold.iter().map(|name| format!("`{name}`: no mass is given")));
    report.warnings = warnings(&report.pairs, &report.not_judged, plan);
    let asks = |group: &str| {
        if others.iter().any(|(name, _)| name == group) {
            return Some(BY_SPRINGS.to_owned());
        }
        let body = loads.keys().find(|body| setting.scene.group_name(**body) == group)?;
        of_group(setting, *body, plan)
    };
    report.notes = notes(&report.pairs, &report.groups, plan, asks).into_iter().collect();
    report
}

/// Limits of a body that only springs of the host act on.
fn springs_alone(name: &str, mass: &GroupMass, plan: &StepPlan) -> Option<GroupLimits> {
    let SpringRates { stiffness, damping } = mass.springs;
    (mass.mass.is_finite() && !mass.springs.is_zero()).then(|| GroupLimits {
        group: name.to_owned(),
        mass: mass.mass,
        contacts: 0,
        spring: Spring { stiffness: stiffness * mass.mass, damping: damping * mass.mass },
        least_damped: 0.0,
        stable_step: surely_stable_with(plan.coupling, SpringRates::default(), 0.0, mass.springs),
    })
}

/// Limits of one group; `None` if it does not yield, or has neither contacts nor springs.
fn group_limits(
    setting: &Setting<'_>,
    body: usize,
    (load, ratio): (Load, f64),
    plan: &StepPlan,
) -> Option<GroupLimits> {
    let mass = setting.masses[body].map(|known| known.mass).filter(|mass| mass.is_finite())?;
    let contacts = SpringRates { stiffness: load.stiffness_rate, damping: load.damping_rate };
    let springs = setting.springs_on(body);
    let (stiffness, damping) = (contacts.stiffness + springs.stiffness, contacts.damping + springs.damping);
    (load.contacts > 0 || !springs.is_zero()).then(|| GroupLimits {
        group: setting.scene.group_name(body),
        mass,
        contacts: load.contacts,
        spring: Spring { stiffness: stiffness * mass, damping: damping * mass },
        least_damped: if springs.is_zero() { ratio } else { 0.0 },
        stable_step: surely_stable_with(plan.coupling, contacts, ratio, springs),
    })
}
