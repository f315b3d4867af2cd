//! Limits of the sizes of primitives.
//!
//! Interference tests multiply up to four lengths, and bounding boxes are in single precision: between these
//! limits neither overflows nor underflows. Beyond them contacts would be missed without a warning.

use super::reader::Reader;
use crate::draft::BodyDraft;
use crate::limits::{LARGEST_SIZE, SMALLEST_SIZE};
use crate::model::PrimitiveInfo;
use pong_geometry::Vec3;
use pong_geometry::primitive::{Frustum, PrimitiveKind};

/// Reports a primitive that is too small or too large; returns `true` if the size is valid.
pub(super) fn check(reader: &mut Reader<'_>, draft: &BodyDraft, info: &PrimitiveInfo, at: u32) -> bool {
    if !reader.judges_shapes {
        return true;
    }
    let outside = |(_, size): &(&str, f64)| !(SMALLEST_SIZE..=LARGEST_SIZE).contains(size);
    let Some((what, size)) = sizes(draft, info).into_iter().find(outside) else { return true };
    let cause = format!("{what} is {size:e} m; sizes are from {SMALLEST_SIZE:e} to {LARGEST_SIZE:e} m");
    reader.fault(at, &info.path, "size-range", cause, "check the unit");
    false
}

/// Sizes that must lie between the limits, with their names, m.
fn sizes(draft: &BodyDraft, info: &PrimitiveInfo) -> Vec<(&'static str, f64)> {
    let body = &draft.body;
    let first = info.elements.start as usize;
    let mut sizes: Vec<(&'static str, f64)> =
        info.thickness.iter().map(|thickness| ("the thickness", *thickness)).collect();
    match info.kind {
        PrimitiveKind::LineSegment => {
            let [a, b] = body.segments[first].ends;
            sizes.push(("the length", longest(&[a - b])));
        }
        PrimitiveKind::Ray => {
            let ray = &body.rays[first];
            sizes.push(("the length", ray.length));
            // The reach of a ray may be zero.
            sizes.extend(ray.reach.filter(|reach| *reach > 0.0).map(|reach| ("the reach", reach)));
        }
        PrimitiveKind::Sphere => sizes.push(("the radius", body.spheres[first].radius)),
        PrimitiveKind::Ellipsoid => {
            let axes = body.ellipsoids[first].semi_axes;
            sizes.extend([("a semi-axis", axes.min()), ("a semi-axis", axes.max())]);
        }
        PrimitiveKind::Triangle => {
            let triangles =
                &body.triangles.triangles[info.elements.start as usize..info.first_mirror as usize];
            let edges = triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.vertices.map(|vertex| body.triangles.vertices[vertex as usize]);
                longest(&[b - a, c - b, a - c])
            });
            let (least, most) =
                edges.fold((f64::INFINITY, 0.0_f64), |(least, most), edge| (least.min(edge), most.max(edge)));
            sizes.extend([("the longest edge of a triangle", least), ("an edge", most)]);
        }
        PrimitiveKind::Capsule => {
            let capsule = &body.capsules[first];
            let [a, b] = capsule.ends;
            sizes.extend([("the length", longest(&[a - b])), ("the radius", capsule.radius)]);
        }
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => sizes.extend(of_frustum(&body.frusta[first])),
        PrimitiveKind::Bore => {
            let bore = &body.bores[first];
            sizes.extend(of_frustum(&bore.hole));
            sizes.push(("the thickness", bore.thickness));
        }
        PrimitiveKind::Polyhedron => sizes.push(("the diameter", draft.hulls[first].diameter)),
        PrimitiveKind::Point | PrimitiveKind::Plane | PrimitiveKind::Custom => {}
    }
    sizes
}

/// Sizes of a frustum; the radius of an apex is left out.
fn of_frustum(frustum: &Frustum) -> Vec<(&'static str, f64)> {
    let radii = frustum.radii.into_iter().filter(|radius| *radius > 0.0);
    let [a, b] = frustum.ends;
    radii.map(|radius| ("a radius", radius)).chain([("the length", longest(&[a - b]))]).collect()
}

/// Length of the longest vector, by its largest component, which is smaller by √3 at most: squares might
/// leave the range of numbers.
fn longest(vectors: &[Vec3]) -> f64 {
    vectors.iter().map(Vec3::amax).fold(0.0, f64::max)
}
