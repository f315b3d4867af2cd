//! Duplicate geometry that pushes twice: points on ends of segments, primitives in one place, coplanar faces.

use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Vec3};
use pong_model::flush::{FlushPair, PlacedGroup, flush_pairs};
use pong_model::{Model, MovableGroup};
use std::collections::HashMap;

/// A point is at a segment's end if it is nearer than this share of the segment's length.
const NEAR: f64 = 1e-6;
/// Number of duplicates listed one by one.
const LISTED: usize = 20;

/// Warnings, one for each duplicate in a movable group.
pub(super) fn warnings(model: &Model) -> Vec<String> {
    let mut lines: Vec<String> =
        model.bodies.iter().flat_map(|body| points_on_segments(body, model)).collect();
    cut(&mut lines, "points sit on ends of segments");
    let mut repeated: Vec<String> = model.bodies.iter().flat_map(in_one_place).collect();
    cut(&mut repeated, "primitives are there twice");
    let mut flush: Vec<String> = model.bodies.iter().flat_map(flush_faces).collect();
    cut(&mut flush, "pairs of primitives are flush");
    lines.extend(repeated.into_iter().chain(flush));
    lines
}

fn cut(lines: &mut Vec<String>, what: &str) {
    let more = lines.len().saturating_sub(LISTED);
    if more > 0 {
        lines.truncate(LISTED);
        lines.push(format!("{more} more {what}"));
    }
}

/// Points, spheres, ellipsoids, segments and round parts of one body with equal numbers.
fn in_one_place(body: &MovableGroup) -> Vec<String> {
    let mut seen: HashMap<(PrimitiveKind, Vec<u64>), &str> = HashMap::new();
    let mut lines = Vec::new();
    for info in &body.primitives {
        let Some(numbers) = numbers(body, info.kind, info.elements.start as usize) else { continue };
        let bits = numbers.iter().map(|x| (x + 0.0).to_bits()).collect();
        let first = *seen.entry((info.kind, bits)).or_insert(&info.path);
        if first != info.path {
            lines.push(format!(
                "`{}` and `{first}` are the same {} in one place: their springs add; leave one out",
                info.path,
                info.kind.name(),
            ));
        }
    }
    lines
}

/// Numbers in which primitives of one kind can differ, independent of the order of two ends.
fn numbers(body: &MovableGroup, kind: PrimitiveKind, index: usize) -> Option<Vec<f64>> {
    let [one, other] = ends(body, kind, index)?;
    let both = match one.0.as_slice().partial_cmp(other.0.as_slice()) {
        Some(std::cmp::Ordering::Greater) => [other, one],
        _ => [one, other],
    };
    Some(both.iter().flat_map(|(end, radius)| [end.x, end.y, end.z, *radius]).collect())
}

/// Two ends of the axis of a primitive and the radii there, m; equal ends for points and spheres. `None` for kinds
/// without an axis.
pub(super) fn ends(body: &MovableGroup, kind: PrimitiveKind, index: usize) -> Option<[(Vec3, f64); 2]> {
    let with = |ends: &[Vec3; 2], radii: [f64; 2]| [(ends[0], radii[0]), (ends[1], radii[1])];
    Some(match kind {
        PrimitiveKind::Point => [(body.points[index].position, 0.0); 2],
        PrimitiveKind::Sphere => [(body.spheres[index].center, body.spheres[index].radius); 2],
        PrimitiveKind::LineSegment => with(&body.segments[index].ends, [0.0; 2]),
        PrimitiveKind::Capsule => with(&body.capsules[index].ends, [body.capsules[index].radius; 2]),
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => {
            with(&body.frusta[index].ends, body.frusta[index].radii)
        }
        PrimitiveKind::Bore => with(&body.bores[index].hole.ends, body.bores[index].hole.radii),
        _ => return None,
    })
}

fn flush_faces(body: &MovableGroup) -> Vec<String> {
    let pairs = flush_pairs(&[PlacedGroup { group: body, pose: Pose::identity() }]);
    let path = |(_, primitive): (usize, usize)| &body.primitives[primitive].path;
    let line = |FlushPair { primitives: [one, other], overlap }: FlushPair| match overlap {
        true => format!(
            "`{}` and `{}` lie in one plane and overlap: what touches both there is pushed twice; leave one out, or declare a \
             group above both `one_surface: true`",
            path(one),
            path(other)
        ),
        false => format!(
            "`{}` and `{}` are flush, but not one surface: what rolls or slides over their seam is pushed by both, up to twice; \
             declare a group above both `one_surface: true`, or let them share vertices (triangles) or an inner wall \
             (`inactive_faces` of polyhedra)",
            path(one),
            path(other)
        ),
    };
    pairs.into_iter().map(line).collect()
}

fn points_on_segments(body: &MovableGroup, model: &Model) -> Vec<String> {
    let primitives = |kind| body.primitives.iter().filter(move |info| info.kind == kind);
    let mut points: Vec<(Vec3, usize)> = Vec::new();
    for (index, info) in body.primitives.iter().enumerate().filter(|(_, i)| i.kind == PrimitiveKind::Point) {
        points.push((body.points[info.elements.start as usize].position, index));
    }
    points.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let mut lines = Vec::new();
    for info in primitives(PrimitiveKind::LineSegment) {
        let segment = &body.segments[info.elements.start as usize];
        let near = NEAR * (segment.ends[1] - segment.ends[0]).norm();
        for end in &segment.ends {
            let first = points.partition_point(|(p, _)| p.x < end.x - near);
            let beside = points[first..].iter().take_while(|(p, _)| p.x <= end.x + near);
            for (_, index) in beside.filter(|(p, _)| (p - end).norm() <= near) {
                let point = &body.primitives[*index];
                let stiffness = |surface: u32| model.surfaces[surface as usize].stiffness;
                let sum = stiffness(point.surface) + 0.5 * stiffness(info.surface);
                lines.push(format!(
                    "`{}` sits on an end of `{}`: their springs add up to {} N/m there; leave the point out unless \
                     that is meant",
                    point.path,
                    info.path,
                    crate::text::number(sum),
                ));
            }
        }
    }
    lines
}
