//! Edges and vertices of a polyhedron that may push, in blocks of eight.

use super::polyhedron_parts::{EdgePush, PolyhedronParts, PolyhedronVertex};
use crate::Vec3;
use crate::simd::{LANES, LaneBits, Simd, Splat};

/// Eight vectors as coordinate arrays.
type EightVectors = [[f64; LANES]; 3];

/// Enlargement of the boxes around edges, as a fraction of the largest coordinate. It is far above rounding.
const BOX_SLACK: f64 = 1e-9;

/// Edges that may push, in blocks of eight that are close together; not in the order of their indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EdgeBlocks {
    /// Blocks; unused lanes of the last block repeat the last edge.
    pub blocks: Vec<EdgeBlock>,
    /// Boxes around the blocks, eight per entry; unused lanes of the last entry repeat the last box.
    pub boxes: Vec<EightBoxes>,
}

/// Eight edges that may push.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct EdgeBlock {
    /// First ends, m.
    pub first: EightVectors,
    /// Second ends, m.
    pub second: EightVectors,
    /// Vectors from the first to the second ends, m.
    pub along: EightVectors,
    /// For each of the two adjacent faces, the unit vector that lies in the face's plane, is perpendicular to
    /// the edge and points out of the face.
    pub outwards: [EightVectors; 2],
    /// Indices into [`PolyhedronParts::edges`].
    pub index: [u32; LANES],
    /// Lanes in use; the others are repetitions.
    pub own: LaneBits,
}

/// Axis-aligned boxes around eight blocks.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct EightBoxes {
    /// Minimum coordinates, m.
    pub low: EightVectors,
    /// Maximum coordinates, m.
    pub high: EightVectors,
}

/// Eight vertices, in vertex-index order.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct VertexBlock {
    /// Positions, m.
    pub position: EightVectors,
    /// Lanes whose vertex may push.
    pub pushes: LaneBits,
}

impl EdgeBlocks {
    /// Creates the blocks from the edges that may push.
    pub fn new(parts: &PolyhedronParts) -> Self {
        let mut edges: Vec<Edge> =
            (0..parts.edges.len()).filter_map(|index| Edge::of(parts, index)).collect();
        bring_together(&mut edges);
        let blocks: Vec<&[Edge]> = edges.chunks(LANES).collect();
        Self {
            boxes: blocks.chunks(LANES).map(EightBoxes::around).collect(),
            blocks: blocks.into_iter().map(EdgeBlock::of).collect(),
        }
    }
}

#[derive(Clone, Copy)]
struct Edge {
    index: u32,
    ends: [Vec3; 2],
    push: EdgePush,
}

impl Edge {
    fn of(parts: &PolyhedronParts, index: usize) -> Option<Self> {
        let edge = &parts.edges[index];
        let ends = edge.vertices.map(|v| parts.vertices[v as usize].position);
        edge.push.map(|push| Self { index: index as u32, ends, push })
    }

    fn middle(&self) -> Vec3 {
        (self.ends[0] + self.ends[1]) * 0.5
    }
}

/// Sorts edges so that the edges of a block are close together. The edges are split recursively across their
/// longest extent, each time into two parts of which the first consists of whole blocks.
fn bring_together(edges: &mut [Edge]) {
    if edges.len() <= LANES {
        return;
    }
    let (low, high) = bounds(edges.iter().map(Edge::middle));
    let axis = (high - low).imax();
    edges.sort_by(|a, b| a.middle()[axis].total_cmp(&b.middle()[axis]).then(a.index.cmp(&b.index)));
    let half = (edges.len().div_ceil(LANES) / 2) * LANES;
    let (left, right) = edges.split_at_mut(half);
    bring_together(left);
    bring_together(right);
}

fn bounds(points: impl Iterator<Item = Vec3>) -> (Vec3, Vec3) {
    let none = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    points.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

/// Returns eight vectors; unused lanes repeat the last one.
fn eight<T>(things: &[T], vector: impl Fn(&T) -> Vec3) -> EightVectors {
    std::array::from_fn(|axis| std::array::from_fn(|lane| vector(&things[lane.min(things.len() - 1)])[axis]))
}

impl EdgeBlock {
    fn of(edges: &[Edge]) -> Self {
        Self {
            first: eight(edges, |edge| edge.ends[0]),
            second: eight(edges, |edge| edge.ends[1]),
            along: eight(edges, |edge| edge.ends[1] - edge.ends[0]),
            outwards: [0, 1].map(|side: usize| eight(edges, |edge| edge.push.outwards[side])),
            index: std::array::from_fn(|lane| edges[lane.min(edges.len() - 1)].index),
            own: LaneBits::MAX >> (LANES - edges.len()),
        }
    }

    /// Returns the edges whose Voronoi region contains a point. The point is then between the planes through
    /// the two ends, perpendicular to the edge, and on the outward side of both faces at the edge.
    #[inline(always)]
    pub fn between<S: Simd>(&self, simd: S, p: &Splat<S>) -> LaneBits {
        let zero = simd.splat(0.0);
        let from_first = p.less(&self.first);
        let beyond = [from_first.dot(&self.outwards[0]), from_first.dot(&self.outwards[1])];
        let beyond = simd.bits(simd.and(simd.below(zero, beyond[0]), simd.below(zero, beyond[1])));
        if beyond & self.own == 0 {
            return 0;
        }
        let after = simd.at_least(from_first.dot(&self.along), zero);
        let before = simd.at_least(zero, p.less(&self.second).dot(&self.along));
        beyond & self.own & simd.bits(simd.and(after, before))
    }
}

impl EightBoxes {
    fn around(blocks: &[&[Edge]]) -> Self {
        let boxes: Vec<(Vec3, Vec3)> = blocks.iter().map(|edges| box_around(edges)).collect();
        Self { low: eight(&boxes, |b| b.0), high: eight(&boxes, |b| b.1) }
    }

    /// Returns the boxes that overlap the box from `low` to `high`.
    #[inline(always)]
    pub fn meet<S: Simd>(&self, simd: S, [low, high]: &[Vec3; 2]) -> LaneBits {
        let mut met = LaneBits::MAX;
        for axis in 0..3 {
            let above = simd.at_least(simd.load(&self.high[axis]), simd.splat(low[axis]));
            let below = simd.at_least(simd.splat(high[axis]), simd.load(&self.low[axis]));
            met &= simd.bits(simd.and(above, below));
        }
        met
    }

    /// Returns the boxes that may contain a point nearer to `p` than `reach` (m).
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, p: &Splat<S>, reach: f64) -> LaneBits {
        let square = simd.splat(reach * reach);
        simd.bits(simd.at_least(square, p.distance_square_to_boxes(&self.low, &self.high)))
    }
}

fn box_around(edges: &[Edge]) -> (Vec3, Vec3) {
    let (low, high) = bounds(edges.iter().flat_map(|edge| edge.ends));
    let slack = Vec3::repeat(BOX_SLACK * low.amax().max(high.amax()));
    (low - slack, high + slack)
}

impl VertexBlock {
    /// Returns blocks of all vertices, in the order of their indices.
    pub fn all(parts: &PolyhedronParts) -> Vec<Self> {
        let block = |vertices: &[PolyhedronVertex]| Self {
            position: eight(vertices, |vertex| vertex.position),
            pushes: vertices
                .iter()
                .enumerate()
                .fold(0, |bits, (lane, vertex)| bits | LaneBits::from(vertex.pushes) << lane),
        };
        parts.vertices.chunks(LANES).map(block).collect()
    }

    /// Returns the vertices that may push and lie within `reach` (m) of a point.
    #[inline(always)]
    pub fn within<S: Simd>(&self, simd: S, p: &Splat<S>, reach: f64) -> LaneBits {
        let square = p.less(&self.position).norm_squared();
        self.pushes & !simd.bits(simd.at_least(square, simd.splat(reach * reach)))
    }
}
