//! Line segment and capsule (A) – capsule, cylinder and cone (B): half a spring at each end of what overlaps (docs/theory.md, 2.8).
//!
//! With δ the depth of the pair and δ₀, δ₁ those of the two ends of the overlap the stored energy is ¼k(δ² + δ₀²δ₁²/δ²). An
//! end of the overlap is an end of A in B or an end of B in A, whichever is deeper. Its derivatives are the weights: of
//! the deepest place ½(1 − δ₀²δ₁²/δ⁴), of the ends ½δ₁²/δ² and ½δ₀²/δ².

use super::Interference;
use super::axis_approach::{Approach, RoundSolid};
use super::ball_round::pressed;
use crate::Vec3;
use crate::primitive::{Capsule, Frustum, LineSegment};

/// A contact of a two-ended body: an end of the overlap, or the place between them that is deepest.
#[derive(Clone, Copy, Debug)]
pub struct EndContact {
    /// Where and how deep.
    pub interference: Interference,
    /// Of half a spring, how much acts: 0…1.
    pub share: f64,
}

/// Of a two-ended body: at its end 0, at its end 1, at the deepest place.
pub type EndContacts = [Option<EndContact>; 3];

/// A segment on a capsule.
pub fn segment_capsule(segment: &LineSegment, capsule: &Capsule) -> EndContacts {
    two_ended(&segment.ends, 0.0, capsule)
}

/// A segment on a cylinder or a cone.
pub fn segment_frustum(segment: &LineSegment, frustum: &Frustum) -> EndContacts {
    two_ended(&segment.ends, 0.0, frustum)
}

/// A capsule on a capsule.
pub fn capsule_capsule(a: &Capsule, b: &Capsule) -> EndContacts {
    two_ended(&a.ends, a.radius, b)
}

/// A capsule on a cylinder or a cone.
pub fn capsule_frustum(capsule: &Capsule, frustum: &Frustum) -> EndContacts {
    two_ended(&capsule.ends, capsule.radius, frustum)
}

fn two_ended(ends: &[Vec3; 2], radius: f64, solid: &impl RoundSolid) -> EndContacts {
    let Some(deepest) = touched(&solid.approach(ends), radius) else { return [None; 3] };
    let same_way = (ends[1] - ends[0]).dot(&solid.axis()) >= 0.0;
    let at_end = |end: usize| {
        let own = pressed(&ends[end], radius, &solid.nearest(end, ends));
        let end_of_solid = if same_way { end } else { 1 - end };
        let approach = solid.approach_end(end_of_solid, ends, radius);
        let other = approach.and_then(|approach| touched(&approach, radius));
        let deeper = match (own, other) {
            (Some(own), Some(other)) if other.depth > own.depth => Some(other),
            (None, other) => other,
            (own, _) => own,
        };
        // No part of a body is deeper than the whole, but for rounding.
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
