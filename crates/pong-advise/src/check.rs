//! Every pair of movable groups against the host's step: single contacts, and all that can act on one group at once.

use crate::asking::of_group;
use crate::coupling::surely_stable_step;
use crate::limits::{GroupLimits, PairLimits, pair_limits};
use crate::mass::{GroupMass, StepPlan};
use crate::setting::Setting;
use crate::spring::Spring;
use crate::together::{Load, pair_load};
use crate::warn::{StepNote, StepWarning, notes, warnings};
use pong_engine::{EngineError, InterfaceId, World};
use std::collections::{BTreeMap, BTreeSet};

/// What the adviser found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Pairs of movable groups, one of which at least yields.
    pub pairs: Vec<PairLimits>,
    /// Movable groups that yield and can be touched.
    pub groups: Vec<GroupLimits>,
    /// What could not be judged, and why.
    pub not_judged: Vec<String>,
    /// What goes wrong at the step, those of instability first.
    pub warnings: Vec<StepWarning>,
    /// What may go wrong at the step, and need not.
    pub notes: Vec<StepNote>,
}

impl StepReport {
    /// The least of the stable steps of single contacts, s; infinite if there are none.
    pub fn stable_step(&self) -> f64 {
        let friction = self.pairs.iter().filter_map(|pair| pair.friction);
        let all = self.pairs.iter().map(|pair| pair.normal).chain(friction);
        all.map(|limit| limit.stable_step).fold(f64::INFINITY, f64::min)
    }

    /// The step at which the scene is surely stable, whatever touches at once, s; infinite if nothing can.
    pub fn surely_stable_step(&self) -> f64 {
        self.groups.iter().map(|group| group.stable_step).fold(self.stable_step(), f64::min)
    }
}

/// What a step can hold in a sealed world, by the masses that are known. Of a movable group that is named twice the later mass
/// counts.
///
/// # Errors
/// A mass of another world's movable group, or values that no plan or group can have.
pub fn step_report(
    world: &World,
    plan: &StepPlan,
    masses: &[(InterfaceId, GroupMass)],
) -> Result<StepReport, EngineError> {
    plan.check()?;
    Ok(report(&Setting::new(world, masses)?, plan))
}

fn report(setting: &Setting<'_>, plan: &StepPlan) -> StepReport {
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
    let limits =
        loads.iter().filter_map(|(&body, (load, ratio))| group_limits(setting, body, load, *ratio, plan));
    report.groups = limits.collect();
    report.not_judged.dedup();
    report.not_judged.extend(untold.iter().map(|name| format!("`{name}`: no mass is given")));
    report.warnings = warnings(&report.pairs, &report.not_judged, plan);
    let asks = |group: &str| {
        let body = loads.keys().find(|body| setting.scene.group_name(**body) == group)?;
        of_group(setting, *body, plan)
    };
    report.notes = notes(&report.pairs, &report.groups, plan, asks).into_iter().collect();
    report
}

/// `None` for what does not yield or cannot be touched.
fn group_limits(
    setting: &Setting<'_>,
    body: usize,
    load: &Load,
    ratio: f64,
    plan: &StepPlan,
) -> Option<GroupLimits> {
    let mass = setting.masses[body].map(|known| known.mass).filter(|mass| mass.is_finite())?;
    let (stiffness, damping) = (load.stiffness_rate, load.damping_rate);
    (load.contacts > 0).then(|| GroupLimits {
        group: setting.scene.group_name(body),
        mass,
        contacts: load.contacts,
        spring: Spring { stiffness: stiffness * mass, damping: damping * mass },
        least_damped: ratio,
        stable_step: surely_stable_step(plan.coupling, stiffness, damping, ratio),
    })
}
