//! Bodies, and how their motion is determined.

use crate::mass::MassProperties;
use crate::path::Path;
use pong_engine::{InterfaceId, SurfaceMotion};
use pong_geometry::{Pose, Twist};

/// A body of one simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BodyId(pub(crate) usize);

impl BodyId {
    /// Index in the order in which the bodies were added.
    pub fn index(self) -> usize {
        self.0
    }
}

/// Law of a body's motion.
#[derive(Clone, Debug)]
pub enum Motion {
    /// Newton's and Euler's equations.
    Free(MassProperties),
    /// No motion.
    Fixed,
    /// Motion along a path, whatever the forces.
    Prescribed(Path),
}

/// A rigid body, often a movable group of an Object; several groups of one Object are several bodies.
#[derive(Clone, Debug)]
pub struct RigidBody {
    /// Name for messages and records.
    pub name: String,
    /// Law of its motion.
    pub motion: Motion,
    /// Initial pose of the group frame in the common frame. A prescribed body starts where its path does.
    pub pose: Pose,
    /// Initial velocity of the group's origin and angular velocity, along the common axes.
    pub twist: Twist,
    /// The Interface whose contact wrench acts on it; `None` for a body that touches nothing.
    pub interface: Option<InterfaceId>,
    /// Motion of its surface along itself: velocities that stay as they are, and the travels at time zero.
    pub surface: SurfaceMotion,
}

impl RigidBody {
    /// A body free to move, at rest at the common origin.
    pub fn free(name: &str, mass: MassProperties) -> Self {
        Self::with_motion(name, Motion::Free(mass))
    }

    /// A body that never moves, at the common origin.
    pub fn fixed(name: &str) -> Self {
        Self::with_motion(name, Motion::Fixed)
    }

    /// A body that follows a path.
    pub fn prescribed(name: &str, path: Path) -> Self {
        Self::with_motion(name, Motion::Prescribed(path))
    }

    fn with_motion(name: &str, motion: Motion) -> Self {
        let (pose, twist) = (Pose::identity(), Twist::zero());
        Self {
            name: name.to_owned(),
            motion,
            pose,
            twist,
            interface: None,
            surface: SurfaceMotion::default(),
        }
    }

    /// Returns this body with an initial pose.
    pub fn at(self, pose: Pose) -> Self {
        Self { pose, ..self }
    }

    /// Returns this body with an initial twist.
    pub fn moving(self, twist: Twist) -> Self {
        Self { twist, ..self }
    }

    /// Returns this body with the contact wrench of an Interface.
    pub fn touching(self, interface: InterfaceId) -> Self {
        Self { interface: Some(interface), ..self }
    }

    /// Returns this body with a surface that moves along itself, as of a belt or a turntable.
    pub fn with_surface(self, surface: SurfaceMotion) -> Self {
        Self { surface, ..self }
    }

    /// Mass properties of a free body.
    pub fn mass(&self) -> Option<&MassProperties> {
        match &self.motion {
            Motion::Free(mass) => Some(mass),
            _ => None,
        }
    }
}
