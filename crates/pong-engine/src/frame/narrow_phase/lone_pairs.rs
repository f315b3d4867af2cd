//! Elements of A by themselves against what they may touch of B.
//!
//! Of the triangles whose boxes a wheel reaches, few push. Which ones is asked of eight pairs at a time, for several wheels
//! together: what is left over of one fills up with what comes of the next.

use super::element_pair::{Ball, ChunkCandidates, DeferredPairs, ElementPair};
use super::on_triangle::thickness_for;
use super::pair_table::{ellipsoid_triangle, sphere_triangle};
use super::testers::{Target, is_deferred};
use crate::frame::broad_phase::chunk::Chunk;
use crate::frame::broad_phase::lone_element::{Bottom, LoneElement};
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

/// An element by itself and a batch of B.
#[derive(Clone, Copy)]
pub(crate) struct LonePair<'a> {
    pub context: &'a PairContext<'a>,
    /// Which the element is the first of.
    pub chunk: &'a Chunk<'a>,
    pub batch: &'a Batch,
}

/// Asks of all pairs of a sphere or an ellipsoid and a triangle which may touch, and takes out those that do not.
#[inline(always)]
pub(crate) fn narrow_down(
    pairs: &[Option<LonePair<'_>>],
    ways: &mut [LoneElement],
    deferred: &mut DeferredPairs,
    counts: &mut FrameCounts,
) {
    let mut asked = Asked { of: None, from: [(0, 0, 0); LANES] };
    for (way, pair) in pairs.iter().enumerate() {
        let Some(LonePair { context, chunk, batch }) = pair else { continue };
        if !is_deferred(chunk.kind, batch.kind) {
            continue;
        }
        let of = (chunk.kind, &context.body_b.triangles);
        if !asked.goes_with(of) {
            asked.put_back(ways, deferred);
        }
        asked.of = Some(of);
        let items = &context.body_b.tree.items[batch.items.start as usize..batch.items.end as usize];
        let mut tested = 0;
        let mut last = (u32::MAX, 0.0);
        for bottom in 0..ways[way].bottoms().len() {
            let found = &mut ways[way].bottoms_mut()[bottom];
            let (first, met) = (found.first as usize, std::mem::take(&mut found.met));
            tested += met.count_ones();
            for lane in lanes(met) {
                let item = items[first + lane];
                // Most are of one mesh: to foresee that is quicker than to look it up.
                if item.primitive != last.0 {
                    last = (item.primitive, thickness_for(context, chunk, 0, item));
                }
                let place = deferred.add(chunk, 0, item.element, last.1);
                asked.from[place] = (way as u8, bottom as u8, lane as u8);
                if place + 1 == LANES {
                    asked.put_back(ways, deferred);
                }
            }
        }
        counts.note_testers(chunk.kind, Triangle, tested, 0);
    }
    asked.put_back(ways, deferred);
}

/// Pairs of elements of one kind and triangles of one body that are about to be asked.
struct Asked<'a> {
    of: Option<(PrimitiveKind, &'a TriangleSet)>,
    /// Which bit each stands for: the way, the bottom node on it, the lane of that.
    from: [(u8, u8, u8); LANES],
}

impl<'a> Asked<'a> {
    #[inline(always)]
    fn goes_with(&self, (kind, set): (PrimitiveKind, &'a TriangleSet)) -> bool {
        self.of.is_none_or(|of| of.0 == kind && std::ptr::eq(of.1, set))
    }

    /// Asks them, and puts back those that may touch.
    #[inline(always)]
    fn put_back(&mut self, ways: &mut [LoneElement], deferred: &mut DeferredPairs) {
        let Some((_, set)) = self.of else { return };
        let PairsTold { near, over_face } = deferred.tell(set);
        for place in lanes(near) {
            let (way, bottom, lane) = self.from[place];
            let found = &mut ways[usize::from(way)].bottoms_mut()[usize::from(bottom)];
            found.met |= 1 << lane;
            found.over_face |= (over_face >> place & 1) << lane;
        }
    }
}

/// Tests an element by itself against what was found of a batch and narrowed down, and what is still to be found of it.
#[inline(always)]
pub(crate) fn test_lone<S: Simd>(
    simd: S,
    pair: LonePair<'_>,
    way: &mut LoneElement,
    found: &mut ChunkCandidates<'_>,
    out: &mut ContactBuffer,
    laps: &mut impl Laps,
) {
    loop {
        out.counts.boxes_tested += way.take_asked();
        test_bottoms(simd, pair, way.bottoms(), found, &mut out.counts);
        laps.lap(Work::NarrowPhase, &mut out.times);
        if way.is_through() {
            return;
        }
        way.go_on(simd, &pair.batch.boxes);
        laps.lap(Work::BroadPhase, &mut out.times);
        narrow_down(&[Some(pair)], std::slice::from_mut(way), found.deferred, &mut out.counts);
    }
}

#[inline(always)]
fn test_bottoms<S: Simd>(
    simd: S,
    pair: LonePair<'_>,
    bottoms: &[Bottom],
    found: &mut ChunkCandidates<'_>,
    counts: &mut FrameCounts,
) {
    let LonePair { context, chunk, batch } = pair;
    let items = &context.body_b.tree.items[batch.items.start as usize..batch.items.end as usize];
    if is_deferred(chunk.kind, batch.kind) {
        let before = found.seen;
        test_near(pair, (items, bottoms), found);
        return counts.note_testers(chunk.kind, Triangle, 0, (found.seen - before) as u32);
    }
    for &Bottom { first, met, .. } in bottoms {
        for lane in lanes(met) {
            let target = Target { context, item_b: items[first as usize + lane], kind_b: batch.kind };
            target.test_lanes(simd, chunk, 1, found, counts);
        }
    }
}

/// A sphere or an ellipsoid against the triangles that it may touch.
#[inline(always)]
fn test_near(pair: LonePair<'_>, (items, bottoms): (&[Item], &[Bottom]), found: &mut ChunkCandidates<'_>) {
    let LonePair { context, chunk, .. } = pair;
    let item_a = chunk.items[0];
    let mut ready: Option<EllipsoidOnTriangles> = None;
    for &Bottom { first, met, over_face } in bottoms {
        for lane in lanes(met) {
            let item_b = items[first as usize + lane];
            let pair = ElementPair { context, item_a, lane: 0, item_b, kind_b: Triangle };
            if let Some(ellipsoid) = chunk.ellipsoid(0) {
                let ready = ready.get_or_insert_with(|| EllipsoidOnTriangles::new(ellipsoid));
                ellipsoid_triangle::test_ready(&pair, ready, found);
            } else {
                let over_face = over_face >> lane & 1 == 1;
                sphere_triangle::test_ball(&pair, &Ball::of(&chunk.sphere(0)), over_face, found);
            }
        }
    }
}
