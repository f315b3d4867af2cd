//! Bounding volumes, and the trait of shapes around which they can be fitted.

use crate::{Mat3, Transform, Vec3};
use std::sync::Arc;

/// Kind of a bounding volume, as named in the model file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum BoundKind {
    /// Box along the axes of the group frame.
    Aabb,
    /// Sphere.
    Sphere,
    /// Oriented box.
    Obb,
    /// A kind registered in [`crate::extension::Extensions`], by name.
    Custom(String),
}

impl BoundKind {
    /// Returns the name of the kind, as in [`Volume::kind_name`]; for a custom kind, its own name.
    pub fn name(&self) -> &str {
        match self {
            Self::Aabb => "Aabb",
            Self::Sphere => "Sphere",
            Self::Obb => "Obb",
            Self::Custom(name) => name,
        }
    }
}

/// Bounding volume in the frame of its movable group.
#[derive(Clone, Debug)]
pub enum Volume {
    /// No bound, for example for a leaf with a plane.
    Unbounded,
    /// Box along the frame's axes.
    Aabb {
        /// Centre, m.
        center: Vec3,
        /// Half extents, m.
        half: Vec3,
    },
    /// Sphere.
    Sphere {
        /// Centre, m.
        center: Vec3,
        /// Radius, m.
        radius: f64,
    },
    /// Oriented box.
    Obb {
        /// Centre, m.
        center: Vec3,
        /// Columns are the axes of the box.
        axes: Mat3,
        /// Half extents along them, m.
        half: Vec3,
    },
    /// Volume of a registered kind.
    Custom(Arc<dyn CustomVolume>),
}

impl Volume {
    /// Returns the name of the kind; for a custom kind, its own name.
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

/// Bounding volume defined by a Rust user.
pub trait CustomVolume: std::fmt::Debug + Send + Sync + std::any::Any {
    /// Returns the kind's name, as in the model file and in the registration of its pair tests.
    fn kind_name(&self) -> &str;
    /// Returns the volume as `Any`, so that a pair test can get its own type back.
    fn as_any(&self) -> &dyn std::any::Any;
    /// Returns the support as [`Bounded::support`] does, to fit a parent volume around this one. The default
    /// makes every parent unbounded, which is correct but slow.
    fn support(&self, _direction: &Vec3) -> f64 {
        f64::INFINITY
    }
}

/// Shape around which a bounding volume can be fitted.
pub trait Bounded {
    /// Returns the maximum of `direction · x` over the shape for a unit direction, m (support function). It
    /// is infinite if the shape is unbounded.
    fn support(&self, direction: &Vec3) -> f64;
    /// Returns an upper bound of the distance from `from` to the farthest point of the shape, m.
    fn farthest(&self, from: &Vec3) -> f64;
    /// Appends representative points of the shape, from which axes and centres are chosen. They need not
    /// bound the shape.
    fn representatives(&self, out: &mut Vec<Vec3>);
}

/// Transform from A's frame to B's frame in a pair test.
pub type FromAToB = Transform;
