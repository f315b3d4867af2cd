//! Limits of the sizes of primitives.
//!
//! Interference tests multiply up to four lengths, and bounding boxes are in single precision: between these
//! limits neither overflows nor underflows. Beyond them contacts would be missed without a warning.

use super::reader::Reader;
use crate::draft::BodyDraft;
use crate::limits::{LARGEST_SIZE, SMALLEST_SIZE};
use crate::model::PrimitiveInfo;
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;

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
        PrimitiveKind::Polyhedron => sizes.push(("the diameter", draft.hulls[first].diameter)),
        PrimitiveKind::Custom => {}
        kind => {
            let facts = body.element(kind, info.elements.start).facts();
            sizes.extend(facts.iter().flat_map(|facts| facts.sizes_m()));
        }
    }
    sizes
}

/// Length of the longest vector, by its largest component, which is smaller by √3 at most: squares might
/// leave the range of numbers.
fn longest(vectors: &[Vec3]) -> f64 {
    vectors.iter().map(Vec3::amax).fold(0.0, f64::max)
}
