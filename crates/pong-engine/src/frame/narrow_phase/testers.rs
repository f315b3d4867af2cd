//! Dispatches elements of A to the contact tester for an element of B that they may touch; eight elements at
//! a time where that is faster.

use super::element_pair::{Ball, ChunkCandidates, ElementPair};
use super::on_triangle::thickness_for;
use super::pair_table::balls::{ball_on_triangle, ellipsoid_on_triangle};
use super::pair_table::test_of;
use crate::frame::broad_phase::chunk::{Chunk, Ellipsoidal};
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::input::PairContext;
use crate::report::FrameCounts;
use pong_geometry::interference::ellipsoid_triangle::EllipsoidOnTriangles;
use pong_geometry::primitive::PrimitiveKind::{self, Polyhedron, Triangle};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::Item;
use pong_model::box_tree::lanes;

/// Least number of line segments near a polyhedron for which the eight-wide test is faster.
const WORTH_EIGHT: u32 = 2;

/// One element of B, to be tested against a chunk of A.
pub(crate) struct Target<'a> {
    pub context: &'a PairContext<'a>,
    pub item_b: Item,
    pub kind_b: PrimitiveKind,
}

impl<'a> Target<'a> {
    /// Tests the elements of A in the lanes `near`, whose boxes overlap the box of the element of B.
    #[inline(always)]
    pub fn test_lanes<S: Simd>(
        &self,
        simd: S,
        chunk: &Chunk<'_>,
        near: LaneBits,
        found: &mut ChunkCandidates<'_>,
        counts: &mut FrameCounts,
    ) {
        if is_deferred(chunk.kind, self.kind_b) {
            counts.note_testers(chunk.kind, self.kind_b, near.count_ones(), 0);
            return defer(self.context, chunk, (near, self.item_b), found, counts);
        }
        let tested = near.count_ones();
        let near = self.not_separated(simd, chunk, near);
        let before = found.seen;
        if near != 0 {
            let test = test_of(chunk.kind, self.kind_b);
            for lane in lanes(near) {
                let pair = ElementPair {
                    context: self.context,
                    item_a: chunk.items[lane],
                    lane: lane as u8,
                    item_b: self.item_b,
                    kind_b: self.kind_b,
                };
                let of_lane = chunk.of_lane(lane);
                let a = of_lane.as_ref().or_else(|| chunk.carried(lane));
                // Kinds without a transformed copy are tested only by registered tests, which read the model.
                test(&pair, a.unwrap_or(&TransformedPrimitive::NOTHING), found);
            }
        }
        counts.note_testers(chunk.kind, self.kind_b, tested, (found.seen - before) as u32);
    }

    /// Removes the lanes whose element is separated from the polyhedron by the plane of a face, as are most
    /// points, spheres and line segments.
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
                near & !polyhedron.lanes_kept_out_in(simd, chunk.ends)
            }
            _ => near,
        }
    }
}

/// Returns true if tests of these kinds are deferred until there are eight pairs.
#[inline(always)]
pub(super) fn is_deferred(kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
    kind_b == Triangle && matches!(kind_a, PrimitiveKind::Sphere | PrimitiveKind::Ellipsoid)
}

/// Adds pairs of a triangle and the spheres or ellipsoids in the lanes `near` to the deferred tests, and runs
/// the tests whenever there are eight pairs.
#[inline(always)]
fn defer(
    context: &PairContext<'_>,
    chunk: &Chunk<'_>,
    (near, item_b): (LaneBits, Item),
    found: &mut ChunkCandidates<'_>,
    counts: &mut FrameCounts,
) {
    for lane in lanes(near) {
        let element = Ellipsoidal::of(chunk, lane);
        let thickness = thickness_for(context, &element, item_b);
        let place = found.deferred.add(&element, item_b.element, thickness);
        found.deferred.from[place] = (lane as u8, item_b);
        if place + 1 == LANES {
            test_deferred(context, *chunk, found, counts);
        }
    }
}

/// Runs the deferred tests of a chunk in the order in which they were added. Takes the chunk by value: a
/// reference would force every chunk to memory.
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
    let told = found.deferred.spheres.take(&context.body_b.triangles);
    for place in lanes(told.near) {
        let (lane, item_b) = found.deferred.from[place];
        let item_a = chunk.items[usize::from(lane)];
        let pair = ElementPair { context, item_a, lane, item_b, kind_b: Triangle };
        let over_face = told.over_face >> place & 1 == 1;
        ball_on_triangle(&pair, &Ball::of(&chunk.sphere(usize::from(lane))), over_face, found);
    }
}

fn test_ellipsoids(context: &PairContext<'_>, chunk: &Chunk<'_>, found: &mut ChunkCandidates<'_>) {
    let near = found.deferred.ellipsoids.take(&context.body_b.triangles);
    // Consecutive pairs usually have the same ellipsoid.
    let mut ready: Option<(u8, EllipsoidOnTriangles)> = None;
    for place in lanes(near) {
        let (lane, item_b) = found.deferred.from[place];
        let Some(ellipsoid) = chunk.ellipsoid(usize::from(lane)) else { continue };
        let ready = match &mut ready {
            Some((of, ready)) if *of == lane => ready,
            other => &mut other.insert((lane, EllipsoidOnTriangles::new(ellipsoid))).1,
        };
        let item_a = chunk.items[usize::from(lane)];
        ellipsoid_on_triangle(&ElementPair { context, item_a, lane, item_b, kind_b: Triangle }, ready, found);
    }
}
