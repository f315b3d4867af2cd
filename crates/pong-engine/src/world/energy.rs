//! Energies and energy accounts of the last commit.

use super::World;
use crate::contact::Ledger;
use crate::energy::account::{EnergyAccount, PairEnergyAccount};
use crate::ids::{InterfaceId, PairId};

impl World {
    /// Energies at the last commit, J. Work and dissipation are zero unless
    /// [`Config::ledger`](crate::Config::ledger) is set.
    pub fn ledger(&self) -> Ledger {
        let memory = &self.runtime.memory;
        // Adding 0 turns the −0 of an empty sum into +0.
        let stored = memory.records.iter().map(|record| record.stored).sum::<f64>() + 0.0;
        Ledger { stored, work: memory.work, dissipated: memory.dissipated }
    }

    /// Energy accounts of the contacts of the last frame, one for each of [`contacts`](Self::contacts) in the
    /// same order; empty unless [`Config::accounts`](crate::Config::accounts) is set.
    pub fn contact_accounts(&self) -> impl Iterator<Item = EnergyAccount> + '_ {
        let kept = self.scene.config.accounts.map(|_| self.last_results().list_accounts());
        kept.into_iter().flatten()
    }

    /// Energy accounts of all pairs of movable groups at the last commit; empty unless
    /// [`Config::accounts`](crate::Config::accounts) is set.
    pub fn pair_accounts(&self) -> impl Iterator<Item = PairEnergyAccount> + '_ {
        let stamp = self.scene.stamp;
        self.runtime.pair_energies().map(move |(pair, energy, total, episode, stiffest)| PairEnergyAccount {
            pair: PairId::new(stamp, pair.pair),
            interfaces: [pair.first, pair.second].map(|body| InterfaceId::new(stamp, body)),
            total,
            episode,
            in_contact: energy.episode.lasts,
            episodes: energy.episodes,
            episodes_gained: energy.episodes_gained,
            episodes_unresolved: energy.episodes_unresolved,
            excess: energy.excess,
            worst_excess: energy.worst_excess,
            stiffest,
            coupling: self.scene.config.accounts.unwrap_or_default(),
        })
    }

    /// Sum of the energy accounts of all pairs of movable groups at the last commit.
    pub fn account(&self) -> EnergyAccount {
        let mut all = EnergyAccount::default();
        self.pair_accounts().for_each(|pair| all.add(&pair.total));
        all
    }
}
