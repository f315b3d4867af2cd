//! What the stage of energies writes.

use super::interval::Interval;
use crate::energy::contact::ContactEnergies;
use crate::energy::episodes::PairEnergies;
use crate::energy::ledger::LedgerEntry;
use crate::scene::Scene;
use crate::sealed::Sealed;

/// Energies of a frame: what a commit would remember of them.
pub(crate) struct EnergyBuffers {
    /// Work done on the bodies since the world began, J.
    pub work: f64,
    /// Energy that left the contacts for good since the world began, J.
    pub dissipated: f64,
    /// What the frame adds to both, by pair of movable groups, for a commit of some pairs; none unless the ledger is kept.
    pub added: Vec<LedgerEntry>,
    /// Of the contacts, by their places in the caller's buffer; none unless accounts are kept.
    pub contacts: ContactEnergies,
    /// Of the pairs of movable groups; none unless accounts are kept.
    pub pairs: PairEnergies,
    /// What happened to each pair since the last commit.
    pub intervals: Vec<Interval>,
}

impl EnergyBuffers {
    pub fn new(scene: &Scene, sealed: &Sealed) -> Self {
        let pairs = if scene.config.ledger { sealed.group_pairs.len() } else { 0 };
        Self {
            work: 0.0,
            dissipated: 0.0,
            added: vec![LedgerEntry::default(); pairs],
            contacts: ContactEnergies::with_capacity(sealed.coupling, sealed.limits.lane_contacts),
            pairs: PairEnergies::new(sealed.account_pairs(), sealed.delay()),
            intervals: vec![Interval::default(); sealed.account_pairs()],
        }
    }
}
