//! Side of entry of solids (docs/theory.md, 2.12): a convex body pushes out of the side through which the other
//! entered, whatever the depth.

use super::Relative;
use super::side::Side;
use crate::frame::input::PairContext;
use crate::state::{ContactKey, ContactRecord, SolidContactPart};
use pong_geometry::overlap::HalfSpace;
use pong_geometry::{Transform, Vec3};

/// Cosine between the direction of entry and a face below which the face does not push: it is a face
/// through which the other body would leave at the far side.
const FAR_SIDE_COSINE: f64 = -0.3;

/// Unit directions that separated two bodies before they overlapped, from one body to the other.
pub(super) struct Entry {
    /// From B to A, in B's frame.
    pub in_b: Vec3,
    /// From A to B, in A's frame.
    pub in_a: Vec3,
    /// Index of the committed record, if there is one.
    pub record: Option<usize>,
}

impl Entry {
    /// Returns true if a face pushes, in the frame in which `entry` is given.
    pub fn pushes(face: &HalfSpace, entry: &Vec3) -> bool {
        face.normal_b.dot(entry) >= FAR_SIDE_COSINE
    }
}

/// Key of a part of the contact of two sides.
pub(super) fn key(
    context: &PairContext<'_>,
    (a, b): (&Side<'_>, &Side<'_>),
    part: SolidContactPart,
) -> ContactKey {
    let PairContext { group_pair, flipped, .. } = *context;
    ContactKey { group_pair, flipped, primitive_a: a.primitive, shell_b: b.shell, end: 0 }
        .of_solids(part, a.unit)
}

/// Committed records of a part of the contact of two sides, with their indices.
pub(super) fn records<'m>(
    context: &PairContext<'m>,
    sides: (&Side<'_>, &Side<'_>),
    part: SolidContactPart,
) -> impl Iterator<Item = (usize, &'m ContactRecord)> {
    let of_key = context.memory.under(&key(context, sides, part));
    let element_b = sides.1.element;
    (of_key.range.first()..).zip(of_key.records).filter(move |(_, record)| record.element_b == element_b)
}

/// Directions of entry of two sides that overlap: those committed, else those of the last committed pose, in
/// which they were apart, else those of least depth. `None` if neither side remembers.
pub(super) fn side_of_entry(
    context: &PairContext<'_>,
    relative: &Relative,
    sides: (&Side<'_>, &Side<'_>),
) -> Option<Entry> {
    let (a, b) = sides;
    if !a.is_whole || !b.is_whole || !context.remembers_entry || !context.a_remembers_entry {
        return None;
    }
    if let Some((index, record)) = records(context, sides, SolidContactPart::Entry).next() {
        return Some(Entry { in_b: record.normal_b, in_a: record.bristle_b, record: Some(index) });
    }
    let earlier = context.motion.since_commit.as_ref().map(|since| &since.x_ba);
    let x_ba = earlier.unwrap_or(&relative.x_ba);
    let in_b = separating_direction(a, b, x_ba);
    Some(Entry { in_b, in_a: -x_ba.rotation.tr_mul(&in_b), record: None })
}

/// Face normal along which two convex sides are farthest apart, or overlap least, from B to A in B's frame.
fn separating_direction(a: &Side<'_>, b: &Side<'_>, x_ba: &Transform) -> Vec3 {
    let x_ab = x_ba.inverse();
    let mut best = (f64::NEG_INFINITY, Vec3::z());
    for face in b.faces {
        let gap = gap_above(face, a, x_ba);
        if gap > best.0 {
            best = (gap, face.normal_b);
        }
    }
    // The plane of B has no parts, and then the faces of A say nothing.
    for face in a.faces.iter().filter(|_| !b.parts.is_empty()) {
        let gap = gap_above(face, b, &x_ab);
        if gap > best.0 {
            best = (gap, -x_ba.vector(&face.normal_b));
        }
    }
    best.1
}

/// Height of the lowest vertex of `other` above a face, m; negative below it. `x` transforms from the frame
/// of `other` to that of the face.
fn gap_above(face: &HalfSpace, other: &Side<'_>, x: &Transform) -> f64 {
    let vertices = other.parts.iter().flat_map(|part| part.surface.vertices());
    let within = x.rotation.tr_mul(&face.normal_b);
    let lowest = vertices.map(|vertex| within.dot(vertex)).fold(f64::INFINITY, f64::min);
    lowest + face.normal_b.dot(&x.translation) - face.offset
}
