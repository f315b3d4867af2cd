//! Convex planar polyhedra with their surface topology.
//!
//! A polyhedron is one convex piece of a body. Pieces that touch along *inactive* faces (internal faces,
//! "inner walls" in the documentation) form one surface (docs/theory.md, 2.2). Which edges and vertices may
//! push is therefore a property of the whole surface, computed when the model is loaded.

use super::edge_blocks::{EdgeBlocks, VertexBlock};
use super::face_planes::FacePlanes;
use super::facts::{Drawing, Primitive};
use super::polyhedron_parts::{PolyhedronFace, PolyhedronParts};
use crate::Vec3;
use crate::bounding::{Bounded, farthest_of_points, support_of_points};
use crate::simd::{LaneBits, Simd, Splat, run_at_level};

/// Convex solid: intersection of the half spaces of its faces.
///
/// Created by [`new`](Self::new) from [`PolyhedronParts`], to which it dereferences; [`change`](Self::change)
/// modifies them.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    parts: PolyhedronParts,
    planes: FacePlanes,
    edge_blocks: EdgeBlocks,
    vertex_blocks: Vec<VertexBlock>,
}

/// Position of a point relative to one piece of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Containment {
    /// Inside, not on an internal face.
    Inside,
    /// Inside (by the tie rule of internal faces), and on an internal face within the tolerance
    /// (`wall_slack`).
    AtWall,
    /// On or above internal faces by less than `wall_slack`, not inside by the tie rule, and below all active
    /// faces.
    BeyondWall,
    /// Outside.
    Outside,
}

impl Polyhedron {
    /// Builds the polyhedron and its data for the tests: planes, edges and vertices.
    pub fn new(parts: PolyhedronParts) -> Self {
        Self {
            planes: FacePlanes::new(&parts),
            edge_blocks: EdgeBlocks::new(&parts),
            vertex_blocks: VertexBlock::all(&parts),
            parts,
        }
    }

    /// Modifies the parts and rebuilds all derived data.
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

    /// Least height of `p` above a face, m, at which the face may contain the point of the solid nearest to
    /// `p`. Without rounding such a face has the greatest height of all, `top`, m.
    ///
    /// The slack is far above the convexity error of a loaded polyhedron and above the rounding of the
    /// narrowest outline.
    #[inline]
    pub(crate) fn least_height_over_face(&self, p: &Vec3, top: f64) -> f64 {
        const SLACK: f64 = 1e-4;
        let place = self.parts.vertices.first().map_or(0.0, |vertex| vertex.position.amax());
        top - SLACK * (self.parts.diameter + p.amax() + place)
    }

    /// Returns `true` if a point lies inside this piece (by the tie rule of internal faces).
    #[inline]
    pub fn contains(&self, p: &Vec3) -> bool {
        let planes = self.planes();
        run_at_level!(planes_hold(p: Vec3, planes: FacePlanes) -> bool)
    }

    /// Position of a point relative to this piece. Near internal faces the result depends on the neighbouring
    /// pieces too: see [`Containment`].
    #[inline]
    pub fn containment(&self, p: &Vec3) -> Containment {
        let planes = self.planes();
        run_at_level!(containment_in(p: Vec3, planes: FacePlanes) -> Containment)
    }

    /// Internal faces that the point is above, or less than `wall_slack` below.
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
    /// Least extent along any of the face normals, m.
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
