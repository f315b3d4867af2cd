//! Capsule (A) – one piece of a body (B): contacts with convex edges that the capsule's axis crosses between
//! its ends (docs/theory.md, 2.8). Contacts of the end spheres are found by the sphere test.
//!
//! As long as the axis is above an edge, the edge pushes if its distance from the axis is less than the
//! radius. If the axis has sunk below an edge, the edge pushes only if it gives the minimum translation: no
//! face and no other edge gives a shorter one. So an edge cannot push if its distance from the axis exceeds
//! both the radius and the depth of the axis below the nearest face. Such edges are rejected eight at a time;
//! the others are tested one by one.

use super::capsule_edge::{ConvexEdge, capsule_edge};
use super::round_surface::ROUNDING;
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Capsule, EdgeBlock, FacePlanes, Polyhedron};
use crate::simd::{LANES, LaneBits, Numbers, Simd, Splat, Vectors, run_at_level};

/// Capsule and piece that are not separated by the plane of any face of the piece.
#[derive(Clone, Copy, Debug)]
pub struct CapsuleAtPiece<'a> {
    capsule: &'a Capsule,
    polyhedron: &'a Polyhedron,
    /// Height of the axis above a face's plane, m, greatest over all faces. For each face, the lower end of
    /// the axis counts; below the plane its height is negative.
    top: f64,
}

impl<'a> CapsuleAtPiece<'a> {
    /// Returns `None` if the plane of a face separates the capsule from the piece, or if the capsule only
    /// touches a face.
    #[inline]
    pub fn new(capsule: &'a Capsule, polyhedron: &'a Polyhedron) -> Option<Self> {
        let top = run_at_level!(highest_of_lower_end(capsule: Capsule, polyhedron: Polyhedron) -> f64);
        (top < capsule.radius).then_some(Self { capsule, polyhedron, top })
    }

    /// Calls `visit` with the contact of each edge that pushes, in edge order.
    pub fn each_crossing(&self, mut visit: impl FnMut(&Interference)) {
        let mut shortest = None;
        self.each_near(&mut |crossing| {
            let is_over = crossing.depth < self.capsule.radius;
            if is_over || self.leaves_by(crossing, *shortest.get_or_insert_with(|| self.shortest_way_out())) {
                visit(crossing);
            }
        });
    }

    /// Rounding error of a depth, m.
    fn rounding(&self) -> f64 {
        ROUNDING * self.capsule.ends[0].amax().max(self.capsule.ends[1].amax())
    }

    /// Returns the length of the shortest translation that moves the capsule out of the piece, past a face or
    /// over an edge, m.
    #[cold]
    fn shortest_way_out(&self) -> f64 {
        let mut shortest = self.capsule.radius - self.top;
        self.each_near(&mut |crossing| {
            if crossing.depth >= self.capsule.radius {
                shortest = shortest.min(crossing.depth);
            }
        });
        shortest
    }

    /// Returns `true` if an edge below which the axis has sunk pushes. This holds if the point where the axis
    /// crosses the edge is inside the piece and the depth is at most `shortest` (m), both within rounding.
    /// Without the tolerance, no edge would push an axis along a face, where the face and its edges are
    /// equally near.
    fn leaves_by(&self, crossing: &Interference, shortest: f64) -> bool {
        let place = crossing.deepest_b + crossing.normal_b * self.capsule.radius;
        let rounding = self.rounding();
        crossing.depth <= shortest + rounding
            && self.polyhedron.faces.iter().all(|face| face.height(&place) <= rounding)
    }

    /// Calls `visit` with the contacts of all edges that are near enough to push, in edge order.
    fn each_near(&self, visit: &mut dyn FnMut(&Interference)) {
        each_edge_in(&Query::new(self), self.polyhedron, &mut |index| {
            if let Some(crossing) = self.crossing(index) {
                visit(&crossing);
            }
        });
    }

    /// Returns the contact with an edge; `None` if there is none or the index is out of range.
    fn crossing(&self, index: usize) -> Option<Interference> {
        let edge = self.polyhedron.edges.get(index)?;
        let push = edge.push.as_ref()?;
        let edge = ConvexEdge {
            ends_b: edge.vertices.map(|vertex| self.polyhedron.vertices[vertex as usize].position),
            normals_b: push.normals,
            free_outward_b: None,
            outwards_b: Some(push.outwards),
            feature: Feature::edge(index),
        };
        capsule_edge(self.capsule, &edge)
    }
}

/// Computes `CapsuleAtPiece::top`, m.
#[inline(always)]
fn highest_of_lower_end<S: Simd>(simd: S, capsule: &Capsule, polyhedron: &Polyhedron) -> f64 {
    let ends = [Splat::new(simd, &capsule.ends[0]), Splat::new(simd, &capsule.ends[1])];
    let mut top = simd.splat(f64::NEG_INFINITY);
    for block in &polyhedron.planes().blocks {
        let [first, second] = [block.heights(simd, &ends[0]), block.heights(simd, &ends[1])];
        let lower = simd.select(simd.below(first, second), first, second);
        top = simd.larger(lower, top);
    }
    simd.largest(top)
}

/// Calls `visit` with the indices of all edges that push and come within `reach` (m) of a segment, and perhaps of
/// some others, in order.
pub(super) fn each_edge_near(
    ends: &[Vec3; 2],
    reach: f64,
    polyhedron: &Polyhedron,
    visit: &mut dyn FnMut(usize),
) {
    let reach = reach + Query::slack(ends, reach, polyhedron);
    each_edge_in(&Query { ends: *ends, reach, beside: reach }, polyhedron, visit);
}

fn each_edge_in(query: &Query, polyhedron: &Polyhedron, visit: &mut dyn FnMut(usize)) {
    for first in (0..polyhedron.edges.len()).step_by(SomeEdges::COUNT) {
        SomeEdges::near(query, polyhedron, first).each(&mut *visit);
    }
}

/// Subset of the edges of a piece: a bit for each of [`COUNT`](Self::COUNT) consecutive edges.
struct SomeEdges {
    /// Index of the first edge.
    first: usize,
    bits: [u64; Self::WORDS],
}

impl SomeEdges {
    const WORDS: usize = 8;
    const COUNT: usize = Self::WORDS * u64::BITS as usize;

    /// Returns all edges that are near enough to push, and perhaps some others, among the `COUNT` edges from
    /// `first` on.
    fn near(query: &Query, polyhedron: &Polyhedron, first: usize) -> Self {
        let first = &first;
        run_at_level!(near_in(query: Query, polyhedron: Polyhedron, first: usize) -> SomeEdges)
    }

    #[inline(always)]
    fn mark(&mut self, edge: usize) {
        let place = edge.wrapping_sub(self.first);
        if place < Self::COUNT {
            self.bits[place / u64::BITS as usize] |= 1 << (place % u64::BITS as usize);
        }
    }

    /// Calls `visit` with the index of each selected edge, in order.
    fn each(self, mut visit: impl FnMut(usize)) {
        for (word, mut bits) in self.bits.into_iter().enumerate() {
            while bits != 0 {
                visit(self.first + word * u64::BITS as usize + bits.trailing_zeros() as usize);
                bits &= bits - 1;
            }
        }
    }
}

/// Axis and distances for the selection of near edges.
struct Query {
    /// Ends of the axis, m.
    ends: [Vec3; 2],
    /// Largest distance from the axis at which an edge can push, m.
    reach: f64,
    /// Largest distance from the axis at which an end of an edge can push, m.
    beside: f64,
}

impl Query {
    /// Relative margin far above rounding.
    const SLACK: f64 = 1e-9;

    fn new(at: &CapsuleAtPiece<'_>) -> Self {
        let Capsule { ends, radius } = at.capsule;
        let slack = Self::slack(ends, *radius, at.polyhedron);
        let sunk = at.rounding() - at.top;
        Self { ends: *ends, reach: radius.max(sunk) + slack, beside: radius + slack }
    }

    /// Returns a margin far above the rounding of a distance, m.
    fn slack([one, other]: &[Vec3; 2], reach: f64, polyhedron: &Polyhedron) -> f64 {
        let diameter = polyhedron.planes().wall_slack / FacePlanes::WALL_TOLERANCE;
        Self::SLACK * (one.amax() + other.amax() + reach + diameter)
    }
}

/// Kernel of `SomeEdges::near`. It tests only the edges in boxes that overlap the axis's box, enlarged by
/// `reach`.
#[inline(always)]
fn near_in<S: Simd>(simd: S, query: &Query, polyhedron: &Polyhedron, first: &usize) -> SomeEdges {
    let mut near = SomeEdges { first: *first, bits: [0; SomeEdges::WORDS] };
    let axis = Axis::new(simd, query);
    let [one, other] = &query.ends;
    let reach = Vec3::repeat(query.reach);
    let around = [one.inf(other) - reach, one.sup(other) + reach];
    let edges = polyhedron.edge_blocks();
    for (boxes, blocks) in edges.boxes.iter().zip(edges.blocks.chunks(LANES)) {
        let mut met = boxes.meet(simd, &around);
        while met != 0 {
            // Unused lanes of `boxes` repeat the last box and have no block. Unused lanes of a block repeat
            // its last edge, which is then marked twice.
            let Some(block) = blocks.get(met.trailing_zeros() as usize) else { break };
            let mut marked = axis.near(block);
            while marked != 0 {
                near.mark(block.index[marked.trailing_zeros() as usize] as usize);
                marked &= marked - 1;
            }
            met &= met - 1;
        }
    }
    near
}

/// Axis of a capsule, broadcast to eight lanes.
struct Axis<S: Simd> {
    simd: S,
    start: Vectors<S>,
    along: Vectors<S>,
    /// Squared length of the axis, m².
    length_square: Numbers<S>,
    /// Squares of the distances in `Query`, m².
    reach_square: Numbers<S>,
    beside_square: Numbers<S>,
}

impl<S: Simd> Axis<S> {
    #[inline(always)]
    fn new(simd: S, query: &Query) -> Self {
        let [one, other] = &query.ends;
        let along = Vectors::splat(simd, &(other - one));
        Self {
            simd,
            start: Vectors::splat(simd, one),
            along,
            length_square: along.norm_squared(),
            reach_square: Numbers::splat(simd, query.reach * query.reach),
            beside_square: Numbers::splat(simd, query.beside * query.beside),
        }
    }

    /// Returns the edges of a block that are near enough to push.
    #[inline(always)]
    fn near(&self, block: &EdgeBlock) -> LaneBits {
        self.crosses(block) | self.passes_beside(&block.first) | self.passes_beside(&block.second)
    }

    /// Returns the lanes in which `share`, a position along a segment as a fraction of its length, is
    /// strictly between 0 and 1.
    #[inline(always)]
    fn is_inside(&self, share: Numbers<S>) -> S::Mask {
        self.simd.and(share.all(0.0).below(share), share.below(share.all(1.0)))
    }

    /// Returns the edges that the axis crosses within `Query::reach`, between the ends of both the axis and
    /// the edge. The crossings are computed as in [`capsule_edge`], so that both functions find the same ones
    /// even for nearly parallel edges, where they are mostly rounding.
    #[inline(always)]
    fn crosses(&self, block: &EdgeBlock) -> LaneBits {
        /// Margins far above rounding: `NOISE` is relative to the squared distance between the nearest
        /// points. `WIDER` is a factor on the squared reach that also covers the mixed term of (reach +
        /// noise)².
        const NOISE: f64 = 1e-18;
        const WIDER: f64 = 1.0 + 1e-6;
        let simd = self.simd;
        let (first, along) = (Vectors::load(simd, &block.first), Vectors::load(simd, &block.along));
        let between = first - self.start;
        let across = self.along.cross(along);
        let square = across.norm_squared();
        let at = between.cross(along).dot(across).over(square);
        let on_edge = between.cross(self.along).dot(across).over(square);
        let apart = (self.start + self.along * at) - (first + along * on_edge);
        let height = across.dot(apart);
        let reach = self.reach_square * square.all(WIDER) + apart.norm_squared() * square.all(NOISE);
        let inside = simd.and(self.is_inside(at), self.is_inside(on_edge));
        // If `square` is subnormal, the quotients are inaccurate, so the edge counts as near.
        let least = square.all(f64::MIN_POSITIVE);
        let is_too_short = simd.and(square.all(0.0).below(square), square.below(least));
        simd.bits(simd.and(inside, (reach * square).at_least(height * height))) | simd.bits(is_too_short)
    }

    /// Returns the points within `Query::beside` of the axis that project between the ends of the axis.
    #[inline(always)]
    fn passes_beside(&self, places: &[[f64; LANES]; 3]) -> LaneBits {
        let simd = self.simd;
        let places = Vectors::load(simd, places);
        let at = (places - self.start).dot(self.along).over(self.length_square);
        let square = (self.start + self.along * at - places).norm_squared();
        simd.bits(simd.and(self.is_inside(at), self.beside_square.at_least(square)))
    }
}
