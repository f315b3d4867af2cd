//! Energies of single contacts, as part of the contact state.

use super::account::{EnergyAccount, WrenchCoupling};
use pong_arena::{Full, Table};
use pong_geometry::Wrench;

/// Energies of one contact since it began.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ContactEnergy {
    /// Account without `stored`, which each frame recomputes.
    pub account: EnergyAccount,
    /// Energy stored in the bristle, J.
    pub bristle: f64,
}

/// Energies of one contact, borrowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContactEnergyRef<'a> {
    pub energy: &'a ContactEnergy,
    /// Delayed wrenches, oldest first: on A about its origin, in the frame of B.
    pub delayed: &'a [Wrench],
}

/// Energies of all contacts of a list, in its order; empty unless accounts are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ContactEnergies {
    kept: bool,
    energies: Table<ContactEnergy>,
    /// Delayed wrenches, `delay` for each contact.
    delayed: Table<Wrench>,
    delay: usize,
}

impl ContactEnergies {
    /// Room for this many contacts, if accounts are kept.
    pub fn with_capacity(coupling: Option<WrenchCoupling>, contacts: usize) -> Self {
        let contacts = if coupling.is_some() { contacts } else { 0 };
        let delay = coupling.map_or(0, WrenchCoupling::delay);
        Self {
            kept: coupling.is_some(),
            energies: Table::with_capacity(contacts, ContactEnergy::default()),
            delayed: Table::with_capacity(contacts * delay, Wrench::zero()),
            delay,
        }
    }

    /// Memory per contact, bytes.
    pub fn bytes_each(coupling: Option<WrenchCoupling>) -> usize {
        coupling.map_or(0, |coupling| size_of::<ContactEnergy>() + coupling.delay() * size_of::<Wrench>())
    }

    /// Numbers per contact in a saved block.
    pub fn numbers_each(coupling: Option<WrenchCoupling>) -> usize {
        coupling.map_or(0, |coupling| EnergyAccount::NUMBERS + 1 + 6 * coupling.delay())
    }

    /// Numbers per contact in a saved block.
    pub fn numbers(&self) -> usize {
        if self.kept { EnergyAccount::NUMBERS + 1 + 6 * self.delay } else { 0 }
    }

    /// Delay of the wrench in frames.
    pub fn delay(&self) -> usize {
        self.delay
    }

    /// Energies of a contact, if accounts are kept.
    pub fn get(&self, index: usize) -> Option<ContactEnergyRef<'_>> {
        let of_contact = index * self.delay..(index + 1) * self.delay;
        self.kept
            .then(|| ContactEnergyRef { energy: &self.energies[index], delayed: &self.delayed[of_contact] })
    }

    /// Appends a contact.
    ///
    /// # Errors
    /// [`Full`] if there is no room.
    #[inline]
    pub fn push(&mut self, energy: Option<ContactEnergyRef<'_>>) -> Result<(), Full> {
        let Some(ContactEnergyRef { energy, delayed }) = energy.filter(|_| self.kept) else { return Ok(()) };
        self.energies.push(*energy)?;
        self.delayed.extend_from_slice(delayed)
    }

    /// Resets to this many contacts with zero energies.
    pub fn reset(&mut self, contacts: usize) {
        self.clear();
        for _ in 0..if self.kept { contacts } else { 0 } {
            self.energies.push(ContactEnergy::default()).expect("as much room as for contacts");
        }
        for _ in 0..contacts * self.delay {
            self.delayed.push(Wrench::zero()).expect("as much room as for contacts");
        }
    }

    /// Replaces the energies and the delayed wrenches of a contact. `sent` enters the queue of delayed
    /// wrenches, and the wrench that has arrived leaves it.
    pub fn set(&mut self, index: usize, energy: ContactEnergy, delayed: &[Wrench], sent: Option<Wrench>) {
        self.energies[index] = energy;
        let waiting = &mut self.delayed[index * self.delay..(index + 1) * self.delay];
        waiting[..delayed.len()].copy_from_slice(delayed);
        if let (Some(first), Some(sent)) = (waiting.first_mut(), sent) {
            *first = sent;
            waiting.rotate_left(1);
        }
    }

    /// Books energy that the host inserted into the bristle of a contact, J.
    pub fn insert_into_bristle(&mut self, index: usize, energy: f64) {
        if self.kept {
            let of_contact = &mut self.energies[index];
            of_contact.bristle += energy;
            of_contact.account.inserted += energy;
        }
    }

    pub fn clear(&mut self) {
        self.energies.clear();
        self.delayed.clear();
    }

    /// Copies the energies of one contact over another's.
    pub fn copy_within(&mut self, from: usize, to: usize) {
        if self.kept {
            self.energies[to] = self.energies[from];
            let delay = self.delay;
            self.delayed.as_mut_slice().copy_within(from * delay..(from + 1) * delay, to * delay);
        }
    }

    /// Keeps the first `contacts` contacts.
    pub fn truncate(&mut self, contacts: usize) {
        self.energies.truncate(contacts);
        self.delayed.truncate(contacts * self.delay);
    }

    /// Copies another set of energies of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.clear();
        let fits = self
            .energies
            .extend_from_slice(&other.energies)
            .and_then(|()| self.delayed.extend_from_slice(&other.delayed));
        fits.expect("memories of one world have room for the same");
    }
}

impl ContactEnergyRef<'_> {
    /// Numbers for a saved block.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let wrenches = self.delayed.iter().flat_map(|wrench| wrench.force.into_iter().chain(&wrench.moment));
        let of_contact = self.energy.account.numbers().into_iter().chain([self.energy.bristle]);
        of_contact.chain(wrenches.copied())
    }
}
