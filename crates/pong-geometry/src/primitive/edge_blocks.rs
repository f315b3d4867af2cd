//! The edges and vertices of a polyhedron that may push, eight at a time.

use super::polyhedron_parts::{EdgePush, PolyhedronParts, PolyhedronVertex};
use crate::Vec3;
use crate::simd::{LANES, LaneBits, Simd, Splat};

/// Vectors, coordinate by coordinate.
type EightVectors = [[f64; LANES]; 3];

/// Boxes around edges are wider than these by such a share of the largest coordinate: far beyond rounding.
const BOX_SLACK: f64 = 1e-9;

/// The edges that may push. Those in one block lie near each other; the order is not theirs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EdgeBlocks {
    /// The blocks; lanes beyond the last edge repeat it.
    pub blocks: Vec<EdgeBlock>,
    /// Boxes around the blocks; those beyond the last repeat it.
    pub boxes: Vec<EightBoxes>,
}

/// Eight edges that may push.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct EdgeBlock {
    /// Their first ends, m.
    pub first: EightVectors,
    /// Their second ends, m.
    pub second: EightVectors,
    /// From the first to the second, m.
    pub along: EightVectors,
    /// Of each of the two faces the unit vector in its plane, across the edge, out of the face.
    pub outwards: [EightVectors; 2],
    /// Their places in [`PolyhedronParts::edges`].
    pub index: [u32; LANES],
    /// Which lanes are no repetition.
    pub own: LaneBits,
}

/// Boxes along the frame's axes around eight blocks.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct EightBoxes {
    /// Least coordinates, m.
    pub low: EightVectors,
    /// Greatest coordinates, m.
    pub high: EightVectors,
}

/// The vertices in their order, eight at a time.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct VertexBlock {
    /// Places, m.
    pub position: EightVectors,
    /// Which lanes hold a vertex that may push.
    pub pushes: LaneBits,
}

impl EdgeBlocks {
    /// The edges that may push.
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

/// Orders edges so that those of one block lie near each other: halves, across the longest extent, of whole blocks.
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

/// Vectors of eight lanes; those beyond the last repeat it.
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

    /// The edges between whose two faces and whose two ends a point lies.
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

    /// Which boxes meet another one, from its least to its greatest coordinates.
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

    /// Which boxes may hold a point that is nearer to `p` than `reach` (m).
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
    /// All vertices, in blocks.
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

    /// The vertices that may push and are not as far as `reach` (m) from a point.
    #[inline(always)]
    pub fn within<S: Simd>(&self, simd: S, p: &Splat<S>, reach: f64) -> LaneBits {
        let square = p.less(&self.position).norm_squared();
        self.pushes & !simd.bits(simd.at_least(square, simd.splat(reach * reach)))
    }
}
