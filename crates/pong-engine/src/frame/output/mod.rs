//! Results of a frame: ordered contacts, wrenches, the host's contact list, wrenches of single pairs, records
//! for the commit, and preloaded bristles.

pub(crate) mod commit;
mod listing;
pub(crate) mod order;
mod pair_wrench;
pub(crate) mod preload;
pub(crate) mod reduce;

use crate::energy::contact::ContactEnergies;
use crate::scene::Scene;
use crate::seal::Sealed;
use order::OrderedContacts;
use pong_geometry::{Pose, Wrench};

/// Results of a frame, read-only, for the host. Contacts are listed in `listing.rs`, the wrenches of single pairs
/// summed in `pair_wrench.rs`.
#[derive(Clone, Copy)]
pub(crate) struct FrameResults<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    /// Poses of all movable groups in the frame.
    pub poses: &'a [Pose],
    pub contacts: OrderedContacts<'a>,
    /// Wrench on each movable group, about and along its own frame.
    pub wrenches: &'a [Wrench],
    /// Energies of the contacts, by index in the caller's buffer; empty unless accounts are kept.
    pub energies: &'a ContactEnergies,
}

impl FrameResults<'_> {
    /// Rotates a wrench from the axes of a movable group to those of the common frame; its origin stays.
    pub fn along_common_axes(&self, wrench: &Wrench, group: usize) -> Wrench {
        let orientation = self.poses[group].orientation;
        Wrench { force: orientation * wrench.force, moment: orientation * wrench.moment }
    }
}
