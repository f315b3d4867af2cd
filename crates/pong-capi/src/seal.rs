//! The end of set-up.

use crate::guard::{get, setting_up};
use crate::handle::pong_world;
use crate::names::{c_text, text_at};
use crate::pointers::Out;
use crate::status::pong_status;
use pong_advise::StepReport;
use pong_model::printable;
use std::ffi::c_char;

/// Result of sealing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_seal_report {
    /// Pairs of movable groups that will be tested.
    pub group_pairs: u64,
    /// Most contacts of a frame.
    pub contact_capacity: u64,
    /// Size of the largest contact state that can be saved, bytes.
    pub contact_state_size: u64,
    /// Number of warnings: see pong_seal_warning().
    pub warning_count: u64,
    /// Workers that were started, which may be fewer than the configuration asks for: see pong_get_worker().
    pub workers: u64,
    /// Number of notes: see pong_seal_note().
    pub note_count: u64,
    /// The longest step at which no contact by itself gains energy, s; infinite if nothing that yields can be touched, 0
    /// if no step is stable or none was planned (pong_plan_step()).
    pub stable_step: f64,
    /// The step up to which the scene is surely stable for any set of simultaneous contacts, s; infinite or 0
    /// as above.
    pub surely_stable_step: f64,
    /// Zero in this version.
    pub reserved: [u64; 4],
}

/// Ends set-up: checks that everything that may meet can be tested and combined, sizes and takes all memory of
/// the frames, and starts the workers. `report` may be NULL. PONG_STATUS_SEAL_FAILED,
/// PONG_STATUS_OUT_OF_MEMORY: the world is still in set-up, and the message lists every reason.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_seal(world: *mut pong_world, report: *mut pong_seal_report) -> pong_status {
    setting_up(world, |inner| {
        let out = Out::optional(report, "report")?;
        let sealed = inner.phase.seal()?;
        // Plan and masses were checked when they were set: this refuses nothing.
        let step = inner.advice.report(inner.phase.frames("plan the step")?)?;
        let of_step = step.iter().flat_map(|step| step.warnings.iter().map(ToString::to_string));
        let warnings = sealed.warnings.iter().map(ToString::to_string).chain(of_step);
        inner.seal_warnings = warnings.map(|warning| c_text(&printable(&warning))).collect();
        let of_step = step.iter().flat_map(|step| step.notes.iter().map(ToString::to_string));
        let notes = sealed.notes.iter().map(ToString::to_string).chain(of_step);
        inner.seal_notes = notes.map(|note| c_text(&printable(&note))).collect();
        inner.workers = sealed.workers.iter().map(Into::into).collect();
        inner.counters.contact_capacity = sealed.contact_capacity as u64;
        inner.states.reserve(inner.names.interface_count());
        inner.surface_motions.reserve(inner.names.interface_count());
        inner.pairs.reserve(inner.pair_count);
        out.set(pong_seal_report {
            group_pairs: sealed.group_pairs as u64,
            contact_capacity: sealed.contact_capacity as u64,
            contact_state_size: sealed.state_size as u64,
            warning_count: inner.seal_warnings.len() as u64,
            workers: sealed.workers.len() as u64,
            note_count: inner.seal_notes.len() as u64,
            stable_step: step.as_ref().map_or(0.0, StepReport::stable_step),
            surely_stable_step: step.as_ref().map_or(0.0, StepReport::surely_stable_step),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Returns a warning of the seal: a probable mistake in the set-up, or a contact that gains energy at the
/// planned step. `index` counts from 0. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_seal_warning(
    world: *const pong_world,
    index: usize,
    warning: *mut *const c_char,
) -> pong_status {
    get(world, (warning, "warning"), |inner| text_at("warning", &inner.seal_warnings, index))
}

/// Returns a note of the seal: something that may, but need not, go wrong at the planned step if enough
/// contacts act at once. `index` counts from 0. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_seal_note(
    world: *const pong_world,
    index: usize,
    note: *mut *const c_char,
) -> pong_status {
    get(world, (note, "note"), |inner| text_at("note", &inner.seal_notes, index))
}
