//! Ellipsoid (A) – polyhedron (B): the minimum translation, exact, feature by feature.
//!
//! Over unit normals the overlap is `D(n) = h_E(n) − n·c + h_P(n)`, with the support functions h of the ellipsoid
//! about its centre c and of the polyhedron; the depth is its minimum. At the minimiser one feature of the
//! polyhedron supports it:
//!
//! * a face: `n` is its normal, and the foot of the ellipsoid's deepest point lies in its outline;
//! * an edge: `n` lies between the normals of its two faces and is a local minimum of the overlap of the edge's line,
//!   which is that of a point and an ellipse seen along the edge; the deepest point's foot lies between the ends;
//! * a vertex: `n` lies in its normal cone and is a local minimum for a point and an ellipsoid.
//!
//! A point has at most two local minima ([`ellipsoid_math`](super::ellipsoid_math)), so the candidates are few and
//! the true minimum is one of them: no iteration over the shape, no sampling. The smallest candidate that may push
//! is the contact (ties: the lower feature).
//!
//! # Rounding
//!
//! A foot may lie outside its face or edge, and a normal outside its cone, by a margin of rounding. A face's and an
//! edge's overlap is `D` wherever its foot lies; a normal outside its cone is charged the whole polyhedron's `D`. So
//! every candidate is at least the minimum, and one that belongs to two features is found from at least one side.
//! If still none is found while every face is active, the least face, or the direction from the polyhedron's nearest
//! point to the centre (nearest where the ellipsoid is a ball), stands in, again with the whole `D`: a body that
//! overlaps never loses its contact.
//!
//! # Inner walls
//!
//! Only active features push. A piece whose active features hold no foot has no contact: its neighbour has. Two
//! kinds of far minima would push the body through a whole piece and are left out: those deeper than the least
//! overlap of any active face (its foot lies in a neighbour, which pushes), and those that push back against an inner
//! wall (`n·n_wall < 0`) which the centre is beyond and which is nearer (the centre lies in a neighbour).

use super::ellipsoid_math::{
    NormalFoot, nearest_on_ellipse, nearest_on_ellipsoid, second_nearest_on_ellipse,
    second_nearest_on_ellipsoid,
};
use super::ellipsoid_prepared::{PreparedEllipsoid, Shadow};
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{EdgePush, Ellipsoid, Polyhedron};

/// How far outside its feature a foot may lie, as a share of the sizes involved.
const FOOT_SLACK: f64 = 1e-12;
/// How far outside its cone a normal may lie (sine).
const CONE_SLACK: f64 = 1e-9;
/// A bound within this share of the best is not taken to exclude anything.
const BOUND_SLACK: f64 = 1e-9;
/// Only a point this near to the surface of the unit ball may turn out to be outside (share of the square).
const HARDLY_INSIDE: f64 = 1e-6;
/// Overlap that is no more than the rounding of a depth, as a share of the largest length.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Tests an ellipsoid (A) against one convex piece (B).
pub fn ellipsoid_polyhedron(e: &Ellipsoid, p: &Polyhedron) -> Option<Interference> {
    let prepared = PreparedEllipsoid::new(e);
    let mut search = Search::start(e, &prepared, p)?;
    let witness = search.overlap_witness()?;
    if search.only_touches(&witness) {
        return None;
    }
    search.try_faces();
    search.try_edges();
    search.try_vertices();
    if search.best.is_none() && search.all_active {
        search.stand_in(&witness);
    }
    search.best.map(|best| Interference {
        depth: best.depth,
        normal: best.normal,
        point_a: prepared.deepest(&best.normal),
        feature: best.feature,
    })
}

#[derive(Clone, Copy)]
struct Candidate {
    depth: f64,
    normal: Vec3,
    feature: Feature,
}

struct Search<'a> {
    ellipsoid: &'a Ellipsoid,
    prepared: &'a PreparedEllipsoid,
    polyhedron: &'a Polyhedron,
    all_active: bool,
    /// The least overlap of an active face, an upper bound of the depth.
    bound: f64,
    /// Faces this high or lower have no part in a minimum below `bound`.
    near_height: f64,
    /// The largest length involved, which rounding is relative to, m.
    size: f64,
    foot_slack: f64,
    best: Option<Candidate>,
}

impl<'a> Search<'a> {
    /// `None` if a face's plane separates the two.
    fn start(e: &'a Ellipsoid, prepared: &'a PreparedEllipsoid, p: &'a Polyhedron) -> Option<Self> {
        let mut all_active = true;
        for face in &p.faces {
            let height = face.height(&e.center);
            all_active &= face.active;
            if height >= prepared.smallest && height >= prepared.widened(&face.normal).norm() {
                return None;
            }
        }
        let mut bound = f64::INFINITY;
        for face in p.faces.iter().filter(|face| face.active) {
            let height = face.height(&e.center);
            if prepared.smallest - height < bound {
                bound = bound.min(prepared.widened(&face.normal).norm() - height);
            }
        }
        bound += BOUND_SLACK * bound;
        let near_height = (prepared.smallest - bound).min(0.0);
        let size = p.diameter + prepared.largest + e.center.amax();
        Some(Self {
            ellipsoid: e,
            prepared,
            polyhedron: p,
            all_active,
            bound,
            near_height,
            size,
            foot_slack: FOOT_SLACK * size,
            best: None,
        })
    }

    /// A point of the polyhedron in the ellipsoid, from the centre, where the ellipsoid is the unit ball.
    ///
    /// If the centre is outside, the polyhedron's point nearest to it there lies on a face whose plane the centre is
    /// in front of: at the foot on the plane, or else on one of the edges that the foot is beyond.
    fn overlap_witness(&self) -> Option<Vec3> {
        let mut inside = true;
        for (index, face) in self.polyhedron.faces.iter().enumerate() {
            let height = face.height(&self.ellipsoid.center);
            if height <= 0.0 {
                continue;
            }
            inside = false;
            let widened = self.prepared.widened(&face.normal);
            let share = height / widened.norm_squared();
            let foot = self.ellipsoid.center - self.prepared.reach(&widened) * share;
            let mut in_outline = true;
            for rim in self.polyhedron.rim(index) {
                if rim.outward.dot(&(foot - rim.anchor)) > 0.0 {
                    in_outline = false;
                    let nearest = self.nearest_of_edge(rim.edge as usize);
                    if nearest.norm_squared() < 1.0 {
                        return Some(nearest);
                    }
                }
            }
            if in_outline {
                return Some(widened * -share);
            }
        }
        inside.then(Vec3::zeros)
    }

    /// Whether the overlap found is nothing but rounding, told from the direction of a point hardly inside.
    fn only_touches(&self, witness: &Vec3) -> bool {
        witness.norm_squared() > 1.0 - HARDLY_INSIDE
            && self.whole_depth(&self.direction_from(witness)) <= ROUNDING * self.size
    }

    /// The unit normal along which a point of the ellipsoid's inside is pushed, from where it is the unit ball.
    fn direction_from(&self, witness: &Vec3) -> Vec3 {
        self.prepared.direction_of(&-witness).normalize()
    }

    fn nearest_of_edge(&self, edge: usize) -> Vec3 {
        let [first, second] = self.polyhedron.edges[edge].vertices.map(|v| self.position(v));
        let start = self.prepared.shrunk(&(first - self.ellipsoid.center));
        let along = self.prepared.shrunk(&(second - first));
        let share = (-start.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        start + along * share
    }

    fn try_faces(&mut self) {
        for (index, face) in self.polyhedron.faces.iter().enumerate().filter(|(_, face)| face.active) {
            let height = face.height(&self.ellipsoid.center);
            if self.prepared.smallest - height > self.limit() {
                continue;
            }
            let widened = self.prepared.widened(&face.normal);
            let half_width = widened.norm();
            let depth = half_width - height;
            if depth > self.limit() {
                continue;
            }
            let deepest = self.ellipsoid.center - self.prepared.reach(&widened) / half_width;
            let rims = self.polyhedron.rim(index);
            if rims.iter().all(|rim| rim.outward.dot(&(deepest - rim.anchor)) <= self.foot_slack) {
                self.offer(depth, &face.normal, Feature::face(index));
            }
        }
    }

    fn try_edges(&mut self) {
        for index in 0..self.polyhedron.edges.len() {
            if let Some(push) = &self.polyhedron.edges[index].push {
                self.try_edge(index, push);
            }
        }
    }

    fn try_edge(&mut self, index: usize, push: &EdgePush) {
        let edge = &self.polyhedron.edges[index];
        let from_edge = self.ellipsoid.center - self.position(edge.vertices[0]);
        let heights = push.normals.map(|n| n.dot(&from_edge));
        if heights[0].max(heights[1]) <= self.near_height
            || self.prepared.arc_bound(&push.normals, &heights) > self.limit()
        {
            return;
        }
        let shadow = Shadow::new(self.prepared, &push.normals[0], &push.outwards[0]);
        let y = shadow.components(&from_edge);
        if y[0].abs() < shadow.semi_axes[0] && y[1].abs() < shadow.semi_axes[1] {
            self.offer_edge(index, push, &shadow, &nearest_on_ellipse(shadow.semi_axes, y));
        }
        if let Some(foot) = second_nearest_on_ellipse(shadow.semi_axes, y) {
            self.offer_edge(index, push, &shadow, &foot);
        }
    }

    fn offer_edge(&mut self, index: usize, push: &EdgePush, shadow: &Shadow, foot: &NormalFoot<2>) {
        if foot.depth <= 0.0 || foot.depth > self.limit() {
            return;
        }
        let normal = shadow.vector(&foot.normal);
        let least = push.outwards[0].dot(&normal).min(push.outwards[1].dot(&normal));
        if least <= -CONE_SLACK {
            return;
        }
        let deepest = self.prepared.deepest(&normal);
        let edge = &self.polyhedron.edges[index];
        let [first, second] = edge.vertices.map(|v| edge.direction.dot(&(deepest - self.position(v))));
        if first >= -self.foot_slack && second <= self.foot_slack {
            let depth = if least > 0.0 { foot.depth } else { self.whole_depth(&normal) };
            self.offer(depth, &normal, Feature::edge(index));
        }
    }

    fn try_vertices(&mut self) {
        for index in 0..self.polyhedron.vertices.len() {
            let vertex = &self.polyhedron.vertices[index];
            if !vertex.pushes {
                continue;
            }
            let from_vertex = self.ellipsoid.center - vertex.position;
            let radius_square = self.prepared.shrunk(&from_vertex).norm_squared();
            let y = self.ellipsoid.axes.tr_mul(&from_vertex);
            if radius_square < 1.0 && self.prepared.smallest * (1.0 - radius_square.sqrt()) <= self.limit() {
                self.offer_vertex(index, &nearest_on_ellipsoid(&self.ellipsoid.semi_axes, &y));
            }
            if let Some(foot) = second_nearest_on_ellipsoid(&self.ellipsoid.semi_axes, &y) {
                self.offer_vertex(index, &foot);
            }
        }
    }

    fn offer_vertex(&mut self, index: usize, foot: &NormalFoot<3>) {
        if foot.depth <= 0.0 || foot.depth > self.limit() {
            return;
        }
        let normal = self.ellipsoid.axes * Vec3::from(foot.normal);
        let most = self.polyhedron.cone(index).iter().fold(f64::NEG_INFINITY, |m, e| m.max(e.dot(&normal)));
        if most < CONE_SLACK {
            let depth = if most < 0.0 { foot.depth } else { self.whole_depth(&normal) };
            self.offer(depth, &normal, Feature::vertex(index));
        }
    }

    /// The contact where every feature's foot was lost to rounding (see the head of this file).
    fn stand_in(&mut self, witness: &Vec3) {
        for (index, face) in self.polyhedron.faces.iter().enumerate() {
            let depth = self.prepared.widened(&face.normal).norm() - face.height(&self.ellipsoid.center);
            self.offer(depth, &face.normal, Feature::face(index));
        }
        if *witness != Vec3::zeros() {
            let normal = self.direction_from(witness);
            let support = self.support_vertex(&normal);
            self.offer(self.whole_depth(&normal), &normal, Feature::vertex(support));
        }
    }

    fn offer(&mut self, depth: f64, normal: &Vec3, feature: Feature) {
        let wins = self.best.is_none_or(|best| (depth, feature) < (best.depth, best.feature));
        if depth > 0.0 && wins && !self.pushes_into_a_wall(depth, normal) {
            self.best = Some(Candidate { depth, normal: *normal, feature });
        }
    }

    fn pushes_into_a_wall(&self, depth: f64, normal: &Vec3) -> bool {
        !self.all_active
            && self.polyhedron.faces.iter().filter(|face| !face.active).any(|wall| {
                let height = wall.height(&self.ellipsoid.center);
                height > 0.0
                    && wall.normal.dot(normal) < 0.0
                    && self.prepared.widened(&wall.normal).norm() - height < depth
            })
    }

    /// Candidates above this cannot win.
    fn limit(&self) -> f64 {
        self.best.map_or(self.bound, |best| best.depth.min(self.bound))
    }

    /// `D(n)` with the support of all vertices.
    fn whole_depth(&self, normal: &Vec3) -> f64 {
        let vertex = self.support_vertex(normal);
        let from_vertex = self.ellipsoid.center - self.polyhedron.vertices[vertex].position;
        self.prepared.widened(normal).norm() - normal.dot(&from_vertex)
    }

    fn support_vertex(&self, normal: &Vec3) -> usize {
        let mut best = (0, f64::NEG_INFINITY);
        for (index, vertex) in self.polyhedron.vertices.iter().enumerate() {
            let reach = normal.dot(&vertex.position);
            if reach > best.1 {
                best = (index, reach);
            }
        }
        best.0
    }

    #[inline]
    fn position(&self, vertex: u32) -> Vec3 {
        self.polyhedron.vertices[vertex as usize].position
    }
}
