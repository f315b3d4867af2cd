//! Primitives of a model, and their storage in flat arrays.
//!
//! All geometry of one movable group is expressed in the frame of that group.

mod curved;
mod edge_blocks;
mod face_planes;
mod polyhedron;
mod polyhedron_parts;
mod round;
mod simple;
mod triangles;

pub use curved::{Ellipsoid, Sphere};
pub use edge_blocks::{EdgeBlock, EdgeBlocks, EightBoxes, VertexBlock};
pub use face_planes::{FacePlanes, PlaneBlock};
pub use polyhedron::{Containment, Polyhedron};
pub use polyhedron_parts::{
    EdgePush, PolyhedronEdge, PolyhedronFace, PolyhedronParts, PolyhedronVertex, RimEdge,
};
pub use round::{Bore, Capsule, Frustum};
pub use simple::{LineSegment, Plane, Point, Ray, RayResponse};
pub use triangles::{Lean, MayPush, NO_NEIGHBOR, TriangleRecord, TriangleSet};

use crate::Vec3;

/// Kind of a primitive. Its number enters the hash of models and never changes. The table of pairs says which
/// kind of a pair is A.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum PrimitiveKind {
    /// Vertex without extent.
    Point = 0,
    /// Line segment with two ends.
    LineSegment = 1,
    /// Plunger: origin, direction, length.
    Ray = 2,
    /// Ball.
    Sphere = 3,
    /// Ball scaled along three axes.
    Ellipsoid = 4,
    /// One-sided or two-sided facet.
    Triangle = 5,
    /// Convex solid bounded by planar faces.
    Polyhedron = 6,
    /// Half space.
    Plane = 7,
    /// Kind defined by the user (see [`CustomPrimitive`]).
    Custom = 8,
    /// All points within a radius of a segment.
    Capsule = 9,
    /// Straight round solid with flat ends.
    Cylinder = 10,
    /// Frustum of a cone.
    Cone = 11,
    /// Inner wall of a round hole.
    Bore = 12,
}

impl PrimitiveKind {
    /// All kinds, by number.
    pub const ALL: [Self; 13] = [
        Self::Point,
        Self::LineSegment,
        Self::Ray,
        Self::Sphere,
        Self::Ellipsoid,
        Self::Triangle,
        Self::Polyhedron,
        Self::Plane,
        Self::Custom,
        Self::Capsule,
        Self::Cylinder,
        Self::Cone,
        Self::Bore,
    ];

    /// Name of the kind in model files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "Point",
            Self::LineSegment => "LineSegment",
            Self::Ray => "Ray",
            Self::Sphere => "Sphere",
            Self::Ellipsoid => "Ellipsoid",
            Self::Triangle => "Triangle",
            Self::Polyhedron => "Polyhedron",
            Self::Plane => "Plane",
            Self::Custom => "Custom",
            Self::Capsule => "Capsule",
            Self::Cylinder => "Cylinder",
            Self::Cone => "Cone",
            Self::Bore => "Bore",
        }
    }
}

/// Primitive defined by a Rust user. Its testers are registered with the engine by kind name.
pub trait CustomPrimitive: std::fmt::Debug + Send + Sync + std::any::Any {
    /// The kind's name, as in the model file and in the registration of its testers.
    fn kind_name(&self) -> &str;

    /// Support function: the largest `direction · x` over the primitive, in the frame of its movable group, m.
    ///
    /// `direction` is a unit vector. Infinity makes the primitive unbounded. Bounding volumes are fitted from it.
    fn support(&self, direction: &Vec3) -> f64;

    /// The primitive as `Any`, so that a tester can get its own type back.
    fn as_any(&self) -> &dyn std::any::Any;
}
