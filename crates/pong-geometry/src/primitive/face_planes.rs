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
    /// True if, in addition, no face is closed.
    pub simple: bool,
    /// Distance within which a point counts as on an internal face, m.
    pub wall_slack: f64,
}

/// Eight planes. Unused lanes repeat the last face: then results over all or any faces are unchanged, and
/// among equals the lower lane wins.
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
    /// Heights of a point above the planes, bit-identical to [`PolyhedronFace::height`].
    #[inline(always)]
    pub fn heights<S: Simd>(&self, simd: S, p: &Splat<S>) -> S::Eight {
        simd.sub(p.dot(&self.normal), simd.load(&self.offset))
    }

    /// Returns the planes for which a point at these heights is on the solid's side: below the plane, or on
    /// the plane of a closed face.
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
    /// Returns the planes for which a point at these heights is below, or on an internal face within
    /// `wall_slack`.
    #[inline(always)]
    pub fn held_or_at_wall<S: Simd>(&self, simd: S, heights: S::Eight, wall_slack: f64) -> LaneBits {
        let below = simd.bits(simd.below(heights, simd.splat(0.0)));
        below | simd.bits(simd.below(heights, simd.splat(wall_slack))) & !self.active
    }

    /// Returns the internal faces (inactive) whose plane a point at these heights is on or beyond, within
    /// `wall_slack`.
    #[inline(always)]
    pub fn walls_reached<S: Simd>(&self, simd: S, heights: S::Eight, wall_slack: f64) -> LaneBits {
        simd.bits(simd.below(simd.splat(-wall_slack), heights)) & !self.active
    }
}

impl FacePlanes {
    /// Tolerance of internal faces, relative to a piece's diameter: two opposite internal faces within it
    /// count as one plane, and a point within it counts as on the face. Where several internal faces meet,
    /// rounding leaves a point in no piece or in several.
    pub const WALL_TOLERANCE: f64 = 1e-6;

    /// Maximum number of blocks that kernels keep in registers.
    pub const IN_REGISTERS: usize = 4;

    /// Number of blocks that a kernel for `N` blocks processes: always `N` if it keeps them in registers,
    /// else all.
    #[inline(always)]
    pub(crate) fn count<const N: usize>(&self) -> usize {
        if N <= Self::IN_REGISTERS { N } else { self.blocks.len() }
    }

    /// Returns a block; an index past the last returns the last one.
    ///
    /// # Panics
    /// If the polyhedron has no faces.
    #[inline(always)]
    pub(crate) fn block(&self, index: usize) -> &PlaneBlock {
        &self.blocks[index.min(self.blocks.len() - 1)]
    }

    /// The only block, if there is one: most pieces have at most eight faces.
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
