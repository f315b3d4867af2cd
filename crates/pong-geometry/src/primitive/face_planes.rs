//! The planes of a polyhedron's faces, coordinate by coordinate.

use super::polyhedron_parts::{PolyhedronFace, PolyhedronParts};
use crate::Vec3;
use crate::simd::{LANES, LaneBits, MODERATE, Simd, Splat, is_moderate};

/// Faces in blocks of eight, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FacePlanes {
    /// The blocks; the last one may have empty lanes.
    pub blocks: Vec<PlaneBlock>,
    /// The faces from the widest to the narrowest, of equal ones the first first: what is near a solid but outside is mostly
    /// above a wide face, so who asks one plane after another ends sooner.
    pub widest_first: Vec<PolyhedronFace>,
    /// Whether all numbers are moderate ([`is_moderate`]), so that the height of such a point is finite.
    pub moderate: bool,
    /// Whether all faces are active.
    pub all_active: bool,
    /// Whether also none is closed.
    pub simple: bool,
    /// How near a point must be to an inner wall to be at it, m.
    pub wall_slack: f64,
}

/// Eight planes. Lanes beyond the last face repeat it: what holds for all faces, or for any, is then the same, and of
/// equals the lower place wins.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct PlaneBlock {
    /// Components of the unit outward normals.
    pub normal: [[f64; LANES]; 3],
    /// Distances from the frame's origin along the normals, m.
    pub offset: [f64; LANES],
    /// Which lanes are no repetition.
    pub own: LaneBits,
    /// Which lanes hold an active face.
    pub active: LaneBits,
    /// Which lanes hold a closed face.
    pub closed: LaneBits,
    /// For each face, the active ones in this block that have an edge in common with it.
    pub beside: [LaneBits; LANES],
}

impl PlaneBlock {
    /// Heights of a point above the planes, in the bits of [`PolyhedronFace::height`].
    #[inline(always)]
    pub fn heights<S: Simd>(&self, simd: S, p: &Splat<S>) -> S::Eight {
        simd.sub(p.dot(&self.normal), simd.load(&self.offset))
    }

    /// For which planes a point at these heights is on the solid's side: below, or on one that is closed.
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
    /// For which planes a point at these heights is below, or at an inner wall.
    #[inline(always)]
    pub fn held_or_at_wall<S: Simd>(&self, simd: S, heights: S::Eight, wall_slack: f64) -> LaneBits {
        let below = simd.bits(simd.below(heights, simd.splat(0.0)));
        below | simd.bits(simd.below(heights, simd.splat(wall_slack))) & !self.active
    }

    /// At which planes of inner walls a point at these heights is, or beyond.
    #[inline(always)]
    pub fn walls_reached<S: Simd>(&self, simd: S, heights: S::Eight, wall_slack: f64) -> LaneBits {
        simd.bits(simd.below(simd.splat(-wall_slack), heights)) & !self.active
    }
}

impl FacePlanes {
    /// Relative to a piece's diameter: two opposite inner walls within this count as one plane, and a point within this
    /// of a wall is at it. Where several walls meet, rounding leaves a point in none of the pieces, or in several.
    pub const WALL_TOLERANCE: f64 = 1e-6;

    /// Most blocks that kernels keep in registers.
    pub const IN_REGISTERS: usize = 4;

    /// How many blocks a kernel for `N` blocks looks at: always `N` if it keeps them in registers, else all.
    #[inline(always)]
    pub(crate) fn count<const N: usize>(&self) -> usize {
        if N <= Self::IN_REGISTERS { N } else { self.blocks.len() }
    }

    /// A block; beyond the last the last once more.
    ///
    /// # Panics
    /// If there are no faces.
    #[inline(always)]
    pub(crate) fn block(&self, index: usize) -> &PlaneBlock {
        &self.blocks[index.min(self.blocks.len() - 1)]
    }

    /// The only block: most pieces have at most eight faces.
    #[inline]
    pub(crate) fn only_block(&self) -> Option<&PlaneBlock> {
        let [only] = &self.blocks[..] else { return None };
        Some(only)
    }

    /// The planes of the faces of a piece.
    pub fn new(parts: &PolyhedronParts) -> Self {
        let faces = &parts.faces[..];
        let moderate = faces.iter().all(|face| is_moderate(&face.normal) && face.offset.abs() < MODERATE);
        let all_active = faces.iter().all(|face| face.active);
        let simple = all_active && !faces.iter().any(|face| face.closed);
        let wall_slack = Self::WALL_TOLERANCE * parts.diameter;
        let blocks = (0..faces.len()).step_by(LANES).map(|first| block(parts, first)).collect();
        Self { blocks, widest_first: widest_first(parts), moderate, all_active, simple, wall_slack }
    }
}

fn widest_first(parts: &PolyhedronParts) -> Vec<PolyhedronFace> {
    let mut faces: Vec<_> = parts.faces.iter().map(|face| (twice_the_area(parts, face), *face)).collect();
    faces.sort_by(|(area, _), (other, _)| other.total_cmp(area));
    faces.into_iter().map(|(_, face)| face).collect()
}

/// Of a face, from the triangles between the first corner of its outline and the edges that do not meet there, m².
fn twice_the_area(parts: &PolyhedronParts, face: &PolyhedronFace) -> f64 {
    let mut from_first = parts.rims_of(face).iter().map(|rim| parts.vertices[rim.start as usize].position);
    let Some(first) = from_first.next() else { return 0.0 };
    let corners: Vec<Vec3> = from_first.map(|corner| corner - first).collect();
    corners.windows(2).map(|pair| pair[0].cross(&pair[1])).sum::<Vec3>().norm()
}

/// The block of the faces from `first` on.
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
