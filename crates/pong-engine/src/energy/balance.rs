//! Energies of a frame: the ledger and, if they are kept, the accounts.
//!
//! Work of the force F of a contact on the two bodies, by the trapezoidal rule over the relative displacement
//! since the last commit:
//!
//! ```text
//! W = Σ_{then, now} ½·(F·Δo + ((c − o) × F)·φ)
//! ```
//!
//! with c the contact point, o the reference point of A, Δo its displacement and φ the rotation vector of A.
//! The dissipated energy is −W − Δstored, plus the work of the drives of surfaces that move along themselves. A
//! contact that has ended contributes the half of its last force, and its stored energy is dissipated.

use super::LedgerEntry;
use super::accounts::Accounts;
use super::buffers::EnergyBuffers;
use super::displacement::Displacement;
use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::input::motion::Motion;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, WorkerInput};
use crate::frame::worker_context::WorkerContext;
use crate::state::{ContactRecord, ContactRole};

/// Computes the energies of the contacts and the totals. Contacts that push get their work and dissipation.
#[inline]
pub(crate) fn balance(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    order: &[ContactRef],
    caller: &mut WorkerContext,
    energy: &mut EnergyBuffers,
) {
    energy.total = LedgerEntry { work: given.memory.work, dissipated: given.memory.dissipated };
    if !given.scene.config.ledger {
        return;
    }
    let WorkerContext { scratch, out, .. } = caller;
    let records = &given.memory.records;
    energy.contacts.reset(out.contacts.len());
    let mut books = Books::open(given, motions, input, energy);
    scratch.reset();
    let continued = scratch.slice(records.len(), false).expect("sealing has sized the scratch");
    for reference in order.iter().filter(|reference| reference.pushes()) {
        // If two contacts continue one record, the first in summation order gets the energy of the record,
        // and the other counts as new.
        let earlier =
            reference.continues().filter(|&record| !std::mem::replace(&mut continued[record], true));
        let index = reference.slot.index();
        books.add_contact(index, &mut out.contacts[index], earlier);
    }
    for (index, record) in records.iter().enumerate() {
        if record.role == ContactRole::Active && !continued[index] {
            books.end_contact(index, record);
        }
    }
    books.close(&given.states.enabled);
}

/// Ledger and accounts of one frame.
struct Books<'a> {
    given: &'a EvaluationInput<'a>,
    motions: &'a Motions<'a>,
    input: &'a WorkerInput,
    /// Sums since the world began.
    total: &'a mut LedgerEntry,
    /// Sums of the frame per pair of movable groups.
    added: &'a mut [LedgerEntry],
    accounts: Option<Accounts<'a>>,
    /// Earlier state of a contact that begins: no force, no energy.
    nothing: ContactRecord,
}

impl<'a> Books<'a> {
    /// Begins a frame with empty sums.
    fn open(
        given: &'a EvaluationInput<'a>,
        motions: &'a Motions<'a>,
        input: &'a WorkerInput,
        energy: &'a mut EnergyBuffers,
    ) -> Self {
        let EnergyBuffers { total, added, contacts: energies, pairs, intervals } = energy;
        added.fill(LedgerEntry::default());
        let coupling = given.sealed.coupling;
        let mut accounts =
            coupling.map(|coupling| Accounts { given, input, coupling, pairs, intervals, energies });
        accounts.iter_mut().for_each(Accounts::begin);
        Self { given, motions, input, total, added, accounts, nothing: ContactRecord::blank() }
    }

    /// Books a contact that pushes, with the index of the record that it continues.
    fn add_contact(&mut self, index: usize, contact: &mut FrameContact, earlier: Option<usize>) {
        let motion = self.motions.known(self.input, contact.found.key.direction());
        let displacement = self.displacement(contact, &motion);
        let before = earlier.map_or(&self.nothing, |earlier| &self.given.memory.records[earlier]);
        let work = displacement.as_ref().map_or(0.0, |displacement| {
            displacement.half_work(&before.point_b, &before.force_b, false)
                + displacement.half_work(&contact.point_b, &contact.force(), true)
        });
        let drive = self.drive_work(before, Some(contact));
        let dissipated = -work - (contact.stored - before.stored) + drive;
        contact.work = before.work + work;
        contact.dissipated = before.dissipated + dissipated;
        self.book(contact.found.key.group_pair, &LedgerEntry { work, dissipated });
        if let Some(accounts) = &mut self.accounts {
            accounts.contact(index, contact, earlier, (displacement.as_ref(), drive));
        }
    }

    /// Books a committed contact that no contact continues: half of the trapezoidal work, with its last
    /// force. Its stored energy is dissipated.
    fn end_contact(&mut self, index: usize, earlier: &ContactRecord) {
        let displacement = displacement_of_ended(earlier, self.motions);
        let half =
            |displacement: &Displacement| displacement.half_work(&earlier.point_b, &earlier.force_b, false);
        let work = displacement.as_ref().map_or(0.0, half);
        let drive = self.drive_work(earlier, None);
        let entry = LedgerEntry { work, dissipated: earlier.stored - work + drive };
        self.book(earlier.key.group_pair, &entry);
        if let Some(accounts) = &mut self.accounts {
            accounts.ended(index, (displacement.as_ref(), drive));
        }
    }

    /// Work of the drives of moving surfaces since the last commit, J, against the friction of a contact: at the
    /// last commit (`before`) and, unless it has ended, now. Zero without an earlier pose.
    fn drive_work(&self, before: &ContactRecord, now: Option<&FrameContact>) -> f64 {
        let direction = now.map_or(before.key, |contact| contact.found.key).direction();
        let Some(surfaces) = self.given.round(self.input).moving_surfaces(direction) else { return 0.0 };
        let motion = self.motions.known(self.input, direction);
        let now = now.map(|contact| (&contact.point_b, &contact.found.normal_b, &contact.friction_force_b));
        motion.since_commit.as_ref().map_or(0.0, |since| surfaces.drive_work((&motion, since), before, now))
    }

    /// Ends the frame: sums the accounts of the pairs.
    fn close(mut self, enabled: &[bool]) {
        self.accounts.iter_mut().for_each(|accounts| accounts.close(self.motions, enabled));
    }

    /// Adds an entry of a pair of movable groups to the ledger.
    fn book(&mut self, group_pair: u32, entry: &LedgerEntry) {
        self.total.add(entry);
        self.added[group_pair as usize].add(entry);
    }

    /// Displacement of A at a contact since the last commit; `None` without an earlier pose.
    fn displacement(&self, contact: &FrameContact, motion: &Motion) -> Option<Displacement> {
        let since = motion.since_commit.as_ref()?;
        let found = &contact.found;
        let (body_a, _) = self.motions.sealed.bodies_of(found.key.direction());
        let body_a = self.given.scene.body(body_a);
        let kind_a = body_a.primitives[found.key.primitive_a as usize].kind;
        let reference = body_a.element(kind_a, found.element_a).reference_point(found.key.end);
        Some(Displacement::new(since, &motion.x_ba, &reference))
    }
}

/// Displacement of A at an ended contact since the last commit; `None` without an earlier pose.
fn displacement_of_ended(earlier: &ContactRecord, motions: &Motions<'_>) -> Option<Displacement> {
    let motion = motions.of(earlier.key.direction());
    let since = motion.since_commit.as_ref()?;
    // Any point of A can be the reference point; the contact point is at hand.
    let local = since.x_ba.inverse().point(&earlier.point_b);
    Some(Displacement::new(since, &motion.x_ba, &local))
}
