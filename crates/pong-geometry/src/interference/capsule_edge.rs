//! Capsule (A) – a convex edge of a polyhedron or of a surface of triangles (B), crossed between the capsule's ends (docs/theory.md,
//! 2.8). What the balls at the ends touch is not asked here.
//!
//! Degenerate cases: of an axis along the edge the balls are as near as what is between them, and there is no crossing.

use super::round_surface::ROUNDING;
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::Capsule;

/// An edge as what crosses it sees it.
#[derive(Clone, Copy, Debug)]
pub struct ConvexEdge {
    /// Where it begins and ends, m.
    pub ends_b: [Vec3; 2],
    /// Unit normals of the faces that meet there; of a free edge twice that of its face.
    pub normals_b: [Vec3; 2],
    /// Unit vectors across the edge, in the plane of each face and out of it; `None` if only what is in front is pushed.
    pub outwards_b: Option<[Vec3; 2]>,
    /// Of a free edge the unit vector across it, in the plane of its face and out of it. An axis that stands upright on the face is
    /// pushed that way, though it is as much in front of the face as behind it.
    pub free_outward_b: Option<Vec3>,
    /// Which edge it is.
    pub feature: Feature,
}

/// The depth of an edge in a capsule where the axis is nearest to it, if that is between the ends of the axis. The normal is from the
/// edge to the axis. The depth of an axis that has sunk below the edge is more than the radius; it is told as long as the way out
/// is between the normals of the two faces.
pub fn capsule_edge(capsule: &Capsule, edge: &ConvexEdge) -> Option<Interference> {
    let axis = Segment::new(&capsule.ends);
    let of_edge = Segment::new(&edge.ends_b);
    if let Some((at, on_edge)) = axis.crossing(&of_edge) {
        return over(capsule, edge, &axis, &of_edge, at, on_edge);
    }
    // Else an end of one of the two is nearest to the other: only an end of the edge counts.
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
        // The way to it is noise: it counts as a place of the edge.
        return over(capsule, edge, &axis, &of_edge, at, if corner == edge.ends_b[0] { 0.0 } else { 1.0 });
    }
    if !(is_between && is_outside && distance < capsule.radius) {
        return None;
    }
    Some(touched(capsule, edge, (arm / distance).normalize(), distance, &axis.at(at)))
}

/// A crossing with the common perpendicular between the ends of both.
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
    // Of an axis along a face rounding decides whether the way out is beside that face's normal: it counts as if it were not.
    let is_between = |outward: &Vec3| outward.dot(&normal) > -ROUNDING;
    let leaves_there = || edge.outwards_b.is_some_and(|outwards| outwards.iter().all(is_between));
    // An axis in the edge has not passed it.
    let lowest = if edge.outwards_b.is_some() { 0.0 } else { -rounding(axis, of_edge) };
    if height >= capsule.radius || (height <= lowest && !leaves_there()) {
        return None;
    }
    Some(touched(capsule, edge, normal, height, &axis.at(at)))
}

/// How much a unit vector across the edge points out of what the edge bounds: of two opposite ones the positive one pushes.
fn outside(edge: &ConvexEdge, across: &Vec3) -> f64 {
    let in_front = edge.normals_b.iter().sum::<Vec3>().dot(across);
    // Of an axis that stands upright on a face rounding decides what is in front.
    edge.free_outward_b.filter(|_| in_front.abs() <= ROUNDING).map_or(in_front, |outward| outward.dot(across))
}

/// What rounding makes of a distance between the two, m.
fn rounding(axis: &Segment, of_edge: &Segment) -> f64 {
    let reach = |segment: &Segment| segment.start.amax() + segment.along.amax();
    ROUNDING * reach(axis).max(reach(of_edge))
}

/// The edge lies so far below a place of the axis, against the normal.
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

    /// Where along the line a place has its foot.
    fn nearest(&self, place: &Vec3) -> f64 {
        (place - self.start).dot(&self.along) / self.along.norm_squared()
    }

    /// Across both, of any length, if they are not parallel.
    fn across(&self, other: &Self) -> Option<Vec3> {
        let across = self.along.cross(&other.along);
        let least = f64::EPSILON * f64::EPSILON * self.along.norm_squared() * other.along.norm_squared();
        (across.norm_squared() > least).then_some(across)
    }

    /// The feet of the common perpendicular, if both lie between the ends.
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
