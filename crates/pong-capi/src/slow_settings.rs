//! Settings of a slow host.

use crate::failure::{Failure, Outcome};
use crate::status::pong_status;
use pong_slow::Settings;

/// Settings of a slow host. Make it with pong_default_slow_settings() and change what you like.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_slow_settings {
    /// Position rule theta of the host, a fraction of 0 to 1: x1 = x0 + T v0 + theta T^2 a. 1 (default) for
    /// semi-implicit Euler, 0.5 for Runge-Kutta with the wrench held, 0 for explicit Euler.
    pub theta: f64,
    /// Substeps per radian of the fastest vibration on the contacts, 1/rad, 2 to 1e6; 12 by default.
    pub substeps_per_radian: f64,
    /// Largest number of substeps in a frame, at least 1; 20000 by default. It bounds the time of a frame: one that
    /// needs more has PONG_SLOW_SUBSTEP_LIMIT in its report.
    pub substeps_max: u32,
    /// Whole frames by which the host applies the wrench later than it could, at most 1024; 0 by default.
    pub delay_frames: u32,
    /// Zero.
    pub reserved: [u64; 4],
}

/// The default settings of a slow host.
#[unsafe(no_mangle)]
pub extern "C" fn pong_default_slow_settings() -> pong_slow_settings {
    let Settings { theta, substeps_per_radian, substeps_max, delay_frames } = Settings::default();
    pong_slow_settings { theta, substeps_per_radian, substeps_max, delay_frames, reserved: [0; 4] }
}

impl pong_slow_settings {
    /// The settings of the crate, which checks the numbers.
    pub(crate) fn settings(&self) -> Outcome<Settings> {
        if self.reserved != [0; 4] {
            let message =
                "settings: it has values in its reserved fields; start from pong_default_slow_settings()";
            return Err(Failure::new(pong_status::BadValue, message));
        }
        let Self { theta, substeps_per_radian, substeps_max, delay_frames, .. } = *self;
        Ok(Settings { theta, substeps_per_radian, substeps_max, delay_frames })
    }
}
