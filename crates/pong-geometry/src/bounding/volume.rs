//! What bounds, and what can be bounded.

use crate::{Mat3, Transform, Vec3};
use std::sync::Arc;

/// The kind of a bounding volume as the model file names it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum BoundKind {
    /// Box along the axes of the movable group's frame.
    Aabb,
    /// Ball.
    Sphere,
    /// Box along its own axes.
    Obb,
    /// A kind registered in [`crate::extension::Extensions`], by name.
    Custom(String),
}

impl BoundKind {
    /// The name, a custom kind's own name included: what [`Volume::kind_name`] gives for a bounded volume of
    /// this kind.
    pub fn name(&self) -> &str {
        match self {
            Self::Aabb => "Aabb",
            Self::Sphere => "Sphere",
            Self::Obb => "Obb",
            Self::Custom(name) => name,
        }
    }
}

/// A bounding volume in the frame of its movable group.
#[derive(Clone, Debug)]
pub enum Volume {
    /// Bounds nothing: a leaf that holds a plane.
    Unbounded,
    /// Box along the frame's axes.
    Aabb {
        /// Centre, m.
        center: Vec3,
        /// Half extents, m.
        half: Vec3,
    },
    /// Ball.
    Sphere {
        /// Centre, m.
        center: Vec3,
        /// Radius, m.
        radius: f64,
    },
    /// Box along its own axes.
    Obb {
        /// Centre, m.
        center: Vec3,
        /// Columns are the axes of the box.
        axes: Mat3,
        /// Half extents along them, m.
        half: Vec3,
    },
    /// A volume of a registered kind.
    Custom(Arc<dyn CustomVolume>),
}

impl Volume {
    /// The name of the kind, a custom kind's own name included.
    pub fn kind_name(&self) -> &str {
        match self {
            Self::Unbounded => "Unbounded",
            Self::Aabb { .. } => "Aabb",
            Self::Sphere { .. } => "Sphere",
            Self::Obb { .. } => "Obb",
            Self::Custom(custom) => custom.kind_name(),
        }
    }
}

/// A bounding volume added by a Rust user.
pub trait CustomVolume: std::fmt::Debug + Send + Sync + std::any::Any {
    /// The kind's name, as in the model file and in the registration of its pair tests.
    fn kind_name(&self) -> &str;
    /// The volume as `Any`, so that a pair test can get its own type back.
    fn as_any(&self) -> &dyn std::any::Any;
    /// Support function, as [`Bounded::support`]: a parent volume is fitted around this one with it. Without one
    /// every parent is unbounded, which is correct and slow.
    fn support(&self, _direction: &Vec3) -> f64 {
        f64::INFINITY
    }
}

/// Something a bounding volume can be fitted around.
pub trait Bounded {
    /// Support function: the largest `direction · x` over the thing for a unit direction, m; infinite if unbounded.
    fn support(&self, direction: &Vec3) -> f64;
    /// An upper bound of the distance from `from` to the farthest point of the thing, m.
    fn farthest(&self, from: &Vec3) -> f64;
    /// Points that represent the thing when axes and centres are chosen (they need not bound it).
    fn representatives(&self, out: &mut Vec<Vec3>);
}

/// Transform from A's frame to B's frame in a pair test.
pub type FromAToB = Transform;
