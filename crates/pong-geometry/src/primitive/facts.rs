//! Properties of one primitive: all that the engine and the viewers need of a kind, apart from contact tests.

use crate::bounding::Bounded;
use crate::{Mat3, Vec3};
use std::borrow::Cow;

/// Properties of a primitive, given in the frame of its movable group. Each kind implements this trait in its
/// own file.
pub trait Primitive: Bounded {
    /// Returns the point of A whose displacement deflects the bristle of a contact, m. It is the centre of a
    /// sphere or an ellipsoid, the point itself, an end of a segment or of a round part's axis, or the tip of
    /// a ray. `end` is the end in the contact's key.
    fn reference_point(&self, _end: u32) -> Cow<'_, Vec3> {
        Cow::Owned(Vec3::zeros())
    }

    /// Returns the points whose paths are followed to detect tunnelling, m.
    fn followed(&self) -> [Option<Vec3>; 3] {
        [None; 3]
    }

    /// Returns axis and radius of a primitive that can touch round solids, m; otherwise `None`. For a point,
    /// a ray or a sphere both ends of the axis coincide.
    fn core(&self) -> Option<([Vec3; 2], f64)> {
        None
    }

    /// Returns the least radius of a primitive that can touch triangles, m. A triangle for which the model
    /// gives no thickness takes this radius as its thickness.
    fn smallest_radius_m(&self) -> Option<f64> {
        None
    }

    /// Returns the least thickness of the primitive, m, where a path can pass through it; infinite if no path
    /// can.
    fn least_width_m(&self) -> f64 {
        f64::INFINITY
    }

    /// Returns the primitive as a round solid, if tunnelling through it is detected by the axis of the
    /// passing element.
    fn round(&self) -> Option<&dyn Round> {
        None
    }

    /// Returns the primitive as a curved surface, if tunnelling through it is detected by points of the
    /// passing element.
    fn curved(&self) -> Option<&dyn Curved> {
        None
    }

    /// Returns the sizes that a model limits, with their names, m.
    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// Returns the drawing of the primitive; `None` for a polyhedron, which is drawn face by face.
    fn drawing(&self) -> Option<Drawing>;
}

/// Distance of a segment from a round solid, with its direction.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// Distance, m; in overlap, minus the length of the minimum translation.
    pub distance: f64,
    /// Unit vector from the round solid to the segment; in overlap, the direction of the minimum translation.
    pub normal_b: Vec3,
}

/// Round solid that the axis of another element may sweep through (docs/theory.md, 2.9).
pub trait Round {
    /// Returns the gap between the solid and the segment `axis`, whose ends may coincide.
    fn gap(&self, axis: &[Vec3; 2]) -> Gap;

    /// Returns the least distance between two parallel planes that enclose the solid, m.
    fn width_m(&self) -> f64;
}

/// Curved surface that a point of another element may pass through (docs/theory.md, 2.9).
pub trait Curved {
    /// Returns the unit normal of the surface where a straight path enters it; `None` if the path does not
    /// pass through. `radius`, m, is that of the sphere whose centre takes the path; 0 for a point.
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
        /// Outline in a half plane that the axis bounds. Where the outline runs in the direction of the axis,
        /// the surface faces away from the axis; where it runs in the opposite direction, towards the axis.
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
        /// Angles of the two ends of the arc in quarter turns: 0 points away from the axis, 1 along it.
        quarters: [i32; 2],
    },
}

/// Returns a point of an axis: end 0, end 1, or for any other `end` the middle.
pub(super) fn on_axis([one, other]: &[Vec3; 2], end: u32) -> Cow<'_, Vec3> {
    match end {
        0 => Cow::Borrowed(one),
        1 => Cow::Borrowed(other),
        _ => Cow::Owned(0.5 * (one + other)),
    }
}

/// Returns the two ends and the middle of an axis.
pub(super) fn ends_and_middle([one, other]: &[Vec3; 2]) -> [Option<Vec3>; 3] {
    [Some(*one), Some(*other), Some(0.5 * (one + other))]
}

/// Returns the largest component of the vector between two points, m. It is at least 1/√3 of their distance,
/// and computed without squares, which may overflow.
pub(super) fn distance_m([one, other]: &[Vec3; 2]) -> f64 {
    (one - other).amax()
}

/// Returns the lowest and the highest corner of a box, given its centre and half sizes, m.
pub(super) fn box_around(center: &Vec3, half: Vec3) -> (Vec3, Vec3) {
    (center - half, center + half)
}
