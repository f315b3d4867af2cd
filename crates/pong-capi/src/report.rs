//! Report and energies.

use crate::guard::{get, with_world};
use crate::handle::{Counters, pong_world};
use crate::phase::Phase;
use crate::pointers::Out;
use crate::status::pong_status;
use pong_engine::{Stage, StageTimes, Work, WorkTimes, World};
use std::ffi::{CStr, c_char};

/// Limits that a frame reached: a sum of PONG_FLAG_...
pub type pong_flags = u32;

/// The frame had more contacts than the world's capacity: the deepest were kept.
pub const PONG_FLAG_CONTACT_LIMIT: pong_flags = 1;
/// A sphere had more contacts with one surface than could be shared exactly: the deepest were shared.
pub const PONG_FLAG_LOAD_SHARING_LIMIT: pong_flags = 2;
/// A contact was missed: a body passed right through another one since the last commit, or came out on the far
/// side of the one that pushed it back. Remedy: shorter frames, a thicker wall or a stiffer surface. Before an
/// intended jump call pong_clear_contact_history().
pub const PONG_FLAG_TUNNELLED: pong_flags = 4;
/// A solid was deeper in a mesh that is not convex than the regions below its facets: the force no longer grew as it
/// should. Remedy: stiffer surfaces, a thicker mesh or one with longer edges, or convex pieces (`pong decompose`).
/// `pong check` prints the least depth of the regions of each mesh.
pub const PONG_FLAG_DEEP_IN_MESH: pong_flags = 8;

/// `stage_ns` of states in and relative motion.
pub const PONG_STAGE_INPUT: usize = 0;
/// `stage_ns` of bounding volumes, testers, sharing and forces, on the calling thread and the workers.
pub const PONG_STAGE_CONTACTS: usize = 1;
/// `stage_ns` of putting contacts in order and keeping to the limits.
pub const PONG_STAGE_ORDER: usize = 2;
/// `stage_ns` of the energies, if they are kept.
pub const PONG_STAGE_ENERGY: usize = 3;
/// `stage_ns` of the wrenches.
pub const PONG_STAGE_OUTPUT: usize = 4;
/// `stage_ns` of the contact state, if the frame was committed.
pub const PONG_STAGE_COMMIT: usize = 5;

/// `work_ns` of laying out the work, bounding volumes and boxes.
pub const PONG_WORK_BROAD_PHASE: usize = 0;
/// `work_ns` of contact tests.
pub const PONG_WORK_NARROW_PHASE: usize = 1;
/// `work_ns` of load sharing: which contacts count, and their weights.
pub const PONG_WORK_LOAD_SHARING: usize = 2;
/// `work_ns` of normal and friction forces.
pub const PONG_WORK_FORCES: usize = 3;

/// Names, by PONG_STAGE_....
const STAGE_NAMES: [&CStr; 6] = [c"input", c"contacts", c"order", c"energy", c"output", c"commit"];
/// Names, by PONG_WORK_....
const WORK_NAMES: [&CStr; 4] = [c"broad phase", c"narrow phase", c"load sharing", c"forces"];

/// Number of stages that pong_report has room for.
const STAGES: usize = 8;

/// Counts, times, memory use and flags of the last frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct pong_report {
    /// Limits that the last frame hit, PONG_FLAG_...; 0 if none. See pong_flag_name().
    pub flags: pong_flags,
    /// Contacts listed.
    pub contacts: u32,
    /// Contacts before the limit was applied: the capacity to ask for after PONG_FLAG_CONTACT_LIMIT.
    pub contacts_wanted: u32,
    /// Largest `contacts_wanted` of any frame of this world.
    pub peak_contacts_wanted: u32,
    /// Pairs of bounding volumes tested.
    pub volumes_tested: u64,
    /// Pairs of leaves whose contents were tested.
    pub leaf_pairs: u64,
    /// Tests of a box with the eight boxes of a node below a leaf.
    pub boxes_tested: u64,
    /// Pairs of primitives tested. By kind: pong_get_tally().
    pub primitives_tested: u64,
    /// Evaluations since the world was made, including those made by a step or a commit.
    pub evaluations: u64,
    /// Commits since the world was made.
    pub commits: u64,
    /// Duration of the last evaluation, ns.
    pub evaluate_ns: u64,
    /// Duration of the last commit, ns, without an evaluation made by it.
    pub commit_ns: u64,
    /// With report_times: duration of each stage of the last frame, ns, at PONG_STAGE_...; else zero.
    pub stage_ns: [u64; 8],
    /// With report_times: processor time in each part of the work of PONG_STAGE_CONTACTS, ns, at PONG_WORK_..., the calling
    /// thread's and the workers' together: with workers the sum may be more than the stage took. By thread:
    /// pong_get_worker().
    pub work_ns: [u64; 4],
    /// The contact_capacity to ask for after a limit was hit in the last frame; 0 if none was. After
    /// PONG_FLAG_LOAD_SHARING_LIMIT alone it is twice the present one, and may have to be doubled again.
    pub advised_capacity: u64,
    /// Largest number of contacts that a frame of this world had to hold, including contacts that have ended
    /// and are only remembered.
    pub contacts_peak: u64,
    /// Number of contacts that there is room for: more than the contact capacity.
    pub contacts_capacity: u64,
    /// Largest memory that the testers of one part of a frame needed, bytes.
    pub arena_peak: u64,
    /// Memory available to them, bytes.
    pub arena_capacity: u64,
    /// Largest memory that sharing among the contacts of one surface needed, bytes.
    pub scratch_peak: u64,
    /// Memory available to it, bytes.
    pub scratch_capacity: u64,
    /// Rounds of work since the world was sealed that the calling thread did by itself because a worker did
    /// not come back in time. The results are the same; the frame takes longer.
    pub worker_timeouts: u64,
    /// Zero in this version.
    pub reserved: [u64; 3],
}

/// Copies counts, times, memory and flags of the last frame; before the first all zero, except the capacities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_report(world: *const pong_world, report: *mut pong_report) -> pong_status {
    get(world, (report, "report"), |inner| Ok(report_of(&inner.phase, &inner.counters)))
}

fn report_of(phase: &Phase, counters: &Counters) -> pong_report {
    let world = phase.sealed();
    let (frame, counts) = (phase.report(), world.map(World::counts).unwrap_or_default());
    let memory = world.map(World::memory).unwrap_or_default();
    let times = world.map(World::stage_times).unwrap_or_default();
    pong_report {
        flags: frame.status.bits(),
        contacts: frame.contacts,
        contacts_wanted: frame.contacts_wanted,
        peak_contacts_wanted: counters.peak_contacts_wanted,
        volumes_tested: counts.volumes_tested(),
        leaf_pairs: counts.leaf_pairs,
        boxes_tested: counts.boxes_tested,
        primitives_tested: counts.primitives_tested(),
        evaluations: counters.evaluations,
        commits: counters.commits,
        evaluate_ns: counters.evaluate_ns,
        commit_ns: counters.commit_ns,
        stage_ns: by_stage(&times),
        work_ns: by_work(&times.work),
        advised_capacity: frame.advised_capacity(counters.contact_capacity as usize).unwrap_or(0) as u64,
        contacts_peak: memory.contacts_peak as u64,
        contacts_capacity: memory.contacts_capacity as u64,
        arena_peak: memory.arena_peak as u64,
        arena_capacity: memory.arena_capacity as u64,
        scratch_peak: memory.scratch_peak as u64,
        scratch_capacity: memory.scratch_capacity as u64,
        worker_timeouts: world.map_or(0, World::worker_timeouts),
        reserved: [0; 3],
    }
}

fn by_stage(times: &StageTimes) -> [u64; STAGES] {
    let mut all = [0; STAGES];
    for stage in Stage::ALL {
        all[stage as usize] = times.of(stage);
    }
    all
}

/// Times of the parts of the work of one thread, or of all together, in order.
pub(crate) fn by_work(times: &WorkTimes) -> [u64; 4] {
    Work::ALL.map(|work| times.of(work))
}

/// Meaning of a flag of the report, in words: "contact limit", "load sharing limit", "tunnelled", "deep in mesh";
/// "unknown limit" for a number that is no single flag. Lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn pong_flag_name(flag: pong_flags) -> *const c_char {
    let name: &CStr = match flag {
        PONG_FLAG_CONTACT_LIMIT => c"contact limit",
        PONG_FLAG_LOAD_SHARING_LIMIT => c"load sharing limit",
        PONG_FLAG_TUNNELLED => c"tunnelled",
        PONG_FLAG_DEEP_IN_MESH => c"deep in mesh",
        _ => c"unknown limit",
    };
    name.as_ptr()
}

/// Name of a stage, PONG_STAGE_...: "input", "contacts", "order", "energy", "output", "commit"; empty for an
/// index of `stage_ns` that has no stage. Lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn pong_stage_name(stage: usize) -> *const c_char {
    STAGE_NAMES.get(stage).unwrap_or(&c"").as_ptr()
}

/// Name of a part of the contacts' work, PONG_WORK_...: "broad phase", "narrow phase", "load sharing",
/// "forces"; empty for an index outside `work_ns`. Lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn pong_work_name(work: usize) -> *const c_char {
    WORK_NAMES.get(work).unwrap_or(&c"").as_ptr()
}

/// Energies of all contacts of a world, at the last commit.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_ledger {
    /// Stored in normal springs and friction, J.
    pub stored: f64,
    /// Work done on the bodies since the world began, J, by the trapezoid rule between commits.
    pub work: f64,
    /// Energy that left the contacts for good since the world began, J: −work − stored. Forgotten energy
    /// counts as lost; energy that the host put in, by a contact that it set up or by a preload, counts as
    /// negative.
    pub dissipated: f64,
}

/// Copies the energies at the last commit; work and dissipation are zero unless the configuration has
/// keep_ledger.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_ledger(world: *const pong_world, ledger: *mut pong_ledger) -> pong_status {
    with_world(world, |inner| {
        let energies = inner.phase.sealed().map(World::ledger).unwrap_or_default();
        Out::new(ledger, "ledger")?.set(pong_ledger {
            stored: energies.stored,
            work: energies.work,
            dissipated: energies.dissipated,
        });
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_engine::StatusBits;

    #[test]
    fn flags_are_the_bits_of_the_engine() {
        assert_eq!(PONG_FLAG_CONTACT_LIMIT, StatusBits::CONTACT_LIMIT.bits());
        assert_eq!(PONG_FLAG_LOAD_SHARING_LIMIT, StatusBits::LOAD_SHARING_LIMIT.bits());
        assert_eq!(PONG_FLAG_TUNNELLED, StatusBits::TUNNELLED.bits());
        assert_eq!(PONG_FLAG_DEEP_IN_MESH, StatusBits::DEEP_IN_MESH.bits());
    }

    #[test]
    fn stages_are_those_of_the_engine() {
        for stage in Stage::ALL {
            // SAFETY: the name ends with a zero byte and lives as long as the library.
            let name = unsafe { CStr::from_ptr(pong_stage_name(stage as usize)) };
            assert_eq!(name.to_str(), Ok(stage.name()));
        }
    }

    #[test]
    fn parts_of_the_work_are_those_of_the_engine() {
        for work in Work::ALL {
            // SAFETY: the name ends with a zero byte and lives as long as the library.
            let name = unsafe { CStr::from_ptr(pong_work_name(work as usize)) };
            assert_eq!(name.to_str(), Ok(work.name()));
        }
    }
}
