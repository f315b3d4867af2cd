//! Energy accounts of pairs of movable groups and of their contact episodes, and wrenches on their way to the bodies.

use crate::energy::account::{EnergyAccount, Verdict};
use pong_geometry::{Vec3, Wrench};

/// From the first contact of a pair of movable groups until nothing of it touches any more, and no delayed wrench of it is
/// on its way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ContactEpisode {
    /// Of the episode so far; all zero unless it lasts.
    pub account: EnergyAccount,
    pub lasts: bool,
}

/// Energies of one pair of movable groups.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PairEnergy {
    /// Since the world began.
    pub total: EnergyAccount,
    /// The present one.
    pub episode: ContactEpisode,
    /// Episodes that have ended; of those the ones that gained energy, and the ones of which the accounts cannot tell.
    pub episodes: u64,
    pub episodes_gained: u64,
    pub episodes_unresolved: u64,
    /// What episodes gained, all together, J.
    pub excess: f64,
    /// What one episode gained at most, J.
    pub worst_excess: f64,
}

/// Energies of all pairs; empty unless the world keeps them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct PairEnergies {
    pub pairs: Box<[PairEnergy]>,
    /// Wrenches that have not reached the bodies yet, `delay` for each pair, the oldest first: on the first group about
    /// its origin, in the frame of the second.
    pub delayed: Box<[Wrench]>,
    pub delay: usize,
}

impl PairEnergy {
    /// In a block.
    pub const NUMBERS: usize = 2 * EnergyAccount::NUMBERS + 6;

    /// The episode is over: what is to be said of it.
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
    /// Of so many pairs, whose wrenches come so many frames late.
    pub fn new(pairs: usize, delay: usize) -> Self {
        Self {
            pairs: vec![PairEnergy::default(); pairs].into_boxed_slice(),
            delayed: vec![Wrench::zero(); pairs * delay].into_boxed_slice(),
            delay,
        }
    }

    /// Bytes in a block.
    pub fn block_len(pairs: usize, delay: usize) -> usize {
        pairs * 8 * (PairEnergy::NUMBERS + 6 * delay)
    }

    /// Becomes equal to energies of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.pairs.copy_from_slice(&other.pairs);
        self.delayed.copy_from_slice(&other.delayed);
    }

    /// Takes over what is written of one pair.
    pub fn copy_pair(&mut self, pair: usize, other: &Self) {
        if let Some(energy) = self.pairs.get_mut(pair) {
            *energy = other.pairs[pair];
            let delayed = pair * self.delay..(pair + 1) * self.delay;
            self.delayed[delayed.clone()].copy_from_slice(&other.delayed[delayed]);
        }
    }

    /// The host put energy into contacts of the pair, J.
    pub fn insert(&mut self, pair: usize, energy: f64) {
        if let Some(of_pair) = self.pairs.get_mut(pair) {
            of_pair.total.inserted += energy;
            of_pair.episode.account.inserted += energy;
        }
    }

    /// The history of the pair is cleared: no episode lasts, nothing is on its way, and what it had stored is gone.
    pub fn clear_history(&mut self, pair: usize, stored: f64) {
        if let Some(energy) = self.pairs.get_mut(pair) {
            energy.total.inserted -= stored;
            energy.episode = ContactEpisode::default();
            self.delayed[pair * self.delay..(pair + 1) * self.delay].fill(Wrench::zero());
        }
    }

    /// Sends a wrench on its way and takes out the one that arrives.
    pub fn exchange(&mut self, pair: usize, sent: Wrench) -> Wrench {
        let delayed = &mut self.delayed[pair * self.delay..(pair + 1) * self.delay];
        let Some(first) = delayed.first_mut() else { return sent };
        let arrives = std::mem::replace(first, sent);
        delayed.rotate_left(1);
        arrives
    }

    /// Whether a wrench is on its way.
    pub fn is_delayed(&self, pair: usize) -> bool {
        let nothing = |wrench: &Wrench| wrench.force == Vec3::zeros() && wrench.moment == Vec3::zeros();
        !self.delayed[pair * self.delay..(pair + 1) * self.delay].iter().all(nothing)
    }
}
