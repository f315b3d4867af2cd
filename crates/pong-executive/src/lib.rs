//! A small rigid-body executive: bodies, loads, springs and integrators around a contact [`World`].
//!
//! Limited to the dynamics that demonstrations and verification need; real multibody work belongs to the
//! host. It has no contact physics of its own: every contact wrench comes from the engine.
//!
//! ```
//! use pong_executive::{Integrator, MassProperties, RigidBody, Simulation, Vec3};
//! use pong_engine::{Config, WorldBuilder};
//!
//! # fn main() -> Result<(), pong_executive::ExecutiveError> {
//! let (world, _) = WorldBuilder::new(Config::default()).seal()?;
//! let mut simulation = Simulation::new(world, Integrator::RungeKutta4, 1e-3)?;
//! simulation.set_gravity(Vec3::new(0.0, 0.0, -9.81));
//! let ball = simulation.add_body(RigidBody::free("ball", MassProperties::sphere(1.0, 0.1)))?;
//! simulation.run_for(1.0)?;
//! assert!((simulation.pose(ball).position.z + 0.5 * 9.81).abs() < 1e-12);
//! # Ok(())
//! # }
//! ```
//!
//! # Conventions
//!
//! A body is a movable group. Its pose and twist are those of the group frame, relative to and expressed in the
//! common frame; its wrenches are about the group's origin along the axes of the common frame.
//!
//! Outside [`Simulation::step`] the world has always been evaluated *and committed* at the present states, so
//! that its contacts and wrenches belong to [`Simulation::time`].

#![forbid(unsafe_code)]

/// The example of the user's guide.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/users_guide.md")]
struct UsersGuide;

mod body;
mod energy;
mod energy_warnings;
mod error;
mod integrate;
mod left_out;
mod load;
mod mass;
mod math;
mod missed;
mod path;
pub mod scene;
mod simulation;
mod spring;
mod stability;
mod state;
mod statistics;
mod system;
mod watch;

pub use body::{BodyId, Motion, RigidBody};
pub use energy::Energy;
pub use error::{ExecutiveError, Result};
pub use integrate::Integrator;
pub use left_out::LeftOut;
pub use load::{Axes, Load, LoadHistory, LoadRow};
pub use mass::MassProperties;
pub use missed::{deep_in_mesh_in_words, tunnelling_in_words};
pub use path::{Oscillation, Path, PathRow, PathTable};
pub use pong_geometry::{Mat3, Pose, Quat, Twist, Vec3, Wrench};
pub use simulation::{Linearised, Observer, Simulation};
pub use spring::{Spring, SpringEnd};
pub use stability::{group_mass, longest_stable_step};
pub use statistics::{BodyStatistics, RunStatistics};
pub use watch::StepWatch;

#[doc(no_inline)]
pub use pong_engine::{World, WorldBuilder};
