//! Primitives of A, transformed into B's frame.

use pong_geometry::primitive::{Point, PrimitiveKind};
use pong_geometry::{Transform, Vec3};
use pong_model::MovableGroup;

macro_rules! transformed {
    ($($name:ident: $shape:ty, $array:ident, $($kind:ident)|+;)*) => {
        /// A primitive of A in B's frame.
        #[derive(Clone, Copy, Debug)]
        pub(crate) enum TransformedPrimitive {
            $($name($shape),)*
        }

        impl TransformedPrimitive {
            /// Transforms an element; `None` for kinds that are never A in the tester table.
            #[inline(always)]
            pub fn new(
                body: &MovableGroup,
                kind: PrimitiveKind,
                element: u32,
                x_ba: &Transform,
            ) -> Option<Self> {
                match kind {
                    $($(PrimitiveKind::$kind)|+ => {
                        Some(Self::$name(body.$array[element as usize].carried(x_ba)))
                    })*
                    _ => None,
                }
            }

            /// Lowest and highest corner, along B's axes, of the box around everything that the primitive can
            /// touch, m. With `meets_triangles` the box of an ellipsoid may be larger than its bounding box,
            /// because triangles may push it at foot points outside.
            pub fn bounds(&self, meets_triangles: bool) -> (Vec3, Vec3) {
                match self {
                    $(Self::$name(shape) => shape.region(meets_triangles),)*
                }
            }
        }
    };
}

pong_geometry::for_each_moving_shape!(transformed);

impl TransformedPrimitive {
    /// Placeholder to fill memory.
    pub const NOTHING: Self = Self::Point(Point { position: Vec3::new(0.0, 0.0, 0.0) });
}
