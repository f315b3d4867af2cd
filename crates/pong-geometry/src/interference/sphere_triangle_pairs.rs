//! Classification of sphere-triangle pairs, eight at a time.
//!
//! A sphere near a surface overlaps the boxes of many triangles and touches few. Dot products alone decide
//! most pairs:
//!
//! * most are rejected: the sphere is too far from the plane, too far beyond an edge, or near no feature that
//!   may push;
//! * in most of the others only the face may push, for which a shorter test is enough;
//! * the few that remain go one by one through [`sphere_triangle`](super::sphere_triangle::sphere_triangle).
//!
//! The classification changes no result: every comparison has a margin for rounding or is bit-identical to
//! that of the test of a single pair, and NaN never rejects a pair.

use super::triangle_lanes::{EightVectors, TriangleLanes, bit_of_each, fill_in};
use super::triangle_reach::{REACH_SLACK, SIDE_SLACK};
use crate::primitive::{Lean, Sphere, TriangleSet};
use crate::simd::{LANES, LaneBits, Simd, run_at_level};

/// Fraction of the product of two lengths that a dot product must exceed to count as positive. It is far
/// above the corresponding tolerance in the test of a single pair, and above rounding.
const ALONG_SLACK: f64 = 2e-9;

/// Batch of up to eight sphere-triangle pairs.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct SphereTrianglePairs {
    lanes: TriangleLanes,
    radii: [f64; LANES],
    /// Tangents of [`Lean`] of the edges, without a unit.
    edge_leans: [f64; LANES],
    /// Tangents of [`Lean`] of the vertices, without a unit.
    vertex_leans: [f64; LANES],
}

impl Default for SphereTrianglePairs {
    fn default() -> Self {
        let nothing = [0.0; LANES];
        Self { lanes: TriangleLanes::NONE, radii: nothing, edge_leans: nothing, vertex_leans: nothing }
    }
}

impl SphereTrianglePairs {
    /// Returns the number of pairs in the batch.
    #[inline]
    pub fn count(&self) -> usize {
        self.lanes.count
    }

    /// Removes all pairs.
    #[inline]
    pub fn clear(&mut self) {
        self.lanes.count = 0;
    }

    /// Adds a pair to the batch, which may hold eight, and returns the lane of the pair. `thickness` is as in
    /// [`sphere_triangle`](super::sphere_triangle::sphere_triangle).
    #[inline(always)]
    pub fn add(&mut self, sphere: &Sphere, triangle: u32, thickness: f64) -> usize {
        let lane = self.lanes.add(&sphere.center, triangle, thickness);
        self.radii[lane] = sphere.radius;
        lane
    }

    /// Sets the sphere for all pairs that [`push`](Self::push) adds afterwards. `thickness` is as in
    /// [`add`](Self::add). This is faster than `add` if several consecutive pairs have the same sphere.
    #[inline(always)]
    pub fn begin_in<S: Simd>(&mut self, simd: S, sphere: &Sphere, thickness: f64) {
        fill_in(simd, &mut self.radii, self.lanes.count, sphere.radius);
        self.lanes.begin_in(simd, &sphere.center, thickness);
    }

    /// Adds a pair of the current sphere and a triangle to the batch, which may hold eight, and returns the
    /// lane of the pair.
    #[inline(always)]
    pub fn push(&mut self, triangle: u32) -> usize {
        self.lanes.push(triangle)
    }

    /// Classifies all pairs of the batch, whose triangles are in `set`, and empties the batch.
    #[inline]
    pub fn take(&mut self, set: &TriangleSet) -> PairsTold {
        if self.count() == 0 {
            return PairsTold { near: 0, over_face: 0 };
        }
        self.fetch(set);
        let told = tell(self);
        self.clear();
        told
    }

    /// Same as [`take`](Self::take), for a caller that already runs at the SIMD level `S`.
    #[inline(always)]
    pub fn take_in<S: Simd>(&mut self, simd: S, set: &TriangleSet) -> PairsTold {
        self.fetch(set);
        let told = tell_in(simd, self);
        self.clear();
        told
    }

    #[inline(always)]
    fn fetch(&mut self, set: &TriangleSet) {
        self.lanes.fetch(set);
        let (mut edge_leans, mut vertex_leans) = ([Lean::ANY; LANES], [Lean::ANY; LANES]);
        for (lane, &triangle) in self.lanes.triangles.iter().enumerate() {
            let record = &set.triangles[triangle as usize];
            (edge_leans[lane], vertex_leans[lane]) = (record.edge_lean, record.vertex_lean);
        }
        self.edge_leans = edge_leans.map(Lean::tangent);
        self.vertex_leans = vertex_leans.map(Lean::tangent);
    }
}

/// Classification of the pairs of a batch, one bit per lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairsTold {
    /// Pairs that may touch.
    pub near: LaneBits,
    /// Pairs of `near` whose sphere has its centre in front and can be pushed by the face only. For these
    /// [`sphere_over_face`](super::sphere_triangle::sphere_over_face) is enough.
    pub over_face: LaneBits,
}

fn tell(pairs: &SphereTrianglePairs) -> PairsTold {
    run_at_level!(tell_in(pairs: SphereTrianglePairs) -> PairsTold)
}

/// One vector per lane.
#[derive(Clone, Copy)]
struct Vector<S: Simd> {
    simd: S,
    x: S::Eight,
    y: S::Eight,
    z: S::Eight,
}

impl<S: Simd> Vector<S> {
    #[inline(always)]
    fn load(simd: S, v: &EightVectors) -> Self {
        Self { simd, x: simd.load(&v[0]), y: simd.load(&v[1]), z: simd.load(&v[2]) }
    }

    #[inline(always)]
    fn less(&self, other: &Self) -> Self {
        let simd = self.simd;
        Self {
            simd,
            x: simd.sub(self.x, other.x),
            y: simd.sub(self.y, other.y),
            z: simd.sub(self.z, other.z),
        }
    }

    /// Dot products, bit-identical to `Vec3::dot`.
    #[inline(always)]
    fn dot(&self, other: &Self) -> S::Eight {
        let simd = self.simd;
        let sum = simd.add(simd.mul(self.x, other.x), simd.mul(self.y, other.y));
        simd.add(sum, simd.mul(self.z, other.z))
    }

    #[inline(always)]
    fn cross(&self, other: &Self) -> Self {
        let simd = self.simd;
        Self {
            simd,
            x: simd.sub(simd.mul(self.y, other.z), simd.mul(self.z, other.y)),
            y: simd.sub(simd.mul(self.z, other.x), simd.mul(self.x, other.z)),
            z: simd.sub(simd.mul(self.x, other.y), simd.mul(self.y, other.x)),
        }
    }

    /// Returns the sums of the absolute components.
    #[inline(always)]
    fn taxicab(&self) -> S::Eight {
        let simd = self.simd;
        let sum = simd.add(size(simd, self.x), size(simd, self.y));
        simd.add(sum, size(simd, self.z))
    }
}

#[inline(always)]
fn size<S: Simd>(simd: S, x: S::Eight) -> S::Eight {
    simd.larger(x, simd.sub(simd.splat(0.0), x))
}

/// Classifies the pairs. The first comparisons and the names are those of
/// [`InReach`](super::triangle_reach::InReach).
#[inline(always)]
fn tell_in<S: Simd>(simd: S, pairs: &SphereTrianglePairs) -> PairsTold {
    let (edge_lean, vertex_lean) = (simd.load(&pairs.edge_leans), simd.load(&pairs.vertex_leans));
    let (used, radii) = (pairs.lanes.used(), &pairs.radii);
    let pairs = &pairs.lanes;
    let corners = [
        Vector::load(simd, &pairs.corners[0]),
        Vector::load(simd, &pairs.corners[1]),
        Vector::load(simd, &pairs.corners[2]),
    ];
    let center = Vector::load(simd, &pairs.centers);
    let radius = simd.load(radii);
    let edges = [corners[1].less(&corners[0]), corners[2].less(&corners[1]), corners[0].less(&corners[2])];
    let arms = [center.less(&corners[0]), center.less(&corners[1]), center.less(&corners[2])];
    let normal = edges[0].cross(&corners[2].less(&corners[0]));
    let height = normal.dot(&arms[0]);
    // Upper bound of the lengths of all arms and edges.
    let span = simd.add(arms[0].taxicab(), simd.add(edges[0].taxicab(), edges[1].taxicab()));
    let normal_size = normal.taxicab();
    let room = simd.add(radius, simd.add(span, center.taxicab()));
    let slack = simd.mul(simd.splat(REACH_SLACK), room);
    let in_front = simd.below(simd.mul(slack, normal_size), height);
    let thickness = simd.load(&pairs.thicknesses);
    let reach = simd.add(simd.select(in_front, radius, simd.larger(radius, thickness)), slack);
    let normal_square = normal.dot(&normal);
    let reach_square = simd.mul(simd.mul(reach, reach), normal_square);
    let height_square = simd.mul(height, height);
    let side_slack = simd.mul(simd.splat(2.0 * SIDE_SLACK), simd.mul(simd.mul(span, span), normal_size));
    let within_slack = simd.sub(simd.splat(0.0), side_slack);

    let in_front = simd.bits(in_front);
    let mut far = simd.bits(simd.below(reach_square, height_square));
    let (mut face, mut within, mut features) = (LaneBits::MAX, LaneBits::MAX, 0);
    let radius_square = simd.mul(radius, radius);
    let span_square = simd.mul(span, span);
    let zero = simd.splat(0.0);
    let any_lean = simd.splat(Lean::ANY.tangent());
    let edges_lean_little = in_front & simd.bits(simd.below(edge_lean, any_lean));
    let vertices_lean_little = in_front & simd.bits(simd.below(vertex_lean, any_lean));
    // Squared distances, times `normal_square`, up to which an edge and a vertex can push the centre. For an
    // edge the distance is measured in the triangle's plane.
    let edge_reach = simd.mul(height_square, simd.mul(edge_lean, edge_lean));
    let vertex_reach = simd.add(height_square, simd.mul(height_square, simd.mul(vertex_lean, vertex_lean)));
    for k in 0..3 {
        let (edge, arm, next_arm) = (&edges[k], &arms[k], &arms[(k + 1) % 3]);
        let edge_square = edge.dot(edge);
        let beyond = edge.cross(&normal).dot(arm);
        let surely_beyond = simd.bits(simd.below(side_slack, beyond));
        let surely_within = simd.bits(simd.below(beyond, within_slack));
        let square = simd.add(simd.mul(height_square, edge_square), simd.mul(beyond, beyond));
        far |= in_front & surely_beyond & simd.bits(simd.below(simd.mul(reach_square, edge_square), square));
        face &= !surely_beyond;
        within &= surely_within;
        // True if the foot point on the edge's line lies before the edge's start or after its end.
        let (from_start, from_end) = (arm.dot(edge), next_arm.dot(edge));
        let beside = simd.bits(simd.below(from_start, zero)) | simd.bits(simd.below(zero, from_end));
        // True if the centre lies over the face across the edge, outside the range of normals along which the
        // edge pushes.
        let aside = simd.sub(beyond, side_slack);
        let leans_more = simd.below(simd.mul(edge_reach, edge_square), simd.mul(aside, aside));
        let over_other = edges_lean_little & surely_beyond & simd.bits(leans_more);
        features |= bit_of_each(&pairs.may_push, k) & !surely_within & !beside & !over_other;
        // Vertex `k`, at the start of edge `k` and the end of the previous edge.
        let before = &edges[(k + 2) % 3];
        let arm_square = arm.dot(arm);
        let past = arm.dot(before);
        let least = simd.mul(simd.mul(simd.splat(ALONG_SLACK * ALONG_SLACK), arm_square), span_square);
        let along = simd.bits(simd.below(zero, from_start))
            & simd.bits(simd.below(least, simd.mul(from_start, from_start)))
            | simd.bits(simd.below(past, zero)) & simd.bits(simd.below(least, simd.mul(past, past)));
        let aside = simd.bits(simd.at_least(arm_square, radius_square)) | along;
        let leans_more = simd.bits(simd.below(vertex_reach, simd.mul(arm_square, normal_square)));
        let over_other = vertices_lean_little & leans_more;
        features |= bit_of_each(&pairs.may_push, 3 + k) & !aside & !over_other;
    }
    let near = used & !far & (!in_front | face | features);
    PairsTold { near, over_face: near & in_front & within & !features }
}
