//! A point mass dropped on a plane, and hosts with different integration schemes.

use super::{Rig, at, model, moving, surface};
use pong_engine::{Config, PairEnergyAccount, State, WrenchCoupling};
use pong_geometry::{Quat, Vec3};
use std::collections::VecDeque;

pub const G: f64 = 9.81;

/// A drop, and the way in which the host moves the mass.
#[derive(Clone, Copy, Debug)]
pub struct Drop {
    pub mass: f64,
    pub stiffness: f64,
    pub damping: f64,
    pub gravity: f64,
    /// Initial height above the plane, m, and upward velocity, m/s.
    pub start: [f64; 2],
    pub step: f64,
    pub coupling: WrenchCoupling,
}

/// Result of a drop.
#[derive(Debug)]
pub struct Landed {
    /// Kinetic plus potential energy at the beginning and at the end, J.
    pub before: f64,
    pub after: f64,
    /// True if the mass left the plane for good within the time.
    pub left: bool,
    pub least_normal_force: f64,
    pub account: PairEnergyAccount,
}

/// The mass between two commits.
struct Flight {
    rig: Rig,
    drop: Drop,
    least_normal_force: f64,
}

impl Flight {
    /// Force on the mass at a height and a velocity, N.
    fn force(&mut self, height: f64, velocity: f64) -> f64 {
        let state =
            moving(Vec3::new(0.0, 0.0, height), Quat::identity(), Vec3::z() * velocity, Vec3::zeros());
        self.rig.world.set_state(self.rig.interfaces[0], &state).unwrap();
        self.rig.world.evaluate().unwrap();
        for contact in self.rig.world.contacts_iter() {
            self.least_normal_force = self.least_normal_force.min(contact.normal_force);
        }
        self.rig.wrench(0).force.z
    }

    /// Commits a height and a velocity; returns the force, N.
    fn commit(&mut self, height: f64, velocity: f64) -> f64 {
        let force = self.force(height, velocity);
        self.rig.world.commit().unwrap();
        force
    }

    fn acceleration(&self, force: f64) -> f64 {
        force / self.drop.mass - self.drop.gravity
    }

    /// One step of the host, from a committed force.
    fn step(&mut self, [z, v]: [f64; 2], committed: f64, waiting: &mut VecDeque<f64>) -> [f64; 2] {
        let h = self.drop.step;
        match self.drop.coupling {
            WrenchCoupling::SemiImplicit => {
                let v = v + h * self.acceleration(committed);
                [z + h * v, v]
            }
            WrenchCoupling::ZeroOrderHold { delay_frames } => {
                waiting.push_back(committed);
                let held =
                    if waiting.len() > delay_frames as usize { waiting.pop_front().unwrap() } else { 0.0 };
                let a = self.acceleration(held);
                [z + h * (v + 0.5 * h * a), v + h * a]
            }
            WrenchCoupling::Stages => {
                let a1 = self.acceleration(committed);
                let v2 = v + 0.5 * h * a1;
                let force = self.force(z + 0.5 * h * v, v2);
                let a2 = self.acceleration(force);
                let v3 = v + 0.5 * h * a2;
                let force = self.force(z + 0.5 * h * v2, v3);
                let a3 = self.acceleration(force);
                let v4 = v + h * a3;
                let force = self.force(z + h * v3, v4);
                let a4 = self.acceleration(force);
                [z + h * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0, v + h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0]
            }
        }
    }
}

impl Drop {
    /// Invariant of free flight, J; for semi-implicit Euler the energy that the scheme conserves exactly.
    fn energy(&self, [z, v]: [f64; 2]) -> f64 {
        let z = match self.coupling {
            WrenchCoupling::SemiImplicit => z - 0.5 * self.step * v,
            _ => z,
        };
        self.mass * (0.5 * v * v + self.gravity * z)
    }

    /// Drops the mass until it has left the plane and no delayed force remains, for at most this many steps.
    pub fn run(&self, steps: usize) -> Landed {
        let law = surface(self.stiffness, &format!("normal: Linear(damping: {:?})", self.damping));
        let tip = model("tip", &law, "Point(name: \"p\", position: (0,0,0))");
        let rigid = "\"s\": (stiffness: inf)";
        let ground = model("ground", rigid, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
        let config = Config { accounts: Some(self.coupling), ..Config::default() };
        let mut flight = Flight {
            rig: Rig::with_config(config, &tip, &ground),
            drop: *self,
            least_normal_force: f64::INFINITY,
        };
        flight.rig.place([at(Vec3::z(), Quat::identity()), State::identity()]);
        let mut state = self.start;
        let mut force = flight.commit(state[0], state[1]);
        let mut waiting = VecDeque::new();
        let (before, mut left) = (self.energy(state), false);
        for _ in 0..steps {
            state = flight.step(state, force, &mut waiting);
            force = flight.commit(state[0], state[1]);
            let account = flight.rig.world.pair_accounts().next().unwrap();
            if account.episodes > 0 && !account.in_contact && state[1] > 0.0 {
                left = true;
                break;
            }
        }
        Landed {
            before,
            after: self.energy(state),
            left,
            least_normal_force: flight.least_normal_force,
            account: flight.rig.world.pair_accounts().next().unwrap(),
        }
    }
}
