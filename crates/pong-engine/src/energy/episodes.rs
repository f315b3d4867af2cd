//! Energy accounts of pairs of movable groups and of their contact episodes, and delayed wrenches.

use crate::energy::account::{EnergyAccount, Verdict};
use pong_geometry::{Vec3, Wrench};

/// Contact episode: from the first contact of a pair of movable groups until it has no contact and no delayed
/// wrench any more.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ContactEpisode {
    /// Account of the episode so far; zero outside an episode.
    pub account: EnergyAccount,
    pub lasts: bool,
}

/// Energies of one pair of movable groups.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PairEnergy {
    /// Account since the world began.
    pub total: EnergyAccount,
    /// Current episode.
    pub episode: ContactEpisode,
    /// Completed episodes; among them those that gained energy, and those with an undecided verdict.
    pub episodes: u64,
    pub episodes_gained: u64,
    pub episodes_unresolved: u64,
    /// Total energy gained in episodes, J.
    pub excess: f64,
    /// Largest energy gained in one episode, J.
    pub worst_excess: f64,
}

/// Energies of all pairs; empty unless accounts are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct PairEnergies {
    pub pairs: Box<[PairEnergy]>,
    /// Delayed wrenches, `delay` for each pair, oldest first: on the first group about its origin, in the
    /// frame of the second.
    pub delayed: Box<[Wrench]>,
    pub delay: usize,
}

impl PairEnergy {
    /// Numbers in a saved block.
    pub const NUMBERS: usize = 2 * EnergyAccount::NUMBERS + 6;

    /// Ends the episode and counts its verdict.
    pub fn end_episode(&mut self) {
        let excess = self.episode.account.excess();
        match self.episode.account.verdict() {
            Verdict::Gained => {
                self.episodes_gained += 1;
                self.excess += excess;
                self.worst_excess = self.worst_excess.max(excess);
            }
            Verdict::Unresolved => self.episodes_unresolved += 1,
            Verdict::Dissipated => {}
        }
        self.episodes += 1;
        self.episode = ContactEpisode::default();
    }

    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let counts =
            [self.episodes, self.episodes_gained, self.episodes_unresolved].map(|count| count as f64);
        let rest = [f64::from(u8::from(self.episode.lasts)), self.excess, self.worst_excess];
        self.total.numbers().into_iter().chain(self.episode.account.numbers()).chain(counts).chain(rest)
    }

    pub fn from_numbers(numbers: &[f64; Self::NUMBERS]) -> Self {
        let (total, rest) = numbers.split_at(EnergyAccount::NUMBERS);
        let (episode, rest) = rest.split_at(EnergyAccount::NUMBERS);
        Self {
            total: EnergyAccount::from_numbers(total),
            episode: ContactEpisode { account: EnergyAccount::from_numbers(episode), lasts: rest[3] != 0.0 },
            episodes: rest[0] as u64,
            episodes_gained: rest[1] as u64,
            episodes_unresolved: rest[2] as u64,
            excess: rest[4],
            worst_excess: rest[5],
        }
    }
}

impl PairEnergies {
    /// Zero energies for this many pairs, with wrenches delayed by `delay` frames.
    pub fn new(pairs: usize, delay: usize) -> Self {
        Self {
            pairs: vec![PairEnergy::default(); pairs].into_boxed_slice(),
            delayed: vec![Wrench::zero(); pairs * delay].into_boxed_slice(),
            delay,
        }
    }

    /// Length in a saved block, bytes.
    pub fn block_len(pairs: usize, delay: usize) -> usize {
        pairs * 8 * (PairEnergy::NUMBERS + 6 * delay)
    }

    /// Copies other energies of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.pairs.copy_from_slice(&other.pairs);
        self.delayed.copy_from_slice(&other.delayed);
    }

    /// Copies the energies of one pair.
    pub fn copy_pair(&mut self, pair: usize, other: &Self) {
        if let Some(energy) = self.pairs.get_mut(pair) {
            *energy = other.pairs[pair];
            let delayed = pair * self.delay..(pair + 1) * self.delay;
            self.delayed[delayed.clone()].copy_from_slice(&other.delayed[delayed]);
        }
    }

    /// Books energy that the host inserted into contacts of the pair, J.
    pub fn insert(&mut self, pair: usize, energy: f64) {
        if let Some(of_pair) = self.pairs.get_mut(pair) {
            of_pair.total.inserted += energy;
            of_pair.episode.account.inserted += energy;
        }
    }

    /// Clears the history of the pair: ends the episode without a verdict, and drops delayed wrenches and the
    /// stored energy, J.
    pub fn clear_history(&mut self, pair: usize, stored: f64) {
        if let Some(energy) = self.pairs.get_mut(pair) {
            energy.total.inserted -= stored;
            energy.episode = ContactEpisode::default();
            self.delayed[pair * self.delay..(pair + 1) * self.delay].fill(Wrench::zero());
        }
    }

    /// Queues a wrench and returns the one that arrives: `sent` itself without a delay.
    pub fn exchange(&mut self, pair: usize, sent: Wrench) -> Wrench {
        let delayed = &mut self.delayed[pair * self.delay..(pair + 1) * self.delay];
        let Some(first) = delayed.first_mut() else { return sent };
        let arrives = std::mem::replace(first, sent);
        delayed.rotate_left(1);
        arrives
    }

    /// Returns true if a delayed wrench is not zero.
    pub fn is_delayed(&self, pair: usize) -> bool {
        let nothing = |wrench: &Wrench| wrench.force == Vec3::zeros() && wrench.moment == Vec3::zeros();
        !self.delayed[pair * self.delay..(pair + 1) * self.delay].iter().all(nothing)
    }
}
