//! Layout of every struct, as data: hashed for `pong_check_abi`, compared with the layout that C compilers
//! give.

use crate::accounts::{pong_energy_account, pong_pair_energy_account};
use crate::config::pong_config;
use crate::contacts::{pong_contact, pong_contact_side};
use crate::continuation::pong_continuation;
use crate::distance::pong_distance;
use crate::ids::{pong_interface_id, pong_model_id, pong_object_id, pong_pair_id};
use crate::law_types::{pong_friction_input, pong_friction_output, pong_normal_input};
use crate::log::{pong_log_options, pong_log_report};
use crate::pair_monitor::{pong_contact_change, pong_pair_peaks};
use crate::report::{pong_ledger, pong_report};
use crate::seal::pong_seal_report;
use crate::slopes::{pong_potential, pong_surface_slope};
use crate::slow_input::{pong_slow_coupling, pong_slow_input};
use crate::slow_report::{pong_slow_difference, pong_slow_report};
use crate::slow_settings::pong_slow_settings;
use crate::states::pong_state;
use crate::status::pong_status;
use crate::step_plan::{pong_joints, pong_mass, pong_step_check, pong_step_plan};
use crate::surface_motions::pong_surface_motion;
use crate::surfaces::{pong_surface_more, pong_surface_values};
use crate::tally::pong_tally;
use crate::tangents::{pong_contact_tangent, pong_tangent};
use crate::worker::pong_worker;
use crate::wrenches::pong_wrench;
use pong_model::Fnv;
use std::mem::offset_of;
use strum::VariantArray;

/// Layout of one struct.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StructLayout {
    /// Name in C.
    pub name: &'static str,
    /// `sizeof`.
    pub size: usize,
    /// `_Alignof`.
    pub align: usize,
    /// Name and `offsetof` of every field.
    pub fields: &'static [(&'static str, usize)],
}

macro_rules! layouts {
    ($($name:ident { $($field:ident),* $(,)? })*) => {
        /// Every struct of pong.h.
        pub const LAYOUTS: &[StructLayout] = &[$(StructLayout {
            name: stringify!($name),
            size: size_of::<$name>(),
            align: align_of::<$name>(),
            fields: &[$((stringify!($field), offset_of!($name, $field))),*],
        }),*];

        // Does not compile if a field is missing above.
        $(const _: fn($name) = |whole| { let $name { $($field: _),* } = whole; };)*
    };
}

layouts! {
    pong_config {
        struct_size, abi_version, cookie, contact_capacity, keep_ledger, report_times, workers, oversubscribe, spin_us,
        worker_timeout_us, pin_workers, fifo_priority, worker_cores, energy_accounts, delay_frames,
        reserved,
    }
    pong_model_id { bits }
    pong_object_id { bits }
    pong_pair_id { bits }
    pong_interface_id { bits }
    pong_normal_input { depth, depth_rate, stiffness, parameters, parameter_count }
    pong_friction_input {
        normal_force, normal_b, slip_b, slip_velocity_b, share, stiffness, parameters, parameter_count, stuck, reserved,
    }
    pong_friction_output { force_b, stored, sticks, reserved }
    pong_seal_report {
        group_pairs, contact_capacity, contact_state_size, warning_count, workers, note_count, stable_step,
        surely_stable_step, reserved,
    }
    pong_mass { mass, inertia, mass_center }
    pong_joints { inverse_inertia, spring_rate, damper_rate, mechanism, reserved }
    pong_step_check { contacts, not_judged, stable_step, stiffness_rate, damping_rate }
    pong_step_plan { step, wrench_coupling, delay_frames, closing_speed, depth_within, rebound_within, reserved }
    pong_state { position, orientation, linear_velocity, angular_velocity }
    pong_surface_motion {
        linear_velocity, angular_velocity, belt_velocity, linear_travel, angular_travel, belt_travel,
    }
    pong_wrench { force, moment }
    pong_distance { distance, points, primitives, elements }
    pong_contact_side { object, interface, primitive, element, arm }
    pong_contact {
        pair, a, b, feature_kind, feature_index, end, sticks, point, normal, depth, depth_rate, weight, normal_force,
        friction_force, force, slip_velocity, stored,
    }
    pong_tangent { interfaces, stiffness, damping }
    pong_potential { interfaces, energy, wrenches, stiffness }
    pong_surface_slope { interfaces, wrenches }
    pong_contact_tangent { normal_stiffness, normal_damping, tangential_stiffness, tangential_damping }
    pong_slow_settings { theta, substeps_per_radian, substeps_max, delay_frames, reserved }
    pong_slow_input {
        interface, state, dynamics, reserved, mass, mobility, linear_acceleration, angular_acceleration,
    }
    pong_slow_coupling { of, by, mobility }
    pong_slow_report {
        substeps, substeps_wanted, evaluations, warnings, flags, contacts, groups, reserved_flags, rate, theta_measured,
        inserted, reserved,
    }
    pong_slow_difference { interface, position, rotation, linear_velocity, angular_velocity, inserted }
    pong_contact_change { pair, interfaces, begins, reserved }
    pong_pair_peaks {
        pair, interfaces, peak_normal_force, mean, contact_time, window, begins, ends, touches, reserved,
    }
    pong_report {
        flags, contacts, contacts_wanted, peak_contacts_wanted, volumes_tested, leaf_pairs, boxes_tested,
        primitives_tested, evaluations, commits, evaluate_ns, commit_ns, stage_ns, work_ns, advised_capacity, contacts_peak,
        contacts_capacity, arena_peak, arena_capacity, scratch_peak, scratch_capacity, worker_timeouts, reserved,
    }
    pong_tally { what, tested, met, reserved, kind_a, kind_b }
    pong_worker { index, core_grant, core, fifo_grant, fifo_priority, blocks, busy_ns, work_ns }
    pong_log_options {
        struct_size, abi_version, cookie, name, step, buffer_bytes, flush_ms, when_full, overwrite, commits_per_frame,
        reserved,
    }
    pong_log_report {
        frames, flushed, lost, events_lost, bytes, buffer_peak, buffer_size, failed, reserved_flags, reserved,
    }
    pong_ledger { stored, work, dissipated }
    pong_energy_account {
        work_in, work_out, inserted, hold_error, stored, damping_loss, friction_loss, resolution, verdict, reserved,
    }
    pong_pair_energy_account {
        pair, interfaces, total, episode, in_contact, gains_energy, episodes, episodes_gained, episodes_unresolved, excess, worst_excess,
        stiffness, damping,
    }
    pong_continuation {
        objects, pairs, contacts, objects_left, pairs_left, contacts_left, energy_left, reserved,
    }
    pong_surface_values {
        normal_law, friction_law, stiffness, damping, ramp, dissipation, friction, friction_static_excess,
        friction_stiffness, friction_damping, friction_slip_speed,
    }
    pong_surface_more { foundation, area, rolling, spinning }
}

/// FNV-1a over names, sizes, offsets and status numbers.
pub fn layout_hash() -> u64 {
    let mut hash = Fnv::default();
    let text = |hash: &mut Fnv, text: &str| {
        hash.bytes(text.as_bytes());
        hash.bytes(&[0]);
    };
    for layout in LAYOUTS {
        text(&mut hash, layout.name);
        hash.word(layout.size as u64);
        hash.word(layout.align as u64);
        for (field, offset) in layout.fields {
            text(&mut hash, field);
            hash.word(*offset as u64);
        }
    }
    for status in pong_status::VARIANTS {
        text(&mut hash, &format!("{status:?}"));
        hash.word(*status as u64);
    }
    hash.value()
}
