//! Integrators: how a step uses the contact wrench.

mod euler;
mod hold;
mod long_frame;
mod runge_kutta;
mod stages;

pub(crate) use euler::euler;
pub(crate) use hold::{Held, hold};
pub(crate) use long_frame::{LongFrames, refused, settings as long_frame_settings};
pub(crate) use runge_kutta::{Contact, runge_kutta};
pub(crate) use stages::{Pushed, Stages};

use pong_engine::WrenchCoupling;
use serde::Deserialize;

/// Integrator of the motion of the free bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename = "IntegratorEntry")]
pub enum Integrator {
    /// Velocities from the loads at the start of the step, then positions from the new velocities. First
    /// order; one contact evaluation a step.
    SemiImplicitEuler,
    /// The classic fourth-order method; contact is evaluated at every stage and committed at the end of the step.
    RungeKutta4,
    /// A host that calls the contact engine once a frame (one frame = one step): the wrench of the frame's start
    /// acts, unchanged along the common axes about the group's origin, until the next. All other loads and the
    /// motion are integrated in between by Runge-Kutta.
    ZeroOrderHold {
        /// Runge-Kutta steps in a frame, at least 1. With no other loads than gravity one is exact in translation.
        #[serde(default = "one_substep")]
        substeps: u32,
        /// Delay of the wrench in whole frames.
        #[serde(default, alias = "delay")]
        delay_frames: u32,
    },
    /// A host that calls once in a long frame (one frame = one step): the wrench that it holds follows the contacts in
    /// substeps on copies of the bodies (docs/slow_hosts.md). Semi-implicit Euler under that wrench and all other loads.
    LongFrame {
        /// Largest number of substeps in a frame, at least 1.
        #[serde(default = "many_substeps")]
        substeps_max: u32,
        /// Delay of the wrench in whole frames, known to the copies.
        #[serde(default)]
        delay_frames: u32,
    },
}

fn many_substeps() -> u32 {
    pong_slow::Settings::default().substeps_max
}

fn one_substep() -> u32 {
    1
}

/// Name as in the scene format and in logs.
impl std::fmt::Display for Integrator {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::ZeroOrderHold { substeps, delay_frames } => {
                write!(out, "ZeroOrderHold(substeps: {substeps}, delay_frames: {delay_frames})")
            }
            Self::LongFrame { substeps_max, delay_frames } => {
                write!(out, "LongFrame(substeps_max: {substeps_max}, delay_frames: {delay_frames})")
            }
            Self::SemiImplicitEuler | Self::RungeKutta4 => write!(out, "{self:?}"),
        }
    }
}

impl Integrator {
    /// Coupling of the contact wrench to the integrator.
    pub fn coupling(self) -> WrenchCoupling {
        match self {
            // The contacts feel the substeps.
            Self::SemiImplicitEuler | Self::LongFrame { .. } => WrenchCoupling::SemiImplicit,
            Self::RungeKutta4 => WrenchCoupling::Stages,
            Self::ZeroOrderHold { delay_frames, .. } => WrenchCoupling::ZeroOrderHold { delay_frames },
        }
    }

    /// [`coupling`](Self::coupling), for a world that keeps accounts of the wrenches' work
    /// ([`Config::accounts`](pong_engine::Config)); `None` if their delay is longer than accounts allow, and for long
    /// frames, whose contacts act on copies.
    pub fn wrench_coupling(self) -> Option<WrenchCoupling> {
        let is_kept = |coupling: &WrenchCoupling| match *coupling {
            WrenchCoupling::ZeroOrderHold { delay_frames } => {
                delay_frames <= WrenchCoupling::DELAY_FRAMES_MAX
            }
            WrenchCoupling::Stages | WrenchCoupling::SemiImplicit => true,
        };
        let acts_on_copies = matches!(self, Self::LongFrame { .. });
        Some(self.coupling()).filter(is_kept).filter(|_| !acts_on_copies)
    }
}
