//! Points that sit on the ends of segments: their springs add.

use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Model, MovableGroup};

/// A point this near a segment's end, by the segment's length, sits on it.
const NEAR: f64 = 1e-6;
/// How many are told one by one.
const LISTED: usize = 20;

/// One line for each point that sits on a segment's end.
pub(super) fn warnings(model: &Model) -> Vec<String> {
    let mut lines: Vec<String> = model.bodies.iter().flat_map(|body| in_body(body, model)).collect();
    let more = lines.len().saturating_sub(LISTED);
    if more > 0 {
        lines.truncate(LISTED);
        lines.push(format!("{more} more points sit on ends of segments"));
    }
    lines
}

fn in_body(body: &MovableGroup, model: &Model) -> Vec<String> {
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
