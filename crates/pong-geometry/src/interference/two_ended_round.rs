//! Line segment and capsule (A) – cylinder and cone (B) (docs/theory.md, 2.8): half a spring acts at each end of
//! the overlap.
//!
//! An end of the overlap is an end of A in B or an end of B in A, whichever is deeper. Let k be the
//! stiffness, δ the depth of the pair, and δ₀ and δ₁ the depths at the two ends of the overlap. The stored
//! energy is ¼k(δ² + δ₀²δ₁²/δ²). The derivatives of the energy give the weights: ½(1 − δ₀²δ₁²/δ⁴) at the
//! deepest point, ½δ₁²/δ² at end 0 and ½δ₀²/δ² at end 1.

use super::Interference;
use super::axis_approach::Approach;
use super::ball_round::pressed;
use super::round_surface::of_frustum;
use crate::Vec3;
use crate::primitive::{Capsule, Frustum, LineSegment};

/// Contact of a segment or a capsule: at an end of the overlap, or at the deepest point between the ends.
#[derive(Clone, Copy, Debug)]
pub struct EndContact {
    /// Point, normal and depth.
    pub interference: Interference,
    /// Part of half a spring that acts in this contact: 0…1, or 0…2 between two capsules.
    pub share: f64,
}

/// Contacts of a segment or a capsule: at its end 0, at its end 1, and at the deepest point.
pub type EndContacts = [Option<EndContact>; 3];

/// Tests a segment against a cylinder or a cone.
pub fn segment_frustum(segment: &LineSegment, frustum: &Frustum) -> EndContacts {
    two_ended(&segment.ends, 0.0, frustum)
}

/// Tests a capsule against a cylinder or a cone.
pub fn capsule_frustum(capsule: &Capsule, frustum: &Frustum) -> EndContacts {
    two_ended(&capsule.ends, capsule.radius, frustum)
}

fn two_ended(ends: &[Vec3; 2], radius: f64, solid: &Frustum) -> EndContacts {
    let Some(deepest) = touched(&solid.approach(ends), radius) else { return [None; 3] };
    let same_way = (ends[1] - ends[0]).dot(&solid.axis) >= 0.0;
    let at_end = |end: usize| {
        let own = pressed(&ends[end], radius, &of_frustum(&ends[end], solid));
        let end_of_solid = if same_way { end } else { 1 - end };
        let approach = solid.approach_end(end_of_solid, ends, radius);
        let other = approach.and_then(|approach| touched(&approach, radius));
        let deeper = match (own, other) {
            (Some(own), Some(other)) if other.depth > own.depth => Some(other),
            (None, other) => other,
            (own, _) => own,
        };
        // The depth of an end is at most that of the pair, but rounding might exceed it.
        deeper.map(|contact| Interference { depth: contact.depth.min(deepest.depth), ..contact })
    };
    shared([at_end(0), at_end(1)], &deepest)
}

fn touched(approach: &Approach, radius: f64) -> Option<Interference> {
    let depth = radius - approach.distance;
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: approach.normal_b,
        deepest_b: approach.place_b - approach.normal_b * radius,
        feature: approach.feature,
    })
}

fn shared(ends: [Option<Interference>; 2], deepest: &Interference) -> EndContacts {
    let squares =
        ends.map(|end| end.map_or(0.0, |end| end.depth * end.depth / (deepest.depth * deepest.depth)));
    let contact = |interference: Option<Interference>, share: f64| {
        interference.filter(|_| share > 0.0).map(|interference| EndContact { interference, share })
    };
    [
        contact(ends[0], squares[1]),
        contact(ends[1], squares[0]),
        contact(Some(*deepest), 1.0 - squares[0] * squares[1]),
    ]
}
