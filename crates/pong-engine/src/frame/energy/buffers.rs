//! What the stage of energies writes.

use super::interval::Interval;
use crate::energy::contact::ContactEnergies;
use crate::energy::episodes::PairEnergies;
use crate::sealed::Sealed;

/// Energies of a frame: what a commit would remember of them.
pub(crate) struct EnergyBuffers {
    /// Work done on the bodies since the world began, J.
    pub work: f64,
    /// Energy that left the contacts for good since the world began, J.
    pub dissipated: f64,
    /// Of the contacts, by their places in the caller's buffer; none unless accounts are kept.
    pub contacts: ContactEnergies,
    /// Of the pairs of movable groups; none unless accounts are kept.
    pub pairs: PairEnergies,
    /// What happened to each pair since the last commit.
    pub intervals: Vec<Interval>,
}

impl EnergyBuffers {
    pub fn new(sealed: &Sealed) -> Self {
        Self {
            work: 0.0,
            dissipated: 0.0,
            contacts: ContactEnergies::with_capacity(sealed.coupling, sealed.limits.lane_contacts),
            pairs: PairEnergies::new(sealed.account_pairs(), sealed.delay()),
            intervals: vec![Interval::default(); sealed.account_pairs()],
        }
    }
}
