//! Capsule (A) – convex or free edge of a polyhedron or a triangle surface (B): contact with an edge that the
//! capsule's axis crosses between its ends (docs/theory.md, 2.8). Contacts of the end spheres are not tested
//! here.
//!
//! Degenerate case: an axis parallel to the edge does not cross it, because an end of the axis or of the edge
//! is among the nearest points.

use super::round_surface::ROUNDING;
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::Capsule;

/// Convex or free edge, as the capsule test needs it.
#[derive(Clone, Copy, Debug)]
pub struct ConvexEdge {
    /// End points, m.
    pub ends_b: [Vec3; 2],
    /// Unit normals of the two faces at the edge; for a free edge, its face's normal twice.
    pub normals_b: [Vec3; 2],
    /// For each of the two faces, the unit vector in the face's plane that is perpendicular to the edge and
    /// points out of the face. `None` if the edge never pushes an axis that has passed it.
    pub outwards_b: Option<[Vec3; 2]>,
    /// For a free edge, the unit vector in the face's plane that is perpendicular to the edge and points out
    /// of the face. It gives the sign of a contact normal that lies in the face's plane, as for an axis
    /// perpendicular to the face.
    pub free_outward_b: Option<Vec3>,
    /// The edge as a feature of B.
    pub feature: Feature,
}

/// Tests a capsule against an edge. The normal points from the edge to the axis. `None` if they do not
/// overlap, or if the point of the axis nearest to the edge is an end of the axis.
///
/// If the axis has sunk below the edge, the normal points out of the solid and the depth exceeds the radius.
/// There is then a contact only if `outwards_b` is given and the normal lies between the normals of the two
/// faces.
pub fn capsule_edge(capsule: &Capsule, edge: &ConvexEdge) -> Option<Interference> {
    let axis = Segment::new(&capsule.ends);
    let of_edge = Segment::new(&edge.ends_b);
    if let Some((at, on_edge)) = axis.crossing(&of_edge) {
        return over(capsule, edge, &axis, &of_edge, at, on_edge);
    }
    // Without a crossing, an end of the axis or an end of the edge is nearest. Only the ends of the edge are
    // tested here, because the ends of the axis belong to the capsule's end spheres.
    let tips =
        capsule.ends.map(|tip| (tip - of_edge.at(of_edge.nearest(&tip).clamp(0.0, 1.0))).norm_squared());
    let [one, other] = edge.ends_b.map(|corner| {
        let at = axis.nearest(&corner);
        ((axis.at(at.clamp(0.0, 1.0)) - corner).norm_squared(), at, corner)
    });
    let (square, at, corner) = if one.0 <= other.0 { one } else { other };
    let is_between = at > 0.0 && at < 1.0 && square < tips[0].min(tips[1]);
    let arm = axis.at(at) - corner;
    let is_outside = edge.normals_b.iter().sum::<Vec3>().dot(&arm) > 0.0;
    let distance = square.sqrt();
    let is_in_axis = distance <= rounding(&axis, &of_edge);
    if is_between && is_in_axis && axis.across(&of_edge).is_some() {
        // Up to rounding, the axis intersects the end of the edge. The direction from edge to axis is then
        // only rounding, so the common perpendicular is used.
        return over(capsule, edge, &axis, &of_edge, at, if corner == edge.ends_b[0] { 0.0 } else { 1.0 });
    }
    if !(is_between && is_outside && distance < capsule.radius) {
        return None;
    }
    Some(touched(capsule, edge, (arm / distance).normalize(), distance, &axis.at(at)))
}

/// Returns the contact at a crossing, which lies at the fraction `at` of the axis and `on_edge` of the edge.
/// `None` if the capsule does not reach the edge, or has passed it and must not be pushed by it.
fn over(
    capsule: &Capsule,
    edge: &ConvexEdge,
    axis: &Segment,
    of_edge: &Segment,
    at: f64,
    on_edge: f64,
) -> Option<Interference> {
    let across = of_edge.along.cross(&axis.along).normalize();
    let outside = outside(edge, &across);
    let normal = if outside < 0.0 { -across } else { across };
    let height = normal.dot(&(axis.at(at) - of_edge.at(on_edge)));
    // For an axis along a face, rounding puts the normal on either side of the face's normal. So a normal
    // outside the range by no more than the tolerance also counts as between the two.
    let is_between = |outward: &Vec3| outward.dot(&normal) > -ROUNDING;
    let leaves_there = || edge.outwards_b.is_some_and(|outwards| outwards.iter().all(is_between));
    // Without `outwards_b`, an axis that has passed the edge by more than rounding is not pushed.
    let lowest = if edge.outwards_b.is_some() { 0.0 } else { -rounding(axis, of_edge) };
    if height >= capsule.radius || (height <= lowest && !leaves_there()) {
        return None;
    }
    Some(touched(capsule, edge, normal, height, &axis.at(at)))
}

/// Returns a positive number if `across`, a unit vector perpendicular to the edge, points out of the solid,
/// and a negative number if it points into the solid. Of `across` and −`across`, the one that points out of
/// the solid is the contact normal.
fn outside(edge: &ConvexEdge, across: &Vec3) -> f64 {
    let in_front = edge.normals_b.iter().sum::<Vec3>().dot(across);
    // For an axis perpendicular to the face of a free edge, only rounding decides the sign of `in_front`, so
    // `free_outward_b` decides.
    edge.free_outward_b.filter(|_| in_front.abs() <= ROUNDING).map_or(in_front, |outward| outward.dot(across))
}

/// Returns the rounding error of a distance between the axis and the edge, m.
fn rounding(axis: &Segment, of_edge: &Segment) -> f64 {
    let reach = |segment: &Segment| segment.start.amax() + segment.along.amax();
    ROUNDING * reach(axis).max(reach(of_edge))
}

/// Returns the contact with an edge that lies `height` (m) below the point `place` of the axis, along the
/// normal.
fn touched(capsule: &Capsule, edge: &ConvexEdge, normal: Vec3, height: f64, place: &Vec3) -> Interference {
    Interference {
        depth: capsule.radius - height,
        normal_b: normal,
        deepest_b: place - normal * capsule.radius,
        feature: edge.feature,
    }
}

struct Segment {
    start: Vec3,
    along: Vec3,
}

impl Segment {
    fn new([one, other]: &[Vec3; 2]) -> Self {
        Self { start: *one, along: other - one }
    }

    fn at(&self, share: f64) -> Vec3 {
        self.start + self.along * share
    }

    /// Returns the position of a point's projection onto the segment's line, as a fraction of the segment.
    fn nearest(&self, place: &Vec3) -> f64 {
        (place - self.start).dot(&self.along) / self.along.norm_squared()
    }

    /// Returns a vector perpendicular to both segments, of any length; `None` if they are parallel.
    fn across(&self, other: &Self) -> Option<Vec3> {
        let across = self.along.cross(&other.along);
        let least = f64::EPSILON * f64::EPSILON * self.along.norm_squared() * other.along.norm_squared();
        (across.norm_squared() > least).then_some(across)
    }

    /// Returns the positions of the end points of the common perpendicular, as fractions of `self` and of
    /// `other`. `None` if the segments are parallel, or if an end point is not strictly between the ends of
    /// its segment.
    fn crossing(&self, other: &Self) -> Option<(f64, f64)> {
        let (u, v, between) = (self.along, other.along, other.start - self.start);
        let across = self.across(other)?;
        let square = across.norm_squared();
        let at = between.cross(&v).dot(&across) / square;
        let on_other = between.cross(&u).dot(&across) / square;
        let inside = |share: f64| share > 0.0 && share < 1.0;
        (inside(at) && inside(on_other)).then_some((at, on_other))
    }
}
