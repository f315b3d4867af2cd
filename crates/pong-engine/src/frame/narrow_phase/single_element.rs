//! Tests single elements of A against their candidates of B.
//!
//! A wheel reaches the boxes of many triangles, but few of these push. So its pairs are filtered first, eight
//! at a time; the pairs of several wheels together fill the lanes.

use super::element_pair::{Ball, ChunkCandidates, DeferredPairs, ElementPair};
use super::on_triangle::thickness_for;
use super::pair_table::balls::{ball_on_triangle, ellipsoid_on_triangle};
use super::testers::{Target, is_deferred};
use crate::frame::broad_phase::chunk::{Chunk, Ellipsoidal};
use crate::frame::broad_phase::element_search::{ElementSearch, Near};
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::input::PairContext;
use crate::report::{FrameCounts, Laps, Work};
use pong_geometry::interference::ellipsoid_triangle::EllipsoidOnTriangles;
use pong_geometry::interference::sphere_triangle_pairs::PairsTold;
use pong_geometry::primitive::PrimitiveKind::{self, Triangle};
use pong_geometry::primitive::TriangleSet;
use pong_geometry::simd::{LANES, Simd};
use pong_model::box_tree::lanes;
use pong_model::{Batch, Item};

/// A single element of A and a batch of B.
#[derive(Clone, Copy)]
pub(crate) struct ElementAndBatch<'a> {
    pub context: &'a PairContext<'a>,
    /// Chunk with the element as its first.
    pub chunk: &'a Chunk<'a>,
    pub batch: &'a Batch,
}

/// Filters all pairs of a sphere or an ellipsoid with a triangle, and keeps those that may touch.
#[inline(always)]
pub(crate) fn narrow_down<S: Simd>(
    simd: S,
    pairs: &[Option<ElementAndBatch<'_>>],
    searches: &mut [ElementSearch],
    deferred: &mut DeferredPairs,
    counts: &mut FrameCounts,
) {
    let mut queue = Queue { of: None, from: [(0, 0); LANES] };
    for (number, pair) in pairs.iter().enumerate() {
        let Some(ElementAndBatch { context, chunk, batch }) = pair else { continue };
        if !is_deferred(chunk.kind, batch.kind) {
            continue;
        }
        let of = (chunk.kind, &context.body_b.triangles);
        if !queue.takes(of) {
            queue.keep_near(searches, deferred);
        }
        queue.of = Some(of);
        let items = &context.body_b.tree.items[batch.items.start as usize..batch.items.end as usize];
        let element = Ellipsoidal::of(chunk, 0);
        let found = searches[number].begin_keeping();
        let mut last = u32::MAX;
        for candidate in 0..found {
            let place = searches[number].place_of(candidate);
            let item = items[place as usize];
            // Most consecutive triangles are of one mesh, so `begin` and the look-up of the thickness are
            // rarely needed.
            if item.primitive != last {
                last = item.primitive;
                deferred.begin(simd, &element, thickness_for(context, &element, item));
            }
            let lane = deferred.push(&element, item.element);
            queue.from[lane] = (number as u32, place);
            if lane + 1 == LANES {
                queue.keep_near(searches, deferred);
                // `keep_near` has emptied `deferred`. The next pair must call `begin` again, even for the
                // same primitive.
                last = u32::MAX;
            }
        }
        counts.note_testers(chunk.kind, Triangle, found as u32, 0);
    }
    queue.keep_near(searches, deferred);
}

/// Pairs of elements of one kind with triangles of one movable group, filtered when there are eight.
struct Queue<'a> {
    of: Option<(PrimitiveKind, &'a TriangleSet)>,
    /// Per pair: index of the element's search, and the triangle's index in its batch.
    from: [(u32, u32); LANES],
}

impl<'a> Queue<'a> {
    #[inline(always)]
    fn takes(&self, (kind, set): (PrimitiveKind, &'a TriangleSet)) -> bool {
        self.of.is_none_or(|of| of.0 == kind && std::ptr::eq(of.1, set))
    }

    /// Filters the pairs and keeps those that may touch, in their order. No search keeps more candidates than
    /// it had, so that none is overwritten before it is read.
    #[inline(always)]
    fn keep_near(&mut self, searches: &mut [ElementSearch], deferred: &mut DeferredPairs) {
        let Some((_, set)) = self.of else { return };
        let PairsTold { near, over_face } = deferred.tell(set);
        for lane in lanes(near) {
            let (number, place) = self.from[lane];
            searches[number as usize].keep(place, over_face >> lane & 1 == 1);
        }
    }
}

/// Tests a single element against the filtered candidates of a batch, then continues its search and tests the
/// others.
#[inline(always)]
pub(crate) fn test_element<S: Simd>(
    simd: S,
    pair: ElementAndBatch<'_>,
    search: &mut ElementSearch,
    found: &mut ChunkCandidates<'_>,
    out: &mut ContactBuffer,
    laps: &mut impl Laps,
) {
    let ElementAndBatch { context, chunk, batch } = pair;
    let items = &context.body_b.tree.items[batch.items.start as usize..batch.items.end as usize];
    loop {
        out.counts.boxes_tested += search.take_tested();
        if is_deferred(chunk.kind, batch.kind) {
            let before = found.seen;
            test_near(pair, (items, search), found);
            out.counts.note_testers(chunk.kind, Triangle, 0, (found.seen - before) as u32);
        } else {
            for near in search.found() {
                let target = Target { context, item_b: items[near.place()], kind_b: batch.kind };
                target.test_lanes(simd, chunk, 1, found, &mut out.counts);
            }
        }
        laps.lap(Work::NarrowPhase, &mut out.times);
        if search.has_ended() {
            return;
        }
        search.go_on(simd, &batch.boxes);
        laps.lap(Work::BroadPhase, &mut out.times);
        narrow_down(simd, &[Some(pair)], std::slice::from_mut(search), found.deferred, &mut out.counts);
    }
}

/// Tests a sphere or an ellipsoid against the triangles that it may touch.
#[inline(always)]
fn test_near(
    pair: ElementAndBatch<'_>,
    (items, search): (&[Item], &ElementSearch),
    found: &mut ChunkCandidates<'_>,
) {
    let ElementAndBatch { context, chunk, .. } = pair;
    let item_a = chunk.items[0];
    let pair_with =
        |near: Near| ElementPair { context, item_a, lane: 0, item_b: items[near.place()], kind_b: Triangle };
    match Ellipsoidal::of(chunk, 0) {
        Ellipsoidal::Sphere(sphere) => {
            for near in search.found() {
                ball_on_triangle(&pair_with(near), &Ball::of(&sphere), near.over_face(), found);
            }
        }
        Ellipsoidal::Ellipsoid(ellipsoid) => {
            let mut ready: Option<EllipsoidOnTriangles> = None;
            for near in search.found() {
                let ready = ready.get_or_insert_with(|| EllipsoidOnTriangles::new(ellipsoid));
                ellipsoid_on_triangle(&pair_with(near), ready, found);
            }
        }
    }
}
