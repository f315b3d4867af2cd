//! Features of a triangle surface and the normals along which they push: faces, edges, vertices
//! (docs/theory.md, 2.2).
//!
//! A triangle surface is a set of one-sided triangles joined at edges. Let *p* be the support point of a
//! shape that has a centre:
//!
//! * a face pushes along its normal if *p* lies over it;
//! * a convex edge pushes only along normals strictly between those of its two faces;
//! * a convex vertex pushes only inside its normal cone;
//! * a concave or flat edge never pushes: it is called *silent*;
//! * a free edge (one face only) pushes from the edge towards the centre, while the centre is in front.
//!
//! These regions of faces, edges and vertices partition the space in front of the surface. The plane between
//! two regions is computed from the same numbers for the features on both sides, so rounding opens no gap
//! between the regions. A silent edge has no region of its own: a point that rounding puts outside both of
//! its faces belongs to the face of lower index. Behind two faces that meet concavely there is a wedge that
//! lies beyond their common edge as seen from either face. The wedge belongs to both faces, as does the space
//! in front of the edge.

use super::{Feature, FeatureKind, Interference};
use crate::Vec3;
use crate::primitive::{NO_NEIGHBOR, TriangleSet};
use std::cell::OnceCell;

/// Sine of the angle between two faces above which they count as convex. Rounding in a unit normal computed
/// from f64 vertices stays below it for every triangle that the loader accepts.
const CONVEX_SINE_MIN: f64 = 1e-12;

/// Side of the triangle on which the centre lies, and whether the contact is only a fallback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Centre in front of the face.
    Front,
    /// Centre behind the face, within its thickness.
    Behind,
    /// Fallback, because rounding may assign the centre to this feature, to a feature beside it, or to
    /// neither. It counts if no other contact covers the centre.
    Spare,
    /// Fallback as `Spare`, for a face with the centre behind it.
    SpareBehind,
    /// Fallback for a face whose foot point lies beyond a concave edge. It counts if no other contact is as
    /// deep.
    StandIn,
}

/// Contact of a sphere or an ellipsoid with one triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleContact {
    /// Depth, normal, point and feature.
    pub interference: Interference,
    /// Side of the centre, and whether the contact is a fallback.
    pub standing: Standing,
}

/// Triangle with its plane, from which the regions of its face, edges and corners are derived.
#[derive(Clone, Copy, Debug)]
pub struct TriangleView {
    /// Index in the set.
    pub index: u32,
    /// Corners, counter-clockwise seen from the front, m.
    pub corners: [Vec3; 3],
    /// Unit normal towards the front.
    pub normal: Vec3,
}

/// Type of an edge.
#[derive(Clone, Copy, Debug)]
pub enum EdgeClass {
    /// Boundary edge of one face.
    Free,
    /// Edge of two faces that meet convexly.
    Convex {
        /// Triangle on the other side.
        neighbor: u32,
        /// Unit normal of the neighbour.
        normal: Vec3,
        /// Unit vector in the neighbour's plane, perpendicular to the edge, pointing out of the neighbour.
        outward: Vec3,
    },
    /// Edge of two faces that meet flat or concavely: it never pushes.
    Silent {
        /// Triangle on the other side.
        neighbor: u32,
        /// Unit vector in the neighbour's plane, perpendicular to the edge, pointing out of the neighbour.
        outward: Vec3,
    },
}

/// Sine of the angle between two faces above which they count as concave rather than flat. A foot point on
/// the edge between them lies in both faces if they are concave. If they are flat, it lies in one, and the
/// other gives a fallback.
const CONCAVE_SINE_MIN: f64 = 1e-9;

impl TriangleView {
    /// Returns `true` if the face across a silent edge (one that never pushes) meets this face concavely
    /// rather than flat. `outward`, as in [`EdgeClass::Silent`], lies in the plane of that other face, is
    /// perpendicular to the edge and points out of the other face.
    #[inline]
    pub fn meets_concavely(&self, outward: &Vec3) -> bool {
        self.normal.dot(outward) < -CONCAVE_SINE_MIN
    }

    /// Creates the view of one triangle of a set.
    #[inline]
    pub fn new(set: &TriangleSet, index: u32) -> Self {
        let corners = set.corners(index);
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
        Self { index, corners, normal }
    }

    /// Returns the height of a point above the plane, m; positive in front.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(&(p - self.corners[0]))
    }

    /// Returns the ends of edge `k`, ordered by x, then y, then z, so that both of its triangles give the
    /// same order.
    #[inline]
    pub fn edge_ends(&self, k: usize) -> [Vec3; 2] {
        let (a, b) = (self.corners[k], self.corners[(k + 1) % 3]);
        if lexicographically_before(&b, &a) { [b, a] } else { [a, b] }
    }

    /// Returns the unit vector in the triangle's plane that is perpendicular to edge `k` and points out of
    /// the triangle.
    #[inline]
    pub fn outward(&self, k: usize) -> Vec3 {
        (self.corners[(k + 1) % 3] - self.corners[k]).cross(&self.normal).normalize()
    }

    /// Returns the type of edge `k`.
    pub fn classify_edge(&self, set: &TriangleSet, k: usize) -> EdgeClass {
        let neighbor = set.triangles[self.index as usize].neighbors[k];
        if neighbor == NO_NEIGHBOR {
            return EdgeClass::Free;
        }
        let other = Self::new(set, neighbor);
        let twin = edge_towards(set, neighbor, self.index);
        let outward = other.outward(twin);
        if self.normal.dot(&outward) > CONVEX_SINE_MIN {
            EdgeClass::Convex { neighbor, normal: other.normal, outward }
        } else {
            EdgeClass::Silent { neighbor, outward }
        }
    }

    /// Returns `true` if edge `k` may push and this triangle owns it.
    #[inline]
    pub(super) fn pushes_with_edge(&self, set: &TriangleSet, k: usize) -> bool {
        set.triangles[self.index as usize].may_push.edge(k) && self.owns_edge(set, k)
    }

    /// Returns `true` if the vertex may push and this triangle may own it. That is so if both neighbours at
    /// the vertex have higher indices; the other triangles around the vertex are not tested.
    #[inline]
    pub(super) fn may_own_vertex(&self, set: &TriangleSet, corner: usize) -> bool {
        let may_push = set.triangles[self.index as usize].may_push.vertex(corner);
        may_push && self.owns_edge(set, corner) && self.owns_edge(set, (corner + 2) % 3)
    }

    /// Returns `true` if this triangle owns edge `k`: the edge is free, or the triangle has the lower index
    /// of the two that share it.
    #[inline]
    pub fn owns_edge(&self, set: &TriangleSet, k: usize) -> bool {
        let neighbor = set.triangles[self.index as usize].neighbors[k];
        neighbor == NO_NEIGHBOR || self.index < neighbor
    }
}

/// Edges of a triangle, each computed on first use.
pub(super) struct TriangleEdges<'a> {
    pub set: &'a TriangleSet,
    pub view: &'a TriangleView,
    outwards: [OnceCell<Vec3>; 3],
    classes: [OnceCell<EdgeClass>; 3],
}

impl<'a> TriangleEdges<'a> {
    pub fn new(set: &'a TriangleSet, view: &'a TriangleView) -> Self {
        Self { set, view, outwards: Default::default(), classes: Default::default() }
    }

    /// Same as [`TriangleView::outward`], cached.
    #[inline]
    pub fn outward(&self, k: usize) -> Vec3 {
        *self.outwards[k].get_or_init(|| self.view.outward(k))
    }

    /// Same as [`TriangleView::classify_edge`], cached.
    #[inline]
    pub fn class(&self, k: usize) -> EdgeClass {
        *self.classes[k].get_or_init(|| self.view.classify_edge(self.set, k))
    }

    /// Returns the distance of a point beyond edge `k`, measured in the triangle's plane, m; negative within
    /// the edge.
    #[inline]
    pub fn beyond(&self, k: usize, p: &Vec3) -> f64 {
        self.outward(k).dot(&(p - self.view.edge_ends(k)[0]))
    }

    /// Returns `true` if a point lies beyond edge `k`, or if the distance is NaN.
    #[inline]
    pub fn is_beyond(&self, k: usize, p: &Vec3) -> bool {
        let beyond = self.beyond(k, p);
        beyond > 0.0 || beyond.is_nan()
    }

    /// Returns `true` if a point in front of the triangle and beyond edge `k` still belongs to the triangle.
    /// By rounding, a point may be beyond a silent (concave or flat) edge as seen from both of its faces; it
    /// then belongs to the face of lower index. If the normals of the two faces are a right angle or more
    /// apart, the result is `false`: the point is outside the fold, where neither face pushes.
    pub fn has_on_seam(&self, k: usize, p: &Vec3) -> bool {
        let EdgeClass::Silent { neighbor, outward } = self.class(k) else { return false };
        outward.dot(&(p - self.view.edge_ends(k)[0])) > 0.0
            && self.view.index < neighbor
            && self.view.normal.dot(&self.set.normal(neighbor)) > 0.0
    }
}

/// Triangles around one vertex, reached from one of them across shared edges.
#[derive(Clone, Copy, Debug)]
pub struct Fan {
    /// Lowest index of the triangles of the fan; this triangle owns the vertex.
    pub lowest: u32,
    /// True if the fan ends at free edges, false if it closes.
    pub open: bool,
}

/// Visits all triangles around corner `corner` of `triangle`. `visit` is called once per triangle, with the
/// triangle's index and the corner's index in it.
pub fn walk_fan(set: &TriangleSet, triangle: u32, corner: usize, visit: &mut dyn FnMut(u32, usize)) -> Fan {
    let all = walk_fan_while(set, triangle, corner, |t, at| {
        visit(t, at);
        true
    });
    all.expect("nothing ends the walk")
}

/// Same as [`walk_fan`], but stops when `visit` returns `false`; the result is then `None`.
#[inline]
pub(super) fn walk_fan_while(
    set: &TriangleSet,
    triangle: u32,
    corner: usize,
    mut visit: impl FnMut(u32, usize) -> bool,
) -> Option<Fan> {
    let vertex = set.triangles[triangle as usize].vertices[corner];
    let mut fan = Fan { lowest: triangle, open: false };
    if !visit(triangle, corner) {
        return None;
    }
    // Walks across the edge that ends in the corner, and if the fan is open, then across the edge that starts
    // in the corner.
    for side in [2, 0] {
        let (mut current, mut at) = (triangle, corner);
        loop {
            let next = set.triangles[current as usize].neighbors[(at + side) % 3];
            if next == NO_NEIGHBOR {
                fan.open = true;
                break;
            }
            if next == triangle {
                return Some(fan);
            }
            at = corner_of(set, next, vertex);
            current = next;
            fan.lowest = fan.lowest.min(current);
            if !visit(current, at) {
                return None;
            }
        }
    }
    Some(fan)
}

/// Tests whether a vertex pushes along `direction`, which points from the vertex to the centre (any length).
/// `Some(true)` if the direction is strictly inside the vertex's normal cone, `Some(false)` if it is on the
/// boundary of the cone within rounding. Otherwise `None`, and also if
///
/// * a triangle of lower index owns the vertex;
/// * the fan is open and the centre is behind all of its faces;
/// * the fan is closed and seen from its back, as the bottom of a pit from within the solid.
///
/// `center_in_front`, called once per triangle of the fan, returns `true` if the centre is in front of that
/// triangle.
///
/// *Front or back.* If the direction is in the cone, all edges of the fan descend from the vertex, seen along
/// `direction`. Their lines meet a plane that is below the vertex and perpendicular to `direction` in the
/// corners of a simple polygon. The polygon runs counter-clockwise if the centre sees the front of the
/// surface, clockwise if it sees the back. The sum of the signed areas of the polygon's triangles around the
/// vertex's projection gives the orientation.
pub fn vertex_pushes(
    set: &TriangleSet,
    triangle: u32,
    corner: usize,
    direction: &Vec3,
    center_in_front: &mut dyn FnMut(&TriangleView) -> bool,
) -> Option<bool> {
    /// Rounding of the product of a unit direction and a unit edge.
    const CONE_COSINE_SLACK: f64 = 1e-12;
    let apex = set.corners(triangle)[corner];
    let length = direction.norm();
    // At the vertex itself there is no direction, and the scale of 1 avoids a division by zero.
    let scale = if length > 0.0 { length } else { 1.0 };
    let (mut strictly, mut in_front) = (true, false);
    let mut turn = 0.0;
    // The walk stops early, because most vertices fail at one of the first triangles.
    let fan = walk_fan_while(set, triangle, corner, |t, at| {
        let corners = set.corners(t);
        let edges = [corners[(at + 1) % 3] - apex, corners[(at + 2) % 3] - apex];
        let mut below = 1.0;
        for edge in &edges {
            let product = direction.dot(edge);
            let edge_length = edge.norm();
            strictly &= product < 0.0;
            let nearly = product <= CONE_COSINE_SLACK * scale * edge_length;
            if !nearly || t < triangle {
                return false;
            }
            below *= edge_length * (-product / (scale * edge_length)).max(CONE_COSINE_SLACK);
        }
        turn += direction.dot(&edges[0].cross(&edges[1])) / (scale * below);
        in_front |= center_in_front(&TriangleView::new(set, t));
        true
    })?;
    let seen_from_front = if fan.open { in_front } else { length == 0.0 || turn > 0.0 };
    seen_from_front.then_some(strictly)
}

/// Returns `true` if a point whose nearest surface point is the vertex sees the front of the surface there.
/// `direction` points from the vertex to the point (any length). A point at the vertex counts as in front.
///
/// The orientation of the polygon described at [`vertex_pushes`] decides, here for closed and open fans.
pub fn vertex_is_seen_from_front(set: &TriangleSet, triangle: u32, corner: usize, direction: &Vec3) -> bool {
    /// Lower limit of the cosine, because an edge perpendicular to the direction would meet the polygon's
    /// plane at infinity.
    const COSINE_MIN: f64 = 1e-12;
    let apex = set.corners(triangle)[corner];
    let length = direction.norm();
    if length == 0.0 {
        return true;
    }
    let mut turn = 0.0;
    walk_fan(set, triangle, corner, &mut |t, at| {
        let corners = set.corners(t);
        let edges = [corners[(at + 1) % 3] - apex, corners[(at + 2) % 3] - apex];
        let below = edges.map(|edge| (-direction.dot(&edge)).max(COSINE_MIN * length * edge.norm()));
        turn += direction.dot(&edges[0].cross(&edges[1])) * (length / below[0]) * (length / below[1]);
    });
    turn >= 0.0
}

/// Returns `true` if a point is in front of one of the faces that meet at a feature of a triangle, or behind
/// that face by at most `rounding` (m).
pub fn is_in_front_of_a_face(
    p: &Vec3,
    set: &TriangleSet,
    triangle: u32,
    feature: Feature,
    rounding: f64,
) -> bool {
    let in_front = |t: u32| TriangleView::new(set, t).height(p) >= -rounding;
    let record = &set.triangles[triangle as usize];
    match feature.kind() {
        FeatureKind::Face => in_front(triangle),
        FeatureKind::Edge => {
            let neighbor = record.neighbors[feature.index() % 3];
            in_front(triangle) || (neighbor != NO_NEIGHBOR && in_front(neighbor))
        }
        FeatureKind::Vertex => {
            let corner = corner_of(set, triangle, feature.index() as u32);
            walk_fan_while(set, triangle, corner, |t, _| !in_front(t)).is_none()
        }
    }
}

/// Returns a point on a feature of a triangle surface, m; `None` if the set has no such feature.
pub fn place_on_feature(set: &TriangleSet, feature: Feature) -> Option<Vec3> {
    let index = feature.index();
    let corner = |triangle: usize, k: usize| Some(set.triangles.get(triangle)?.vertices[k] as usize);
    let vertex = match feature.kind() {
        FeatureKind::Face => corner(index, 0)?,
        FeatureKind::Edge => corner(index / 3, index % 3)?,
        FeatureKind::Vertex => index,
    };
    set.vertices.get(vertex).copied()
}

fn corner_of(set: &TriangleSet, triangle: u32, vertex: u32) -> usize {
    let vertices = &set.triangles[triangle as usize].vertices;
    (0..3).find(|&i| vertices[i] == vertex).expect("neighbours share the vertex")
}

fn edge_towards(set: &TriangleSet, triangle: u32, neighbor: u32) -> usize {
    let own = &set.triangles[triangle as usize];
    let other = &set.triangles[neighbor as usize];
    (0..3)
        .find(|&k| {
            own.neighbors[k] == neighbor
                && other.vertices.contains(&own.vertices[k])
                && other.vertices.contains(&own.vertices[(k + 1) % 3])
        })
        .expect("neighbours share an edge")
}

/// Returns `true` if `a` is the first of the two ends of an edge, in an order that both faces of the edge
/// use.
#[inline]
pub(super) fn lexicographically_before(a: &Vec3, b: &Vec3) -> bool {
    (a.x, a.y, a.z) < (b.x, b.y, b.z)
}
