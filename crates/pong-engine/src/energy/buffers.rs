//! Buffers of the energy stage.

use super::LedgerEntry;
use super::account::EnergyAccount;
use super::contact::ContactEnergies;
use super::episodes::PairEnergies;
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

/// Energies of a pair of movable groups since the last commit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Interval {
    /// Sum of its contacts, without `work_in` and `work_out`.
    pub sum: EnergyAccount,
    /// Work of the wrench as the host applies it, J.
    pub as_used: f64,
    /// Work of forces that follow the motion, J.
    pub along_motion: f64,
    pub pushes: bool,
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
