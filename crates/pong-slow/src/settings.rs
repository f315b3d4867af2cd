//! Settings that hold for a whole run.

use crate::error::SlowError;

/// Settings of a [`SlowHost`](crate::SlowHost).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Position rule θ of the host, 0…1, dimensionless: x₁ = x₀ + T·v₀ + θ·T²·a. It is 1 for semi-implicit Euler, ½
    /// for Runge-Kutta with the wrench held or an exact motion under a held wrench, 0 for explicit Euler.
    pub theta: f64,
    /// Substeps per radian of the fastest contact vibration, 1/rad; at least 2. At 12 a rebound without
    /// damping is right to 1e-3, at 40 to 2e-4.
    pub substeps_per_radian: f64,
    /// Largest number of substeps in a frame, at least 1. A frame that needs more takes this many and says so
    /// ([`FrameStatus::substep_limit`](crate::FrameStatus)).
    pub substeps_max: u32,
    /// Number of whole frames by which the host applies the wrench later than it could, at most
    /// [`DELAY_FRAMES_MAX`](Self::DELAY_FRAMES_MAX).
    pub delay_frames: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { theta: 1.0, substeps_per_radian: 12.0, substeps_max: 20_000, delay_frames: 0 }
    }
}

impl Settings {
    /// Maximum delay, frames.
    pub const DELAY_FRAMES_MAX: u32 = 1024;

    /// Refuses settings outside their ranges.
    pub(crate) fn require_valid(&self) -> Result<(), SlowError> {
        let refused = |what: &str, cause: String| Err(SlowError::BadSetting { what: what.to_owned(), cause });
        if !(0.0..=1.0).contains(&self.theta) {
            let cause = format!(
                "it is {}; give 1 for semi-implicit Euler, 0.5 for Runge-Kutta, 0 for explicit Euler",
                self.theta
            );
            return refused("theta", cause);
        }
        if !(2.0..=1e6).contains(&self.substeps_per_radian) {
            return refused(
                "substeps_per_radian",
                format!("it is {}; give 2 to 1e6", self.substeps_per_radian),
            );
        }
        if self.substeps_max == 0 {
            return refused("substeps_max", "it is 0; give at least 1".to_owned());
        }
        if self.delay_frames > Self::DELAY_FRAMES_MAX {
            let cause = format!("it is {}; give at most {}", self.delay_frames, Self::DELAY_FRAMES_MAX);
            return refused("delay_frames", cause);
        }
        Ok(())
    }
}
