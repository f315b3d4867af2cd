//! Buffers of the energy stage.

use super::interval::Interval;
use crate::energy::contact::ContactEnergies;
use crate::energy::episodes::PairEnergies;
use crate::energy::ledger::LedgerEntry;
use crate::scene::Scene;
use crate::seal::Sealed;

/// Energies of a frame, as a commit would store them.
pub(crate) struct EnergyBuffers {
    /// Work and dissipation since the world began.
    pub total: LedgerEntry,
    /// Contributions of the frame to `total`, per pair of movable groups, for partial commits; empty without a
    /// ledger.
    pub added: Vec<LedgerEntry>,
    /// Energies of the contacts, by index in the caller's buffer; empty unless accounts are kept.
    pub contacts: ContactEnergies,
    /// Energies of the pairs of movable groups; empty unless accounts are kept.
    pub pairs: PairEnergies,
    /// Energies of each pair since the last commit.
    pub intervals: Vec<Interval>,
}

impl EnergyBuffers {
    pub fn new(scene: &Scene, sealed: &Sealed) -> Self {
        let pairs = if scene.config.ledger { sealed.group_pairs.len() } else { 0 };
        Self {
            total: LedgerEntry::default(),
            added: vec![LedgerEntry::default(); pairs],
            contacts: ContactEnergies::with_capacity(sealed.coupling, sealed.limits.thread_contacts),
            pairs: PairEnergies::new(sealed.account_pairs(), sealed.delay()),
            intervals: vec![Interval::default(); sealed.account_pairs()],
        }
    }
}
