//! Elements of A that may touch an element of B: which contact tester they go to, and eight at a time where that is quicker.

use super::element_pair::{Ball, ChunkCandidates, DeferredPairs, ElementPair};
use super::on_triangle::{thickness_for_ellipsoid, thickness_for_sphere};
use super::pair_table::{Test, ellipsoid_triangle, sphere_triangle, test_of};
use super::registered;
use crate::frame::broad_phase::chunk::Chunk;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::input::PairContext;
use crate::report::FrameCounts;
use pong_geometry::interference::ellipsoid_triangle::EllipsoidOnTriangles;
use pong_geometry::primitive::PrimitiveKind::{self, Polyhedron, Triangle};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::Item;
use pong_model::box_tree::lanes;

/// So many line segments near a polyhedron are asked together: fewer end sooner one by one.
const WORTH_EIGHT: u32 = 4;

/// One element of B against a chunk of A.
pub(crate) struct Target<'a> {
    pub context: &'a PairContext<'a>,
    pub item_b: Item,
    pub kind_b: PrimitiveKind,
}

impl<'a> Target<'a> {
    /// Tests the elements of A whose boxes the element's box meets.
    #[inline(always)]
    pub fn test_lanes<S: Simd>(
        &self,
        simd: S,
        chunk: &Chunk<'_>,
        near: LaneBits,
        found: &mut ChunkCandidates<'_>,
        counts: &mut FrameCounts,
    ) {
        if self.kind_b == Triangle && matches!(chunk.kind, PrimitiveKind::Sphere | PrimitiveKind::Ellipsoid) {
            counts.note_testers(chunk.kind, self.kind_b, near.count_ones(), 0);
            return match chunk.kind {
                PrimitiveKind::Sphere => self.defer_spheres(chunk, near, found, counts),
                _ => self.defer_ellipsoids(chunk, near, found, counts),
            };
        }
        let tested = near.count_ones();
        let near = self.not_separated(simd, chunk, near);
        let before = found.seen;
        if near != 0 {
            let test = test_of(chunk.kind, self.kind_b);
            for lane in lanes(near) {
                self.test_one(test, chunk, lane, found);
            }
        }
        counts.note_testers(chunk.kind, self.kind_b, tested, (found.seen - before) as u32);
    }

    /// Defers the tests of spheres near a triangle until there are eight such pairs.
    #[inline(always)]
    fn defer_spheres(
        &self,
        chunk: &Chunk<'_>,
        near: LaneBits,
        found: &mut ChunkCandidates<'_>,
        counts: &mut FrameCounts,
    ) {
        let triangles = &self.context.body_b.triangles;
        for lane in lanes(near) {
            let sphere = chunk.sphere(lane);
            let thickness = thickness_for_sphere(self.context, self.item_b, &sphere);
            let DeferredPairs { spheres: pairs, from, .. } = &mut *found.deferred;
            from[pairs.count()] = (lane as u8, self.item_b);
            pairs.add(&sphere, triangles, self.item_b.element, thickness);
            if pairs.count() == LANES {
                test_deferred(self.context, *chunk, found, counts);
            }
        }
    }

    /// The same of ellipsoids.
    #[inline(never)]
    fn defer_ellipsoids(
        &self,
        chunk: &Chunk<'_>,
        near: LaneBits,
        found: &mut ChunkCandidates<'_>,
        counts: &mut FrameCounts,
    ) {
        let triangles = &self.context.body_b.triangles;
        for lane in lanes(near) {
            let Some(TransformedPrimitive::Ellipsoid(ellipsoid)) = chunk.carried(lane) else { continue };
            let thickness = thickness_for_ellipsoid(self.context, self.item_b, ellipsoid);
            let DeferredPairs { ellipsoids: pairs, from, .. } = &mut *found.deferred;
            from[pairs.count()] = (lane as u8, self.item_b);
            pairs.add(ellipsoid, triangles, self.item_b.element, thickness);
            if pairs.count() == LANES {
                test_deferred(self.context, *chunk, found, counts);
            }
        }
    }

    /// Most points, spheres and line segments near a polyhedron end here: apart by the plane of one face.
    #[inline(always)]
    fn not_separated<S: Simd>(&self, simd: S, chunk: &Chunk<'_>, near: LaneBits) -> LaneBits {
        if self.kind_b != Polyhedron {
            return near;
        }
        let polyhedron = &self.context.body_b.polyhedra[self.item_b.element as usize];
        match chunk.kind {
            PrimitiveKind::Point => near & polyhedron.lanes_inside_or_at_wall_in(simd, chunk.centers),
            PrimitiveKind::Sphere => near & !polyhedron.lanes_outside_in(simd, chunk.centers, chunk.radii),
            PrimitiveKind::LineSegment if near.count_ones() >= WORTH_EIGHT => {
                near & !polyhedron.lanes_kept_out_in(simd, &chunk.ends())
            }
            _ => near,
        }
    }

    #[inline(always)]
    fn test_one(&self, test: Option<Test>, chunk: &Chunk<'_>, lane: usize, found: &mut ChunkCandidates<'_>) {
        let pair = ElementPair {
            context: self.context,
            item_a: chunk.items[lane],
            item_b: self.item_b,
            kind_b: self.kind_b,
        };
        let ball;
        let a = match chunk.ball(lane) {
            Some(one) => {
                ball = one;
                Some(&ball)
            }
            None => chunk.carried(lane),
        };
        match (test, a) {
            (Some(test), Some(a)) => test(&pair, a, found),
            (None, _) | (_, None) => registered::test(&pair, found),
        }
    }
}

/// Makes the deferred tests of a chunk, in the order in which they came. The chunk comes as a copy, made here alone: one whose
/// address is handed on would be written to memory for every chunk.
#[inline(never)]
pub(crate) fn test_deferred(
    context: &PairContext<'_>,
    chunk: Chunk<'_>,
    found: &mut ChunkCandidates<'_>,
    counts: &mut FrameCounts,
) {
    let before = found.seen;
    match chunk.kind {
        PrimitiveKind::Ellipsoid => test_ellipsoids(context, &chunk, found),
        _ => test_spheres(context, &chunk, found),
    }
    counts.note_testers(chunk.kind, Triangle, 0, (found.seen - before) as u32);
}

fn test_spheres(context: &PairContext<'_>, chunk: &Chunk<'_>, found: &mut ChunkCandidates<'_>) {
    let told = found.deferred.spheres.take();
    for place in lanes(told.near) {
        let (lane, item_b) = found.deferred.from[place];
        let lane = usize::from(lane);
        let pair = ElementPair { context, item_a: chunk.items[lane], item_b, kind_b: Triangle };
        let over_face = told.over_face >> place & 1 == 1;
        sphere_triangle::test_ball(&pair, &Ball::of(&chunk.sphere(lane)), over_face, found);
    }
}

fn test_ellipsoids(context: &PairContext<'_>, chunk: &Chunk<'_>, found: &mut ChunkCandidates<'_>) {
    let near = found.deferred.ellipsoids.take();
    // Mostly several in a row are of one ellipsoid.
    let mut ready: Option<(u8, EllipsoidOnTriangles)> = None;
    for place in lanes(near) {
        let (lane, item_b) = found.deferred.from[place];
        let Some(TransformedPrimitive::Ellipsoid(ellipsoid)) = chunk.carried(usize::from(lane)) else {
            continue;
        };
        let ready = match &mut ready {
            Some((of, ready)) if *of == lane => ready,
            other => &mut other.insert((lane, EllipsoidOnTriangles::new(ellipsoid))).1,
        };
        let item_a = chunk.items[usize::from(lane)];
        ellipsoid_triangle::test_ready(
            &ElementPair { context, item_a, item_b, kind_b: Triangle },
            ready,
            found,
        );
    }
}
