//! Check of every pair of movable groups against the host's step: single contacts, and all that can act on
//! one group at once.

use crate::asking::{BY_SPRINGS, of_group};
use crate::coupling::surely_stable_with;
use crate::limits::{GroupLimits, PairLimits, pair_limits};
use crate::mass::{GroupMass, SpringRates, StepPlan};
use crate::setting::Setting;
use crate::solids::{Footprints, classes, footprints};
use crate::spring::Spring;
use crate::together::{Load, pair_load};
use crate::warn::{StepNote, StepWarning, fall_note, is_unstable, notes, warnings};
use pong_engine::inspect::GroupPair;
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
    let mut pairs = PairFindings::new(setting, plan);
    setting.scene.pairs().iter().for_each(|pair| pairs.add(pair));
    let PairFindings { mut report, untold, mut loads, in_falls, .. } = pairs;
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
    report.notes.extend(plan.fall_speed.and_then(|speed| fall_note(&in_falls, speed, plan)));
    report
}

/// Findings about pairs of movable groups.
struct PairFindings<'s, 'w> {
    setting: &'s Setting<'w>,
    plan: &'s StepPlan,
    report: StepReport,
    /// Movable groups without a mass.
    untold: BTreeSet<String>,
    /// Load of each movable group, and the least damping over stiffness of its contacts, s.
    loads: BTreeMap<usize, (Load, f64)>,
    /// Limits of solids at the speed that a fall can reach, of pairs that are stable without it.
    in_falls: Vec<PairLimits>,
    footprints: Footprints,
    classes: Vec<usize>,
    /// Classes and plans of the pairs of solids that have been judged.
    judged: BTreeSet<([usize; 2], [u32; 2])>,
}

impl<'s, 'w> PairFindings<'s, 'w> {
    fn new(setting: &'s Setting<'w>, plan: &'s StepPlan) -> Self {
        Self {
            setting,
            plan,
            report: StepReport::default(),
            untold: BTreeSet::new(),
            loads: BTreeMap::new(),
            in_falls: Vec::new(),
            footprints: footprints(setting),
            classes: classes(setting),
            judged: BTreeSet::new(),
        }
    }

    fn add(&mut self, pair: &GroupPair) {
        let Self { setting, plan, .. } = *self;
        let has_marks = !setting.met(pair).is_empty();
        if !has_marks && !setting.scene.has_solid_meetings(pair) {
            return;
        }
        let bodies = [pair.first, pair.second];
        let unknown = bodies.map(|body| setting.masses[body].is_none());
        if unknown != [false, false] {
            let names = bodies.map(|body| setting.scene.group_name(body)).into_iter().zip(unknown);
            self.untold.extend(names.filter(|(_, unknown)| *unknown).map(|(name, _)| name));
            return;
        }
        let Some(mass) = setting.effective_mass(pair) else { return };
        // Pairs of solids of the same models and masses have the same limits: a bin of boxes is judged once.
        let key = (bodies.map(|body| self.classes[body]), setting.scene.plans_of(pair));
        if !self.judged.insert(key) && !has_marks {
            return;
        }
        let names = bodies.map(|body| setting.scene.group_name(body));
        let (mut known, mut causes) = setting.known(pair, mass, plan);
        let ratio = known.iter().map(|known| known.springs.least_damped()).fold(f64::INFINITY, f64::min);
        let (of_solids, more) = setting.known_solids(pair, mass, plan.closing_speed, &self.footprints);
        known.extend(of_solids);
        causes.extend(more);
        let not_judged = causes.iter().map(|cause| format!("`{}` and `{}`: {cause}", names[0], names[1]));
        self.report.not_judged.extend(not_judged);
        let limits = pair_limits(names.clone(), mass, &known, plan);
        if !limits.as_ref().is_some_and(|limits| is_unstable(limits, plan)) {
            self.in_falls.extend(self.limits_in_a_fall(pair, mass, names));
        }
        self.report.pairs.extend(limits);
        if has_marks {
            let load = pair_load(setting, pair, mass, plan, &[]);
            for body in bodies {
                let (sum, least) = self.loads.entry(body).or_insert((Load::default(), f64::INFINITY));
                (*sum, *least) = (sum.plus(load), least.min(ratio));
            }
        }
    }

    /// Limits of the solids of a pair at the speed that a fall can reach, if that is more than the closing speed.
    fn limits_in_a_fall(&self, pair: &GroupPair, mass: f64, names: [String; 2]) -> Option<PairLimits> {
        let speed = self.plan.fall_speed.filter(|speed| *speed > self.plan.closing_speed.unwrap_or(0.0))?;
        let known = self.setting.known_solids(pair, mass, Some(speed), &self.footprints).0;
        pair_limits(names, mass, &known, self.plan)
    }
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
