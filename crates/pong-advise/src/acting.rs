//! The contacts of a frame against the host's step: contacts that act together, instead of a bound of those
//! that might.
//!
//! In coordinates in which every mass is one, a contact with weight w along the normal n, with friction
//! across it, adds
//!
//! ```text
//! K += r·(w·k·nnᵀ + k_t·(1 − nnᵀ))·rᵀ        r: its three directions on both movable groups, mobility.rs
//! ```
//!
//! and ω² = λ, the largest eigenvalue of K. Friction counts as if it stuck everywhere. Where ends yield, the springs of
//! `yielding.rs` count in place of those of the contacts, or beside them.

use crate::coupling::surely_stable_with;
use crate::mass::{GroupMass, SpringRates, StepPlan};
use crate::mobility::largest_eigenvalue;
use crate::rows::{Acting, primitives_of};
use crate::setting::Setting;
use crate::yielding::count_yielding;
use nalgebra::DMatrix;
use pong_engine::{EngineError, InterfaceId, World};
use std::collections::{BTreeMap, BTreeSet};

/// Limits that the contacts of one frame set to a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActingReport {
    /// Contacts with at least one body of known mass that yields.
    pub contacts: usize,
    /// Contacts whose masses or laws are not known.
    pub not_judged: usize,
    /// ω² of the stiffest mode, 1/s².
    pub stiffness_rate: f64,
    /// Damping over mass of the most damped mode, 1/s.
    pub damping_rate: f64,
    /// The longest step at which these contacts are surely stable, s; 0 if there is none, infinite if nothing acts.
    pub stable_step: f64,
}

/// Limits that all contacts of the last frame set to a step, with exact levers and normals instead of the
/// bound of [`step_report`](crate::step_report) before anything touches.
///
/// # Errors
/// A world that has no frame yet, a mass of another world's movable group, or values that no plan or group
/// can have.
pub fn acting_report(
    world: &World,
    plan: &StepPlan,
    masses: &[(InterfaceId, GroupMass)],
) -> Result<ActingReport, EngineError> {
    plan.check()?;
    let setting = Setting::new(world, masses)?;
    let mut not_judged = 0;
    let (mut acting, mut contacts) = (Vec::new(), Vec::new());
    let mut touching: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for contact in setting.scene.pushing()? {
        let Some(known) = Acting::new(&setting, &contact) else {
            not_judged += 1;
            continue;
        };
        if !known.rows.is_empty() {
            touching.entry(primitives_of(&contact)).or_default().push(acting.len());
            acting.push(known);
            contacts.push(contact);
        }
    }
    let mut at_ends = Vec::new();
    for of_two in touching.values() {
        at_ends.extend(count_yielding(&setting, &contacts, &mut acting, of_two));
    }
    let ratio = acting.iter().map(|one| one.springs.least_damped()).fold(f64::INFINITY, f64::min);
    let groups: BTreeSet<usize> = acting.iter().flat_map(|one| one.rows.iter().map(|row| row.0)).collect();
    // Groups that share joints move together: each may have the whole of the largest mode.
    let shared =
        groups.iter().map(|body| groups.iter().filter(|other| same(&setting, *body, **other)).count());
    let shared = shared.max().unwrap_or(1) as f64;
    let springs = sum_of_springs(&setting, &groups);
    let stiffness_rate = shared
        * largest(acting.iter().chain(&at_ends), |one| {
            (one.stiffens * one.springs.normal.stiffness, one.springs.friction.map_or(0.0, |f| f.stiffness))
        });
    let damping_rate = shared
        * largest(acting.iter(), |one| {
            (one.weight * one.springs.normal.damping, one.springs.friction.map_or(0.0, |f| f.damping))
        });
    let rates = SpringRates { stiffness: stiffness_rate, damping: damping_rate };
    let stable_step = match acting.is_empty() {
        true => f64::INFINITY,
        false => surely_stable_with(plan.coupling, rates, ratio, springs),
    };
    Ok(ActingReport { contacts: acting.len(), not_judged, stiffness_rate, damping_rate, stable_step })
}

fn same(setting: &Setting<'_>, body: usize, other: usize) -> bool {
    body == other || setting.share_joints(body, other)
}

/// The largest rates that springs of the host add to any of these groups.
fn sum_of_springs(setting: &Setting<'_>, groups: &BTreeSet<usize>) -> SpringRates {
    let most = SpringRates::default();
    groups.iter().fold(most, |most, body| {
        let here = setting.springs_on(*body);
        SpringRates { stiffness: most.stiffness.max(here.stiffness), damping: most.damping.max(here.damping) }
    })
}

/// Largest eigenvalue of the sum over all contacts; `values` gives the rates along the normal and across it.
fn largest<'s>(
    acting: impl Iterator<Item = &'s Acting> + Clone,
    values: impl Fn(&Acting) -> (f64, f64),
) -> f64 {
    let bodies: BTreeSet<usize> = acting.clone().flat_map(|one| one.rows.iter().map(|row| row.0)).collect();
    let slot = |body: usize| 6 * bodies.iter().position(|other| *other == body).expect("collected above");
    let mut sum = DMatrix::<f64>::zeros(6 * bodies.len(), 6 * bodies.len());
    for one in acting {
        let (along, across) = values(one);
        let n = &one.normal;
        let spring = n * n.transpose() * (along - across) + pong_geometry::Mat3::identity() * across;
        for (body_i, rows_i) in &one.rows {
            for (body_j, rows_j) in &one.rows {
                let mut block = sum.fixed_view_mut::<6, 6>(slot(*body_i), slot(*body_j));
                for (p, row_p) in rows_i.iter().enumerate() {
                    for (q, row_q) in rows_j.iter().enumerate() {
                        block += spring[(p, q)] * row_p * row_q.transpose();
                    }
                }
            }
        }
    }
    largest_eigenvalue(sum)
}
