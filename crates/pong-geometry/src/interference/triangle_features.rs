//! What the features of a triangle surface may push: faces, edges, vertices (docs/theory.md, 2.2).
//!
//! A triangle surface is a set of one-sided facets joined at edges. For a support point *p*:
//!
//! * a face pushes along its normal when *p* lies over it;
//! * a convex edge pushes only along normals strictly between those of its two faces;
//! * a convex vertex pushes only inside its normal cone;
//! * concave and flat edges are silent;
//! * a free edge (one face only) pushes from the edge towards the centre, while the centre is in front.
//!
//! The three kinds of regions partition the space in front. Each bounding plane is computed once, from the same
//! numbers, for the features on both its sides, so that rounding opens no gap between them; where an edge is
//! silent there is no third region, and a point that rounding puts outside both faces belongs to the lower one. Behind two
//! faces that meet concavely there is a wedge beyond both: it belongs to both, as the space in front of their line does.

use super::{Feature, FeatureKind, Interference};
use crate::Vec3;
use crate::primitive::{NO_NEIGHBOR, TriangleSet};
use std::cell::OnceCell;

/// Two faces count as convex only if the sine of the angle between them exceeds this: rounding in a unit normal
/// computed from f64 vertices stays below it for every triangle that the loader accepts as flat.
const CONVEX_SINE_MIN: f64 = 1e-12;

/// How a contact of a triangle surface stands among its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The centre is in front.
    Front,
    /// The centre is behind the face, within its thickness.
    Behind,
    /// It pushes within rounding alone: beside what it belongs to lies another feature, and rounding decides which of the
    /// two, or neither, has the place. It counts where no other contact has it.
    Spare,
    /// A spare face with the centre behind it.
    SpareBehind,
    /// A face that has lost its foot beyond a concave edge and stands in for it: counts where nothing else is as deep.
    StandIn,
}

/// A contact of a sphere or an ellipsoid with one triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleContact {
    /// Depth, normal, point, feature.
    pub interference: Interference,
    /// How it stands.
    pub standing: Standing,
}

/// A triangle with the planes that bound its regions.
#[derive(Clone, Copy, Debug)]
pub struct TriangleView {
    /// Its index in the set.
    pub index: u32,
    /// Corners, counter-clockwise seen from the front, m.
    pub corners: [Vec3; 3],
    /// Unit normal to the front.
    pub normal: Vec3,
}

/// What an edge may do.
#[derive(Clone, Copy, Debug)]
pub enum EdgeClass {
    /// One face only.
    Free,
    /// Two faces that meet convexly.
    Convex {
        /// The triangle on the other side.
        neighbor: u32,
        /// Its unit normal.
        normal: Vec3,
        /// Unit vector in its plane, across the edge, out of it.
        outward: Vec3,
    },
    /// Two faces that meet flat or concavely: the edge never pushes.
    Silent {
        /// The triangle on the other side.
        neighbor: u32,
        /// Unit vector in its plane, across the edge, out of it.
        outward: Vec3,
    },
}

/// Two faces count as meeting concavely, and not flat, only if the sine of the angle between them exceeds this: on a seam
/// of a flat plate one face holds the foot, and the other is spare.
const CONCAVE_SINE_MIN: f64 = 1e-9;

impl TriangleView {
    /// Whether the face beyond a silent edge, whose direction out of that face is `outward`, meets this one concavely.
    #[inline]
    pub fn meets_concavely(&self, outward: &Vec3) -> bool {
        self.normal.dot(outward) < -CONCAVE_SINE_MIN
    }

    /// The view of one triangle of a set.
    #[inline]
    pub fn new(set: &TriangleSet, index: u32) -> Self {
        let corners = set.corners(index);
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
        Self { index, corners, normal }
    }

    /// Signed distance of a point in front of the plane, m.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(&(p - self.corners[0]))
    }

    /// The two ends of edge `k` in (x, y, z) order.
    #[inline]
    pub fn edge_ends(&self, k: usize) -> [Vec3; 2] {
        let (a, b) = (self.corners[k], self.corners[(k + 1) % 3]);
        if lexicographically_before(&b, &a) { [b, a] } else { [a, b] }
    }

    /// Unit vector in the plane, across edge `k`, out of the triangle.
    #[inline]
    pub fn outward(&self, k: usize) -> Vec3 {
        (self.corners[(k + 1) % 3] - self.corners[k]).cross(&self.normal).normalize()
    }

    /// What edge `k` may do.
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

    /// Whether this triangle owns edge `k`, which may push.
    #[inline]
    pub(super) fn pushes_with_edge(&self, set: &TriangleSet, k: usize) -> bool {
        set.triangles[self.index as usize].may_push.edge(k) && self.owns_edge(set, k)
    }

    /// Whether this triangle can be the lowest of the fan around a corner, by the two that it shares edges with there,
    /// and the vertex may push.
    #[inline]
    pub(super) fn may_own_vertex(&self, set: &TriangleSet, corner: usize) -> bool {
        let may_push = set.triangles[self.index as usize].may_push.vertex(corner);
        may_push && self.owns_edge(set, corner) && self.owns_edge(set, (corner + 2) % 3)
    }

    /// Whether this triangle is the owner of edge `k`: the lower of the two that share it.
    #[inline]
    pub fn owns_edge(&self, set: &TriangleSet, k: usize) -> bool {
        let neighbor = set.triangles[self.index as usize].neighbors[k];
        neighbor == NO_NEIGHBOR || self.index < neighbor
    }
}

/// The edges of a triangle, each worked out when it is first asked for.
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

    /// As [`TriangleView::outward`].
    #[inline]
    pub fn outward(&self, k: usize) -> Vec3 {
        *self.outwards[k].get_or_init(|| self.view.outward(k))
    }

    /// As [`TriangleView::classify_edge`].
    #[inline]
    pub fn class(&self, k: usize) -> EdgeClass {
        *self.classes[k].get_or_init(|| self.view.classify_edge(self.set, k))
    }

    /// Signed distance of a point beyond edge `k`, along the plane, m.
    #[inline]
    pub fn beyond(&self, k: usize, p: &Vec3) -> f64 {
        self.outward(k).dot(&(p - self.view.edge_ends(k)[0]))
    }

    /// Whether a point lies beyond edge `k`; a NaN does.
    #[inline]
    pub fn is_beyond(&self, k: usize, p: &Vec3) -> bool {
        let beyond = self.beyond(k, p);
        beyond > 0.0 || beyond.is_nan()
    }

    /// Whether a point in front of the triangle and beyond edge `k` still belongs to it: on the seam that rounding leaves at a
    /// silent edge, beyond both of its faces, the lower has it. But two faces folded to less than a right angle have such
    /// points outside the fold, where neither pushes.
    pub fn has_on_seam(&self, k: usize, p: &Vec3) -> bool {
        let EdgeClass::Silent { neighbor, outward } = self.class(k) else { return false };
        outward.dot(&(p - self.view.edge_ends(k)[0])) > 0.0
            && self.view.index < neighbor
            && self.view.normal.dot(&self.set.normal(neighbor)) > 0.0
    }
}

/// The triangles around one vertex, reached from one of them across shared edges.
#[derive(Clone, Copy, Debug)]
pub struct Fan {
    /// The lowest triangle of the fan: the vertex's owner.
    pub lowest: u32,
    /// Whether the fan ends at free edges instead of closing.
    pub open: bool,
}

/// Walks the fan around corner `corner` of `triangle` and calls `visit` with every triangle of it and that
/// triangle's index of the corner, each once.
pub fn walk_fan(set: &TriangleSet, triangle: u32, corner: usize, visit: &mut dyn FnMut(u32, usize)) -> Fan {
    let all = walk_fan_while(set, triangle, corner, |t, at| {
        visit(t, at);
        true
    });
    all.expect("nothing ends the walk")
}

/// As [`walk_fan`], as long as `visit` says so; `None` if it ended the walk.
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
    // Across the edge that ends in the corner, then, if the fan is open, across the edge that starts there.
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

/// Whether a normal lies in the cone of a vertex, `Some(strictly)`; `None` if it is outside by more than
/// rounding, if the vertex belongs to a lower triangle, if an open fan has its centre behind all its faces, or a
/// closed fan is seen from its back (the bottom of a pit, from within the solid).
///
/// `direction` points from the vertex to the centre (any length), `center_in_front` answers for one triangle of
/// an open fan.
///
/// All edges of a fan around its cone lie in the half space below `direction`. Seen along it from the vertex
/// they pierce a plane in the corners of a polygon without crossings, which runs counter-clockwise if the front
/// is seen and clockwise if the back is. The sum of its triangles with the vertex' own foot gives the sense.
pub fn vertex_pushes(
    set: &TriangleSet,
    triangle: u32,
    corner: usize,
    direction: &Vec3,
    center_in_front: &mut dyn FnMut(&TriangleView) -> bool,
) -> Option<bool> {
    /// Rounding in a product of a unit direction and a unit edge.
    const CONE_COSINE_SLACK: f64 = 1e-12;
    let apex = set.corners(triangle)[corner];
    let length = direction.norm();
    // In the vertex itself there is no direction, and nothing is divided by its length.
    let scale = if length > 0.0 { length } else { 1.0 };
    let (mut strictly, mut in_front) = (true, false);
    let mut turn = 0.0;
    // Most vertices fail at one of the first triangles.
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

/// Whether the surface around a vertex is seen from its front, for a point of which the vertex is the nearest place;
/// `direction` points from the vertex to the point (any length). A point in the vertex counts as in front.
///
/// As in [`vertex_pushes`], the sum of the triangles that the edges make in a plane across `direction` has the sense in
/// which the surface runs around the vertex, whether the fan is closed or open.
pub fn vertex_is_seen_from_front(set: &TriangleSet, triangle: u32, corner: usize, direction: &Vec3) -> bool {
    /// An edge across the direction would reach infinitely far in that plane.
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

/// Whether a point is in front of one of the faces that meet at a feature of a triangle, or behind it by no more than
/// `rounding` (m).
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

/// A place on a feature of a triangle surface, m; `None` if the set has no such feature.
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

/// The order in which both faces of an edge see its ends.
#[inline]
pub(super) fn lexicographically_before(a: &Vec3, b: &Vec3) -> bool {
    (a.x, a.y, a.z) < (b.x, b.y, b.z)
}
