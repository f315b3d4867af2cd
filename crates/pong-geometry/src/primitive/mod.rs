//! Kinds of primitives, and the flat arrays in which a model stores them.
//!
//! All geometry of one movable group is expressed in the frame of that group.

mod curved;
mod custom;
mod edge_blocks;
mod face_planes;
mod facts;
mod polyhedron;
mod polyhedron_parts;
mod round;
mod simple;
mod triangles;

pub use curved::{Ellipsoid, Sphere};
pub use custom::CustomPrimitive;
pub use edge_blocks::{EdgeBlock, EdgeBlocks, EightBoxes, VertexBlock};
pub use face_planes::{FacePlanes, PlaneBlock};
pub use facts::{Curved, Drawing, Gap, Primitive, Round, Stroke};
pub use polyhedron::{Containment, Polyhedron};
pub use polyhedron_parts::{
    EdgePush, PolyhedronEdge, PolyhedronFace, PolyhedronParts, PolyhedronVertex, RimEdge,
};
pub use round::{Bore, Capsule, Frustum};
pub use simple::{LineSegment, Plane, Point, Ray, RayResponse};
pub use triangles::{Lean, MayPush, NO_NEIGHBOR, TriangleRecord, TriangleSet};

/// Expands a macro with one row per kind of primitive: documentation, name, number, shape, and the movable
/// group's array for this shape. Triangles, which are parts of a mesh, and custom primitives are not in the
/// list: each user of this macro adds them.
///
/// For a new kind, add a row here, a shape with its [`Primitive`](crate::primitive::Primitive) in a file of
/// this folder, an array in the movable group, the fields in the reader of model files, and rows in the
/// engine's table of pairs.
#[macro_export]
macro_rules! for_each_kind {
    ($then:ident) => {
        $then! {
            /// Vertex without extent.
            Point = 0: $crate::primitive::Point, points;
            /// Line segment with two ends.
            LineSegment = 1: $crate::primitive::LineSegment, segments;
            /// Plunger: origin, direction, length.
            Ray = 2: $crate::primitive::Ray, rays;
            /// Ball.
            Sphere = 3: $crate::primitive::Sphere, spheres;
            /// Ball scaled along three axes.
            Ellipsoid = 4: $crate::primitive::Ellipsoid, ellipsoids;
            /// Convex solid bounded by planar faces.
            Polyhedron = 6: $crate::primitive::Polyhedron, polyhedra;
            /// Half space.
            Plane = 7: $crate::primitive::Plane, planes;
            /// All points within a radius of a segment.
            Capsule = 9: $crate::primitive::Capsule, capsules;
            /// Straight round solid with flat ends.
            Cylinder = 10: $crate::primitive::Frustum, frusta;
            /// Frustum of a cone.
            Cone = 11: $crate::primitive::Frustum, frusta;
            /// Inner wall of a round hole.
            Bore = 12: $crate::primitive::Bore, bores;
        }
    };
}

/// Expands a macro with one row per shape that can be A in the engine's tests: name, shape, array, kinds.
/// Each of these shapes has the methods `carried` (its copy in another frame) and `region` (a box around
/// everything that it can touch).
#[macro_export]
macro_rules! for_each_moving_shape {
    ($then:ident) => {
        $then! {
            Point: $crate::primitive::Point, points, Point;
            Segment: $crate::primitive::LineSegment, segments, LineSegment;
            Ray: $crate::primitive::Ray, rays, Ray;
            Sphere: $crate::primitive::Sphere, spheres, Sphere;
            Ellipsoid: $crate::primitive::Ellipsoid, ellipsoids, Ellipsoid;
            Capsule: $crate::primitive::Capsule, capsules, Capsule;
            Frustum: $crate::primitive::Frustum, frusta, Cylinder | Cone;
        }
    };
}

macro_rules! define_kinds {
    ($($(#[$doc:meta])+ $kind:ident = $number:literal: $shape:ty, $array:ident;)*) => {
        /// Kind of a primitive. Its number enters the hash of models and never changes. The engine's table of
        /// pairs defines which kind of a pair is A.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum PrimitiveKind {
            $($(#[$doc])+ $kind = $number,)*
            /// One-sided or two-sided triangle.
            Triangle = 5,
            /// Kind defined by the user (see [`CustomPrimitive`]).
            Custom = 8,
        }

        impl PrimitiveKind {
            /// All kinds, by number.
            pub const ALL: [Self; [$($number,)* 5, 8].len()] = {
                let mut all = [Self::Custom; [$($number,)* 5, 8].len()];
                $(all[$number] = Self::$kind;)*
                all[Self::Triangle as usize] = Self::Triangle;
                all
            };

            /// Name of the kind in model files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => stringify!($kind),)*
                    Self::Triangle => "Triangle",
                    Self::Custom => "Custom",
                }
            }
        }
    };
}

for_each_kind!(define_kinds);
