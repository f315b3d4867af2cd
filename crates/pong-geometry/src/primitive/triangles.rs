//! All triangles of one movable group, sharing vertices, with their neighbours.
//!
//! Forty-four bytes per triangle: normals and edge planes are computed when they are needed; which edges and vertices
//! may push at all is known, and how far aside. Edge `k` of a triangle runs from its vertex `k` to its vertex `k + 1` (mod 3).

use crate::Vec3;

/// In [`TriangleRecord::neighbors`]: the edge is free (or shared by three or more triangles, which counts as
/// free).
pub const NO_NEIGHBOR: u32 = u32::MAX;

/// The triangles of one movable group.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleSet {
    /// Vertices in the movable group's frame, m; bit-equal positions are one vertex.
    pub vertices: Vec<Vec3>,
    /// Triangles in the order of the file. A two-sided one is followed, at the end of its primitive, by its
    /// mirror image.
    pub triangles: Vec<TriangleRecord>,
}

/// One facet; its front is where its vertices run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleRecord {
    /// Indices into [`TriangleSet::vertices`].
    pub vertices: [u32; 3],
    /// The triangle across each edge (index into [`TriangleSet::triangles`]) or [`NO_NEIGHBOR`].
    pub neighbors: [u32; 3],
    /// The connected surface this triangle belongs to (index among the movable group's shells).
    pub shell: u32,
    /// Which of its edges and vertices may push.
    pub may_push: MayPush,
    /// How far aside its edges may push.
    pub edge_lean: Lean,
    /// How far aside its vertices may push.
    pub vertex_lean: Lean,
}

/// Which edges and vertices of a triangle may push, as
/// [`mark_pushing`](crate::interference::pushing_features::mark_pushing) tells. It decides no answer: where nothing is
/// known every feature is tested.
///
/// Bit `k` is edge `k`, bit `3 + k` vertex `k`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MayPush(pub u8);

impl MayPush {
    /// Every feature: nothing is known yet.
    pub const ALL: Self = Self(0b11_1111);

    /// Edge `k`.
    #[inline]
    pub fn edge(self, k: usize) -> bool {
        self.0 >> k & 1 == 1
    }

    /// Vertex `k`.
    #[inline]
    pub fn vertex(self, k: usize) -> bool {
        self.0 >> (3 + k) & 1 == 1
    }
}

/// The greatest tangent of the angle between the normal of a triangle and a normal along which one of its features may push,
/// rounded up, as [`mark_pushing`](crate::interference::pushing_features::mark_pushing) tells. It decides no answer: where
/// nothing is known it may push any way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Lean(u8);

impl Lean {
    /// Nothing pushes.
    pub const NONE: Self = Self(0);
    /// Any way.
    pub const ANY: Self = Self(u8::MAX);

    /// Steps of one.
    const STEPS: f64 = 64.0;

    /// Of a tangent of at least zero; a number that is none tells nothing.
    pub fn of_tangent(tangent: f64) -> Self {
        /// Far beyond rounding of two normals and of a height that is certainly not nothing, in steps.
        const ROOM: f64 = 0.01;
        let steps = (tangent * Self::STEPS * (1.0 + ROOM) + ROOM).ceil();
        if steps < f64::from(u8::MAX) { Self(steps as u8) } else { Self::ANY }
    }

    /// The tangent.
    #[inline]
    pub fn tangent(self) -> f64 {
        f64::from(self.0) / Self::STEPS
    }
}

impl TriangleSet {
    /// The corners of a triangle, m.
    #[inline]
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].vertices.map(|v| self.vertices[v as usize])
    }

    /// Unit normal towards the front.
    ///
    /// The two edges that meet at the largest angle are not singled out: triangles flatter than the loader's
    /// limit never get here.
    #[inline]
    pub fn normal(&self, triangle: u32) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a)).normalize()
    }
}
