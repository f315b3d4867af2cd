//! Bodies and everything that acts on them, at one instant.

use crate::body::{Motion, RigidBody};
use crate::error::{ExecutiveError, Result};
use crate::load::Load;
use crate::spring::{Spring, SpringAction, SpringEnd};
use crate::state::{FreeState, Inertia, Rates};
use pong_engine::{FrictionPreload, InterfaceId, PairId, State, SurfaceMotion, World};
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// The ground as the end of a spring.
const GROUND: usize = usize::MAX;

pub(crate) struct System {
    pub world: World,
    pub bodies: Vec<RigidBody>,
    /// Acceleration by gravity in the common axes, m/s².
    pub gravity: Vec3,
    pub loads: Vec<Load>,
    pub springs: Vec<Spring>,
    /// The bodies that are free, in order, and their inertia.
    pub free: Vec<(usize, Inertia)>,
    /// Motion of every group frame at the instant last placed.
    pub motions: Vec<(Pose, Twist)>,
    /// Contact wrench on every body, about its group's origin along the common axes.
    pub contact: Vec<Wrench>,
    /// Wrench of the host on every body, beside loads and springs, likewise.
    pub external: Vec<Wrench>,
    /// Sum of loads, springs and the host's wrench on every body, likewise.
    applied: Vec<Wrench>,
    states_in: Vec<(InterfaceId, State)>,
    surfaces_in: Vec<(InterfaceId, SurfaceMotion)>,
}

impl System {
    pub fn new(world: World) -> Self {
        Self {
            world,
            bodies: Vec::new(),
            gravity: Vec3::zeros(),
            loads: Vec::new(),
            springs: Vec::new(),
            free: Vec::new(),
            motions: Vec::new(),
            contact: Vec::new(),
            external: Vec::new(),
            applied: Vec::new(),
            states_in: Vec::new(),
            surfaces_in: Vec::new(),
        }
    }

    /// Adds a checked body.
    pub fn push(&mut self, body: RigidBody, inertia: Option<Inertia>) {
        let index = self.bodies.len();
        if let Some(inertia) = inertia {
            self.free.push((index, inertia));
        }
        self.motions.push((body.pose, body.twist));
        self.contact.push(Wrench::zero());
        self.external.push(Wrench::zero());
        self.applied.push(Wrench::zero());
        self.bodies.push(body);
    }

    /// Sets every group frame from the states of the free bodies and the time.
    pub fn place(&mut self, time: f64, states: &[FreeState]) {
        for ((index, inertia), state) in self.free.iter().zip(states) {
            self.motions[*index] = state.motion(inertia);
        }
        for (body, motion) in self.bodies.iter().zip(&mut self.motions) {
            if let Motion::Prescribed(path) = &body.motion {
                *motion = path.at(time);
            }
        }
    }

    /// Sets the states of the world, evaluates it and reads the contact wrenches.
    pub fn touch(&mut self, time: f64) -> Result<()> {
        self.hand_in(time)?;
        self.world.evaluate()?;
        self.take_wrenches()
    }

    /// As [`touch`](Self::touch), and commits the states.
    pub fn touch_and_commit(&mut self, time: f64) -> Result<()> {
        self.hand_in(time)?;
        self.world.step()?;
        self.take_wrenches()
    }

    /// As [`touch_and_commit`](Self::touch_and_commit), without evaluating the states just touched again.
    pub fn commit(&mut self, time: f64) -> Result<()> {
        self.hand_in(time)?;
        self.world.commit()?;
        self.take_wrenches()
    }

    /// Commits the states with friction preloaded between two Objects; wrenches stay as they were.
    pub fn preload_friction(&mut self, time: f64, pair: PairId, preload: &FrictionPreload) -> Result<usize> {
        self.hand_in(time)?;
        Ok(self.world.preload_friction(pair, preload)?)
    }

    /// # Errors
    /// A motion that is not finite, or beyond the engine's limits; also within a step.
    fn hand_in(&mut self, time: f64) -> Result<()> {
        self.states_in.clear();
        for (body, (pose, twist)) in self.bodies.iter().zip(&self.motions) {
            let values = [pose.position, twist.linear, twist.angular, pose.orientation.imag()];
            if values.iter().flatten().any(|x| x.is_nan() || x.abs() > State::LARGEST) {
                return Err(ExecutiveError::no_longer_finite(&body.name, time));
            }
            if let Some(interface) = body.interface {
                self.states_in.push((interface, State::from_motion(pose, twist)));
            }
        }
        self.world.set_states(&self.states_in)?;
        self.hand_in_surfaces(time)
    }

    /// Sets the motions of the surfaces that move along themselves.
    fn hand_in_surfaces(&mut self, time: f64) -> Result<()> {
        self.surfaces_in.clear();
        for body in self.bodies.iter().filter(|body| body.surface != SurfaceMotion::default()) {
            if let Some(interface) = body.interface {
                let mut motion = body.surface;
                motion.advance(time);
                self.surfaces_in.push((interface, motion));
            }
        }
        Ok(self.world.set_surface_motions(&self.surfaces_in)?)
    }

    fn take_wrenches(&mut self) -> Result<()> {
        for (body, wrench) in self.bodies.iter().zip(&mut self.contact) {
            if let Some(interface) = body.interface {
                *wrench = self.world.wrench_common(interface)?;
            }
        }
        Ok(())
    }

    /// Derivatives of the free bodies, which must have been placed, under a contact wrench for every body.
    pub fn rates(&mut self, time: f64, states: &[FreeState], contact: &[Wrench], out: &mut Vec<Rates>) {
        self.apply(time);
        out.clear();
        for ((index, inertia), state) in self.free.iter().zip(states) {
            let mut wrench = contact[*index];
            wrench += self.applied[*index];
            out.push(state.rates(inertia, &wrench, &self.gravity));
        }
    }

    /// Force of loads, springs and the host on a body at the instant last placed, N.
    pub fn applied_force(&self, time: f64, body: usize) -> Vec3 {
        let mut force = self.external[body].force;
        for load in self.loads.iter().filter(|load| load.body.index() == body) {
            force += load.wrench(time, &self.motions[body].0).force;
        }
        for spring in &self.springs {
            let action = self.spring_action(spring);
            for (end, wrench) in [(spring.first, action.on_first), (spring.second, action.on_second)] {
                if end.body.is_some_and(|end| end.index() == body) {
                    force += wrench.force;
                }
            }
        }
        force
    }

    /// Sums loads, springs and the host's wrenches.
    fn apply(&mut self, time: f64) {
        self.applied.copy_from_slice(&self.external);
        for load in &self.loads {
            let index = load.body.index();
            self.applied[index] += load.wrench(time, &self.motions[index].0);
        }
        for spring in &self.springs {
            let action = self.spring_action(spring);
            for (end, wrench) in [(spring.first, action.on_first), (spring.second, action.on_second)] {
                if let Some(body) = end.body {
                    self.applied[body.index()] += wrench;
                }
            }
        }
    }

    pub fn spring_action(&self, spring: &Spring) -> SpringAction {
        spring.act(&self.motion_of(&spring.first), &self.motion_of(&spring.second))
    }

    /// Angle of a spring's deviation from rest, rad.
    pub fn spring_angle(&self, spring: &Spring) -> f64 {
        spring.angle(&self.motion_of(&spring.first), &self.motion_of(&spring.second))
    }

    pub fn motion_of(&self, end: &SpringEnd) -> (Pose, Twist) {
        let ground = (Pose::identity(), Twist::zero());
        let index = end.body.map_or(GROUND, |body| body.index());
        *self.motions.get(index).unwrap_or(&ground)
    }
}
