//! The primitives a model is built of, and how they sit in flat arrays.
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

/// The kind of a primitive. Its number is part of the hash of models and never changes; what is A of a pair of kinds stands in
/// the table of pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum PrimitiveKind {
    /// A vertex without extent.
    Point = 0,
    /// A straight piece of a line with two ends.
    LineSegment = 1,
    /// A plunger: origin, direction, length.
    Ray = 2,
    /// A ball.
    Sphere = 3,
    /// A ball stretched along three axes.
    Ellipsoid = 4,
    /// A one-sided or two-sided facet.
    Triangle = 5,
    /// A convex solid bounded by planar faces.
    Polyhedron = 6,
    /// A half space.
    Plane = 7,
    /// A kind added by the user (see [`CustomPrimitive`]).
    Custom = 8,
    /// Everything within a radius of a segment.
    Capsule = 9,
    /// A straight round solid with flat ends.
    Cylinder = 10,
    /// A frustum of a cone.
    Cone = 11,
    /// The inner wall of a round hole.
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

    /// The name as the model file spells it.
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

/// A primitive added by a Rust user. Its testers are registered with the engine by kind name.
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
