//! Planes of a polyhedron's faces as coordinate arrays.

use super::polyhedron_parts::{PolyhedronFace, PolyhedronParts};
use crate::simd::{LANES, LaneBits, MODERATE, Simd, Splat, is_moderate};

/// Face planes in blocks of eight, in face-index order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FacePlanes {
    /// Blocks; the last one may have unused lanes.
    pub blocks: Vec<PlaneBlock>,
    /// True if all numbers are moderate ([`is_moderate`]); heights of moderate points are then finite.
    pub moderate: bool,
    /// True if all faces are active.
    pub all_active: bool,
    /// True if all faces are active and none is closed.
    pub simple: bool,
    /// Tolerance of internal faces, m: [`WALL_TOLERANCE`](Self::WALL_TOLERANCE) times the piece's diameter.
    pub wall_slack: f64,
}

/// Eight planes. Unused lanes repeat the last face. They change no result, because the lowest of several
/// lanes with equal values counts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct PlaneBlock {
    /// Components of the outward unit normals.
    pub normal: [[f64; LANES]; 3],
    /// Distances from the frame's origin along the normals, m.
    pub offset: [f64; LANES],
    /// Lanes in use; the others are repetitions.
    pub own: LaneBits,
    /// Lanes whose face is active.
    pub active: LaneBits,
    /// Lanes whose face is closed.
    pub closed: LaneBits,
    /// For each face, the active faces of this block that share an edge with it.
    pub beside: [LaneBits; LANES],
}

impl PlaneBlock {
    /// Returns the heights of a point above the planes, bit-identical to [`PolyhedronFace::height`].
    #[inline(always)]
    pub fn heights<S: Simd>(&self, simd: S, p: &Splat<S>) -> S::Eight {
        simd.sub(p.dot(&self.normal), simd.load(&self.offset))
    }

    /// Returns the planes for which a point at these heights is on the solid's side. It is there if it is
    /// below the plane, or on the plane of a closed face.
    #[inline(always)]
    pub fn held<S: Simd>(&self, simd: S, heights: S::Eight) -> LaneBits {
        let zero = simd.splat(0.0);
        let below = simd.bits(simd.below(heights, zero));
        match self.closed {
            0 => below,
            closed => below | simd.bits(simd.equal(heights, zero)) & closed,
        }
    }
}

impl PlaneBlock {
    /// Returns the planes for which a point at these heights is on the solid's side within the tolerance:
    /// below the plane, or less than `wall_slack` above the plane of an internal face.
    #[inline(always)]
    pub fn held_or_at_wall<S: Simd>(&self, simd: S, heights: S::Eight, wall_slack: f64) -> LaneBits {
        let below = simd.bits(simd.below(heights, simd.splat(0.0)));
        below | simd.bits(simd.below(heights, simd.splat(wall_slack))) & !self.active
    }

    /// Returns the internal (inactive) faces that a point at these heights is above, or less than
    /// `wall_slack` below.
    #[inline(always)]
    pub fn walls_reached<S: Simd>(&self, simd: S, heights: S::Eight, wall_slack: f64) -> LaneBits {
        simd.bits(simd.below(simd.splat(-wall_slack), heights)) & !self.active
    }
}

impl FacePlanes {
    /// Tolerance of internal faces, relative to a piece's diameter. Two opposite internal faces closer than
    /// the tolerance count as one plane. A point closer than the tolerance to an internal face counts as on
    /// the face. Without the tolerance, a point where several internal faces meet could, by rounding, lie in
    /// no piece or in several.
    pub const WALL_TOLERANCE: f64 = 1e-6;

    /// Maximum number of blocks that kernels keep in registers.
    pub const IN_REGISTERS: usize = 4;

    /// Returns the number of blocks that a kernel compiled for `N` blocks processes: `N` if the kernel keeps
    /// the blocks in registers, otherwise all blocks of the piece.
    #[inline(always)]
    pub(crate) fn count<const N: usize>(&self) -> usize {
        if N <= Self::IN_REGISTERS { N } else { self.blocks.len() }
    }

    /// Returns the block with this index; for an index past the last block, the last one.
    ///
    /// # Panics
    /// If the polyhedron has no faces.
    #[inline(always)]
    pub(crate) fn block(&self, index: usize) -> &PlaneBlock {
        &self.blocks[index.min(self.blocks.len() - 1)]
    }

    /// Returns the only block; `None` if there are several. Most pieces have at most eight faces, so one
    /// block.
    #[inline]
    pub(crate) fn only_block(&self) -> Option<&PlaneBlock> {
        let [only] = &self.blocks[..] else { return None };
        Some(only)
    }

    /// Builds the planes of a piece's faces.
    pub fn new(parts: &PolyhedronParts) -> Self {
        let faces = &parts.faces[..];
        let moderate = faces.iter().all(|face| is_moderate(&face.normal) && face.offset.abs() < MODERATE);
        let all_active = faces.iter().all(|face| face.active);
        let simple = all_active && !faces.iter().any(|face| face.closed);
        let wall_slack = Self::WALL_TOLERANCE * parts.diameter;
        let blocks = (0..faces.len()).step_by(LANES).map(|first| block(parts, first)).collect();
        Self { blocks, moderate, all_active, simple, wall_slack }
    }
}

/// Builds the block of the faces from `first` on.
fn block(parts: &PolyhedronParts, first: usize) -> PlaneBlock {
    let faces = &parts.faces[first..parts.faces.len().min(first + LANES)];
    let beside = |face: &PolyhedronFace| {
        let neighbors = parts.rims_of(face).iter().map(|rim| rim.neighbor as usize);
        let here =
            neighbors.filter(|&other| parts.faces[other].active).filter_map(|other| other.checked_sub(first));
        here.filter(|&lane| lane < faces.len()).fold(0, |bits, lane| bits | 1 << lane)
    };
    let face = |lane: usize| &faces[lane.min(faces.len() - 1)];
    let bits = |is: &dyn Fn(&PolyhedronFace) -> bool| {
        (0..LANES).fold(0, |bits, lane| bits | LaneBits::from(is(face(lane))) << lane)
    };
    PlaneBlock {
        normal: std::array::from_fn(|axis| std::array::from_fn(|lane| face(lane).normal[axis])),
        offset: std::array::from_fn(|lane| face(lane).offset),
        own: LaneBits::MAX >> (LANES - faces.len()),
        active: bits(&|face| face.active),
        closed: bits(&|face| face.closed),
        beside: std::array::from_fn(|lane| faces.get(lane).map_or(0, beside)),
    }
}
