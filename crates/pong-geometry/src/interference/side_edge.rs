//! Side of a cone (A) – convex or free edge of a polyhedron or a triangle surface (B), between the end discs
//! (docs/theory.md, 2.8).
//!
//! Along each of its generators the side has one normal m, out of the cone. An edge along e crosses the generator with
//! m · e = 0, and an end of the edge touches the generator beside it. With p on the edge and R₀ the radius at end 0,
//! whose centre is c₀, the depth is R₀·m_r − m · (p − c₀), where m_r is the part of m across the axis.
//!
//! A body whose axis has sunk past the edges leaves a polyhedron by the shortest of the ways that are flat: over a face,
//! over an edge along −m, or along its own axis past a vertex.

use super::capsule_edge::ConvexEdge;
use super::round_surface::ROUNDING;
use super::{Feature, Interference};
use crate::distance::Solid;
use crate::primitive::{Frustum, Polyhedron};
use crate::{Transform, Vec3, divisor};

/// Tests the side of a cylinder or a cone against an edge. `None` if they do not overlap, if they touch at or beyond an
/// end disc, or if the axis has sunk below the edge.
pub fn side_edge(frustum: &Frustum, edge: &ConvexEdge) -> Option<Interference> {
    let along = edge.ends_b[1] - edge.ends_b[0];
    let mean = edge.normals_b[0] + edge.normals_b[1];
    if let Some(sides) = sides_square_to(frustum, &along) {
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

/// Returns the directions, across the axis, of the two generators whose normals are square to `along`; `None` where
/// `along` is steeper than the side.
fn sides_square_to(frustum: &Frustum, along: &Vec3) -> Option<[Vec3; 2]> {
    let across = along - frustum.axis * frustum.axis.dot(along);
    let beside = across.norm();
    let [wall_along, wall_aside] = frustum.wall;
    let lean = wall_along * frustum.axis.dot(along);
    if beside <= ROUNDING * along.norm() || lean.abs() >= wall_aside * beside {
        return None;
    }
    let aside = across / divisor(beside);
    let cosine = -lean / divisor(wall_aside * beside);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let other = frustum.axis.cross(&aside);
    Some([sine, -sine].map(|sine| aside * cosine + other * sine))
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

    /// Returns the distance of the axis from the side, along the normal, m, at the fraction `at`.
    fn thickness(&self, at: f64) -> f64 {
        let [first, last] = self.frustum.radii;
        (first + (last - first) * at) / self.frustum.wall[1]
    }

    /// Returns the contact with a place of the edge, at the fraction `at` of the generator.
    fn touch(&self, edge: &ConvexEdge, place: &Vec3, at: f64) -> Option<Interference> {
        let touched = self.start + self.along * at;
        let depth = self.normal.dot(&(touched - place));
        // The normal leans: below the generator, but past the plane of an end disc, is outside.
        let along_axis = self.frustum.axis.dot(&(place - self.frustum.ends[0]));
        let is_between = 0.0 < at && at < 1.0 && 0.0 < along_axis && along_axis < self.frustum.length;
        (is_between && 0.0 < depth && depth < self.thickness(at)).then(|| Interference {
            depth,
            normal_b: -self.normal.normalize(),
            deepest_b: touched,
            feature: edge.feature,
        })
    }
}

/// Returns `true` if the axis of a cylinder or a cone passes through a polyhedron.
pub fn axis_passes_through(frustum: &Frustum, polyhedron: &Polyhedron) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for face in &polyhedron.faces {
        let [start, end] = frustum.ends.each_ref().map(|end| face.height(end));
        let crossing = start / divisor(start - end);
        if start > 0.0 {
            from = from.max(if end > 0.0 { f64::INFINITY } else { crossing });
        } else if end > 0.0 {
            to = to.min(crossing);
        }
    }
    from < to
}

/// Returns `true` if a cylinder or a cone overlaps a polyhedron by more than a millionth of its own size.
pub fn surely_overlaps(frustum: &Frustum, polyhedron: &Polyhedron) -> bool {
    const SMALLER: f64 = 1.0 - 1e-6;
    let middle = (frustum.ends[0] + frustum.ends[1]) * 0.5;
    let smaller = Frustum {
        ends: frustum.ends.map(|end| middle + (end - middle) * SMALLER),
        radii: frustum.radii.map(|radius| radius * SMALLER),
        ..*frustum
    };
    let other = Solid::polyhedron(polyhedron, &Transform::identity());
    Solid::frustum(&smaller).to_within(&other, 0.0).is_some_and(|found| found.distance == 0.0)
}

/// Returns the shortest of the flat ways by which a cylinder or a cone leaves a polyhedron or the active features of a piece,
/// and `true` if it leads over an edge past which the axis has sunk. Along this way the two are apart, whether or not
/// they overlap now.
pub fn flat_way_out(frustum: &Frustum, polyhedron: &Polyhedron) -> Option<(Interference, bool)> {
    let mut best: Option<(Interference, bool)> = None;
    let mut offer = |found: Interference, is_sunk: bool| {
        if best.is_none_or(|(best, _)| found.depth < best.depth) {
            best = Some((found, is_sunk));
        }
    };
    let planes = polyhedron.planes();
    for (index, face) in polyhedron.faces.iter().enumerate().filter(|(_, face)| face.active) {
        let deepest_b = frustum.support_point(&-face.normal);
        let depth = -face.height(&deepest_b);
        offer(Interference { depth, normal_b: face.normal, deepest_b, feature: Feature::face(index) }, false);
    }
    for (index, edge) in polyhedron.edges.iter().enumerate() {
        let Some(push) = &edge.push else { continue };
        let [start, end] = edge.vertices.map(|vertex| polyhedron.vertices[vertex as usize].position);
        for side in sides_square_to(frustum, &(end - start)).into_iter().flatten() {
            let generator = Generator::new(frustum, &side);
            let normal_b = -generator.normal;
            if push.outwards.iter().any(|outward| outward.dot(&normal_b) < -ROUNDING) {
                continue;
            }
            let (at, _) = generator.crossing(&start, &(end - start));
            let deepest_b = generator.start + generator.along * at.clamp(0.0, 1.0);
            let depth = normal_b.dot(&(start - deepest_b));
            let is_sunk = depth >= generator.thickness(at.clamp(0.0, 1.0));
            offer(Interference { depth, normal_b, deepest_b, feature: Feature::edge(index) }, is_sunk);
        }
    }
    if planes.all_active {
        for (end, normal_b) in [(0, frustum.axis), (1, -frustum.axis)] {
            let heights = polyhedron.vertices.iter().map(|vertex| normal_b.dot(&vertex.position));
            let highest = heights.enumerate().reduce(|a, b| if b.1 > a.1 { b } else { a });
            let Some((index, height)) = highest else { continue };
            let depth = height - normal_b.dot(&frustum.ends[end]);
            let deepest_b = polyhedron.vertices[index].position - normal_b * depth;
            offer(Interference { depth, normal_b, deepest_b, feature: Feature::vertex(index) }, false);
        }
    }
    best.filter(|(best, _)| best.depth > 0.0)
}
