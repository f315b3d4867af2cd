//! Capsule (A) – convex edge of a polyhedron or triangle surface (B), crossed between the capsule's ends
//! (docs/theory.md, 2.8). Contacts of the end spheres are not tested here.
//!
//! Degenerate case: an axis parallel to the edge has no crossing, because its end spheres are as near as the
//! part between them.

use super::round_surface::ROUNDING;
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::Capsule;

/// Convex edge, as the capsule test needs it.
#[derive(Clone, Copy, Debug)]
pub struct ConvexEdge {
    /// End points, m.
    pub ends_b: [Vec3; 2],
    /// Unit normals of the two faces at the edge; for a free edge, its face's normal twice.
    pub normals_b: [Vec3; 2],
    /// Unit vectors perpendicular to the edge, in the plane of each face, pointing out of it; `None` if the
    /// edge pushes only shapes in front of it.
    pub outwards_b: Option<[Vec3; 2]>,
    /// For a free edge, the unit vector perpendicular to it, in the plane of its face, pointing out of it. An
    /// axis perpendicular to the face is pushed that way, because it is as much in front of the face as
    /// behind it.
    pub free_outward_b: Option<Vec3>,
    /// Feature of B that the edge is.
    pub feature: Feature,
}

/// Tests the edge against the capsule where the axis is nearest to it, if that point is between the ends of
/// the axis. The normal points from the edge to the axis. If the axis has sunk below the edge, the depth
/// exceeds the radius; such a contact is returned as long as the direction of separation is between the
/// normals of the two faces.
pub fn capsule_edge(capsule: &Capsule, edge: &ConvexEdge) -> Option<Interference> {
    let axis = Segment::new(&capsule.ends);
    let of_edge = Segment::new(&edge.ends_b);
    if let Some((at, on_edge)) = axis.crossing(&of_edge) {
        return over(capsule, edge, &axis, &of_edge, at, on_edge);
    }
    // Otherwise the nearest point is an end of the axis or of the edge. Only an end of the edge is a contact
    // of this test.
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
        // The direction from the edge to the axis is noise, so the end counts as a point of the edge.
        return over(capsule, edge, &axis, &of_edge, at, if corner == edge.ends_b[0] { 0.0 } else { 1.0 });
    }
    if !(is_between && is_outside && distance < capsule.radius) {
        return None;
    }
    Some(touched(capsule, edge, (arm / distance).normalize(), distance, &axis.at(at)))
}

/// Contact of a crossing whose common perpendicular ends between the ends of both segments.
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
    // The tolerance keeps a normal that coincides with a face normal: for an axis along a face rounding puts
    // it on either side.
    let is_between = |outward: &Vec3| outward.dot(&normal) > -ROUNDING;
    let leaves_there = || edge.outwards_b.is_some_and(|outwards| outwards.iter().all(is_between));
    // Tolerance for an axis that lies in the edge: it has not passed it.
    let lowest = if edge.outwards_b.is_some() { 0.0 } else { -rounding(axis, of_edge) };
    if height >= capsule.radius || (height <= lowest && !leaves_there()) {
        return None;
    }
    Some(touched(capsule, edge, normal, height, &axis.at(at)))
}

/// Signed amount by which a unit vector perpendicular to the edge points out of the solid: of two opposite
/// ones the positive one pushes.
fn outside(edge: &ConvexEdge, across: &Vec3) -> f64 {
    let in_front = edge.normals_b.iter().sum::<Vec3>().dot(across);
    // For an axis perpendicular to a face only rounding decides what is in front.
    edge.free_outward_b.filter(|_| in_front.abs() <= ROUNDING).map_or(in_front, |outward| outward.dot(across))
}

/// Rounding error of a distance between the two, m.
fn rounding(axis: &Segment, of_edge: &Segment) -> f64 {
    let reach = |segment: &Segment| segment.start.amax() + segment.along.amax();
    ROUNDING * reach(axis).max(reach(of_edge))
}

/// Contact whose edge lies `height` below `place`, a point of the axis, measured along the normal.
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

    /// Parameter of a point's projection onto the line.
    fn nearest(&self, place: &Vec3) -> f64 {
        (place - self.start).dot(&self.along) / self.along.norm_squared()
    }

    /// Vector perpendicular to both, of any length, if they are not parallel.
    fn across(&self, other: &Self) -> Option<Vec3> {
        let across = self.along.cross(&other.along);
        let least = f64::EPSILON * f64::EPSILON * self.along.norm_squared() * other.along.norm_squared();
        (across.norm_squared() > least).then_some(across)
    }

    /// Parameters of the end points of the common perpendicular, if both lie between the ends.
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
