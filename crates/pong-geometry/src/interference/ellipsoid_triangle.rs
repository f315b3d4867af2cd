//! Ellipsoid (A) – triangle (B), one-sided (docs/theory.md, 2.2).
//!
//! The candidates of a feature are those of [`ellipsoid_polyhedron`](super::ellipsoid_polyhedron): for a face
//! its normal; for an edge or a vertex at most two local minima of the overlap. Let the foot of a candidate
//! be the ellipsoid's deepest point after the ellipsoid is pushed out. The candidate is a contact if its foot
//! lies in the feature, and its normal lies between those of the faces there.
//!
//! If the depth is less than the smallest radius of curvature, exactly one of the features that meet convexly
//! has a contact, as for a sphere. At larger depths several may have one; then only the least deep pushes, as
//! in a polyhedron. Load sharing selects it, because it sees the contacts of all triangles and knows which of
//! them push. A selection here would depend on the triangulation, and could prefer an edge that does not
//! push.
//!
//! The ellipsoid is in front of a face if its centre is above the face. It is in front of an edge or a vertex
//! if the centre is above the plane that passes through the feature and is perpendicular to the candidate's
//! normal. Candidates that miss their feature only by rounding are emitted as fallbacks (`Standing::Spare`).
//!
//! An ellipsoid may sink so deep into a valley that on each of the valley's two faces the foot lies beyond
//! the concave edge between them. Neither face then contains its foot, and the position of the centre
//! decides. A face that has the centre in front of it gives a fallback if the centre is not beyond the edge.
//! A face that has the centre behind it gives a fallback if it would push a ball at the centre. Such a
//! fallback (`Standing::StandIn`) counts only if no other contact is as deep.
//!
//! Degenerate cases: a centre in the plane of a face, on an edge or at a vertex counts as in front of it. A
//! centre on an edge that may push is displaced slightly along the mean of the normals there, because only
//! rounding decides on which side of the edge it is.

use super::behind_triangle::has_behind;
use super::ellipsoid_math::{
    NormalFoot, nearest_on_ellipse, nearest_on_ellipsoid, second_nearest_on_ellipse,
    second_nearest_on_ellipsoid,
};
use super::ellipsoid_prepared::{PreparedEllipsoid, Shadow};
use super::triangle_features::{
    EdgeClass, Standing, TriangleContact, TriangleEdges, TriangleView, vertex_pushes, walk_fan,
};
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Ellipsoid, TriangleSet};

/// Distance by which a foot may lie outside its feature and still give a fallback, relative to the sizes
/// involved.
const FOOT_SLACK: f64 = 1e-12;
/// Sine of the angle by which a normal may lie outside the range of its edge and still give a fallback.
const CONE_SLACK: f64 = 1e-9;
/// Relative difference up to which two depths count as equal.
const DEPTH_SLACK: f64 = 1e-9;
/// Relative margin, far above rounding, on the depth up to which second minima are computed.
const SECOND_SLACK: f64 = 1e-6;

/// Tests an ellipsoid against one triangle and emits a contact for each of its features that pushes.
///
/// `thickness` (m) is the distance up to which a centre behind the triangle is still pushed to the front. An
/// edge or a vertex is emitted only by the triangle that owns it, so that each feature of a surface counts
/// once.
pub fn ellipsoid_triangle(
    ellipsoid: &Ellipsoid,
    set: &TriangleSet,
    triangle: u32,
    thickness: f64,
    emit: &mut dyn FnMut(TriangleContact),
) {
    EllipsoidOnTriangles::new(ellipsoid).test(set, triangle, thickness, emit);
}

/// Ellipsoid with precomputed matrices, for tests against many triangles.
#[derive(Clone, Copy, Debug)]
pub struct EllipsoidOnTriangles {
    ellipsoid: Ellipsoid,
    prepared: PreparedEllipsoid,
}

impl EllipsoidOnTriangles {
    /// Computes the matrices of an ellipsoid.
    pub fn new(ellipsoid: &Ellipsoid) -> Self {
        Self { ellipsoid: *ellipsoid, prepared: PreparedEllipsoid::new(ellipsoid) }
    }

    /// Returns the original ellipsoid.
    pub fn ellipsoid(&self) -> &Ellipsoid {
        &self.ellipsoid
    }

    /// Same as [`ellipsoid_triangle`], for an ellipsoid with precomputed matrices. Most triangles near an
    /// ellipsoid do not touch it; use
    /// [`EllipsoidTrianglePairs`](super::ellipsoid_triangle_pairs::EllipsoidTrianglePairs) to reject these
    /// eight at a time.
    pub fn test(
        &self,
        set: &TriangleSet,
        triangle: u32,
        thickness: f64,
        emit: &mut dyn FnMut(TriangleContact),
    ) {
        let view = &TriangleView::new(set, triangle);
        let (ellipsoid, prepared) = (&self.ellipsoid, &self.prepared);
        let height = view.height(&ellipsoid.center);
        let half_width = prepared.widened(&view.normal).norm();
        if height >= half_width || height <= -thickness.max(half_width) {
            return;
        }
        if passes_beside(prepared, view) {
            return;
        }
        let extent = view.corners.iter().map(|c| (c - ellipsoid.center).amax()).fold(0.0, f64::max);
        let foot_slack = FOOT_SLACK * (extent + prepared.largest + ellipsoid.center.amax());
        let edges = TriangleEdges::new(set, view);
        let tester =
            Tester { ellipsoid, prepared, set, view, edges, height, half_width, thickness, foot_slack };
        tester.emit_face(emit);
        for k in 0..3 {
            tester.emit_edge(k, emit);
        }
        for corner in 0..3 {
            tester.emit_vertex(corner, emit);
        }
    }
}

/// Returns `true` if the ellipsoid lies entirely outside of a plane that passes through an edge of the
/// triangle and is perpendicular to the triangle.
fn passes_beside(e: &PreparedEllipsoid, view: &TriangleView) -> bool {
    (0..3).any(|k| {
        let from = view.corners[k];
        let outward = (view.corners[(k + 1) % 3] - from).cross(&view.normal);
        let beyond = outward.dot(&(e.center - from));
        beyond > 0.0 && beyond * beyond > e.widened(&outward).norm_squared()
    })
}

/// Returns `true` if the foot, a point in the triangle's plane, lies inside the triangle.
fn holds_foot(edges: &TriangleEdges<'_>, foot: &Vec3) -> bool {
    !(0..3).any(|k| edges.is_beyond(k, foot))
}

struct Tester<'a> {
    ellipsoid: &'a Ellipsoid,
    prepared: &'a PreparedEllipsoid,
    set: &'a TriangleSet,
    view: &'a TriangleView,
    edges: TriangleEdges<'a>,
    /// Height of the centre above the face, m.
    height: f64,
    half_width: f64,
    thickness: f64,
    foot_slack: f64,
}

/// Local minimum of the overlap with an edge, among the normals between those of the edge's faces.
#[derive(Clone, Copy)]
struct EdgeMinimum {
    depth: f64,
    normal: Vec3,
    standing: Standing,
}

impl Tester<'_> {
    fn emit_face(&self, emit: &mut dyn FnMut(TriangleContact)) {
        let depth = self.half_width - self.height;
        let behind = self.is_behind(self.height);
        if behind && -self.height >= self.thickness - self.foot_slack {
            return;
        }
        let foot = self.foot_on(&self.view.normal, depth);
        let holds = holds_foot(&self.edges, &foot) || self.holds_in_a_crease(&foot);
        if !holds && !self.stands_in(&foot) {
            return;
        }
        let is_lost = || (0..3).any(|k| self.is_lost(k, &foot));
        let standing = match (holds, behind) {
            (true, true) => Standing::Behind,
            (true, false) => Standing::Front,
            (false, _) if is_lost() => Standing::StandIn,
            (false, true) => Standing::SpareBehind,
            (false, false) => Standing::Spare,
        };
        self.push(depth, &self.view.normal, Feature::face(self.view.index as usize), standing, emit);
    }

    /// Returns `true` if the foot lies outside the face only beyond concave edges, and only by rounding. A
    /// foot on the bottom line of a valley is therefore inside both faces.
    fn holds_in_a_crease(&self, foot: &Vec3) -> bool {
        (0..3).filter(|&k| self.edges.is_beyond(k, foot)).all(|k| {
            let is_concave = || match self.edges.class(k) {
                EdgeClass::Silent { outward, .. } => self.view.meets_concavely(&outward),
                EdgeClass::Free | EdgeClass::Convex { .. } => false,
            };
            self.edges.beyond(k, foot) <= self.foot_slack && is_concave()
        })
    }

    /// Returns `true` if the centre is on the line of edge `k`, up to rounding, and the edge may push.
    fn is_on_rim(&self, k: usize) -> bool {
        self.height.abs() <= self.foot_slack
            && self.edges.beyond(k, &self.ellipsoid.center).abs() <= self.foot_slack
            && !matches!(self.edges.class(k), EdgeClass::Silent { .. })
    }

    /// Returns `true` if the face gives a fallback although it does not contain its foot. Either rounding
    /// puts the foot outside, or the foot lies beyond concave or flat edges and the position of the centre
    /// decides (see the module documentation).
    fn stands_in(&self, foot: &Vec3) -> bool {
        let lost = |k: &usize| self.is_lost(*k, foot);
        if !self.is_behind(self.height) {
            return (0..3).filter(lost).all(|k| self.is_lost_beyond(k) && !self.center_is_beyond(k));
        }
        self.is_lost_in_folds(foot)
            && (!(0..3).any(|k| lost(&k))
                || !(0..3).any(|k| self.center_is_beyond(k))
                || has_behind(&self.edges, &self.ellipsoid.center, self.thickness, self.foot_slack))
    }

    /// Returns `true` if the foot lies beyond edge `k` by more than rounding.
    fn is_lost(&self, k: usize, foot: &Vec3) -> bool {
        self.edges.beyond(k, foot) > self.foot_slack
    }

    /// Returns `true` if edge `k` is concave or flat, and the foot on the neighbouring face lies beyond the
    /// edge as well.
    fn is_lost_beyond(&self, k: usize) -> bool {
        let EdgeClass::Silent { neighbor, outward } = self.edges.class(k) else { return false };
        self.is_lost_to(neighbor, &outward, &self.view.edge_ends(k)[0])
    }

    /// Returns `true` if each edge beyond which the foot lies is concave, and the foot on the neighbouring
    /// face lies beyond that edge as well. Coplanar triangles count as one face: across a flat edge the
    /// search continues in the next triangle, and the result is `false` if that triangle contains the foot.
    fn is_lost_in_folds(&self, foot: &Vec3) -> bool {
        /// Maximum number of coplanar triangles in the search; with more, the result is `false`.
        const TRIANGLES_MAX: usize = 32;
        let mut triangles = [self.view.index; TRIANGLES_MAX];
        let mut count = 1;
        let mut next = 0;
        while next < count {
            let view = TriangleView::new(self.set, triangles[next]);
            let edges = TriangleEdges::new(self.set, &view);
            let mut holds = true;
            for k in (0..3).filter(|&k| edges.beyond(k, foot) > self.foot_slack) {
                holds = false;
                let EdgeClass::Silent { neighbor, outward } = edges.class(k) else { return false };
                if view.meets_concavely(&outward) {
                    if !self.is_lost_to(neighbor, &outward, &view.edge_ends(k)[0]) {
                        return false;
                    }
                } else if !triangles[..count].contains(&neighbor) {
                    if count == TRIANGLES_MAX {
                        return false;
                    }
                    triangles[count] = neighbor;
                    count += 1;
                }
            }
            if holds && next > 0 {
                return false;
            }
            next += 1;
        }
        true
    }

    /// Returns `true` if the foot on `face`, the neighbour across an edge, lies beyond the edge as well, or
    /// if the ellipsoid is entirely above `face`. `outward` is perpendicular to the edge and points out of
    /// `face`; `end` is an end of the edge.
    fn is_lost_to(&self, face: u32, outward: &Vec3, end: &Vec3) -> bool {
        let other = TriangleView::new(self.set, face);
        let depth = self.prepared.widened(&other.normal).norm() - other.height(&self.ellipsoid.center);
        depth <= 0.0 || outward.dot(&(self.foot_on(&other.normal, depth) - end)) > self.foot_slack
    }

    /// Returns `true` if the centre lies beyond edge `k` by more than rounding.
    fn center_is_beyond(&self, k: usize) -> bool {
        self.edges.beyond(k, &self.ellipsoid.center) > self.foot_slack
    }

    /// Returns `true` if a centre at `height` (m) above a plane is behind the plane by more than rounding.
    fn is_behind(&self, height: f64) -> bool {
        height < -self.foot_slack
    }

    /// Returns the foot: the deepest point after the ellipsoid is pushed out by `depth` along `normal`.
    fn foot_on(&self, normal: &Vec3, depth: f64) -> Vec3 {
        self.prepared.deepest(normal) + normal * depth
    }

    fn emit_edge(&self, k: usize, emit: &mut dyn FnMut(TriangleContact)) {
        if !self.view.pushes_with_edge(self.set, k) {
            return;
        }
        let feature = Feature::edge(3 * self.view.index as usize + k);
        for minimum in self.edge_minima(k).iter().flatten() {
            self.push(minimum.depth, &minimum.normal, feature, minimum.standing, emit);
        }
    }

    /// Returns the local minima of the overlap with edge `k`, at normals along which the edge may push.
    fn edge_minima(&self, k: usize) -> [Option<EdgeMinimum>; 2] {
        if self.misses_edge(k) {
            return [None, None];
        }
        let [first, _] = self.view.edge_ends(k);
        let mut from_edge = self.ellipsoid.center - first;
        let neighbor = match self.edges.class(k) {
            EdgeClass::Silent { .. } => return [None, None],
            EdgeClass::Free if self.is_behind(self.height) => return [None, None],
            EdgeClass::Free => None,
            EdgeClass::Convex { normal, outward, .. } => Some((normal, outward)),
        };
        let outward = self.edges.outward(k);
        let mean =
            || (self.view.normal + neighbor.map_or(outward, |(other, _): (Vec3, Vec3)| other)).normalize();
        let on_rim = self.is_on_rim(k).then(mean);
        if let Some(mean) = on_rim {
            from_edge = mean * self.foot_slack;
        }
        let shadow = Shadow::new(self.prepared, &self.view.normal, &outward);
        let y = shadow.components(&from_edge);
        let at_foot = |foot: NormalFoot<2>, limit: f64| {
            if foot.depth <= 0.0 || foot.depth > limit {
                return None;
            }
            let normal = shadow.vector(&foot.normal);
            if on_rim.is_some_and(|mean| mean.dot(&normal) <= 0.0) {
                return None;
            }
            // Between nearly coplanar faces, `CONE_SLACK` would admit normals that point to the back, so
            // these are rejected here.
            if neighbor.is_some_and(|(other, _)| (self.view.normal + other).dot(&normal) <= 0.0) {
                return None;
            }
            let least = neighbor.map_or(f64::INFINITY, |(_, o)| o.dot(&normal)).min(outward.dot(&normal));
            let strictly = self.on_edge(k, &normal).filter(|_| least > -CONE_SLACK)?;
            let standing = self.standing(&normal, &first, strictly && least > 0.0)?;
            Some(EdgeMinimum { depth: foot.depth, normal, standing })
        };
        let may_hold = shadow.may_hold(&y, f64::INFINITY);
        let nearest = may_hold.then(|| nearest_on_ellipse(shadow.semi_axes, y));
        let own = self.half_width - self.height;
        let may_have_second = shadow.allows_second(own * (1.0 + SECOND_SLACK));
        let second = may_have_second.then(|| second_nearest_on_ellipse(shadow.semi_axes, y)).flatten();
        // The first minimum is never deeper than the edge's faces. If the second one is deeper than a face,
        // the face pushes instead.
        let limit = || {
            let other = |(n, _): (Vec3, Vec3)| self.prepared.widened(&n).norm() - n.dot(&from_edge);
            own.min(neighbor.map_or(f64::INFINITY, other)) * (1.0 + DEPTH_SLACK)
        };
        [
            nearest.and_then(|foot| at_foot(foot, f64::INFINITY)),
            second.and_then(|foot| at_foot(foot, limit())),
        ]
    }

    /// Returns `true` if edge `k` certainly has no minimum: the edge is outside the ellipsoid, and the
    /// overlap of the face is less than the smallest radius of curvature.
    ///
    /// With such an overlap, the foot of a minimum would lie inside the ellipsoid, in the ball of that radius
    /// that touches the ellipsoid from inside at the deepest point. So an edge outside the ellipsoid contains
    /// no such foot.
    fn misses_edge(&self, k: usize) -> bool {
        /// Margin far above rounding, in the unit-ball metric.
        const SLACK: f64 = 1e-6;
        if self.allows_second() {
            return false;
        }
        let [from, to] = [self.view.corners[k], self.view.corners[(k + 1) % 3]];
        let start = self.prepared.shrunk(&(from - self.ellipsoid.center));
        let along = self.prepared.shrunk(&(to - from));
        let share = (-start.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        let ends_slack = self.foot_slack / self.prepared.smallest;
        (start + along * share).norm_squared() > 1.0 + SLACK + 10.0 * ends_slack
    }

    /// Returns `true` if a second local minimum of an edge or a vertex may be less deep than this face.
    fn allows_second(&self) -> bool {
        self.prepared.allows_second((self.half_width - self.height) * (1.0 + SECOND_SLACK))
    }

    /// Tests whether the foot of a candidate lies between the ends of edge `k`. `Some(true)` if it does,
    /// `Some(false)` if only within rounding, otherwise `None`.
    fn on_edge(&self, k: usize, normal: &Vec3) -> Option<bool> {
        let deepest = self.prepared.deepest(normal);
        let [first, second] = self.view.edge_ends(k);
        let along = (second - first).normalize();
        let outside = (-along.dot(&(deepest - first))).max(along.dot(&(deepest - second)));
        (outside <= self.foot_slack).then_some(outside <= 0.0)
    }

    fn emit_vertex(&self, corner: usize, emit: &mut dyn FnMut(TriangleContact)) {
        if !self.view.may_own_vertex(self.set, corner) {
            return;
        }
        let apex = self.view.corners[corner];
        let y = self.ellipsoid.axes.tr_mul(&(self.ellipsoid.center - apex));
        let semi_axes = &self.ellipsoid.semi_axes;
        if y.component_div(semi_axes).norm_squared() < 1.0 {
            self.try_vertex(corner, &nearest_on_ellipsoid(semi_axes, &y), emit);
        }
        // A second minimum counts only if no face around the vertex is less deep. This face is tested first,
        // because its overlap is known.
        let second = self.allows_second().then(|| second_nearest_on_ellipsoid(semi_axes, &y)).flatten();
        if let Some(foot) = second.filter(|foot| self.no_deeper_than_the_fan(corner, foot.depth)) {
            self.try_vertex(corner, &foot, emit);
        }
    }

    fn try_vertex(&self, corner: usize, foot: &NormalFoot<3>, emit: &mut dyn FnMut(TriangleContact)) {
        if foot.depth <= 0.0 {
            return;
        }
        let normal = self.ellipsoid.axes * Vec3::from(foot.normal);
        let apex = self.view.corners[corner];
        // Quick test: most vertices fail at the two edges of their own triangle.
        for other in [self.view.corners[(corner + 1) % 3], self.view.corners[(corner + 2) % 3]] {
            let edge = other - apex;
            if normal.dot(&edge) > CONE_SLACK * edge.norm() {
                return;
            }
        }
        let mut in_front = |t: &TriangleView| !self.is_behind(t.height(&self.ellipsoid.center));
        let pushes = vertex_pushes(self.set, self.view.index, corner, &normal, &mut in_front);
        let Some(strictly) = pushes else { return };
        if let Some(standing) = self.standing(&normal, &apex, strictly) {
            let vertex = self.set.triangles[self.view.index as usize].vertices[corner];
            self.push(foot.depth, &normal, Feature::vertex(vertex as usize), standing, emit);
        }
    }

    fn no_deeper_than_the_fan(&self, corner: usize, depth: f64) -> bool {
        let mut least = f64::INFINITY;
        walk_fan(self.set, self.view.index, corner, &mut |t, _| {
            let view = TriangleView::new(self.set, t);
            let half_width = self.prepared.widened(&view.normal).norm();
            least = least.min(half_width - view.height(&self.ellipsoid.center));
        });
        depth <= least * (1.0 + DEPTH_SLACK)
    }

    /// Returns the standing of a candidate, from the height of the centre above the plane through `p`
    /// perpendicular to `normal`. `None` if the centre is too far behind this plane. `strictly` is true if
    /// the candidate pushes without any tolerance.
    fn standing(&self, normal: &Vec3, p: &Vec3, strictly: bool) -> Option<Standing> {
        let height = normal.dot(&(self.ellipsoid.center - p));
        if self.is_behind(height) {
            let within = -height < self.thickness - self.foot_slack;
            return within.then_some(if strictly { Standing::Behind } else { Standing::SpareBehind });
        }
        Some(if strictly { Standing::Front } else { Standing::Spare })
    }

    fn push(
        &self,
        depth: f64,
        normal: &Vec3,
        feature: Feature,
        standing: Standing,
        emit: &mut dyn FnMut(TriangleContact),
    ) {
        let deepest_b = self.prepared.deepest(normal);
        emit(TriangleContact {
            interference: Interference { depth, normal_b: *normal, deepest_b, feature },
            standing,
        });
    }
}
