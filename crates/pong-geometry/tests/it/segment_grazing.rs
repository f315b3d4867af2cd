//! A segment that barely enters a solid must barely be pushed, wherever it enters.
//!
//! Degenerate cases: a crossing that has just passed a vertex; a tip outside the solid but below a face of
//! it, beside an inclined flank; a part over a face that ends, untouched, outside the solid.

use crate::common::{Random, cuboid, hull};
use pong_geometry::Vec3;
use pong_geometry::interference::line_segment_polyhedron::line_segment_polyhedron;
use pong_geometry::primitive::{LineSegment, Polyhedron};

/// Petal of a docking ring: its flanks are inclined both ways, so that a corner of its root sticks out.
fn petal() -> Polyhedron {
    let half = [[0.5, 0.275, 0.0], [0.6, 0.3, 0.0], [0.425, 0.04, 0.17], [0.4, 0.03375, 0.17]];
    let corners = half.iter().flat_map(|c| [Vec3::new(c[0], c[1], c[2]), Vec3::new(c[0], -c[1], c[2])]);
    hull(&corners.collect::<Vec<_>>())
}

/// Minus the minimum translation distance, and the direction of the translation.
fn separation(segment: &LineSegment, shape: &Polyhedron) -> (f64, Vec3) {
    let along = segment.ends[1] - segment.ends[0];
    let across = shape.edges.iter().map(|edge| edge.direction.cross(&along)).filter(|n| n.norm() > 1e-9);
    let directions =
        across.flat_map(|n| [n.normalize(), -n.normalize()]).chain(shape.faces.iter().map(|f| f.normal));
    let gap = |n: &Vec3| {
        let nearest = segment.ends.iter().map(|end| n.dot(end)).fold(f64::INFINITY, f64::min);
        nearest - shape.vertices.iter().map(|v| n.dot(&v.position)).fold(f64::NEG_INFINITY, f64::max)
    };
    directions.map(|n| (gap(&n), n)).max_by(|a, b| a.0.total_cmp(&b.0)).expect("a solid has faces")
}

#[test]
fn a_graze_is_never_pushed_through_the_whole_solid() {
    let mut random = Random(77);
    for shape in [petal(), cuboid(Vec3::zeros(), Vec3::new(1.0, 0.7, 0.4))] {
        let graze = 1e-6;
        let mut seen = 0;
        while seen < 60_000 {
            let corner = shape.vertices[random.bits() as usize % shape.vertices.len()].position;
            let near = corner + random.direction() * random.between(0.0, 0.1);
            let far = near + random.direction() * random.between(0.05, 0.8);
            let (gap, n) = separation(&LineSegment { ends: [near, far] }, &shape);
            let segment = LineSegment { ends: [near, far].map(|end| end - n * (gap + graze)) };
            if (separation(&segment, &shape).0 + graze).abs() > 1e-10 {
                continue;
            }
            seen += 1;
            let deepest = line_segment_polyhedron(&segment, &shape)
                .iter()
                .flatten()
                .map(|c| c.depth)
                .fold(0.0, f64::max);
            assert!(deepest > 0.0 && deepest < 20.0 * graze, "{:?}: pushed {deepest} m", segment.ends);
        }
    }
}
