//! Long frames: the wrench of a frame follows the contacts in substeps on copies of the bodies (`pong-slow`,
//! docs/slow_hosts.md). The bodies move by semi-implicit Euler under that wrench, held, and all other loads.

use crate::body::{Motion, RigidBody};
use crate::error::{ExecutiveError, Result};
use crate::state::{FreeState, Inertia, Rates};
use crate::system::System;
use pong_engine::{InterfaceId, State, World};
use pong_geometry::{Pose, Twist, Wrench};
use pong_slow::{Dynamics, GroupInput, Settings, SlowError, SlowHost};

/// Copies of the bodies of a simulation with long frames.
#[derive(Default)]
pub(crate) struct LongFrames {
    /// The host of the copies; `None` until the next frame after a change of the world.
    pub host: Option<SlowHost>,
    /// Saved state of a late host before the present frame, with the impulses on their way; empty without a delay.
    before: Vec<u8>,
    rates: Vec<Rates>,
}

/// Settings of the copies.
pub(crate) fn settings(substeps_max: u32, delay_frames: u32) -> Settings {
    Settings { theta: 1.0, substeps_max, delay_frames, ..Settings::default() }
}

impl LongFrames {
    /// Takes another host, or none, and drops what was kept.
    pub fn begin_anew(&mut self, host: Option<SlowHost>) {
        self.host = host;
        self.before.clear();
    }

    /// Makes the host of the copies if there is none, with the contact state of the world. A late host goes on with the
    /// impulses that are on their way, as the bodies will feel them.
    pub fn prepare(&mut self, world: &World, settings: Settings) -> Result<()> {
        if self.host.is_none() {
            let mut host = SlowHost::new(world, settings).map_err(refused)?;
            // Bytes of a scene with other surfaces are refused; the queue then begins empty.
            if !self.before.is_empty() && host.restore_state(&self.before).is_err() {
                host = SlowHost::new(world, settings).map_err(refused)?;
            }
            self.host = Some(host);
        }
        Ok(())
    }

    /// Replaces the contact wrenches of the system, which has been placed at `time`, by those to hold over a frame.
    pub fn follow(
        &mut self,
        system: &mut System,
        states: &[FreeState],
        settings: Settings,
        (time, frame): (f64, f64),
    ) -> Result<()> {
        let none = vec![Wrench::zero(); system.bodies.len()];
        system.rates(time, states, &none, &mut self.rates);
        let inputs = inputs(system, states, &self.rates, (time, frame));
        self.prepare(&system.world, settings)?;
        let Self { host: Some(host), before, .. } = self else { return Ok(()) };
        if settings.delay_frames > 0 {
            *before = host.save_state();
        }
        host.step(frame, &inputs).map_err(refused)?;
        for (body, wrench) in system.bodies.iter().zip(&mut system.contact) {
            if let Some(interface) = body.interface {
                *wrench = host.wrench_common(interface).map_err(refused)?;
            }
        }
        Ok(())
    }
}

/// Error of the executive for one of a slow host.
pub(crate) fn refused(error: SlowError) -> ExecutiveError {
    match error {
        SlowError::Engine(error) => ExecutiveError::Engine(error),
        other => ExecutiveError::invalid("long frame", other.to_string(), "see docs/slow_hosts.md"),
    }
}

fn inputs(system: &System, states: &[FreeState], rates: &[Rates], times: (f64, f64)) -> Vec<GroupInput> {
    let mut inputs = Vec::with_capacity(system.bodies.len());
    for (index, body) in system.bodies.iter().enumerate() {
        let Some(interface) = body.interface else { continue };
        let free = system.free.iter().position(|(of, _)| *of == index);
        inputs.push(match free {
            Some(slot) => free_input(
                interface,
                &system.motions[index],
                (&system.free[slot].1, &states[slot], &rates[slot]),
            ),
            None => led_input(interface, body, &system.motions[index], times),
        });
    }
    inputs
}

fn free_input(
    interface: InterfaceId,
    (pose, twist): &(Pose, Twist),
    (inertia, state, rates): (&Inertia, &FreeState, &Rates),
) -> GroupInput {
    let back = pose.orientation.inverse();
    let gyroscopic = twist.angular.cross(&state.momentum);
    let turning = pose.orientation * (inertia.inverse * (back * (rates.moment - gyroscopic)));
    let tensor = &inertia.tensor;
    GroupInput {
        interface,
        state: State::from_motion(pose, twist),
        dynamics: Dynamics::Free {
            mass: inertia.mass,
            inertia: [0, 1, 2].map(|row| [0, 1, 2].map(|column| tensor[(row, column)])),
            mass_center: inertia.mass_center.into(),
        },
        linear_acceleration: rates.acceleration.into(),
        angular_acceleration: turning.into(),
    }
}

/// Input of a body that contact does not move, with the mean acceleration of its path over the frame.
fn led_input(
    interface: InterfaceId,
    body: &RigidBody,
    (pose, twist): &(Pose, Twist),
    (time, frame): (f64, f64),
) -> GroupInput {
    let end = match &body.motion {
        Motion::Prescribed(path) => path.at(time + frame).1,
        Motion::Free(_) | Motion::Fixed => *twist,
    };
    GroupInput {
        interface,
        state: State::from_motion(pose, twist),
        dynamics: Dynamics::Prescribed,
        linear_acceleration: ((end.linear - twist.linear) / frame).into(),
        angular_acceleration: ((end.angular - twist.angular) / frame).into(),
    }
}
