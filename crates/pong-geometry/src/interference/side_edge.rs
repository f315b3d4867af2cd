//! Side of a cone (A) – convex or free edge of a polyhedron or a triangle surface (B), between the end discs
//! (docs/theory.md, 2.8).
//!
//! Along each of its generators the side has one normal m, out of the cone. An edge along e crosses the generator with
//! m · e = 0, and an end of the edge touches the generator beside it. With p on the edge and R₀ the radius at end 0,
//! whose centre is c₀, the depth is R₀·m_r − m · (p − c₀), where m_r is the part of m across the axis.

use super::Interference;
use super::capsule_edge::ConvexEdge;
use crate::primitive::Frustum;
use crate::{Vec3, divisor};

/// Tests the side of a cylinder or a cone against an edge. `None` if they do not overlap, if they touch at or beyond an
/// end disc, or if the axis has sunk below the edge.
pub fn side_edge(frustum: &Frustum, edge: &ConvexEdge) -> Option<Interference> {
    let along = edge.ends_b[1] - edge.ends_b[0];
    let across = along - frustum.axis * frustum.axis.dot(&along);
    let beside = across.norm();
    let [wall_along, wall_aside] = frustum.wall;
    let lean = wall_along * frustum.axis.dot(&along);
    let mean = edge.normals_b[0] + edge.normals_b[1];
    // Where the edge is steeper than the side, no normal of the side is square to it.
    let is_crossed = beside > crate::interference::round_surface::ROUNDING * along.norm();
    if is_crossed && lean.abs() < wall_aside * beside {
        let aside = across / beside.max(f64::MIN_POSITIVE);
        let cosine = -lean / (wall_aside * beside).max(f64::MIN_POSITIVE);
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        let other = frustum.axis.cross(&aside);
        let sides = [sine, -sine].map(|sine| aside * cosine + other * sine);
        // Of the two generators the one towards which the faces look.
        let toward = sides.map(|side| -mean.dot(&frustum.wall_toward(&side)));
        let side = if toward[0] >= toward[1] { sides[0] } else { sides[1] };
        let generator = Generator::new(frustum, &side);
        let (at, on_edge) = generator.crossing(&edge.ends_b[0], &along);
        if 0.0 < on_edge && on_edge < 1.0 {
            let place = edge.ends_b[0] + along * on_edge;
            return generator.touch(edge, &place, at).filter(|_| toward[0].max(toward[1]) > 0.0);
        }
    }
    let of_end = |end: &Vec3| {
        let arm = end - frustum.ends[0];
        let side = (arm - frustum.axis * frustum.axis.dot(&arm)).try_normalize(f64::MIN_POSITIVE)?;
        let generator = Generator::new(frustum, &side);
        let is_outside = mean.dot(&generator.normal) < 0.0;
        generator.touch(edge, end, generator.nearest(end)).filter(|_| is_outside)
    };
    let [one, other] = edge.ends_b.each_ref().map(of_end);
    match (one, other) {
        (Some(one), Some(other)) if other.depth > one.depth => Some(other),
        (None, other) => other,
        (one, _) => one,
    }
}

/// Straight line on the side of a frustum, from end to end.
struct Generator<'a> {
    frustum: &'a Frustum,
    start: Vec3,
    along: Vec3,
    /// Normal out of the frustum.
    normal: Vec3,
}

impl<'a> Generator<'a> {
    fn new(frustum: &'a Frustum, side: &Vec3) -> Self {
        let [first, last] = frustum.radii;
        let start = frustum.ends[0] + side * first;
        let along = frustum.axis * frustum.length + side * (last - first);
        Self { frustum, start, along, normal: frustum.wall_toward(side) }
    }

    /// Returns where the generator and a line from `start` along `other` cross, seen along the normal: fractions of the two.
    fn crossing(&self, start: &Vec3, other: &Vec3) -> (f64, f64) {
        let between = start - self.start;
        let area = divisor(self.along.cross(other).dot(&self.normal));
        (between.cross(other).dot(&self.normal) / area, between.cross(&self.along).dot(&self.normal) / area)
    }

    /// Returns the fraction of the generator nearest to a point.
    fn nearest(&self, place: &Vec3) -> f64 {
        (place - self.start).dot(&self.along) / self.along.norm_squared()
    }

    /// Returns the contact with a place of the edge, at the fraction `at` of the generator.
    fn touch(&self, edge: &ConvexEdge, place: &Vec3, at: f64) -> Option<Interference> {
        let touched = self.start + self.along * at;
        let depth = self.normal.dot(&(touched - place));
        let [first, last] = self.frustum.radii;
        // Distance of the axis from the side, along the normal.
        let thickness = (first + (last - first) * at) / self.frustum.wall[1];
        let is_between = 0.0 < at && at < 1.0;
        (is_between && 0.0 < depth && depth < thickness).then(|| Interference {
            depth,
            normal_b: -self.normal.normalize(),
            deepest_b: touched,
            feature: edge.feature,
        })
    }
}
