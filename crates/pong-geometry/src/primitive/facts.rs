//! Facts of a primitive by itself: all that the engine and the viewers need of a kind, except its contact tests.

use crate::bounding::Bounded;
use crate::{Mat3, Vec3};
use std::borrow::Cow;

/// Primitive in the frame of its movable group. Each kind implements this in its own file.
pub trait Primitive: Bounded {
    /// Point of A whose displacement deflects the bristle of a contact, m: centre of a sphere or ellipsoid,
    /// the point itself, end of a segment or of a round part's axis, tip of a ray. `end` is that of the
    /// contact's key. Borrowed where possible.
    fn reference_point(&self, _end: u32) -> Cow<'_, Vec3> {
        Cow::Owned(Vec3::zeros())
    }

    /// Points whose paths are followed to detect tunnelling, m.
    fn followed(&self) -> [Option<Vec3>; 3] {
        [None; 3]
    }

    /// Axis and radius of a primitive that can touch round solids, m; both ends of the axis of a point-like
    /// primitive coincide.
    fn core(&self) -> Option<([Vec3; 2], f64)> {
        None
    }

    /// Least radius of a primitive that can touch triangles, m. A triangle without a thickness of its own
    /// takes it.
    fn smallest_radius_m(&self) -> Option<f64> {
        None
    }

    /// Least extent through which a path can pass, m; infinite if nothing can pass.
    fn least_width_m(&self) -> f64 {
        f64::INFINITY
    }

    /// The primitive as a round solid, if the axis of a passing element is followed.
    fn round(&self) -> Option<&dyn Round> {
        None
    }

    /// The primitive as a curved surface, if single points of a passing element are followed.
    fn curved(&self) -> Option<&dyn Curved> {
        None
    }

    /// Sizes that a model limits, with their names, m.
    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// Drawing of the primitive; `None` for a polyhedron, which is drawn face by face.
    fn drawing(&self) -> Option<Drawing>;
}

/// Distance between two bodies and its direction.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// Distance, m; in overlap, minus the length of the minimum translation.
    pub distance: f64,
    /// Unit vector from the round solid to the other body; in overlap, the direction of the minimum
    /// translation.
    pub normal_b: Vec3,
}

/// Round solid that the axis of another element may sweep through (docs/theory.md, 2.9).
pub trait Round {
    /// Gap to the axis between two points, which may coincide.
    fn gap(&self, axis: &[Vec3; 2]) -> Gap;

    /// Least distance between two parallel planes that enclose the solid, m.
    fn width_m(&self) -> f64;
}

/// Curved surface that a point of another element may pass through (docs/theory.md, 2.9).
pub trait Curved {
    /// Unit normal of the side by which a straight path passes through the surface, if it does. `radius` is
    /// that of the ball around the point that takes the path, m.
    fn passed(&self, from: &Vec3, to: &Vec3, radius: f64) -> Option<Vec3>;
}

/// Drawing of a primitive.
#[derive(Clone, Debug)]
pub enum Drawing {
    /// Dot, m.
    Point(Vec3),
    /// Line between two points, m.
    Segment([Vec3; 2]),
    /// Plunger from its origin to its tip, m.
    Ray([Vec3; 2]),
    /// Ball or ellipsoid.
    Ball {
        /// Centre, m.
        center: Vec3,
        /// Columns are the principal axes.
        axes: Mat3,
        /// Semi-axis along each column of `axes`, m.
        semi_axes: Vec3,
    },
    /// Half space.
    Plane {
        /// Unit outward normal.
        normal: Vec3,
        /// Distance of the plane from the group's origin along the normal, m.
        offset: f64,
    },
    /// Surface of revolution.
    Revolved {
        /// Point of the axis from which positions along it are measured, m.
        origin: Vec3,
        /// Unit vector along the axis.
        axis: Vec3,
        /// Outline in a half plane through the axis. The surface faces away from the axis where the outline
        /// runs along it, and towards the axis where it runs against it.
        outline: Vec<Stroke>,
    },
}

/// Part of the outline of a surface of revolution.
#[derive(Clone, Copy, Debug)]
pub enum Stroke {
    /// Corner.
    Corner {
        /// Position along the axis, m.
        along: f64,
        /// Distance from the axis, m.
        aside: f64,
    },
    /// Arc of a circle.
    Arc {
        /// Position of the centre along the axis, m.
        along: f64,
        /// Distance of the centre from the axis, m.
        aside: f64,
        /// Radius of the arc, m.
        radius: f64,
        /// Ends of the arc in quarters of a turn from the direction away from the axis, positive along it.
        quarters: [i32; 2],
    },
}

/// End of an axis, or its middle for a contact between the ends.
pub(super) fn on_axis([one, other]: &[Vec3; 2], end: u32) -> Cow<'_, Vec3> {
    match end {
        0 => Cow::Borrowed(one),
        1 => Cow::Borrowed(other),
        _ => Cow::Owned(0.5 * (one + other)),
    }
}

/// Ends and middle of an axis.
pub(super) fn ends_and_middle([one, other]: &[Vec3; 2]) -> [Option<Vec3>; 3] {
    [Some(*one), Some(*other), Some(0.5 * (one + other))]
}

/// Distance of two points by its largest component, which is smaller by √3 at most, m: squares might leave the
/// range of numbers.
pub(super) fn distance_m([one, other]: &[Vec3; 2]) -> f64 {
    (one - other).amax()
}

/// Box around a centre with half sizes, m.
pub(super) fn box_around(center: &Vec3, half: Vec3) -> (Vec3, Vec3) {
    (center - half, center + half)
}
