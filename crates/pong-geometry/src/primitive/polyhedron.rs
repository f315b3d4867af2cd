//! Convex planar polyhedra with their surface topology.
//!
//! A polyhedron is one convex piece of a body. Pieces that touch along *inactive* faces (inner walls) form one
//! surface (docs/theory.md, 2.2); what an edge or a vertex may push is therefore a property of the
//! whole surface and is worked out when the model is loaded.

use super::edge_blocks::{EdgeBlocks, VertexBlock};
use super::face_planes::FacePlanes;
use super::polyhedron_parts::{PolyhedronFace, PolyhedronParts};
use crate::Vec3;
use crate::simd::{LaneBits, Simd, Splat, run_at_level};

/// A convex solid: the intersection of the half spaces of its faces.
///
/// Made by [`new`](Self::new) from its [`PolyhedronParts`], whose fields it shows; [`change`](Self::change) alters
/// them.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    parts: PolyhedronParts,
    planes: FacePlanes,
    edge_blocks: EdgeBlocks,
    vertex_blocks: Vec<VertexBlock>,
}

/// Whether a point is in one piece of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Containment {
    /// Inside, away from every inner wall.
    Inside,
    /// Inside (the tie rule of inner walls included), at an inner wall.
    AtWall,
    /// Outside, but only because it is at an inner wall and beyond.
    BeyondWall,
    /// Outside.
    Outside,
}

impl Polyhedron {
    /// The finished polyhedron: planes, edges and vertices are set out for the tests.
    pub fn new(parts: PolyhedronParts) -> Self {
        Self {
            planes: FacePlanes::new(&parts),
            edge_blocks: EdgeBlocks::new(&parts),
            vertex_blocks: VertexBlock::all(&parts),
            parts,
        }
    }

    /// Changes the parts and sets everything out anew.
    pub fn change(&mut self, change: impl FnOnce(&mut PolyhedronParts)) {
        let mut parts = self.parts.clone();
        change(&mut parts);
        *self = Self::new(parts);
    }

    /// The parts.
    pub fn into_parts(self) -> PolyhedronParts {
        self.parts
    }

    /// The planes of the faces, eight at a time.
    #[inline]
    pub fn planes(&self) -> &FacePlanes {
        &self.planes
    }

    /// The edges that may push, eight at a time.
    #[inline]
    pub fn edge_blocks(&self) -> &EdgeBlocks {
        &self.edge_blocks
    }

    /// The vertices, eight at a time.
    #[inline]
    pub fn vertex_blocks(&self) -> &[VertexBlock] {
        &self.vertex_blocks
    }

    /// How high a point must be above the plane of a face, at least, to be over the face's outline: the face then holds
    /// the point of the solid that is nearest, and no plane is farther below the point than that. `top` is its greatest
    /// height above a plane, m.
    ///
    /// The slack is far beyond what a loaded polyhedron may lack in convexity, and what rounding makes of the outline of
    /// the narrowest face.
    #[inline]
    pub(crate) fn least_height_over_face(&self, p: &Vec3, top: f64) -> f64 {
        const SLACK: f64 = 1e-4;
        let place = self.parts.vertices.first().map_or(0.0, |vertex| vertex.position.amax());
        top - SLACK * (self.parts.diameter + p.amax() + place)
    }

    /// Whether a point lies inside this piece (the tie rule of inner walls included).
    #[inline]
    pub fn contains(&self, p: &Vec3) -> bool {
        let planes = self.planes();
        run_at_level!(planes_hold(p: Vec3, planes: FacePlanes) -> bool)
    }

    /// Where a point is. Beside the piece's inner walls that is not this piece's business alone: see [`Containment`].
    #[inline]
    pub fn containment(&self, p: &Vec3) -> Containment {
        let planes = self.planes();
        run_at_level!(containment_in(p: Vec3, planes: FacePlanes) -> Containment)
    }

    /// The planes of the inner walls at which a point is, or beyond.
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
