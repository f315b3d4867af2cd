//! Report and energies.

use crate::guard::with_world;
use crate::pointers::Out;
use crate::status::pong_status;
use crate::world::pong_world;

/// The frame had more contacts than the world's capacity: the deepest were kept. `contacts_wanted` advises a
/// capacity.
pub const PONG_FLAG_CONTACT_LIMIT: u32 = 1;

/// What the last frame did.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct pong_report {
    /// What the last frame had to leave out, PONG_FLAG_...; 0 if nothing.
    pub flags: u32,
    /// Contacts listed.
    pub contacts: u32,
    /// Contacts there would have been without the limit.
    pub contacts_wanted: u32,
    /// Largest `contacts_wanted` of any frame of this world.
    pub peak_contacts_wanted: u32,
    /// Pairs of bounding volumes tested.
    pub volumes_tested: u64,
    /// Pairs of leaves whose contents were tested.
    pub leaf_pairs: u64,
    /// Pairs of primitives tested.
    pub primitives_tested: u64,
    /// Evaluations since the world was made, those that a step or a commit asked for included.
    pub evaluations: u64,
    /// Commits since the world was made.
    pub commits: u64,
    /// Duration of the last evaluation, ns.
    pub evaluate_ns: u64,
    /// Duration of the last commit without the evaluation it may have asked for, ns.
    pub commit_ns: u64,
    /// Zero in this version.
    pub reserved: [u64; 8],
}

/// Counts, times and flags of the last frame; all zero before the first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_report(world: *const pong_world, report: *mut pong_report) -> pong_status {
    // SAFETY: see "Safety of all entries" in lib.rs.
    unsafe {
        with_world(world, |inner| {
            let out = Out::new(report, "report")?;
            let (frame, counts, counters) = (inner.world.report(), inner.world.counts(), inner.counters);
            out.set(pong_report {
                flags: frame.status.bits(),
                contacts: frame.contacts,
                contacts_wanted: frame.contacts_wanted,
                peak_contacts_wanted: counters.peak_contacts_wanted,
                volumes_tested: counts.volumes_tested(),
                leaf_pairs: counts.leaf_pairs,
                primitives_tested: counts.primitives_tested(),
                evaluations: counters.evaluations,
                commits: counters.commits,
                evaluate_ns: counters.evaluate_ns,
                commit_ns: counters.commit_ns,
                reserved: [0; 8],
            });
            Ok(())
        })
    }
}

/// Energies of all contacts of a world, at the last commit.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_ledger {
    /// Stored in normal springs and friction, J.
    pub stored: f64,
    /// Work done on the bodies since the world began, J, by the trapezoid rule between commits.
    pub work: f64,
    /// Dissipated since the world began, J.
    pub dissipated: f64,
}

/// The energies; zero unless the configuration has keep_ledger.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_ledger(world: *const pong_world, ledger: *mut pong_ledger) -> pong_status {
    // SAFETY: see "Safety of all entries" in lib.rs.
    unsafe {
        with_world(world, |inner| {
            let energies = inner.world.ledger();
            Out::new(ledger, "ledger")?.set(pong_ledger {
                stored: energies.stored,
                work: energies.work,
                dissipated: energies.dissipated,
            });
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_engine::StatusBits;

    #[test]
    fn flags_are_the_bits_of_the_engine() {
        assert_eq!(PONG_FLAG_CONTACT_LIMIT, StatusBits::CONTACT_LIMIT.bits());
    }
}
