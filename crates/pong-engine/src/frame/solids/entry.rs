//! Side of entry of solids (docs/theory.md, 2.12): a convex body pushes out of the side through which the other
//! entered, whatever the depth.

use super::relative::Relative;
use super::side::Side;
use crate::frame::input::PairContext;
use crate::state::{ContactKey, ContactRecord, SolidContactPart};
use pong_geometry::overlap::HalfSpace;
use pong_geometry::{Transform, Vec3};
use pong_model::FieldEdge;

/// Cosine between the direction of entry and a face below which the face does not push: it is a face
/// through which the other body would leave at the far side.
const FAR_SIDE_COSINE: f64 = -0.3;

/// Cosine between the direction of entry and a face above which an edge to a face that is taken away gets a wall.
const NEAR_SIDE_COSINE: f64 = 0.3;

/// Cosine of the angle up to which the directions in the two frames agree (11°). A side face at a right angle to one of
/// them then has a cosine of at least -0.2 with the other, so it pushes, and so does one that faces away by up to 6°.
const SAME_DIRECTION_COSINE: f64 = 0.98;

/// Largest depth, relative to the width of a body, at which its direction of entry may change.
const SHALLOW: f64 = 0.25;

/// Difference, relative to a width, below which two lengths are equal: far above rounding, and below any difference that
/// an author means. Where two lengths are equal, neither rounding nor the order of the two bodies decides.
const EQUAL: f64 = 1e-9;

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
    /// Directions of entry along a unit vector in B's frame, at a pose of A.
    fn along(in_b: Vec3, x_ba: &Transform, record: Option<usize>) -> Self {
        Self { in_b, in_a: -x_ba.rotation.tr_mul(&in_b), record }
    }

    /// Returns true if a face pushes, in the frame in which `entry` is given.
    pub fn pushes(face: &HalfSpace, entry: &Vec3) -> bool {
        face.normal_b.dot(entry) >= FAR_SIDE_COSINE
    }
}

/// Face in place of one that is taken away, at its edge with a face that is turned towards the direction of entry: it
/// contains the edge and that direction, and pushes like the other faces. `None` at other edges.
///
/// Without it the field of a sharp edge would go on beyond the body, along the face that pushes.
pub(super) fn wall_at(edge: &FieldEdge, faces: &[HalfSpace], entry: &Vec3) -> Option<HalfSpace> {
    let [one, other] = edge.faces.map(|face| &faces[face as usize]);
    let (near, removed) = if Entry::pushes(one, entry) { (one, other) } else { (other, one) };
    let [toward, away] = [near, removed].map(|face| face.normal_b.dot(entry));
    if toward <= NEAR_SIDE_COSINE || away >= FAR_SIDE_COSINE {
        return None;
    }
    let normal_b = (removed.normal_b * toward - near.normal_b * away).normalize();
    Some(HalfSpace { normal_b, offset: normal_b.dot(&edge.point) })
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
///
/// A body that rolls or tumbles on another turns its own direction away from the contact. Where the two
/// directions no longer agree, they are taken anew, if the overlap is shallow for both bodies: no face that changes is then
/// near the shared volume. If it is shallow for the thicker body alone, that body takes the direction of the other.
pub(super) fn side_of_entry(
    context: &PairContext<'_>,
    relative: &Relative,
    sides: (&Side<'_>, &Side<'_>),
) -> Option<Entry> {
    let (a, b) = sides;
    if !a.is_whole || !b.is_whole || !context.remembers_entry || !context.a_remembers_entry {
        return None;
    }
    let known = match records(context, sides, SolidContactPart::Entry).next() {
        Some((index, record)) => Entry { in_b: record.normal_b, in_a: record.bristle_b, record: Some(index) },
        None => {
            let earlier = context.motion.since_commit.as_ref().map(|since| &since.x_ba);
            let x_ba = earlier.unwrap_or(&relative.x_ba);
            Entry::along(separating_direction(a, b, x_ba).1, x_ba, None)
        }
    };
    if known.in_b.dot(&relative.x_ba.vector(&known.in_a)) < -SAME_DIRECTION_COSINE {
        return Some(known);
    }
    let (gap, in_b) = separating_direction(a, b, &relative.x_ba);
    let widths = widths(sides, &relative.x_ba, &in_b);
    if -gap < SHALLOW * widths[0].min(widths[1]) {
        return Some(Entry::along(in_b, &relative.x_ba, known.record));
    }
    Some(of_thinner(sides, relative, known))
}

/// Directions of entry that no longer agree, where the overlap is not shallow for both sides. The side that is thinner
/// along its own direction keeps it. The other side takes that direction too, if the overlap along it is shallow for it.
/// Of two sides that are equally thin, the one with the smaller overlap along its own direction counts as the thinner
/// one; if these overlaps are equal too, both keep their directions.
fn of_thinner(sides: (&Side<'_>, &Side<'_>), relative: &Relative, known: Entry) -> Entry {
    let x_ba = &relative.x_ba;
    let own = [-x_ba.vector(&known.in_a), known.in_b];
    let [along_a, along_b] = own.map(|direction| widths(sides, x_ba, &direction));
    let thin = [along_a[0], along_b[1]];
    let thick = [along_a[1], along_b[0]];
    // Overlap along the direction of a side that may keep it, if the other side may take it.
    let [by_a, by_b] = [0, 1].map(|side| {
        let overlap = overlap_along(sides, x_ba, &own[side]);
        (thin[side] <= thin[1 - side] * (1.0 + EQUAL) && overlap < SHALLOW * thick[side]).then_some(overlap)
    });
    let kept = match (by_a, by_b) {
        (Some(a), Some(b)) if (a - b).abs() <= EQUAL * thin[0] => None,
        (Some(a), Some(b)) if a < b => Some(own[0]),
        (Some(_), None) => Some(own[0]),
        (_, Some(_)) => Some(own[1]),
        (None, None) => None,
    };
    match kept {
        Some(kept) => Entry::along(kept, x_ba, known.record),
        None => known,
    }
}

/// Lowest and highest position of the vertices of a side along a direction in its frame, m.
fn extent(side: &Side<'_>, direction: &Vec3) -> [f64; 2] {
    let vertices = side.parts.iter().flat_map(|part| part.surface.vertices());
    let along = vertices.map(|vertex| direction.dot(vertex));
    along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

/// Widths of sides A and B along a direction in B's frame, m. A plane has an infinite width.
fn widths((a, b): (&Side<'_>, &Side<'_>), x_ba: &Transform, direction: &Vec3) -> [f64; 2] {
    let [of_a, of_b] = [extent(a, &x_ba.rotation.tr_mul(direction)), extent(b, direction)];
    [of_a[1] - of_a[0], if b.parts.is_empty() { f64::INFINITY } else { of_b[1] - of_b[0] }]
}

/// Distance by which A has to move along a direction from B to A, in B's frame, until the two no longer overlap along
/// it, m. Infinite for a plane.
fn overlap_along((a, b): (&Side<'_>, &Side<'_>), x_ba: &Transform, direction: &Vec3) -> f64 {
    let [lowest_a, _] = extent(a, &x_ba.rotation.tr_mul(direction));
    let [_, highest_b] = extent(b, direction);
    if b.parts.is_empty() { f64::INFINITY } else { highest_b - lowest_a - direction.dot(&x_ba.translation) }
}

/// Face normal along which two convex sides are farthest apart, or overlap least: the distance along it, m,
/// negative for an overlap, and its direction from B to A in B's frame. Where several normals give the same distance,
/// the direction is their mean, unless they cancel out.
fn separating_direction(a: &Side<'_>, b: &Side<'_>, x_ba: &Transform) -> (f64, Vec3) {
    let x_ab = x_ba.inverse();
    let (mut best, mut sum) = ((f64::NEG_INFINITY, Vec3::z()), Vec3::zeros());
    let mut compare = |(gap, width): (f64, f64), direction: Vec3| {
        let equal = (gap - best.0).abs() <= EQUAL * width;
        if equal {
            sum += direction;
        } else if gap > best.0 {
            sum = direction;
        }
        if gap > best.0 {
            best = (gap, direction);
        }
    };
    for face in b.faces {
        compare(gap_above(face, a, x_ba), face.normal_b);
    }
    // The plane of B has no parts, and then the faces of A say nothing.
    for face in a.faces.iter().filter(|_| !b.parts.is_empty()) {
        compare(gap_above(face, b, &x_ab), -x_ba.vector(&face.normal_b));
    }
    // Parallel faces have one normal, but for rounding.
    let length = sum.norm();
    let is_one_normal = sum.dot(&best.1) >= (1.0 - EQUAL) * length;
    if length > EQUAL && !is_one_normal {
        best.1 = sum / length;
    }
    best
}

/// Height of the lowest vertex of `other` above a face, m; negative below it. Then the width of `other` along the normal
/// of the face, m. `x` transforms from the frame of `other` to that of the face.
fn gap_above(face: &HalfSpace, other: &Side<'_>, x: &Transform) -> (f64, f64) {
    let [lowest, highest] = extent(other, &x.rotation.tr_mul(&face.normal_b));
    (lowest + face.normal_b.dot(&x.translation) - face.offset, highest - lowest)
}
