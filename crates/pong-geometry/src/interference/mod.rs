//! Interference tests: one file per pair of primitives (the list of modules is the capability table).
//!
//! Every test takes A already transformed to the frame of B's movable group and returns [`Interference`]s in
//! that frame. No test allocates memory. A test of two primitives that can touch at several points calls a
//! function of the caller (`emit`) for each contact.

mod axis_approach;
pub mod axis_triangle;
pub mod ball_bore;
pub mod ball_round;
pub mod bar_polyhedron;
mod bar_walk;
mod behind_triangle;
pub mod capsule_edge;
pub mod capsule_polyhedron;
mod circles;
mod eight_plates;
pub mod ellipsoid_ellipsoid;
pub mod ellipsoid_math;
pub mod ellipsoid_plane;
pub mod ellipsoid_polyhedron;
mod ellipsoid_prepared;
pub mod ellipsoid_round;
pub mod ellipsoid_triangle;
pub mod ellipsoid_triangle_pairs;
pub mod end_disc;
pub mod frustum_plane;
pub mod frustum_solid;
pub mod frustum_stand;
mod highest_face;
mod least_translation;
pub mod line_segment_plane;
pub mod line_segment_polyhedron;
pub mod nearest_on_triangle;
mod planes_at_round;
pub mod point_ellipsoid;
pub mod point_plane;
pub mod point_polyhedron;
pub mod point_sphere;
pub mod pushing_features;
pub mod ray_bore;
pub mod ray_plane;
pub mod ray_polyhedron;
pub mod ray_round;
pub mod ray_triangle;
mod round_gap;
pub mod round_plane;
mod round_surface;
pub mod segment_at_walls;
mod segment_bounds;
mod segment_ends;
pub mod side_edge;
pub mod side_triangle;
pub mod sphere_ellipsoid;
pub mod sphere_plane;
pub mod sphere_polyhedron;
pub mod sphere_sphere;
pub mod sphere_triangle;
pub mod sphere_triangle_pairs;
pub mod triangle_features;
mod triangle_lanes;
mod triangle_reach;
pub mod two_capsules;
pub mod two_ended_bore;
pub mod two_ended_round;
pub mod two_frusta;

use crate::Vec3;
use crate::primitive::Sphere;

/// Overlap of A and B at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interference {
    /// Depth δ > 0, m.
    pub depth: f64,
    /// Unit normal from B to A, in B's frame.
    pub normal_b: Vec3,
    /// Deepest point of A along −normal, in B's frame, m.
    pub deepest_b: Vec3,
    /// Feature of B that pushes.
    pub feature: Feature,
}

/// Feature of B, encoded as its kind and its index. Features are ordered by kind, then by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Feature(pub u32);

/// Kind of a feature, with its number in C and in logs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// Face, triangle, or the whole primitive.
    Face = 0,
    /// Edge.
    Edge = 1,
    /// Vertex.
    Vertex = 2,
}

impl Feature {
    /// The whole primitive, for planes, spheres and ellipsoids.
    pub const WHOLE: Self = Self(0);
    const KIND_SHIFT: u32 = 30;
    const INDEX_MASK: u32 = (1 << Self::KIND_SHIFT) - 1;

    /// Returns the face with this index; a triangle is a face too.
    pub fn face(index: usize) -> Self {
        Self(index as u32)
    }

    /// Returns the edge with this index.
    pub fn edge(index: usize) -> Self {
        Self(1 << Self::KIND_SHIFT | index as u32)
    }

    /// Returns the vertex with this index.
    pub fn vertex(index: usize) -> Self {
        Self(2 << Self::KIND_SHIFT | index as u32)
    }

    /// Returns the kind of the feature.
    pub fn kind(self) -> FeatureKind {
        match self.0 >> Self::KIND_SHIFT {
            0 => FeatureKind::Face,
            1 => FeatureKind::Edge,
            _ => FeatureKind::Vertex,
        }
    }

    /// Returns `true` for a face.
    pub fn is_face(self) -> bool {
        self.kind() == FeatureKind::Face
    }

    /// Returns the index of the feature within its kind.
    pub fn index(self) -> usize {
        (self.0 & Self::INDEX_MASK) as usize
    }
}

/// Returns the contact of a sphere with one point of B: a foot point on an edge, a vertex, or the centre of
/// another sphere. `None` if the sphere does not contain the point.
///
/// `mean_normal` gives the direction of the normal if the sphere's centre coincides with the point up to
/// rounding. The vector between the two is then only rounding, and may point along an edge or into the solid.
/// `mean_normal` need not have unit length, but must not be zero.
#[inline]
pub(crate) fn ball_over_point(
    sphere: &Sphere,
    foot: &Vec3,
    feature: Feature,
    mean_normal: impl FnOnce() -> Vec3,
) -> Option<Interference> {
    /// Accumulated rounding of the two points, relative to their coordinates.
    const ROUNDING: f64 = 16.0 * f64::EPSILON;
    let arm = sphere.center - foot;
    let distance = arm.norm();
    let depth = sphere.radius - distance;
    if depth <= 0.0 {
        return None;
    }
    let has_direction = distance > ROUNDING * sphere.center.amax();
    let normal = if has_direction {
        // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
        (arm / distance.max(f64::MIN_POSITIVE)).normalize()
    } else {
        mean_normal().normalize()
    };
    Some(Interference { depth, normal_b: normal, deepest_b: sphere.center - normal * sphere.radius, feature })
}
