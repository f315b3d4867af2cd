//! Convex planar polyhedra with their surface topology.
//!
//! A polyhedron is one convex piece of a body. Pieces that touch along *inactive* faces (inner walls) form one
//! surface (docs/theory.md, 2.2); what an edge or a vertex may push is therefore a property of the
//! whole surface and is worked out when the model is loaded.

use super::edge_blocks::{EdgeBlocks, VertexBlock};
use super::face_planes::FacePlanes;
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

/// All that a polyhedron consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedronParts {
    /// Faces; the lower index wins ties.
    pub faces: Vec<PolyhedronFace>,
    /// The edges of all face outlines, face after face, counter-clockwise seen from outside.
    pub rims: Vec<RimEdge>,
    /// Every edge once.
    pub edges: Vec<PolyhedronEdge>,
    /// Every vertex once.
    pub vertices: Vec<PolyhedronVertex>,
    /// Unit directions of the surface's edges away from a vertex, grouped by vertex: its normal cone is where
    /// all of them have a negative product with the normal.
    pub cone_edges: Vec<Vec3>,
    /// Largest distance between two vertices, m: the size that tolerances are relative to.
    pub diameter: f64,
}

/// A planar face: the solid is `normal · x ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronFace {
    /// Unit outward normal.
    pub normal: Vec3,
    /// Distance of the plane from the frame's origin along the normal, m.
    pub offset: f64,
    /// Whether the face can push. An inactive face is an inner wall between pieces of one body.
    pub active: bool,
    /// Whether a point exactly on this plane still belongs to this piece: true for an inactive wall whose twin
    /// belongs to a piece with a higher index.
    pub closed: bool,
    /// First entry of this face's outline in [`PolyhedronParts::rims`].
    pub first_rim: u32,
    /// Number of entries of the outline.
    pub rim_count: u32,
}

/// One edge of a face's outline, as that face sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimEdge {
    /// Where the edge starts, walking the outline counter-clockwise (index into [`PolyhedronParts::vertices`]).
    pub start: u32,
    /// The edge (index into [`PolyhedronParts::edges`]).
    pub edge: u32,
    /// The face on the other side (index into [`PolyhedronParts::faces`]).
    pub neighbor: u32,
    /// The end of the edge that comes first in (x, y, z) order, so that every face and piece measures from the
    /// same point, m.
    pub anchor: Vec3,
    /// Unit vector in the face's plane, across the edge, out of the face.
    pub outward: Vec3,
}

/// An edge of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronEdge {
    /// Its two ends in (x, y, z) order (indices into [`PolyhedronParts::vertices`]).
    pub vertices: [u32; 2],
    /// The two faces of this piece that meet here.
    pub faces: [u32; 2],
    /// Unit direction from the first to the second end.
    pub direction: Vec3,
    /// Whether the edge may push, and within which normals: two active faces of the surface (possibly of two
    /// pieces) meet here convexly, and this piece is the lowest that has the edge.
    pub push: Option<EdgePush>,
    /// The same for every piece that has the edge: for what crosses it from one piece into another.
    pub convex: Option<EdgePush>,
}

/// The normals between which a convex edge pushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePush {
    /// Outward unit normals of the two active faces that meet at the edge.
    pub normals: [Vec3; 2],
    /// For each of them the unit vector in its plane, across the edge, out of the face.
    pub outwards: [Vec3; 2],
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

/// A vertex of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronVertex {
    /// Place in the movable group's frame, m.
    pub position: Vec3,
    /// Whether the vertex may push: active faces of the surface meet here, and this piece is the lowest that has
    /// the vertex.
    pub pushes: bool,
    /// First entry of its cone in [`PolyhedronParts::cone_edges`].
    pub first_cone: u32,
    /// Number of entries of its cone.
    pub cone_count: u32,
}

impl Polyhedron {
    /// The finished polyhedron: planes, edges and vertices are set out for the tests.
    pub fn new(parts: PolyhedronParts) -> Self {
        Self {
            planes: FacePlanes::new(&parts.faces, parts.diameter),
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

impl PolyhedronParts {
    /// The outline of a face.
    #[inline]
    pub fn rim(&self, face: usize) -> &[RimEdge] {
        let face = &self.faces[face];
        &self.rims[face.first_rim as usize..(face.first_rim + face.rim_count) as usize]
    }

    /// The surface's edge directions away from a vertex.
    #[inline]
    pub fn cone(&self, vertex: usize) -> &[Vec3] {
        let vertex = &self.vertices[vertex];
        &self.cone_edges[vertex.first_cone as usize..(vertex.first_cone + vertex.cone_count) as usize]
    }

    /// Signed distance of a point above a face's plane (positive outside), m.
    #[inline]
    pub fn height(&self, face: usize, p: &Vec3) -> f64 {
        self.faces[face].height(p)
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

impl PolyhedronFace {
    /// Signed distance of a point above the plane (positive outside), m.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}
