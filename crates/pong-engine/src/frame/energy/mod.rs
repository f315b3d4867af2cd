//! Energies between commits (docs/theory.md, 6), computed on request.
//!
//! Work of a contact's force on the two bodies, by the trapezoidal rule over the relative displacement since
//! the last commit, with o the reference point of A:
//!
//! ```text
//! W = Σ_{then, now} ½·(F·Δo + ((c − o) × F)·φ)
//! ```
//!
//! and dissipated = −W − Δstored. An ended contact contributes the half for its last force, and its stored
//! energy is lost.

pub(crate) mod accounts;
pub(crate) mod buffers;
mod displacement;
pub(crate) mod interval;

use crate::energy::ledger::LedgerEntry;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::forces::reference_point::reference_point;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, WorkerInput};
use crate::frame::worker_context::WorkerContext;
use crate::state::{ContactRecord, ContactRole};
use accounts::Accounts;
use buffers::EnergyBuffers;
use displacement::Displacement;
use pong_geometry::Vec3;

/// Computes the energies of the contacts and the totals.
#[inline]
pub(crate) fn balance(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    order: &[ContactRef],
    caller: &mut WorkerContext,
    energy: &mut EnergyBuffers,
) {
    let EvaluationInput { scene, sealed, memory, .. } = *given;
    let enabled = &given.states.enabled;
    energy.total = LedgerEntry { work: memory.work, dissipated: memory.dissipated };
    if !scene.config.ledger {
        return;
    }
    let EnergyBuffers { total, added, contacts: energies, pairs, intervals } = energy;
    added.fill(LedgerEntry::default());
    let mut book = |group_pair: u32, entry: &LedgerEntry| {
        total.add(entry);
        added[group_pair as usize].add(entry);
    };
    let WorkerContext { scratch, out, .. } = caller;
    energies.reset(out.contacts.len());
    let mut accounts = sealed.coupling.map(|coupling| Accounts {
        scene,
        sealed,
        memory,
        input,
        coupling,
        pairs,
        intervals,
        energies,
    });
    accounts.iter_mut().for_each(Accounts::begin);
    scratch.reset();
    let continued = scratch.slice(memory.records.len(), false).expect("sealing has sized the scratch");
    for place in order.iter() {
        let contact = &mut out.contacts[place.slot.index()];
        let found = &contact.found;
        if found.role != ContactRole::Active {
            continue;
        }
        let motion = motions.known(input, found.key.direction());
        let mut before = Before::default();
        // If two contacts continue one record, the first gets its energy.
        let earlier = place.continues().filter(|&record| !continued[record]);
        if let Some(earlier) = earlier {
            continued[earlier] = true;
            before = Before::of(&memory.records[earlier]);
        }
        let mut work = 0.0;
        let displacement = motion.since_commit.as_ref().map(|since| {
            let (body_a, _) = sealed.bodies_of(found.key.direction());
            let body_a = scene.body(body_a);
            let kind_a = body_a.primitives[found.key.primitive_a as usize].kind;
            let reference = reference_point((body_a, kind_a), &found.key, found.element_a);
            Displacement::new(since, &motion.x_ba, &reference)
        });
        if let Some(displacement) = &displacement {
            work = displacement.half_work(&before.point_b, &before.force_b, false)
                + displacement.half_work(&contact.point_b, &contact.force(), true);
        }
        let dissipated = -work - (contact.stored - before.stored);
        contact.work = before.work + work;
        contact.dissipated = before.dissipated + dissipated;
        book(found.key.group_pair, &LedgerEntry { work, dissipated });
        if let Some(accounts) = &mut accounts {
            accounts.contact(place.slot.index(), contact, earlier, displacement.as_ref());
        }
    }
    let ended =
        memory.records.iter().enumerate().filter(|(i, r)| r.role == ContactRole::Active && !continued[*i]);
    for (index, earlier) in ended {
        let displacement = displacement_of_ended(earlier, motions);
        book(earlier.key.group_pair, &end_contact(earlier, displacement.as_ref()));
        if let Some(accounts) = &mut accounts {
            accounts.ended(index, displacement.as_ref());
        }
    }
    accounts.iter_mut().for_each(|accounts| accounts.close(motions, enabled));
}

/// State of a contact at the last commit; zero for a new contact.
#[derive(Default)]
struct Before {
    point_b: Vec3,
    force_b: Vec3,
    stored: f64,
    work: f64,
    dissipated: f64,
}

impl Before {
    fn of(record: &ContactRecord) -> Self {
        Self {
            point_b: record.point_b,
            force_b: record.force_b,
            stored: record.stored,
            work: record.work,
            dissipated: record.dissipated,
        }
    }
}

/// Displacement at an ended contact.
fn displacement_of_ended(earlier: &ContactRecord, motions: &Motions<'_>) -> Option<Displacement> {
    let motion = motions.of(earlier.key.direction());
    let since = motion.since_commit.as_ref()?;
    // Any point of A can serve as reference; take the contact point.
    let local = since.x_ba.inverse().point(&earlier.point_b);
    Some(Displacement::new(since, &motion.x_ba, &local))
}

/// Work and dissipation of an ended contact: half of the work of its last force; its stored energy is
/// dissipated.
fn end_contact(earlier: &ContactRecord, displacement: Option<&Displacement>) -> LedgerEntry {
    let half =
        |displacement: &Displacement| displacement.half_work(&earlier.point_b, &earlier.force_b, false);
    let work = displacement.map_or(0.0, half);
    LedgerEntry { work, dissipated: earlier.stored - work }
}
