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
//! and ω² = λ, the largest eigenvalue of K. Friction counts as if it stuck everywhere. Of two capsules, whose ends yield
//! (docs/theory.md, 2.8), a whole spring k·nnᵀ counts at each end of each axis, of its own body alone: U is at most what
//! any displacement of the ends stores that follows a motion of the bodies.

use crate::coupling::surely_stable_with;
use crate::mass::{GroupMass, SpringRates, StepPlan};
use crate::mobility::{Vec6, largest_eigenvalue};
use crate::places::{yield_at_ends, yields_on_round};
use crate::setting::Setting;
use crate::spring::ContactSprings;
use nalgebra::DMatrix;
use pong_engine::inspect::PushingContact;
use pong_engine::{EngineError, InterfaceId, World};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use std::collections::BTreeSet;

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
    let (mut acting, mut at_ends, mut axes) = (Vec::new(), Vec::new(), BTreeSet::new());
    for contact in setting.scene.pushing()? {
        let Some(mut known) = Acting::new(&setting, &contact) else {
            not_judged += 1;
            continue;
        };
        if known.rows.is_empty() {
            continue;
        }
        let [a, b] = primitives_of(&contact);
        let kinds = [a, b].map(|primitive| kind_of(&setting, primitive));
        let [both_yield, a_yields] =
            [yield_at_ends, yields_on_round].map(|yields| yields(kinds[0], kinds[1]));
        if both_yield || a_yields {
            if axes.insert((a, b)) {
                at_ends.extend(match both_yield {
                    true => known.at_ends_of_axes(&setting, &contact),
                    false => known.at_ends_of_a(&setting, &contact),
                });
            }
            known.stiffens = 0.0;
        }
        acting.push(known);
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

/// A contact with at least one body that yields.
#[derive(Clone)]
struct Acting {
    springs: ContactSprings,
    weight: f64,
    /// Part of the normal spring that the stiffness has: the weight, but 0 for a contact of bodies that yield at the ends of
    /// their axes, whose springs count there.
    stiffens: f64,
    /// Unit normal from B to A, in B's frame.
    normal: Vec3,
    /// The axes of B's frame as forces on the movable groups that yield.
    rows: Vec<(usize, [Vec6; 3])>,
}

impl Acting {
    /// Makes it; `None` if the contact cannot be judged.
    fn new(setting: &Setting<'_>, contact: &PushingContact<'_>) -> Option<Self> {
        let (a, b) = (contact.group_a, contact.group_b);
        if setting.masses[a].is_none() || setting.masses[b].is_none() {
            return None;
        }
        let springs = setting.pressed_springs(contact)?;
        let rows = rows_of(setting, contact);
        let weight = contact.weight;
        Some(Self { springs, weight, stiffens: weight, normal: contact.normal_b, rows })
    }

    /// Whole springs along this normal at the four ends of the axes of two capsules.
    fn at_ends_of_axes(&self, setting: &Setting<'_>, contact: &PushingContact<'_>) -> Vec<Self> {
        let x_ba = contact.x_ba;
        let mut all = Vec::new();
        for (k, (group, primitive)) in primitives_of(contact).into_iter().enumerate() {
            let (Some(mobility), Some(ends)) =
                (setting.mobilities[group].as_ref(), ends_of_axis(setting, (group, primitive)))
            else {
                continue;
            };
            for end in ends {
                let axis = |axis: Vec3| if k == 0 { x_ba.rotation.tr_mul(&axis) } else { -axis };
                let rows = AXES.map(|own| mobility.row(&axis(own), &end));
                let springs = ContactSprings { friction: None, ..self.springs };
                all.push(Self { rows: vec![(group, rows)], stiffens: 1.0, springs, ..self.clone() });
            }
        }
        all
    }

    /// Half springs along this normal at the two ends of A's axis, which both bodies feel.
    fn at_ends_of_a(&self, setting: &Setting<'_>, contact: &PushingContact<'_>) -> Vec<Self> {
        let ends = ends_of_axis(setting, (contact.group_a, contact.primitive_a)).into_iter().flatten();
        let at_end = |end: Vec3| {
            let rows = rows_of(setting, &PushingContact { point_b: contact.x_ba.point(&end), ..*contact });
            let springs = ContactSprings { friction: None, ..self.springs };
            Self { rows, stiffens: 0.5, springs, ..self.clone() }
        };
        ends.map(at_end).collect()
    }
}

/// Ends of the axis of a primitive, in the frame of its movable group, if it has one.
fn ends_of_axis(setting: &Setting<'_>, (group, primitive): (usize, u32)) -> Option<[Vec3; 2]> {
    let body = setting.scene.body(group);
    let info = &body.primitives[primitive as usize];
    let core = body.element(info.kind, info.elements.start).facts()?.core()?;
    Some(core.0)
}

/// The axes of B's frame.
const AXES: [Vec3; 3] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];

/// Movable group and primitive of A and of B.
fn primitives_of(contact: &PushingContact<'_>) -> [(usize, u32); 2] {
    [(contact.group_a, contact.primitive_a), (contact.group_b, contact.primitive_b)]
}

fn kind_of(setting: &Setting<'_>, (group, primitive): (usize, u32)) -> PrimitiveKind {
    setting.scene.body(group).primitives[primitive as usize].kind
}

/// The axes of B's frame, at a contact, as forces on the movable groups that yield.
pub(crate) fn rows_of(setting: &Setting<'_>, contact: &PushingContact<'_>) -> Vec<(usize, [Vec6; 3])> {
    let x_ba = contact.x_ba;
    let at_a = x_ba.rotation.tr_mul(&(contact.point_b - x_ba.translation));
    let on_a = setting.mobilities[contact.group_a]
        .as_ref()
        .map(|body| (contact.group_a, AXES.map(|axis| body.row(&x_ba.rotation.tr_mul(&axis), &at_a))));
    let on_b = setting.mobilities[contact.group_b]
        .as_ref()
        .map(|body| (contact.group_b, AXES.map(|axis| body.row(&-axis, &contact.point_b))));
    on_a.into_iter().chain(on_b).collect()
}

/// Inverse of the effective mass at a contact along the normal, 1/kg, and its largest value along the surface.
pub(crate) fn compliances_at(setting: &Setting<'_>, contact: &PushingContact<'_>) -> [f64; 2] {
    let mut sum = pong_geometry::Mat3::zeros();
    for (_, rows) in rows_of(setting, contact) {
        sum += pong_geometry::Mat3::from_fn(|i, j| rows[i].dot(&rows[j]));
    }
    if setting.share_joints(contact.group_a, contact.group_b) {
        sum *= 2.0;
    }
    let n = &contact.normal_b;
    let flat = pong_geometry::Mat3::identity() - n * n.transpose();
    let along = flat * sum * flat;
    [n.dot(&(sum * n)), largest_eigenvalue(DMatrix::from_column_slice(3, 3, along.as_slice()))]
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
