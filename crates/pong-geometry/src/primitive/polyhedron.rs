//! Convex planar polyhedra with their surface topology.
//!
//! A polyhedron is one convex piece of a body. Pieces that touch along *inactive* faces (internal faces) form
//! one surface (docs/theory.md, 2.2). Which edges and vertices may push is therefore a property of the whole
//! surface. It is computed when the model is loaded.

use super::edge_blocks::{EdgeBlocks, VertexBlock};
use super::face_planes::FacePlanes;
use super::facts::{Drawing, Primitive};
use super::polyhedron_parts::{PolyhedronFace, PolyhedronParts};
use crate::Vec3;
use crate::bounding::{Bounded, farthest_of_points, support_of_points};
use crate::simd::{LaneBits, Simd, Splat, run_at_level};

/// Convex solid: the intersection of the half spaces of its faces.
///
/// It is created by [`new`](Self::new) from [`PolyhedronParts`]. It dereferences to these parts;
/// [`change`](Self::change) modifies them.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    parts: PolyhedronParts,
    planes: FacePlanes,
    edge_blocks: EdgeBlocks,
    vertex_blocks: Vec<VertexBlock>,
}

/// Position of a point relative to one piece of a body. Exactly on an internal face, the point is inside the
/// piece whose face is `closed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Containment {
    /// Inside, not on an internal face.
    Inside,
    /// Inside, and on an internal face within the tolerance `wall_slack`.
    AtWall,
    /// Outside by less than `wall_slack`, and above internal faces only: the point is below all active faces.
    BeyondWall,
    /// Outside.
    Outside,
}

impl Polyhedron {
    /// Builds the polyhedron and the data derived from its parts: blocks of planes, edges and vertices.
    pub fn new(parts: PolyhedronParts) -> Self {
        Self {
            planes: FacePlanes::new(&parts),
            edge_blocks: EdgeBlocks::new(&parts),
            vertex_blocks: VertexBlock::all(&parts),
            parts,
        }
    }

    /// Modifies the parts by calling `change`, and rebuilds all derived data.
    pub fn change(&mut self, change: impl FnOnce(&mut PolyhedronParts)) {
        let mut parts = self.parts.clone();
        change(&mut parts);
        *self = Self::new(parts);
    }

    /// Returns the parts.
    pub fn into_parts(self) -> PolyhedronParts {
        self.parts
    }

    /// Planes of the faces, in blocks of eight.
    #[inline]
    pub fn planes(&self) -> &FacePlanes {
        &self.planes
    }

    /// Edges that may push, in blocks of eight.
    #[inline]
    pub fn edge_blocks(&self) -> &EdgeBlocks {
        &self.edge_blocks
    }

    /// Vertices, in blocks of eight.
    #[inline]
    pub fn vertex_blocks(&self) -> &[VertexBlock] {
        &self.vertex_blocks
    }

    /// Returns a bound on the height of `p` above a face, m: below it, the projection of `p` onto the face's
    /// plane cannot be the point of the solid nearest to `p`. `top`, m, is the greatest height of `p` above
    /// any face.
    ///
    /// Without rounding, the bound would be `top` itself. The slack subtracted from `top` is far above the
    /// convexity error of a loaded polyhedron, and above the rounding in the test whether the projection lies
    /// within a very narrow face.
    #[inline]
    pub(crate) fn least_height_over_face(&self, p: &Vec3, top: f64) -> f64 {
        const SLACK: f64 = 1e-4;
        let place = self.parts.vertices.first().map_or(0.0, |vertex| vertex.position.amax());
        top - SLACK * (self.parts.diameter + p.amax() + place)
    }

    /// Returns `true` if a point lies inside this piece. Exactly on an internal face, it does if the face is
    /// `closed`.
    #[inline]
    pub fn contains(&self, p: &Vec3) -> bool {
        let planes = self.planes();
        run_at_level!(planes_hold(p: Vec3, planes: FacePlanes) -> bool)
    }

    /// Returns the position of a point relative to this piece. In which piece of the body a point near
    /// internal faces lies depends on the neighbouring pieces too: see [`Containment`].
    #[inline]
    pub fn containment(&self, p: &Vec3) -> Containment {
        let planes = self.planes();
        run_at_level!(containment_in(p: Vec3, planes: FacePlanes) -> Containment)
    }

    /// Returns the internal faces that the point is above, or less than `wall_slack` below.
    pub fn walls_at<'a>(&'a self, p: &'a Vec3) -> impl Iterator<Item = &'a PolyhedronFace> {
        let slack = self.planes.wall_slack;
        self.faces.iter().filter(move |face| !face.active && face.height(p) > -slack)
    }
}

impl std::ops::Deref for Polyhedron {
    type Target = PolyhedronParts;

    #[inline]
    fn deref(&self) -> &PolyhedronParts {
        &self.parts
    }
}

#[inline(always)]
fn planes_hold<S: Simd>(simd: S, p: &Vec3, planes: &FacePlanes) -> bool {
    let at = Splat::new(simd, p);
    planes.blocks.iter().all(
        #[inline(always)]
        |block| block.held(simd, block.heights(simd, &at)) == LaneBits::MAX,
    )
}

#[inline(always)]
fn containment_in<S: Simd>(simd: S, p: &Vec3, planes: &FacePlanes) -> Containment {
    let at = Splat::new(simd, p);
    let (mut held, mut near, mut walls) = (LaneBits::MAX, LaneBits::MAX, 0);
    for block in &planes.blocks {
        let heights = block.heights(simd, &at);
        held &= block.held(simd, heights);
        if !planes.all_active {
            near &= block.held_or_at_wall(simd, heights, planes.wall_slack);
            walls |= block.walls_reached(simd, heights, planes.wall_slack);
        }
        if held != LaneBits::MAX && (planes.all_active || near != LaneBits::MAX) {
            return Containment::Outside;
        }
    }
    match (held == LaneBits::MAX, walls) {
        (true, 0) => Containment::Inside,
        (true, _) => Containment::AtWall,
        _ => Containment::BeyondWall,
    }
}

impl Bounded for Polyhedron {
    fn support(&self, direction: &Vec3) -> f64 {
        support_of_points(self.vertices.iter().map(|v| v.position), direction)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        farthest_of_points(self.vertices.iter().map(|v| v.position), from)
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        out.extend(self.vertices.iter().map(|v| v.position));
    }
}

impl Primitive for Polyhedron {
    /// Returns the least width of the solid along any of its face normals, m.
    fn least_width_m(&self) -> f64 {
        let lowest = |normal: &Vec3| {
            let along = self.vertices.iter().map(|vertex| normal.dot(&vertex.position));
            along.fold(f64::INFINITY, f64::min)
        };
        let widths = self.faces.iter().map(|face| face.offset - lowest(&face.normal));
        widths.fold(f64::INFINITY, f64::min)
    }

    fn drawing(&self) -> Option<Drawing> {
        None
    }
}
