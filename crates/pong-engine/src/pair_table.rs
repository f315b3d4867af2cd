//! The tester table: which kinds of A meet which kinds of B. A blank is ignored, as the author may intend.
//!
//! ```text
//!  A \ B         Sphere  Ellipsoid  Triangle  Polyhedron  Plane
//!  Point           x         x                    x         x
//!  LineSegment                                    x         x
//!  Ray                                 x          x         x
//!  Sphere          x                   x          x         x
//!  Ellipsoid                           x          x         x
//! ```
//!
//! Point–Triangle is blank on purpose: no depth can be defined.

use pong_geometry::primitive::PrimitiveKind::{self, *};

/// Whether the engine tests primitives of kind `a` as A against primitives of kind `b` as B.
pub fn has_tester(a: PrimitiveKind, b: PrimitiveKind) -> bool {
    matches!(
        (a, b),
        (Point, Sphere | Ellipsoid | Polyhedron | Plane)
            | (LineSegment, Polyhedron | Plane)
            | (Ray, Triangle | Polyhedron | Plane)
            | (Sphere, Sphere | Triangle | Polyhedron | Plane)
            | (Ellipsoid, Triangle | Polyhedron | Plane)
    )
}
