//! Tallies of the tests of the last frame and their results.

use crate::guard::get;
use crate::handle::{Inner, pong_world};
use crate::names::no_such;
use crate::status::pong_status;
use pong_engine::{FrameCounts, Tally, World};
use std::ffi::c_char;

/// Kind of the tests of a tally: PONG_TALLY_...
pub type pong_tally_kind = u32;

/// `what` of a tally of tests of the models' bounding volumes.
pub const PONG_TALLY_VOLUMES: pong_tally_kind = 0;
/// `what` of a tally of contact tests.
pub const PONG_TALLY_PRIMITIVES: pong_tally_kind = 1;

/// Tests of one kind against another in the last frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct pong_tally {
    /// Kind of the tests: PONG_TALLY_...
    pub what: pong_tally_kind,
    /// Tests.
    pub tested: u32,
    /// For volumes, tests that did not find the two apart; the others were rejected. For primitives, contacts
    /// found; one test may find several.
    pub met: u32,
    /// Zero.
    pub reserved: u32,
    /// Name of A's kind, as models write it.
    pub kind_a: [c_char; 16],
    /// Name of B's kind.
    pub kind_b: [c_char; 16],
}

/// Number of tallies of the last frame: pairs of kinds with at least one test. It may differ from frame to
/// frame; 0 before the first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_tally_count(world: *const pong_world, count: *mut usize) -> pong_status {
    get(world, (count, "count"), |inner| Ok(tallies(&counts_of(inner)).count()))
}

/// Copies a tally of the last frame; `index` counts from 0. Bounding volumes come first, then primitives,
/// always in the same order of kinds. The numbers are the same for any number of workers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_tally(
    world: *const pong_world,
    index: usize,
    tally: *mut pong_tally,
) -> pong_status {
    get(world, (tally, "tally"), |inner| {
        let counts = counts_of(inner);
        let found = tallies(&counts).nth(index);
        found.ok_or_else(|| no_such("tally", index, tallies(&counts).count()))
    })
}

/// Counts of the last frame; all zero before the seal.
fn counts_of(inner: &Inner) -> FrameCounts {
    inner.phase.sealed().map(World::counts).unwrap_or_default()
}

fn tallies(counts: &FrameCounts) -> impl Iterator<Item = pong_tally> + '_ {
    let volumes = counts.volumes().map(|(a, b, tally)| in_c(PONG_TALLY_VOLUMES, a, b, tally));
    let testers =
        counts.testers().map(|(a, b, tally)| in_c(PONG_TALLY_PRIMITIVES, a.name(), b.name(), tally));
    volumes.chain(testers)
}

fn in_c(what: u32, a: &str, b: &str, tally: Tally) -> pong_tally {
    let Tally { tested, met } = tally;
    pong_tally { what, tested, met, reserved: 0, kind_a: letters(a), kind_b: letters(b) }
}

/// A name as a C string; the last byte stays zero.
fn letters(name: &str) -> [c_char; 16] {
    let mut all = [0; 16];
    for (place, byte) in all[..15].iter_mut().zip(name.bytes()) {
        *place = byte as c_char;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_geometry::primitive::PrimitiveKind;

    #[test]
    fn no_name_is_cut() {
        for kind in PrimitiveKind::ALL {
            let letters = letters(kind.name());
            let read: String =
                letters.iter().take_while(|c| **c != 0).map(|c| char::from(*c as u8)).collect();
            assert_eq!(read, kind.name());
        }
    }
}
