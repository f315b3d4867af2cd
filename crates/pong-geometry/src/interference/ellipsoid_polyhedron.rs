//! Ellipsoid (A) – polyhedron (B): the exact minimum translation, found among the features of the polyhedron.
//!
//! Along a unit normal n the overlap is `D(n) = h_E(n) − n·c + h_P(n)`. Here h_E is the support function of
//! the ellipsoid about its centre c, and h_P that of the polyhedron. The depth is the minimum of D. Let the
//! foot be the ellipsoid's deepest point after the ellipsoid is pushed out. At the minimum, one feature of
//! the polyhedron is farthest along n:
//!
//! * a face: n is its normal, and the foot lies in its outline;
//! * an edge: n lies between the normals of its two faces, and the foot between its ends; n is a local
//!   minimum of the overlap with the edge's line (seen along the edge: of an ellipse with a point);
//! * a vertex: n lies in its normal cone, and is a local minimum of the overlap with the vertex.
//!
//! The overlap of an ellipse or an ellipsoid with a point has at most two local minima
//! ([`ellipsoid_math`](super::ellipsoid_math)), so there are few candidates, and the true minimum is one of
//! them. The contact is the candidate of least depth; of equally deep ones, that of the lower feature.
//!
//! # Rejecting most candidates
//!
//! The search starts with the *lead*, the active face of least overlap δ. The ellipsoid's deepest point `a`
//! lies δ below the lead. For every n, `D(n)` is at least the depth of `a` along n.
//!
//! The normal of an edge or a vertex is a sum of the normals of its faces, with coefficients that are not
//! negative and whose sum is at least 1. So if `a` lies at least δ below each of these faces, then
//! `D(n) ≥ δ`. A smaller minimum can therefore only belong to an edge or a vertex of a *suspect*, a face that
//! `a` lies less than δ below. Without suspects the lead is the contact. The lead is computed for eight faces
//! at a time; faces that the centre is far below are skipped.
//!
//! # Rounding
//!
//! A foot may lie outside its face or edge, and a normal outside its cone, within a tolerance for rounding.
//! `D(n)` of a face or an edge does not depend on the position of the foot; for a normal outside its cone,
//! `D(n)` is computed with all vertices. So no candidate is below the minimum, and a minimum on the boundary
//! of two features is found for at least one of them.
//!
//! If no candidate is found although every face is active, two fallbacks are compared, each with its `D(n)`.
//! One is the lead. The other is the direction from the polyhedron's nearest point to the centre, nearest in
//! the metric in which the ellipsoid is a ball. So an overlapping body never loses its contact.
//!
//! # Internal faces
//!
//! Only active features push. A piece finds the minimum among its own active features, without knowing its
//! neighbours. Each feature of the body belongs to one piece, so the piece that has the minimising feature
//! finds the body's minimum. Other pieces find other local minima, which are not less deep. Load sharing,
//! which sees the contacts of all pieces, decides which contacts count.
//!
//! A piece applies two rules. It drops minima deeper than the least overlap of its active faces, because the
//! body's minimum is not deeper. If for every feature of the piece the foot lies outside that feature, the
//! piece returns its active face of least overlap as a [fallback](PieceContact::stands_in). The fallback
//! counts only if no piece of the body finds anything else.

use super::ellipsoid_math::{
    NormalFoot, nearest_on_ellipse, nearest_on_ellipsoid, second_nearest_on_ellipse,
    second_nearest_on_ellipsoid,
};
use super::ellipsoid_prepared::{PreparedEllipsoid, Shadow};
use super::highest_face::{Whereabouts, highest_of_many};
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{EdgePush, Ellipsoid, FacePlanes, Polyhedron};
use crate::simd::{Finder, First, LANES, LaneBits, Simd, Splat, Vectors, run_at_level};

/// Distance by which a foot may lie outside its feature, relative to the sizes involved.
const FOOT_SLACK: f64 = 1e-12;
/// Sine of the angle by which a normal may lie outside its cone.
const CONE_SLACK: f64 = 1e-9;
/// Relative amount by which a lower bound must exceed the best depth to exclude a candidate.
const BOUND_SLACK: f64 = 1e-9;
/// Amount by which a squared radius in the unit-ball metric must be below 1 to be certainly inside.
const HARDLY_INSIDE: f64 = 1e-6;
/// Rounding error of a depth, relative to the largest length.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Contact of an ellipsoid with one convex piece of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceContact {
    /// Depth, normal, point and feature.
    pub interference: Interference,
    /// True for a fallback: for every feature of the piece, the ellipsoid's foot lies outside that feature,
    /// so none has a regular contact. The contact is that of the active face of least overlap. It counts only
    /// if no other piece of the body has a regular contact.
    pub stands_in: bool,
}

/// Tests an ellipsoid (A) against one convex solid (B), or against the active features of one piece alone.
#[inline]
pub fn ellipsoid_polyhedron(e: &Ellipsoid, p: &Polyhedron) -> Option<Interference> {
    ellipsoid_piece(e, p).filter(|contact| !contact.stands_in).map(|contact| contact.interference)
}

/// Tests an ellipsoid (A) against one convex piece of a body (B).
#[inline]
pub fn ellipsoid_piece(e: &Ellipsoid, p: &Polyhedron) -> Option<PieceContact> {
    run_at_level!(ellipsoid_piece_in(e: Ellipsoid, p: Polyhedron) -> Option<PieceContact>)
}

/// Same as [`ellipsoid_piece`], for a caller that already runs at the SIMD level `S`.
#[inline(always)]
fn ellipsoid_piece_in<S: Simd>(simd: S, e: &Ellipsoid, p: &Polyhedron) -> Option<PieceContact> {
    let prepared = PreparedEllipsoid::new(e);
    let (lead, suspects) = Lead::find(simd, &prepared, p)?;
    choose(e, &prepared, p, lead, &suspects)
}

/// Returns the contact: that of the lead, or that of a feature of a suspect face.
fn choose(
    e: &Ellipsoid,
    prepared: &PreparedEllipsoid,
    p: &Polyhedron,
    lead: Lead,
    suspects: &Suspects,
) -> Option<PieceContact> {
    let face =
        Candidate { depth: lead.depth, normal: p.faces[lead.face].normal, feature: Feature::face(lead.face) };
    let (least, stands_in) = if suspects.count == 0 {
        (face, false)
    } else {
        Search::new(e, prepared, p, lead, face, p.planes().all_active).least(suspects)?
    };
    let Candidate { depth, normal, feature } = least;
    let deepest_b = prepared.deepest(&normal);
    Some(PieceContact {
        interference: Interference { depth, normal_b: normal, deepest_b, feature },
        stands_in,
    })
}

/// The lead: the active face of least overlap.
#[derive(Clone, Copy)]
struct Lead {
    face: usize,
    depth: f64,
    /// The ellipsoid's deepest point below the face, m.
    deepest: Vec3,
}

/// Suspects: faces below which `Lead::deepest` is less deep than below the lead.
struct Suspects {
    faces: [u32; Self::CAPACITY],
    /// Number of suspects; above the capacity, all features of the polyhedron are tested.
    count: usize,
    /// True if `Lead::deepest` is inside the polyhedron, which proves the overlap.
    pierces: bool,
}

impl Lead {
    /// Returns the lead and the suspects. `None` if the plane of a face separates ellipsoid and polyhedron,
    /// or if no face is active.
    #[inline(always)]
    fn find<S: Simd>(simd: S, e: &PreparedEllipsoid, p: &Polyhedron) -> Option<(Self, Suspects)> {
        let planes = p.planes();
        let highest = highest_of_many(simd, &e.center, planes, Whereabouts::Below(e.largest))?;
        // The ellipsoid's half widths along two normals differ by at most `largest − smallest`. So a face has
        // at least the overlap of the highest face if the centre's height above it is at most `least_height`.
        let least_height = (e.smallest - e.largest) + highest.height - BOUND_SLACK * e.largest;
        let face = least_overlap(simd, e, planes, least_height)?;
        let lead = Self::at(e, p, face);
        let suspects = lead.suspects(simd, p);
        (lead.depth > 0.0).then_some((lead, suspects))
    }

    #[inline(always)]
    fn suspects<S: Simd>(&self, simd: S, p: &Polyhedron) -> Suspects {
        let (deepest, depth) = (Splat::new(simd, &self.deepest), simd.splat(self.depth));
        let mut suspects = Suspects::NONE;
        for (index, block) in p.planes().blocks.iter().enumerate() {
            let others = if index == self.face / LANES { !(1 << (self.face % LANES)) } else { LaneBits::MAX };
            let under = simd.sub(simd.splat(0.0), block.heights(simd, &deepest));
            let mut faces = !simd.bits(simd.at_least(under, depth)) & block.own & others;
            suspects.pierces &= faces & !simd.bits(simd.below(simd.splat(0.0), under)) == 0;
            while faces != 0 {
                suspects.add(index * LANES + faces.trailing_zeros() as usize);
                faces &= faces - 1;
            }
        }
        suspects
    }

    fn at(e: &PreparedEllipsoid, p: &Polyhedron, face: usize) -> Self {
        let widened = e.widened(&p.faces[face].normal);
        let half_width = widened.norm();
        Self {
            face,
            depth: half_width - p.faces[face].height(&e.center),
            deepest: e.center - e.reach(&widened) / half_width,
        }
    }
}

/// Returns the active face of least overlap; of equal ones, the one of lowest index. Faces above which the
/// height of the centre is at most `least_height` (m) may be skipped. `None` if the plane of a face that is
/// not skipped separates the ellipsoid from the polyhedron, or if none of these faces is active.
#[inline(always)]
fn least_overlap<S: Simd>(
    simd: S,
    e: &PreparedEllipsoid,
    planes: &FacePlanes,
    least_height: f64,
) -> Option<usize> {
    let [a, b, c] = &e.widen;
    let widen = [Vectors::splat(simd, a), Vectors::splat(simd, b), Vectors::splat(simd, c)];
    let (center, least_height) = (Splat::new(simd, &e.center), simd.splat(least_height));
    let (zero, nothing) = (simd.splat(0.0), simd.splat(f64::NEG_INFINITY));
    let mut first = First::<S>::above(simd, f64::NEG_INFINITY);
    for (index, block) in planes.blocks.iter().enumerate() {
        let heights = block.heights(simd, &center);
        if simd.bits(simd.below(least_height, heights)) == 0 {
            continue;
        }
        let half_widths = Vectors::load(simd, &block.normal).dot_rows(widen).norm();
        let less = simd.sub(heights, half_widths.eight());
        if simd.bits(simd.at_least(less, zero)) != 0 {
            return None;
        }
        first.offer(index, simd.select(simd.mask(block.active), less, nothing));
    }
    first.found().map(|found| found.place())
}

impl Suspects {
    const CAPACITY: usize = 32;

    const NONE: Self = Self { faces: [0; Self::CAPACITY], count: 0, pierces: true };

    #[inline(always)]
    fn add(&mut self, face: usize) {
        if let Some(slot) = self.faces.get_mut(self.count) {
            *slot = face as u32;
        }
        self.count += 1;
    }

    /// Returns the suspects; `None` if there were too many to list.
    fn listed(&self) -> Option<&[u32]> {
        self.faces.get(..self.count)
    }
}

#[derive(Clone, Copy)]
struct Candidate {
    depth: f64,
    normal: Vec3,
    feature: Feature,
}

/// Search for the candidate of least depth among the features of suspects.
struct Search<'a> {
    ellipsoid: &'a Ellipsoid,
    prepared: &'a PreparedEllipsoid,
    polyhedron: &'a Polyhedron,
    lead: Lead,
    lead_face: Candidate,
    all_active: bool,
    /// Least overlap of an active face: an upper bound of the depth.
    bound: f64,
    /// Largest length involved, the reference for rounding, m.
    size: f64,
    foot_slack: f64,
    best: Option<Candidate>,
}

impl<'a> Search<'a> {
    fn new(
        ellipsoid: &'a Ellipsoid,
        prepared: &'a PreparedEllipsoid,
        polyhedron: &'a Polyhedron,
        lead: Lead,
        lead_face: Candidate,
        all_active: bool,
    ) -> Self {
        let size = polyhedron.diameter + prepared.largest + ellipsoid.center.amax();
        Self {
            ellipsoid,
            prepared,
            polyhedron,
            lead,
            lead_face,
            all_active,
            bound: lead.depth * (1.0 + BOUND_SLACK),
            size,
            foot_slack: FOOT_SLACK * size,
            best: None,
        }
    }

    /// Returns the candidate of least depth, and `true` if it is a fallback. `None` if ellipsoid and
    /// polyhedron do not overlap.
    fn least(mut self, suspects: &Suspects) -> Option<(Candidate, bool)> {
        let mut witness = None;
        if !suspects.pierces {
            let found = self.overlap_witness()?;
            if self.only_touches(&found) {
                return None;
            }
            witness = Some(found);
        }
        self.try_lead_face();
        // With internal faces all features are tested: an edge may also belong to a face of another piece,
        // which is not among the suspects.
        match suspects.listed().filter(|_| self.all_active) {
            Some(faces) => self.try_features_of(faces),
            None => self.try_all_features(),
        }
        if self.best.is_none() && self.all_active {
            self.stand_in(witness);
        }
        self.best.map(|best| (best, false)).or(Some((self.lead_face, true)))
    }

    /// Returns a point of the polyhedron inside the ellipsoid; `None` if there is none. The point is relative
    /// to the ellipsoid's centre, in the metric in which the ellipsoid is the unit ball.
    ///
    /// If the centre is inside the polyhedron, the point is the centre. Otherwise, the polyhedron's nearest
    /// point in this metric lies on a face whose plane has the centre in front of it. It is the centre's
    /// projection onto that plane, or it lies on an edge of the face beyond which the projection lies. So
    /// only such points are tested.
    fn overlap_witness(&self) -> Option<Vec3> {
        let mut inside = true;
        let all = 0..self.polyhedron.faces.len();
        for index in std::iter::once(self.lead.face).chain(all) {
            let height = self.polyhedron.height(index, &self.ellipsoid.center);
            if height > 0.0 {
                inside = false;
                let witness = self.witness_on_face(index, height);
                if witness.is_some() {
                    return witness;
                }
            }
        }
        inside.then(Vec3::zeros)
    }

    fn witness_on_face(&self, index: usize, height: f64) -> Option<Vec3> {
        let widened = self.prepared.widened(&self.polyhedron.faces[index].normal);
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
        in_outline.then(|| widened * -share)
    }

    /// Returns `true` if the overlap is only rounding: `witness` is barely inside the ellipsoid, and the
    /// overlap along the direction in which `witness` pushes is no more than a rounding error.
    fn only_touches(&self, witness: &Vec3) -> bool {
        witness.norm_squared() > 1.0 - HARDLY_INSIDE
            && self.whole_depth(&self.direction_from(witness)) <= ROUNDING * self.size
    }

    /// Returns the unit normal along which a point inside the ellipsoid, given in the unit-ball metric,
    /// pushes the ellipsoid out. It is perpendicular to the concentric, similar ellipsoid through the point.
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

    fn try_lead_face(&mut self) {
        let rims = self.polyhedron.rim(self.lead.face);
        if rims.iter().all(|rim| rim.outward.dot(&(self.lead.deepest - rim.anchor)) <= self.foot_slack) {
            self.offer(self.lead_face);
        }
    }

    fn try_features_of(&mut self, suspects: &[u32]) {
        let polyhedron = self.polyhedron;
        // Vertices already tested; several suspects may share a vertex. Beyond the capacity, some are tested
        // again.
        let mut tried = [u32::MAX; Suspects::CAPACITY];
        let mut count = 0;
        for &face in suspects {
            for rim in polyhedron.rim(face as usize) {
                let first_here = rim.neighbor > face || !suspects.contains(&rim.neighbor);
                if first_here {
                    self.try_edge(rim.edge as usize);
                }
                if !tried[..count].contains(&rim.start) {
                    self.try_vertex(rim.start as usize);
                    tried[count] = rim.start;
                    count = (count + 1).min(tried.len() - 1);
                }
            }
        }
    }

    fn try_all_features(&mut self) {
        for index in 0..self.polyhedron.edges.len() {
            self.try_edge(index);
        }
        for index in 0..self.polyhedron.vertices.len() {
            self.try_vertex(index);
        }
    }

    fn try_edge(&mut self, index: usize) {
        let edge = &self.polyhedron.edges[index];
        let Some(push) = &edge.push else { return };
        let from_edge = self.ellipsoid.center - self.position(edge.vertices[0]);
        let heights = push.normals.map(|n| n.dot(&from_edge));
        if self.prepared.arc_bound(&push.normals, &heights) > self.limit() {
            return;
        }
        let shadow = Shadow::new(self.prepared, &push.normals[0], &push.outwards[0]);
        let y = shadow.components(&from_edge);
        if shadow.may_hold(&y, self.limit()) {
            self.offer_edge(index, push, &shadow, &nearest_on_ellipse(shadow.semi_axes, y));
        }
        let second = shadow.allows_second(self.limit());
        if let Some(foot) = second.then(|| second_nearest_on_ellipse(shadow.semi_axes, y)).flatten() {
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
            self.offer(Candidate { depth, normal, feature: Feature::edge(index) });
        }
    }

    fn try_vertex(&mut self, index: usize) {
        let vertex = &self.polyhedron.vertices[index];
        if !vertex.pushes {
            return;
        }
        let from_vertex = self.ellipsoid.center - vertex.position;
        let semi_axes = &self.ellipsoid.semi_axes;
        let radius_square = self.prepared.shrunk(&from_vertex).norm_squared();
        let limit = self.limit();
        // The depth of a point at this radius in the unit ball is at least `smallest·(1 − radius)`.
        let near = radius_square < 1.0 && self.prepared.smallest * (1.0 - radius_square.sqrt()) <= limit;
        let second = self.prepared.allows_second(limit);
        if near || second {
            let y = self.ellipsoid.axes.tr_mul(&from_vertex);
            if near {
                self.offer_vertex(index, &nearest_on_ellipsoid(semi_axes, &y));
            }
            if let Some(foot) = second.then(|| second_nearest_on_ellipsoid(semi_axes, &y)).flatten() {
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
            self.offer(Candidate { depth, normal, feature: Feature::vertex(index) });
        }
    }

    /// Tests the two fallbacks for the case that rounding puts every foot outside its feature (see the module
    /// documentation).
    fn stand_in(&mut self, witness: Option<Vec3>) {
        self.offer(self.lead_face);
        if let Some(witness) = witness.filter(|w| *w != Vec3::zeros()) {
            let normal = self.direction_from(&witness);
            let feature = Feature::vertex(self.support_vertex(&normal));
            self.offer(Candidate { depth: self.whole_depth(&normal), normal, feature });
        }
    }

    fn offer(&mut self, candidate: Candidate) {
        let wins =
            self.best.is_none_or(|best| (candidate.depth, candidate.feature) < (best.depth, best.feature));
        if candidate.depth > 0.0 && wins {
            self.best = Some(candidate);
        }
    }

    /// Returns the depth above which a candidate cannot win, m.
    fn limit(&self) -> f64 {
        self.best.map_or(self.bound, |best| best.depth.min(self.bound))
    }

    /// Returns `D(n)` for any unit normal, with the support function over all vertices, m.
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
