//! Ray (A) – polyhedron (B) (docs/theory.md, 2.5): finds the face through which the ray enters the solid.
//!
//! Degenerate cases: a ray that runs along an active face has no hit. A ray through an edge hits the face of
//! lower index.
//!
//! A ray that enters near an internal face, or runs along the line in which several internal faces meet,
//! could by rounding miss all pieces. Internal faces are therefore raised by their tolerance, so that at
//! least one piece is hit. If several pieces are hit, the engine keeps the nearest hit.

use super::Feature;
use super::ray_plane::RayHit;
use crate::primitive::{FacePlanes, PlaneBlock, Polyhedron, Ray};
use crate::simd::{Finder, First, FirstOf, LaneBits, Simd, Splat, run_at_level};

/// Largest numbers of face blocks for which the three variants of the kernel are compiled. Up to `SOME`, the
/// kernel keeps the distances in registers.
const FEW: usize = 2;
const SOME: usize = FacePlanes::IN_REGISTERS;
const MANY: usize = usize::MAX;

/// Returns the hit of a ray that enters a polyhedron through an active face; `None` if there is none. The
/// ray's origin may lie inside the solid, less than the ray's `reach` behind the entry, but not beyond the
/// far side. The heights of the origin above the faces must be finite, as they are for coordinates up to
/// 1e100.
#[inline]
pub fn ray_polyhedron(ray: &Ray, polyhedron: &Polyhedron) -> Option<RayHit> {
    if polyhedron.planes().blocks.len() <= FEW {
        run_at_level!(hit_few(ray: Ray, polyhedron: Polyhedron) -> Option<RayHit>)
    } else {
        run_at_level!(hit_many(ray: Ray, polyhedron: Polyhedron) -> Option<RayHit>)
    }
}

#[inline(always)]
fn hit_few<S: Simd>(simd: S, ray: &Ray, polyhedron: &Polyhedron) -> Option<RayHit> {
    hit::<S, FirstOf<S, FEW>, FEW>(simd, ray, polyhedron)
}

#[inline(always)]
fn hit_many<S: Simd>(simd: S, ray: &Ray, polyhedron: &Polyhedron) -> Option<RayHit> {
    if polyhedron.planes().blocks.len() <= SOME {
        hit::<S, FirstOf<S, SOME>, SOME>(simd, ray, polyhedron)
    } else {
        hit::<S, First<S>, MANY>(simd, ray, polyhedron)
    }
}

#[inline(always)]
fn hit<S: Simd, F: Finder<S>, const N: usize>(simd: S, ray: &Ray, polyhedron: &Polyhedron) -> Option<RayHit> {
    let (origin, direction) = (Splat::new(simd, &ray.origin), Splat::new(simd, &ray.direction));
    let mut passage = Passage::<S, F>::new(simd, polyhedron.planes().wall_slack);
    for index in 0..polyhedron.planes().count::<N>() {
        let block = polyhedron.planes().block(index);
        if !passage.clip(index, block, block.heights(simd, &origin), direction.dot(&block.normal)) {
            return None;
        }
    }
    let entry = passage.entry.found()?;
    // Adding 0 turns a negative zero, which the lanes may return, into a positive one.
    let distance = entry.number + 0.0;
    hit_at(ray, polyhedron, distance, entry.place(), passage.leaves_after(distance))
}

/// Interval of a line inside the solid, as distances from the ray's origin.
struct Passage<S: Simd, F: Finder<S>> {
    simd: S,
    /// Search for the last plane that the line crosses inwards: there it enters the solid.
    entry: F,
    /// For each lane, minus the distance at which the line first crosses one of its planes outwards.
    leave: S::Eight,
    /// Tolerance by which internal faces are raised, m.
    wall_slack: f64,
}

impl<S: Simd, F: Finder<S>> Passage<S, F> {
    #[inline(always)]
    fn new(simd: S, wall_slack: f64) -> Self {
        let nowhere = f64::NEG_INFINITY;
        Self { simd, entry: F::above(simd, nowhere), leave: simd.splat(nowhere), wall_slack }
    }

    /// Returns `true` if the line leaves the solid at a distance greater than `distance`, and in front of the
    /// ray's origin.
    #[inline(always)]
    fn leaves_after(&self, distance: f64) -> bool {
        let simd = self.simd;
        let beyond = simd.below(self.leave, simd.splat(-distance));
        simd.bits(simd.and(beyond, simd.below(self.leave, simd.splat(0.0)))) == LaneBits::MAX
    }

    /// Clips the line to eight planes. `heights` are the heights of the origin above the planes, `climbs`
    /// their rates along the line. Returns `false` if the line runs parallel to one of the planes and is not
    /// below it; in the plane of a `closed` face the line counts as below.
    #[inline(always)]
    fn clip(&mut self, index: usize, block: &PlaneBlock, heights: S::Eight, climbs: S::Eight) -> bool {
        let simd = self.simd;
        let (zero, nowhere) = (simd.splat(0.0), simd.splat(f64::NEG_INFINITY));
        let heights = match block.active & block.own == block.own {
            true => heights,
            false => {
                let room = simd.splat(self.wall_slack);
                simd.select(simd.mask(block.active), heights, simd.sub(heights, room))
            }
        };
        // Distances to the planes with the sign reversed.
        let before = simd.ratio(heights, climbs);
        let entered = simd.select(simd.below(climbs, zero), simd.sub(zero, before), nowhere);
        self.entry.offer(index, entered);
        let rising = simd.below(zero, climbs);
        self.leave = simd.larger(simd.select(rising, before, nowhere), self.leave);
        let along = simd.bits(simd.equal(climbs, zero));
        along == 0 || !self.runs_outside(block, heights, along)
    }

    #[inline(always)]
    fn runs_outside(&self, block: &PlaneBlock, heights: S::Eight, along: LaneBits) -> bool {
        let (simd, zero) = (self.simd, self.simd.splat(0.0));
        let above = simd.bits(simd.below(zero, heights));
        let on = simd.bits(simd.equal(heights, zero)) & !block.closed;
        along & (above | on) != 0
    }
}

/// Returns the hit on the face through which the line enters the solid. `None` unless all of these hold: the
/// face is active, the line leaves the solid only after the entry (`leaves_after`), and `distance` is within
/// the ray's range.
#[inline(always)]
fn hit_at(
    ray: &Ray,
    polyhedron: &Polyhedron,
    distance: f64,
    index: usize,
    leaves_after: bool,
) -> Option<RayHit> {
    let face = &polyhedron.faces[index];
    let within = -ray.reach.unwrap_or(0.0) < distance && distance < ray.length;
    if !(face.active && leaves_after && within) {
        return None;
    }
    Some(RayHit { distance, normal_b: face.normal, feature: Feature::face(index) })
}
