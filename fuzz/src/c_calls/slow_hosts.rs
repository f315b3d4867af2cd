//! Slow hosts: made of a world, run for some frames, saved, restored and destroyed.

use super::frames::finite;
use super::session::{Session, Sure};
use super::set_up::COSTS_MAX;
use pong::slow_host::{
    pong_commit_slow, pong_create_slow_host, pong_destroy_slow_host, pong_evaluate_slow,
    pong_get_slow_differences, pong_get_slow_report, pong_get_slow_wrenches, pong_restore_slow_state,
    pong_save_slow_state, pong_set_slow_couplings, pong_slow_host, pong_slow_state_size, pong_step_slow,
};
use pong::slow_input::{PONG_DYNAMICS_FREE, PONG_DYNAMICS_JOINTED, pong_slow_coupling, pong_slow_input};
use pong::slow_report::{pong_slow_difference, pong_slow_report};
use pong::slow_settings::pong_default_slow_settings;
use pong::step_plan::pong_mass;
use pong::wrenches::{PONG_REFERENCE_FRAME_COMMON, pong_wrench};

impl Session<'_> {
    /// Makes a slow host of the world, takes some frames and destroys it.
    pub fn slow_host(&mut self) {
        let (world, known) = self.world();
        let (sealed, calls_back) =
            self.host().map_or((false, false), |host| (host.sealed, host.behaviour.calls_back()));
        // A law that calls its own world back would call the first one, which is not in a call.
        if calls_back || sealed && self.costs >= COSTS_MAX {
            return;
        }
        self.costs += u32::from(sealed);
        let mut settings = pong_default_slow_settings();
        settings.substeps_max = self.input.below(24) as u32;
        settings.theta = self.input.one_of(&[1.0, 0.5, 0.0]);
        settings.delay_frames = self.input.below(4) as u32;
        let mut fit = settings.substeps_max > 0;
        if self.input.chance(32) {
            (settings.theta, settings.substeps_per_radian) = (self.input.number(), self.input.number());
            fit &=
                (0.0..=1.0).contains(&settings.theta) && (2.0..=1e6).contains(&settings.substeps_per_radian);
        }
        let place = self.place();
        let sure = known.and(place.sure).only_if(sealed && fit);
        // SAFETY: here and below: living hosts and places, as the safety contract of all entries says.
        let made = self.call("make slow host", sure, || unsafe {
            pong_create_slow_host(world, &settings, place.pointer)
        });
        if !made {
            return;
        }
        let host: *mut pong_slow_host = place.get();
        for _ in 0..=self.input.below(4) {
            self.slow_frame(host);
        }
        self.slow_state(host);
        self.call("destroy slow host", Sure::Right, || unsafe { pong_destroy_slow_host(host) });
    }

    fn slow_frame(&mut self, host: *mut pong_slow_host) {
        let ids = self.host().map(|host| host.ids.interfaces.clone()).unwrap_or_default();
        let mut inputs = Vec::new();
        for interface in &ids {
            let kind = self.input.below(4) as u32;
            let [mass, moment, mobility] = [(); 3].map(|()| 0.1 + self.input.small(1.0).abs());
            let mut input = pong_slow_input {
                interface: *interface,
                state: self.near(),
                dynamics: kind.max(1),
                reserved: 0,
                mass: pong_mass {
                    mass,
                    inertia: [moment, moment, moment, 0.0, 0.0, 0.0],
                    mass_center: [0.1; 3],
                },
                mobility: [0.0; 36],
                linear_acceleration: [0.0, 0.0, self.input.small(10.0)],
                angular_acceleration: [0.0; 3],
            };
            input.mobility[14] = mobility;
            if self.input.chance(16) {
                match self.input.below(5) {
                    0 => input.mass.mass = self.input.number(),
                    1 => input.mass.inertia = [(); 6].map(|()| self.input.number()),
                    2 => input.mobility[self.input.below(36)] = self.input.number(),
                    3 => input.mass.mass_center[0] = self.input.number(),
                    _ => input.angular_acceleration[1] = self.input.number(),
                }
                input.dynamics = self.input.one_of(&[PONG_DYNAMICS_FREE, PONG_DYNAMICS_JOINTED, 0, 9]);
            }
            inputs.push(input);
        }
        self.slow_couplings(host, &ids);
        let count = inputs.len() - usize::from(!inputs.is_empty() && self.input.chance(8));
        let length = if self.input.chance(16) { self.input.number() } else { 0.05 };
        // Refused for numbers beyond what a frame can hold, and by laws.
        let sure = Sure::Unknown.only_if(length > 0.0 && length.is_finite() && count == inputs.len());
        let input = inputs.as_ptr();
        if self.input.chance(64) {
            self.call("step slow", sure, || unsafe { pong_step_slow(host, length, input, count) });
            return;
        }
        if self.call("evaluate slow", sure, || unsafe { pong_evaluate_slow(host, length, input, count) }) {
            self.slow_results(host, &ids);
            self.call("commit slow", Sure::Right, || unsafe { pong_commit_slow(host) });
        }
        // Without a frame, or twice.
        self.call("commit slow", Sure::Wrong, || unsafe { pong_commit_slow(host) });
    }

    fn slow_couplings(&mut self, host: *mut pong_slow_host, ids: &[pong::ids::pong_interface_id]) {
        if ids.is_empty() || !self.input.chance(4) {
            return;
        }
        let mut coupling = pong_slow_coupling {
            of: ids[self.input.below(ids.len())],
            by: ids[self.input.below(ids.len())],
            mobility: [0.0; 36],
        };
        coupling.mobility[14] =
            if self.input.chance(8) { self.input.number() } else { self.input.small(0.1) };
        // Refused of one group, and where not finite; here or at the frame.
        self.call("slow couplings", Sure::Unknown, || unsafe { pong_set_slow_couplings(host, &coupling, 1) });
    }

    fn slow_results(&mut self, host: *mut pong_slow_host, ids: &[pong::ids::pong_interface_id]) {
        let mut wrenches = Vec::<pong_wrench>::with_capacity(ids.len());
        if self.call("slow wrenches", Sure::Right, || unsafe {
            let (ids, frame) = (ids.as_ptr(), PONG_REFERENCE_FRAME_COMMON);
            pong_get_slow_wrenches(host, ids, frame, wrenches.as_mut_ptr(), wrenches.capacity())
        }) {
            // SAFETY: the call succeeded, so this many were written.
            unsafe { wrenches.set_len(ids.len()) };
            let numbers = wrenches.iter().flat_map(|wrench| wrench.force.iter().chain(&wrench.moment));
            finite(numbers, "wrenches of a slow host");
        }
        let place = self.place::<pong_slow_report>();
        if self.call("slow report", place.sure, || unsafe { pong_get_slow_report(host, place.pointer) }) {
            let report = place.get();
            assert!(report.substeps <= 24 && report.groups as usize == ids.len(), "{report:?}");
        }
        let (mut differences, mut count) = (Vec::<pong_slow_difference>::with_capacity(ids.len()), 0);
        let capacity = differences.capacity();
        if self.call("slow differences", Sure::Right, || unsafe {
            pong_get_slow_differences(host, differences.as_mut_ptr(), capacity, &mut count)
        }) {
            assert_eq!(count, ids.len());
        }
    }

    /// Saves the state, restores it, and restores it with a byte changed.
    fn slow_state(&mut self, host: *mut pong_slow_host) {
        let mut size = 0;
        if !self.call("slow state size", Sure::Right, || unsafe { pong_slow_state_size(host, &mut size) })
            || !self.may_copy(size)
        {
            return;
        }
        let mut state = vec![0_u8; size];
        let largest = size;
        let saved = self.call("save slow state", Sure::Right, || unsafe {
            pong_save_slow_state(host, state.as_mut_ptr().cast(), largest, &mut size)
        });
        if !saved {
            return;
        }
        self.call("restore slow state", Sure::Right, || unsafe {
            pong_restore_slow_state(host, state.as_ptr().cast(), size)
        });
        state[usize::from(self.input.byte()) % size] ^= 1;
        self.call("restore slow state", Sure::Wrong, || unsafe {
            pong_restore_slow_state(host, state.as_ptr().cast(), size)
        });
    }
}
