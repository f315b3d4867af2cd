//! Round parts: capsule, cylinder, cone and bore.

use super::opened_primitive::Primitive;
use super::reader::Reader;
use pong_geometry::Vec3;
use pong_geometry::primitive::{Bore, Capsule, Frustum};

pub(super) fn capsule(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Capsule> {
    let ends = ends(reader, p, "move one end, or use a Sphere");
    let radius = radius(reader, p);
    Some(Capsule { ends: ends?, radius: radius? })
}

pub(super) fn cylinder(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Frustum> {
    let ends = ends(reader, p, "move one end: a cylinder has a length");
    let radius = radius(reader, p);
    Some(Frustum::new(ends?, [radius?; 2]))
}

pub(super) fn cone(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Frustum> {
    frustum(reader, p, "move one end: a cone has a length", "give one end a radius, or use a LineSegment")
}

/// Reads a bore. The default thickness is the smaller radius.
pub(super) fn bore(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Bore> {
    let hole = frustum(reader, p, "move one end: a bore has a length", "give one end a radius");
    let thickness = match p.fields.optional("thickness") {
        Some(node) => reader.positive(node, &p.path, "the thickness").map(Some),
        None => Some(None),
    };
    let mouths = match p.fields.optional("mouths") {
        Some(node) => reader.boolean_pair(node, &p.path),
        None => Some([true; 2]),
    };
    let (hole, thickness) = (hole?, thickness?);
    let [one, other] = hole.radii;
    let narrowest = if one.min(other) > 0.0 { one.min(other) } else { one.max(other) };
    Some(Bore { hole, thickness: thickness.unwrap_or(narrowest), mouths: mouths? })
}

/// Reads a frustum; the arguments are the cures for an axis of zero length and for zero radii.
fn frustum(
    reader: &mut Reader<'_>,
    p: &Primitive<'_, '_>,
    without_length: &str,
    without_radius: &str,
) -> Option<Frustum> {
    let ends = ends(reader, p, without_length);
    let radii = radii(reader, p, without_radius);
    Some(Frustum::new(ends?, radii?))
}

/// Reads two distinct points.
fn ends(reader: &mut Reader<'_>, p: &Primitive<'_, '_>, cure: &str) -> Option<[Vec3; 2]> {
    let node = p.fields.required(reader, "ends")?;
    let ends = reader.vectors::<2>(node, &p.path)?.map(|end| p.x.point(&end));
    if reader.judges_shapes && ends[0] == ends[1] {
        let cause = "both ends of the axis are the same place";
        return reader.refuse(node.at, &p.path, "zero-length", cause, cure);
    }
    Some(ends)
}

fn radius(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<f64> {
    p.fields.required(reader, "radius").and_then(|node| reader.positive(node, &p.path, "the radius"))
}

/// Reads two radii, one of which may be zero: the apex of a cone.
fn radii(reader: &mut Reader<'_>, p: &Primitive<'_, '_>, cure: &str) -> Option<[f64; 2]> {
    let node = p.fields.required(reader, "radii")?;
    let radii = reader.not_negative_pair(node, &p.path, "a radius")?;
    if reader.judges_shapes && radii == [0.0; 2] {
        let cause = "both radii are zero";
        return reader.refuse(node.at, &p.path, "not-positive", cause, cure);
    }
    Some(radii)
}
