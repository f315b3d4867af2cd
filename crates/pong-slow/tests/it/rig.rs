//! A host that calls once in a long frame, with free bodies.

use nalgebra::{UnitQuaternion, Vector3};
use pong_engine::WorldBuilder;
use pong_engine::{Config, InterfaceId, State, World};
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_model::Extensions;
use pong_slow::{Dynamics, GroupInput, Report, Settings, SlowHost};
use std::collections::VecDeque;
use std::sync::Arc;

/// A body of the host; its mass centre is the group's origin.
#[derive(Clone, Debug)]
pub struct Body {
    /// kg; infinite for a body that contact does not move.
    pub mass: f64,
    /// Principal moments along the group's axes, kg·m².
    pub moments: Vec3,
    pub position: Vec3,
    pub orientation: Quat,
    pub velocity: Vec3,
    pub turning: Vec3,
    /// Acceleration without contact.
    pub gravity: Vec3,
}

impl Body {
    pub fn fixed() -> Self {
        Self::ball(f64::INFINITY, 1.0, Vec3::zeros(), Vec3::zeros())
    }

    pub fn ball(mass: f64, radius: f64, position: Vec3, velocity: Vec3) -> Self {
        Self {
            mass,
            moments: Vec3::repeat(0.4 * mass * radius * radius),
            position,
            orientation: Quat::identity(),
            velocity,
            turning: Vec3::zeros(),
            gravity: Vec3::zeros(),
        }
    }

    pub fn moves(&self) -> bool {
        self.mass.is_finite()
    }

    pub fn state(&self) -> State {
        let pose = Pose { position: self.position, orientation: self.orientation };
        State::from_motion(&pose, &Twist { linear: self.velocity, angular: self.turning })
    }

    pub fn kinetic(&self) -> f64 {
        if !self.moves() {
            return 0.0;
        }
        let turning = self.orientation.inverse() * self.turning;
        0.5 * self.mass * self.velocity.norm_squared()
            + 0.5 * self.moments.component_mul(&turning).dot(&turning)
    }
}

/// A host.
pub struct Rig {
    pub slow: SlowHost,
    pub interfaces: Vec<InterfaceId>,
    pub bodies: Vec<Body>,
    pub theta: f64,
    pub frame: f64,
    /// Masses given, over the true ones.
    pub told: f64,
    /// Impulses that wait, for a host that is late.
    pub waiting: VecDeque<Vec<(Vec3, Vec3)>>,
    pub late: usize,
    pub gravity_told: bool,
}

/// A sealed world of Objects `o0`, `o1`, …, each paired with each other, and their roots.
pub fn all_paired(config: Config, models: &[&str]) -> (World, Vec<InterfaceId>) {
    let mut builder = WorldBuilder::new(config);
    let mut objects = Vec::new();
    for (i, text) in models.iter().enumerate() {
        let model = pong_model::parse(text, "test.ron", None, &Extensions::new());
        let model = builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}\n{text}"))));
        let object = builder.create_object(model, &format!("o{i}")).unwrap();
        for other in &objects {
            builder.pair(*other, object).unwrap();
        }
        objects.push(object);
    }
    let roots = objects.iter().map(|object| builder.scene().interface(*object, "").unwrap()).collect();
    let (world, _) = builder.seal().unwrap_or_else(|error| panic!("{error}"));
    (world, roots)
}

pub fn settings(theta: f64, per_radian: f64) -> Settings {
    Settings { theta, substeps_per_radian: per_radian, ..Settings::default() }
}

impl Rig {
    pub fn new(models: &[&str], bodies: Vec<Body>, settings: Settings, frame: f64) -> Self {
        let (world, interfaces) = all_paired(Config::default(), models);
        Self::of(&world, interfaces, bodies, settings, frame)
    }

    pub fn of(
        world: &World,
        interfaces: Vec<InterfaceId>,
        bodies: Vec<Body>,
        settings: Settings,
        frame: f64,
    ) -> Self {
        let slow = SlowHost::new(world, settings).unwrap();
        let (theta, late) = (settings.theta, settings.delay_frames as usize);
        let waiting = Default::default();
        Self { slow, interfaces, bodies, theta, frame, told: 1.0, waiting, late, gravity_told: true }
    }

    pub fn inputs(&self) -> Vec<GroupInput> {
        let input = |(interface, body): (&InterfaceId, &Body)| GroupInput {
            interface: *interface,
            state: body.state(),
            dynamics: if body.moves() {
                let inertia = nalgebra::Matrix3::from_diagonal(&(body.moments * self.told));
                Dynamics::Free {
                    mass: body.mass * self.told,
                    inertia: [0, 1, 2].map(|i| [0, 1, 2].map(|j| inertia[(i, j)])),
                    mass_center: [0.0; 3],
                }
            } else {
                Dynamics::Prescribed
            },
            linear_acceleration: if self.gravity_told { body.gravity.into() } else { [0.0; 3] },
            angular_acceleration: [0.0; 3],
        };
        self.interfaces.iter().zip(&self.bodies).map(input).collect()
    }

    /// A frame; returns the report.
    pub fn step(&mut self) -> Report {
        let report = self.slow.step(self.frame, &self.inputs()).unwrap().clone();
        let fresh: Vec<(Vec3, Vec3)> = self
            .interfaces
            .iter()
            .map(|interface| {
                let wrench = self.slow.wrench_common(*interface).unwrap();
                (wrench.force, wrench.moment)
            })
            .collect();
        self.waiting.push_back(fresh);
        if self.waiting.len() > self.late {
            let held = self.waiting.pop_front().unwrap();
            self.hold(&held);
        } else {
            self.hold(&vec![(Vec3::zeros(), Vec3::zeros()); self.bodies.len()]);
        }
        report
    }

    /// A frame with the wrenches of a world at the present states, held.
    pub fn step_plainly(&mut self, world: &mut World) {
        for (interface, body) in self.interfaces.iter().zip(&self.bodies) {
            world.set_state(*interface, &body.state()).unwrap();
        }
        world.step().unwrap();
        let wrench = |interface: &InterfaceId| world.wrench_common(*interface).unwrap();
        let held: Vec<_> = self.interfaces.iter().map(|id| (wrench(id).force, wrench(id).moment)).collect();
        self.hold(&held);
    }

    /// Moves all bodies without forces for a time, s.
    pub fn fly(&mut self, time: f64) {
        for body in &mut self.bodies {
            body.position += body.velocity * time;
            body.orientation = UnitQuaternion::from_scaled_axis(body.turning * time) * body.orientation;
        }
    }

    fn hold(&mut self, wrenches: &[(Vec3, Vec3)]) {
        let (h, theta) = (self.frame, self.theta);
        for (body, (force, moment)) in self.bodies.iter_mut().zip(wrenches) {
            if !body.moves() {
                continue;
            }
            let a = body.gravity + force / body.mass;
            let local = body.orientation.inverse() * moment;
            let alpha = body.orientation * local.component_div(&body.moments);
            body.position += body.velocity * h + a * (theta * h * h);
            let by = body.turning * h + alpha * (theta * h * h);
            body.orientation = UnitQuaternion::from_scaled_axis(by) * body.orientation;
            body.velocity += a * h;
            body.turning += alpha * h;
        }
    }

    pub fn kinetic(&self) -> f64 {
        self.bodies.iter().map(Body::kinetic).sum()
    }

    /// Leading position of a body.
    pub fn leading(&self, body: usize) -> Vec3 {
        let body = &self.bodies[body];
        body.position + body.velocity * ((1.0 - self.theta) * self.frame)
    }

    pub fn momentum(&self) -> Vector3<f64> {
        self.bodies.iter().filter(|body| body.moves()).map(|body| body.velocity * body.mass).sum()
    }
}
