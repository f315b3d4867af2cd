//! The contacts of a frame against the host's step, one by one, each at its depth and normal force.
//!
//! Before the run a law whose stiffness follows the depth, or whose damping follows the load, can only be
//! judged for an assumed closing speed. Here both are known; the warnings are those of `warn.rs`, as for
//! every other check of a step.

use crate::check::StepReport;
use crate::limits::pair_limits;
use crate::mass::{GroupMass, StepPlan};
use crate::rows::compliances_at;
use crate::setting::{Known, STIFF, Setting};
use crate::warn::warnings;
use pong_engine::inspect::PushingContact;
use pong_engine::{EngineError, InterfaceId, World};
use std::collections::BTreeMap;

/// Limits of a step by the single contacts of the last frame, each at its depth and load, which
/// [`step_report`](crate::step_report) can only assume. Every pair of movable groups is represented by its
/// contact with the shortest stable step; bounces are not judged.
///
/// # Errors
/// A world that has no frame yet, a mass of another world's movable group, or values that no plan or group
/// can have.
pub fn pressed_report(
    world: &World,
    plan: &StepPlan,
    masses: &[(InterfaceId, GroupMass)],
) -> Result<StepReport, EngineError> {
    plan.check()?;
    let setting = Setting::new(world, masses)?;
    let plan = StepPlan { accuracy: None, ..*plan };
    let mut known: BTreeMap<usize, Vec<Known>> = BTreeMap::new();
    for contact in setting.scene.pushing()? {
        known.entry(contact.pair).or_default().extend(known_of(&setting, &contact));
    }
    let mut report = StepReport::default();
    for (index, known) in &known {
        let pair = &setting.scene.pairs()[*index];
        let Some(mass) = setting.effective_mass(pair) else { continue };
        let names = [pair.first, pair.second].map(|body| setting.scene.group_name(body));
        report.pairs.extend(pair_limits(names, mass, known, &plan));
    }
    report.warnings = warnings(&report.pairs, &report.not_judged, &plan);
    Ok(report)
}

/// Springs of a contact; `None` if masses are unknown, or the law is the host's.
fn known_of(setting: &Setting<'_>, contact: &PushingContact<'_>) -> Option<Known> {
    if setting.masses[contact.group_a].is_none() || setting.masses[contact.group_b].is_none() {
        return None;
    }
    let mut springs = setting.pressed_springs(contact)?;
    // A contact at a seam, or at the end of a bar, carries a share of the spring; its load already is that
    // share.
    springs.normal.stiffness *= contact.weight;
    springs.normal.damping *= contact.weight;
    let table = setting.scene.pairs()[contact.pair].tables[contact.flipped];
    let surfaces = setting.scene.surface_names(table, contact.surfaces(&setting.scene));
    // Least effective masses along the normal, and along the surface.
    let least_masses = compliances_at(setting, contact).map(|compliance| 1.0 / compliance.max(STIFF));
    Some(Known { springs, surfaces, least_masses, area: None })
}
