//! A capsule on a triangle: the end spheres, and the convex or free edges that the axis crosses.

use super::sphere_triangle::test_ball;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{Ball, ChunkCandidates, ElementPair, end_spheres, wrong_kind};
use pong_geometry::interference::Feature;
use pong_geometry::interference::capsule_edge::{ConvexEdge, capsule_edge};
use pong_geometry::interference::triangle_features::{EdgeClass, TriangleView};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Capsule(capsule) = a else { wrong_kind(a) };
    for ball in Ball::at_ends(&end_spheres(capsule)) {
        test_ball(pair, &ball, false, found);
    }
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let may_push = set.triangles[triangle as usize].may_push;
    for k in (0..3).filter(|&k| may_push.edge(k)) {
        let view = TriangleView::new(set, triangle);
        let (normals, free_outward_b) = match view.classify_edge(set, k) {
            EdgeClass::Free => ([view.normal; 2], Some(view.outward(k))),
            EdgeClass::Convex { normal, .. } if view.owns_edge(set, k) => ([view.normal, normal], None),
            EdgeClass::Convex { .. } | EdgeClass::Silent { .. } => continue,
        };
        let feature = Feature::edge(triangle as usize * 3 + k);
        let ends_b = view.edge_ends(k);
        let edge = ConvexEdge { ends_b, normals_b: normals, outwards_b: None, free_outward_b, feature };
        if let Some(crossing) = capsule_edge(capsule, &edge) {
            pair.between_ends(&crossing, found);
        }
    }
}
