//! The contacts of a frame against the host's step, one by one, each as deep and as hard pressed as it is.
//!
//! Before the run a law whose stiffness follows the depth, or whose damping follows the load, can only be judged for a closing
//! speed that is guessed. Here nothing is guessed; the warnings are those of `warn.rs`, as for every other check of a step.

use super::asking::Known;
use super::check::{Setting, StepReport, pair_limits};
use super::mass::StepPlan;
use super::spring::pressed_springs;
use super::warn::warnings;
use crate::frame::{EvaluationBuffers, FrameContact};
use crate::sealed::Sealed;
use std::collections::BTreeMap;

/// Single contacts of the last frame; of every pair of movable groups the one that bears the least step speaks. Bounces are
/// not judged.
pub(crate) fn pressed(
    setting: &Setting<'_>,
    sealed: &Sealed,
    frame: &EvaluationBuffers,
    plan: &StepPlan,
) -> StepReport {
    let plan = StepPlan { accuracy: None, ..*plan };
    let mut known: BTreeMap<u32, Vec<Known>> = BTreeMap::new();
    for contact in frame.pushing() {
        if let Some(one) = known_of(setting, sealed, contact) {
            known.entry(contact.found.key.group_pair).or_default().push(one);
        }
    }
    let mut report = StepReport::default();
    for (index, known) in &known {
        let pair = &sealed.group_pairs[*index as usize];
        let Some(mass) = setting.effective_mass(pair) else { continue };
        let names = [pair.first, pair.second].map(|body| setting.scene.body_name(body));
        report.pairs.extend(pair_limits(names, mass, known, &plan));
    }
    report.warnings = warnings(&report, &plan);
    report
}

/// `None` where masses are not told, or the law is the host's.
fn known_of(setting: &Setting<'_>, sealed: &Sealed, contact: &FrameContact) -> Option<Known> {
    let found = &contact.found;
    let (a, b) = sealed.bodies_of(&found.key);
    if setting.masses[a].is_none() || setting.masses[b].is_none() {
        return None;
    }
    let pair = &sealed.group_pairs[found.key.group_pair as usize];
    let surface =
        |body: usize, primitive: u32| setting.scene.body(body).primitives[primitive as usize].surface;
    let surfaces = (surface(a, found.key.primitive_a), surface(b, found.primitive_b));
    let table = pair.tables[found.key.flipped as usize];
    let props = setting.tables[table].props(surfaces.0, surfaces.1);
    let mut springs = pressed_springs(props, found.depth, contact.normal_force).ok()?;
    // A contact of a seam, and the end of a bar, carries a part of the spring; its load is its own already.
    springs.normal.stiffness *= found.full_weight();
    springs.normal.damping *= found.full_weight();
    Some(Known { springs, surfaces: setting.surface_names(table, surfaces) })
}
