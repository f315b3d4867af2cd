//! Read access to a simulation.

use super::Simulation;
use crate::body::{BodyId, Motion, RigidBody};
use crate::energy::Energy;
use crate::error::Result;
use crate::integrate::Integrator;
use crate::spring::Spring;
use crate::stability::group_mass;
use crate::state::FreeState;
use pong_advise::{ActingReport, GroupMass, StepPlan, StepReport, StepWarning};
use pong_engine::{InterfaceId, World};
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// Masses of bodies with an Interface and of those without.
type Masses = (Vec<(InterfaceId, GroupMass)>, Vec<(String, GroupMass)>);

impl Simulation {
    /// Time, s.
    pub fn time(&self) -> f64 {
        self.epoch + self.steps as f64 * self.step
    }

    /// The step, s.
    pub fn step_length(&self) -> f64 {
        self.step
    }

    /// The integrator.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// Warnings about contacts that gain energy at the step, each with the longest stable one
    /// ([`pong_advise::step_report`]). Contacts that cannot be judged are left out:
    /// [`StepWatch`](crate::StepWatch) judges them when they touch.
    pub fn step_warnings(&self) -> Vec<String> {
        let report = self.stability_report().unwrap_or_default();
        let of_steps = report.warnings.iter();
        let judged = of_steps.filter(|warning| !matches!(warning, StepWarning::NotJudged { .. }));
        judged.map(ToString::to_string).collect()
    }

    /// Warnings about contacts of the present instant that gain energy at the step, each judged at its
    /// present depth and normal force ([`pong_advise::pressed_report`]).
    pub fn pressed_warnings(&self) -> Vec<String> {
        let report = pong_advise::pressed_report(self.world(), &self.step_plan(), &self.group_masses());
        report.unwrap_or_default().warnings.iter().map(ToString::to_string).collect()
    }

    /// Notes about contacts that may gain energy at the step if they act together, with the longest step that
    /// is surely stable ([`pong_advise::step_report`]).
    pub fn step_notes(&self) -> Vec<String> {
        let report = self.stability_report().unwrap_or_default();
        report.notes.iter().map(ToString::to_string).collect()
    }

    /// Report of the step, judged by stability alone.
    fn stability_report(&self) -> Option<StepReport> {
        self.step_report(&StepPlan { accuracy: None, ..self.step_plan() }).ok()
    }

    /// Step and integrator as the step adviser takes them, and the initial closing speed of the scene. Every
    /// check of the step begins with this plan, so that all of them agree.
    pub fn step_plan(&self) -> StepPlan {
        let step = match self.integrator {
            Integrator::LongFrame { substeps_max, .. } => self.step / f64::from(substeps_max),
            _ => self.step,
        };
        let plan = StepPlan::new(step, self.integrator.coupling());
        StepPlan { closing_speed: self.closing_speed(), fall_speed: self.fall_speed(), ..plan }
    }

    /// Speed of a fall over the height of the scene, m/s: from the highest free body to the lowest body, by the origins
    /// of their group frames. `None` without gravity or height.
    fn fall_speed(&self) -> Option<f64> {
        let gravity = self.system.gravity;
        let height = |body: &RigidBody| -gravity.dot(&body.pose.position);
        let free = self.bodies().map(|(_, body)| body).filter(|body| matches!(body.motion, Motion::Free(_)));
        let highest = free.map(height).fold(f64::NEG_INFINITY, f64::max);
        let lowest = self.bodies().map(|(_, body)| height(body)).fold(f64::INFINITY, f64::min);
        // Heights are multiplied by the gravity: g·h = v²/2.
        let squared = 2.0 * (highest - lowest);
        (squared > 0.0 && squared.is_finite()).then(|| squared.max(f64::MIN_POSITIVE).sqrt())
    }

    /// The largest initial speed between any two bodies, m/s; `None` if nothing moves.
    pub fn closing_speed(&self) -> Option<f64> {
        let velocities: Vec<Vec3> = self.bodies().map(|(_, body)| body.twist.linear).collect();
        let apart = velocities.iter().flat_map(|a| velocities.iter().map(move |b| (a - b).norm()));
        apart.max_by(f64::total_cmp).filter(|speed| *speed > 0.0)
    }

    /// Report of the step for the present bodies.
    ///
    /// # Errors
    /// A world that cannot be sealed; a plan out of range.
    pub fn step_report(&self, plan: &StepPlan) -> Result<StepReport> {
        let (touching, others) = self.masses_on_springs();
        Ok(pong_advise::step_report_with(self.world(), plan, &touching, &others)?)
    }

    /// Report of the step for the contacts of the present instant, with the springs of the scene
    /// ([`pong_advise::acting_report`]).
    ///
    /// # Errors
    /// A world without a frame; a plan out of range.
    pub fn acting_report(&self, plan: &StepPlan) -> Result<ActingReport> {
        Ok(pong_advise::acting_report(self.world(), plan, &self.masses_on_springs().0)?)
    }

    /// Masses of bodies with an Interface, and of those that only springs act on.
    fn masses_on_springs(&self) -> Masses {
        let mut masses: Masses = (Vec::new(), Vec::new());
        for (body, mass) in self.system.bodies.iter().zip(self.system.masses_on_springs(self.integrator)) {
            match body.interface {
                Some(interface) => masses.0.push((interface, mass)),
                None => masses.1.push((body.name.clone(), mass)),
            }
        }
        masses
    }

    fn group_masses(&self) -> Vec<(InterfaceId, GroupMass)> {
        self.bodies().filter_map(|(_, body)| Some((body.interface?, group_mass(body)))).collect()
    }

    /// The world: contacts, wrenches and counts of the present instant.
    pub fn world(&self) -> &World {
        &self.system.world
    }

    /// Report of the last long frame ([`Integrator::LongFrame`]); `None` with other integrators and before the first
    /// frame.
    pub fn long_frame_report(&self) -> Option<&pong_slow::Report> {
        self.long_frames.host.as_ref().map(pong_slow::SlowHost::report)
    }

    /// The world, to clear contact history, switch pairs or change surfaces between steps. The present states
    /// are evaluated and committed again before the next step.
    pub fn world_mut(&mut self) -> &mut World {
        self.disturbed();
        &mut self.system.world
    }

    /// All bodies in the order in which they were added.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = (BodyId, &RigidBody)> {
        self.system.bodies.iter().enumerate().map(|(index, body)| (BodyId(index), body))
    }

    /// The springs in the order in which they were added.
    pub fn springs(&self) -> &[Spring] {
        &self.system.springs
    }

    /// Uniform gravity, m/s², along the common axes.
    pub fn gravity(&self) -> Vec3 {
        self.system.gravity
    }

    /// Pose of a body's group frame.
    pub fn pose(&self, body: BodyId) -> Pose {
        self.system.motions[body.index()].0
    }

    /// Twist of a body's group frame.
    pub fn twist(&self, body: BodyId) -> Twist {
        self.system.motions[body.index()].1
    }

    /// Contact wrench on a body about its group's origin, along the common axes.
    pub fn contact_wrench(&self, body: BodyId) -> Wrench {
        self.system.contact[body.index()]
    }

    /// Mass centre of a free body and its velocity, in the common frame.
    pub fn mass_center(&self, body: BodyId) -> Option<(Vec3, Vec3)> {
        self.free_state(body).map(|state| (state.position.value(), state.velocity.value()))
    }

    /// Angular momentum of a free body about its mass centre, along the common axes.
    pub fn angular_momentum(&self, body: BodyId) -> Option<Vec3> {
        self.free_state(body).map(|state| state.momentum)
    }

    /// Energies of the present instant.
    pub fn energy(&self) -> Energy {
        let mut energy = self.system.energy(&self.states);
        energy.spring_loss = self.spring_loss;
        energy.work_in = self.work_in;
        if let Some(work) = self.contact_work.filter(|_| self.world().scene().keeps_ledger()) {
            energy.contact_loss = -work - energy.contacts;
        }
        energy
    }

    fn free_state(&self, body: BodyId) -> Option<&FreeState> {
        let slot = self.system.free.iter().position(|(index, _)| *index == body.index())?;
        self.states.get(slot)
    }
}
