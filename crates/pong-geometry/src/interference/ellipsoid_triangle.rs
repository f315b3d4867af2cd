//! Ellipsoid (A) – triangle (B), one-sided (physics contract, 2.1 and 2.2).
//!
//! Each feature has the candidates of [`ellipsoid_polyhedron`](super::ellipsoid_polyhedron): a face its normal, an edge
//! and a vertex the at most two local minima of the overlap of a line or a point with the ellipsoid. An ellipsoid has
//! no single nearest point: what decides between features is where the deepest point's foot lies and between which
//! normals a minimum lies. While the depth is less than the smallest radius of curvature, as for a sphere, exactly one
//! of the features that meet convexly claims a place. Deeper, several may; then only the less deep pushes, as in a
//! polyhedron: a face yields to its edges' minima, and to a convex neighbour that is less deep and holds its own foot
//! (with the centre behind: that is less deep at all). So depth stays continuous where one hands over to the other.
//!
//! "In front" is measured at the centre: above the face, or above the plane through the edge or vertex across the
//! normal at hand. What only rounding keeps from pushing is emitted as spare.
//!
//! Degenerate cases: centre in the plane, on an edge or a vertex counts as in front; there the nearest surface point's
//! normal decides.

use super::ellipsoid_math::{
    NormalFoot, nearest_on_ellipse, nearest_on_ellipsoid, second_nearest_on_ellipse,
    second_nearest_on_ellipsoid,
};
use super::ellipsoid_prepared::{PreparedEllipsoid, Shadow};
use super::triangle_features::{EdgeClass, Standing, TriangleContact, TriangleView, vertex_pushes, walk_fan};
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Ellipsoid, TriangleSet};

/// How far outside its feature a foot may lie, as a share of the sizes involved, and still be emitted as spare.
const FOOT_SLACK: f64 = 1e-12;
/// How far outside the normals of its edge a normal may lie (sine) and still be emitted as spare.
const CONE_SLACK: f64 = 1e-9;
/// Two depths within this share count as equal.
const DEPTH_SLACK: f64 = 1e-9;

/// Tests an ellipsoid against one triangle and emits a contact for each of its features that pushes.
///
/// `thickness` (m): how far behind the centre may be and still be pushed to the front. Edges and vertices are emitted
/// by their owner alone, so that over a whole surface each feature counts once.
pub fn ellipsoid_triangle(
    ellipsoid: &Ellipsoid,
    set: &TriangleSet,
    triangle: u32,
    thickness: f64,
    emit: &mut dyn FnMut(TriangleContact),
) {
    let prepared = PreparedEllipsoid::new(ellipsoid);
    let view = TriangleView::new(set, triangle);
    let height = view.height(&ellipsoid.center);
    let half_width = prepared.widened(&view.normal).norm();
    if height >= half_width || height <= -thickness.max(half_width) {
        return;
    }
    if passes_beside(&prepared, &view) {
        return;
    }
    let extent = view.corners.iter().map(|c| (c - ellipsoid.center).amax()).fold(0.0, f64::max);
    let foot_slack = FOOT_SLACK * (extent + prepared.largest + ellipsoid.center.amax());
    let tester = Tester { ellipsoid, prepared, set, view, height, half_width, thickness, foot_slack };
    tester.emit_face(emit);
    for k in 0..3 {
        tester.emit_edge(k, emit);
    }
    for corner in 0..3 {
        tester.emit_vertex(corner, emit);
    }
}

/// Whether the ellipsoid lies wholly beyond a plane through an edge, across the triangle.
fn passes_beside(e: &PreparedEllipsoid, view: &TriangleView) -> bool {
    (0..3).any(|k| {
        let from = view.corners[k];
        let outward = (view.corners[(k + 1) % 3] - from).cross(&view.normal);
        let beyond = outward.dot(&(e.center - from));
        beyond > 0.0 && beyond * beyond > e.widened(&outward).norm_squared()
    })
}

struct Tester<'a> {
    ellipsoid: &'a Ellipsoid,
    prepared: PreparedEllipsoid,
    set: &'a TriangleSet,
    view: TriangleView,
    /// Of the centre above the face, m.
    height: f64,
    half_width: f64,
    thickness: f64,
    foot_slack: f64,
}

/// A local minimum over the normals between those of an edge's faces.
struct EdgeMinimum {
    depth: f64,
    normal: Vec3,
    /// Not only within rounding.
    strictly: bool,
}

impl Tester<'_> {
    fn emit_face(&self, emit: &mut dyn FnMut(TriangleContact)) {
        let depth = self.half_width - self.height;
        let behind = self.height < 0.0;
        if behind && -self.height >= self.thickness {
            return;
        }
        let foot = self.foot_on(&self.view.normal, depth);
        let holds = self.view.holds_foot(self.set, &foot);
        if !holds && (0..3).any(|k| self.view.beyond_edge(k, &foot) > self.foot_slack) {
            return;
        }
        if (0..3).any(|k| self.edge_is_less_deep(k, depth)) {
            return;
        }
        let standing = match (holds, behind) {
            (false, _) => Standing::Spare,
            (true, true) => Standing::Behind,
            (true, false) => Standing::Front,
        };
        self.push(depth, &self.view.normal, Feature::face(self.view.index as usize), standing, emit);
    }

    /// Whether edge `k`, or the face that meets this one convexly there, pushes instead of this face.
    fn edge_is_less_deep(&self, k: usize, depth: f64) -> bool {
        match self.view.classify_edge(self.set, k) {
            EdgeClass::Silent { .. } => false,
            EdgeClass::Free => self.height >= 0.0 && self.minimum_less_deep_than(k, depth),
            EdgeClass::Convex { neighbor, normal, .. } => {
                let other = TriangleView::new(self.set, neighbor);
                let height = other.height(&self.ellipsoid.center);
                let other_depth = self.prepared.widened(&normal).norm() - height;
                let less = other_depth < depth || (other_depth == depth && neighbor < self.view.index);
                let holds = || other.holds_foot(self.set, &self.foot_on(&normal, other_depth));
                if less && (self.height < 0.0 || holds()) {
                    return true;
                }
                let bound = self.prepared.arc_bound(&[self.view.normal, normal], &[self.height, height]);
                bound < depth * (1.0 - DEPTH_SLACK) && self.minimum_less_deep_than(k, depth)
            }
        }
    }

    /// Where the deepest point comes to lie once the ellipsoid is pushed out.
    fn foot_on(&self, normal: &Vec3, depth: f64) -> Vec3 {
        self.prepared.deepest(normal) + normal * depth
    }

    fn minimum_less_deep_than(&self, k: usize, depth: f64) -> bool {
        let mut found = false;
        self.visit_edge_minima(k, &mut |minimum| {
            found |= minimum.strictly && minimum.depth < depth * (1.0 - DEPTH_SLACK);
        });
        found
    }

    fn emit_edge(&self, k: usize, emit: &mut dyn FnMut(TriangleContact)) {
        if !self.view.owns_edge(self.set, k) {
            return;
        }
        let feature = Feature::edge(3 * self.view.index as usize + k);
        let first = self.view.edge_ends(k)[0];
        self.visit_edge_minima(k, &mut |minimum| {
            if let Some(standing) = self.standing(&minimum.normal, &first, minimum.strictly) {
                self.push(minimum.depth, &minimum.normal, feature, standing, emit);
            }
        });
    }

    /// The minima over the normals that edge `k` may push along.
    fn visit_edge_minima(&self, k: usize, visit: &mut dyn FnMut(EdgeMinimum)) {
        let outward = self.view.outward(k);
        let [first, _] = self.view.edge_ends(k);
        let from_edge = self.ellipsoid.center - first;
        let neighbor = match self.view.classify_edge(self.set, k) {
            EdgeClass::Silent { .. } => return,
            EdgeClass::Free if self.height < 0.0 => return,
            EdgeClass::Free => None,
            EdgeClass::Convex { normal, outward, .. } => Some((normal, outward)),
        };
        let shadow = Shadow::new(&self.prepared, &self.view.normal, &outward);
        let y = shadow.components(&from_edge);
        let mut try_foot = |foot: &NormalFoot<2>, limit: f64| {
            if foot.depth > 0.0 && foot.depth <= limit {
                let normal = shadow.vector(&foot.normal);
                let least = neighbor.map_or(f64::INFINITY, |(_, o)| o.dot(&normal)).min(outward.dot(&normal));
                if let Some(strictly) = self.on_edge(k, &normal).filter(|_| least > -CONE_SLACK) {
                    visit(EdgeMinimum { depth: foot.depth, normal, strictly: strictly && least > 0.0 });
                }
            }
        };
        if shadow.may_hold(&y, f64::INFINITY) {
            try_foot(&nearest_on_ellipse(shadow.semi_axes, y), f64::INFINITY);
        }
        if let Some(foot) = second_nearest_on_ellipse(shadow.semi_axes, y) {
            // The nearest point is never deeper than the faces; this one may be, and then they push.
            let other =
                neighbor.map_or(f64::INFINITY, |(n, _)| self.prepared.widened(&n).norm() - n.dot(&from_edge));
            try_foot(&foot, (self.half_width - self.height).min(other) * (1.0 + DEPTH_SLACK));
        }
    }

    /// Whether the deepest point's foot lies between the ends of edge `k`: `Some(strictly)` within rounding.
    fn on_edge(&self, k: usize, normal: &Vec3) -> Option<bool> {
        let deepest = self.prepared.deepest(normal);
        let [first, second] = self.view.edge_ends(k);
        let along = (second - first).normalize();
        let outside = (-along.dot(&(deepest - first))).max(along.dot(&(deepest - second)));
        (outside <= self.foot_slack).then_some(outside <= 0.0)
    }

    fn emit_vertex(&self, corner: usize, emit: &mut dyn FnMut(TriangleContact)) {
        let apex = self.view.corners[corner];
        let y = self.ellipsoid.axes.tr_mul(&(self.ellipsoid.center - apex));
        let semi_axes = &self.ellipsoid.semi_axes;
        if y.component_div(semi_axes).norm_squared() < 1.0 {
            self.try_vertex(corner, &nearest_on_ellipsoid(semi_axes, &y), emit);
        }
        let second = second_nearest_on_ellipsoid(semi_axes, &y);
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
        // Most vertices fail at the two edges of their own triangle: no need to walk around them.
        for other in [self.view.corners[(corner + 1) % 3], self.view.corners[(corner + 2) % 3]] {
            let edge = other - apex;
            if normal.dot(&edge) > CONE_SLACK * edge.norm() {
                return;
            }
        }
        let mut in_front = |t: &TriangleView| t.height(&self.ellipsoid.center) >= 0.0;
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

    /// `None` if the centre is too far behind the plane through `p` across the normal.
    fn standing(&self, normal: &Vec3, p: &Vec3, strictly: bool) -> Option<Standing> {
        let height = normal.dot(&(self.ellipsoid.center - p));
        if height < 0.0 {
            return (strictly && -height < self.thickness).then_some(Standing::Behind);
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
        let point_a = self.prepared.deepest(normal);
        emit(TriangleContact {
            interference: Interference { depth, normal: *normal, point_a, feature },
            standing,
        });
    }
}
