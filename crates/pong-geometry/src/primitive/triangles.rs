//! All triangles of one movable group, with shared vertices and neighbours.
//!
//! A triangle takes 44 bytes. Its normal and the planes of its edges are computed when needed. Stored are
//! which edges and vertices may push, and how far their pushing normals deviate from the face normal. Edge
//! `k` runs from vertex `k` to vertex `k + 1` (mod 3).

use crate::Vec3;

/// Value in [`TriangleRecord::neighbors`] for a boundary edge. An edge shared by three or more triangles
/// counts as boundary too.
pub const NO_NEIGHBOR: u32 = u32::MAX;

/// Triangles of one movable group.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleSet {
    /// Vertices in the group frame, m; bit-equal positions are one vertex.
    pub vertices: Vec<Vec3>,
    /// Triangles in file order. A two-sided primitive is followed by the mirror images of its triangles.
    pub triangles: Vec<TriangleRecord>,
}

/// Triangle; its front is the side seen from which its vertices run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleRecord {
    /// Indices into [`TriangleSet::vertices`].
    pub vertices: [u32; 3],
    /// Triangle across each edge (index into [`TriangleSet::triangles`]), or [`NO_NEIGHBOR`].
    pub neighbors: [u32; 3],
    /// Connected surface of the triangle (index among the movable group's shells).
    pub shell: u32,
    /// Edges and vertices that may push.
    pub may_push: MayPush,
    /// Bound of the angle between the face normal and the normals along which the edges push.
    pub edge_lean: Lean,
    /// Bound of the angle between the face normal and the normals along which the vertices push.
    pub vertex_lean: Lean,
}

/// Edges and vertices of a triangle that may push, set by
/// [`mark_pushing`](crate::interference::pushing_features::mark_pushing). They only save tests and change no
/// result: without this information every feature is tested.
///
/// Bit `k` is edge `k`, bit `3 + k` is vertex `k`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MayPush(pub u8);

impl MayPush {
    /// All edges and vertices, for a triangle of which nothing is known.
    pub const ALL: Self = Self(0b11_1111);

    /// Returns `true` if edge `k` may push.
    #[inline]
    pub fn edge(self, k: usize) -> bool {
        self.0 >> k & 1 == 1
    }

    /// Returns `true` if vertex `k` may push.
    #[inline]
    pub fn vertex(self, k: usize) -> bool {
        self.0 >> (3 + k) & 1 == 1
    }
}

/// Upper bound of the tangent of the angle between the face normal and any normal along which a feature may
/// push. It is set by [`mark_pushing`](crate::interference::pushing_features::mark_pushing), only saves tests
/// and changes no result: without this information the bound is [`Lean::ANY`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Lean(u8);

impl Lean {
    /// Bound if no feature pushes.
    pub const NONE: Self = Self(0);
    /// Bound if a feature may push along any normal.
    pub const ANY: Self = Self(u8::MAX);

    /// Quantisation steps per unit of the tangent.
    const STEPS: f64 = 64.0;

    /// Returns the bound for a non-negative tangent, rounded up; NaN gives [`Lean::ANY`].
    pub fn of_tangent(tangent: f64) -> Self {
        /// Margin in steps, far above the rounding of two normals and of a height.
        const ROOM: f64 = 0.01;
        let steps = (tangent * Self::STEPS * (1.0 + ROOM) + ROOM).ceil();
        if steps < f64::from(u8::MAX) { Self(steps as u8) } else { Self::ANY }
    }

    /// Returns the tangent of the bound.
    #[inline]
    pub fn tangent(self) -> f64 {
        f64::from(self.0) / Self::STEPS
    }
}

impl TriangleSet {
    /// Returns the corners of a triangle, m.
    #[inline]
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].vertices.map(|v| self.vertices[v as usize])
    }

    /// Returns the unit normal towards the front.
    ///
    /// It is computed from the two edges at the first vertex. The loader refuses triangles so flat that the
    /// choice of the edges would matter.
    #[inline]
    pub fn normal(&self, triangle: u32) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a)).normalize()
    }
}
