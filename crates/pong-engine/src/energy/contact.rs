//! What is remembered of the energies of single contacts.

use super::account::{EnergyAccount, WrenchCoupling};
use pong_arena::{Full, Table};
use pong_geometry::Wrench;

/// Energies of one contact since it began.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ContactEnergy {
    /// All but what is stored, which every frame finds anew.
    pub account: EnergyAccount,
    /// Stored in the bristle, J.
    pub bristle: f64,
}

/// The energies of one contact among others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContactEnergyRef<'a> {
    pub energy: &'a ContactEnergy,
    /// Wrenches that have not reached the bodies yet, the oldest first: on A about its origin, in the frame of B.
    pub delayed: &'a [Wrench],
}

/// Energies of contacts, one after another: of all contacts of a list or, where no accounts are kept, of none.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ContactEnergies {
    kept: bool,
    energies: Table<ContactEnergy>,
    /// As many for every contact as the wrench comes frames late.
    delayed: Table<Wrench>,
    delay: usize,
}

impl ContactEnergies {
    /// Room for so many contacts, if accounts are kept.
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

    /// What a contact takes in memory, bytes.
    pub fn bytes_each(coupling: Option<WrenchCoupling>) -> usize {
        coupling.map_or(0, |coupling| size_of::<ContactEnergy>() + coupling.delay() * size_of::<Wrench>())
    }

    /// What a contact takes in a saved block, numbers.
    pub fn numbers_each(coupling: Option<WrenchCoupling>) -> usize {
        coupling.map_or(0, |coupling| EnergyAccount::NUMBERS + 1 + 6 * coupling.delay())
    }

    /// What a contact takes in a saved block, numbers.
    pub fn numbers(&self) -> usize {
        if self.kept { EnergyAccount::NUMBERS + 1 + 6 * self.delay } else { 0 }
    }

    /// How many frames late the wrench comes.
    pub fn delay(&self) -> usize {
        self.delay
    }

    /// The energies of a contact, if they are kept.
    pub fn get(&self, index: usize) -> Option<ContactEnergyRef<'_>> {
        let of_contact = index * self.delay..(index + 1) * self.delay;
        self.kept
            .then(|| ContactEnergyRef { energy: &self.energies[index], delayed: &self.delayed[of_contact] })
    }

    /// One contact more.
    ///
    /// # Errors
    /// [`Full`] if there is no room.
    #[inline]
    pub fn push(&mut self, energy: Option<ContactEnergyRef<'_>>) -> Result<(), Full> {
        let Some(ContactEnergyRef { energy, delayed }) = energy.filter(|_| self.kept) else { return Ok(()) };
        self.energies.push(*energy)?;
        self.delayed.extend_from_slice(delayed)
    }

    /// Energies of so many contacts, all zero.
    pub fn reset(&mut self, contacts: usize) {
        self.clear();
        for _ in 0..if self.kept { contacts } else { 0 } {
            self.energies.push(ContactEnergy::default()).expect("as much room as for contacts");
        }
        for _ in 0..contacts * self.delay {
            self.delayed.push(Wrench::zero()).expect("as much room as for contacts");
        }
    }

    /// Replaces the energies of a contact; `sent` is on its way from now on, in the place of the wrench that has arrived.
    pub fn set(&mut self, index: usize, energy: ContactEnergy, delayed: &[Wrench], sent: Option<Wrench>) {
        self.energies[index] = energy;
        let waiting = &mut self.delayed[index * self.delay..(index + 1) * self.delay];
        waiting[..delayed.len()].copy_from_slice(delayed);
        if let (Some(first), Some(sent)) = (waiting.first_mut(), sent) {
            *first = sent;
            waiting.rotate_left(1);
        }
    }

    /// The host put energy into the bristle of a contact, J.
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

    /// Copies a contact's energies over those of another.
    pub fn copy_within(&mut self, from: usize, to: usize) {
        if self.kept {
            self.energies[to] = self.energies[from];
            let delay = self.delay;
            self.delayed.as_mut_slice().copy_within(from * delay..(from + 1) * delay, to * delay);
        }
    }

    /// Keeps the first so many contacts.
    pub fn truncate(&mut self, contacts: usize) {
        self.energies.truncate(contacts);
        self.delayed.truncate(contacts * self.delay);
    }

    /// Becomes equal to energies of the same size.
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
    /// In a block.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let wrenches = self.delayed.iter().flat_map(|wrench| wrench.force.into_iter().chain(&wrench.moment));
        let of_contact = self.energy.account.numbers().into_iter().chain([self.energy.bristle]);
        of_contact.chain(wrenches.copied())
    }
}
