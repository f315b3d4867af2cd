//! Computes the capacities of the buffers of a frame, and the memory per contact and per thread.

use super::frame_limits::Limits;
use crate::energy::contact::ContactEnergies;
use crate::frame::load_sharing::solver::scratch_bytes;
use crate::frame::{ContactRef, FrameContact, Slot, WorkerContext, arena_bytes};
use crate::scene::Scene;
use crate::state::Records;
use pong_model::Tree;
use pong_threads::MAX_WORKERS;

/// Capacities of the buffers of the frames of a scene.
pub(super) fn limits(scene: &Scene, paired_bodies: &[usize], record_capacity: usize) -> Limits {
    /// Minimum capacity in candidates per chunk: a sphere on a fine mesh has many candidates before load
    /// sharing selects those that push.
    const FOUND_MIN: usize = 1024;
    /// Contacts of one surface that are shared exactly if some normals are more than 90° apart.
    const SHARED: usize = 128;
    let found = record_capacity.max(FOUND_MIN);
    let thread_contacts = record_capacity + (record_capacity / 8).max(64);
    let in_tree = |count: fn(&Tree) -> usize| {
        let bodies = paired_bodies.iter().map(|&body| count(&scene.body(body).tree));
        bodies.max().unwrap_or(0)
    };
    let (nodes, batches) = (in_tree(|tree| tree.nodes.len()), in_tree(|tree| tree.batches.len()));
    let tree_parts = nodes + batches;
    let arena_bytes = arena_bytes(nodes, batches);
    /// Allowance for rounding each piece up to the arena's grain.
    const GRAINS: usize = 64;
    let per_contact = size_of::<((usize, u32, usize, usize), f64)>();
    let scratch_bytes = scratch_bytes(SHARED).max(thread_contacts * per_contact) + GRAINS;
    let solids = || paired_bodies.iter().flat_map(|&body| &scene.body(body).solids);
    let parts = solids().flat_map(|solid| &solid.parts);
    let facets = parts.map(|part| part.surface.facet_count()).max().unwrap_or(0);
    let fields = solids().flat_map(|solid| &solid.fields);
    // Each edge of a field can get a wall of its own.
    let faces = fields
        .map(|field| field.faces.len() + field.walls.len() + field.edges.len())
        .max()
        .map_or(0, |most| most + 1);
    // The walls of a region are cut like faces, and a side has a face for each region of its part.
    let regions = solids().flat_map(|solid| &solid.facets).map(|facet| facet.walls.len() + 2).max();
    let in_parts = solids().flat_map(|solid| &solid.parts).map(|part| part.facets.len()).max();
    let faces = faces.max(regions.unwrap_or(0)).max(in_parts.unwrap_or(0));
    Limits { thread_contacts, found, tree_parts, arena_bytes, scratch_bytes, facets, faces }
}

/// Copies of a worker's contacts: in its own buffer and, swapped in, in the frame.
const BUFFERS_OF_A_WORKER: usize = 2;

/// Least memory of a thread for contacts and candidates, bytes.
pub(super) fn least_thread_bytes(limits: &Limits, law_state_len: usize) -> usize {
    BUFFERS_OF_A_WORKER * limits.least_worker_contacts() * buffer_bytes_per_contact(law_state_len)
        + WorkerContext::table_bytes(limits.found)
}

/// Size of a contact in a thread's buffer, bytes: the contact, its reference and its friction-law state.
fn buffer_bytes_per_contact(law_state_len: usize) -> usize {
    size_of::<FrameContact>() + size_of::<ContactRef>() + law_state_len * size_of::<f64>()
}

/// Maximum memory for contacts; a request for more is probably a typing error. WebAssembly can address 4 GiB.
const ROOM_BYTES_MAX: usize = if usize::BITS > 32 { 8 << 30 } else { 1 << 30 };

/// Every contact of a thread's buffer has an index that fits into a [`Slot`]. The buffer holds an eighth more
/// contacts than there are records, and each record takes the memory of at least one contact and two records
/// (committed and next).
const _: () = {
    let records = ROOM_BYTES_MAX / (size_of::<FrameContact>() + 2 * Records::BYTES);
    assert!(records / 8 * 9 < Slot::INDICES);
};

/// Cause of the refusal if a capacity needs more memory than [`ROOM_BYTES_MAX`]; otherwise `None`.
pub(super) fn too_large(scene: &Scene, wanted: usize, law_state_len: usize) -> Option<String> {
    let threads = scene.config.workers.as_ref().map_or(0, |settings| settings.workers.min(MAX_WORKERS) + 1);
    let each = bytes_per_contact(scene, threads, law_state_len);
    let most = ROOM_BYTES_MAX / each;
    (wanted > most).then(|| {
        let gib = wanted as f64 * each as f64 / (1 << 30) as f64;
        format!(
            "contact capacity: room for {wanted} contacts takes {gib:.1} GiB, {each} bytes each; give at most {most} \
             ({} GiB), or leave it out",
            ROOM_BYTES_MAX >> 30
        )
    })
}

/// Memory per contact of the capacity in all buffers, bytes; `threads` is the number of threads including the
/// caller, or 0 without workers.
pub(super) fn bytes_per_contact(scene: &Scene, threads: usize, law_state_len: usize) -> usize {
    /// Equal capacities for contacts that push and for those only remembered.
    const RECORDS: usize = 2;
    let numbers = law_state_len * size_of::<f64>();
    // The committed contact state, the next one, and one that a stuck worker may still read.
    let states = if threads > 0 { 3 } else { 2 };
    let energies = ContactEnergies::bytes_each(scene.config.accounts);
    let records = states * (Records::BYTES + numbers + energies) + energies + energies / 8;
    let buffer = buffer_bytes_per_contact(law_state_len);
    // Rank by depth, reference in summation order, and the scratch for rays and ledger.
    let caller_only =
        size_of::<u32>() + size_of::<ContactRef>() + size_of::<((usize, u32, usize, usize), f64)>();
    // Buffers hold an eighth more contacts than there are records.
    let caller = buffer + caller_only;
    let caller = caller + caller / 8 + WorkerContext::BYTES_PER_FOUND;
    // The buffers of all workers together hold twice the contacts of the caller's.
    let workers = match threads {
        0 => 0,
        _ => 2 * BUFFERS_OF_A_WORKER * (buffer + buffer / 8) + (threads - 1) * WorkerContext::BYTES_PER_FOUND,
    };
    RECORDS * (records + caller + workers)
}
