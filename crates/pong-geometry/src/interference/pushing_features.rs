//! Marks of the edges and vertices of a triangle surface that may push, with bounds of their normals. They
//! are computed once per surface. They save most sphere-triangle tests and change no result.

use super::triangle_features::{EdgeClass, TriangleView, walk_fan_while};
use crate::primitive::{Lean, MayPush, TriangleSet};

/// Stores in every triangle of a set which of its edges and vertices may push, and a bound of the angle
/// between their normals and the triangle's normal. An edge may push if the triangle owns it and the edge is
/// convex or free. A vertex may push if the triangle has the lowest index of all triangles around the vertex.
pub fn mark_pushing(set: &mut TriangleSet) {
    for triangle in 0..set.triangles.len() as u32 {
        let marks = Marks::of(set, triangle);
        let record = &mut set.triangles[triangle as usize];
        record.may_push = MayPush(marks.bits);
        (record.edge_lean, record.vertex_lean) = (marks.edge_lean, marks.vertex_lean);
    }
}

struct Marks {
    /// Bits as in [`MayPush`].
    bits: u8,
    edge_lean: Lean,
    vertex_lean: Lean,
}

impl Marks {
    fn of(set: &TriangleSet, triangle: u32) -> Self {
        let view = TriangleView::new(set, triangle);
        let mut marks = Self { bits: 0, edge_lean: Lean::NONE, vertex_lean: Lean::NONE };
        for k in 0..3 {
            if let Some(lean) = lean_of_edge(set, &view, k) {
                marks.bits |= 1 << k;
                marks.edge_lean = marks.edge_lean.max(lean);
            }
            if let Some(lean) = lean_of_vertex(set, &view, k) {
                marks.bits |= 1 << (3 + k);
                marks.vertex_lean = marks.vertex_lean.max(lean);
            }
        }
        marks
    }
}

/// Returns a bound of the angle between the triangle's normal and the normals along which edge `k` pushes,
/// which extend up to that of the other face. `None` if the triangle does not own the edge, or if the edge is
/// concave or flat.
fn lean_of_edge(set: &TriangleSet, view: &TriangleView, k: usize) -> Option<Lean> {
    if !view.owns_edge(set, k) {
        return None;
    }
    match view.classify_edge(set, k) {
        EdgeClass::Silent { .. } => None,
        EdgeClass::Free => Some(Lean::ANY),
        EdgeClass::Convex { normal, .. } => {
            let (sine, cosine) = (view.normal.cross(&normal).norm(), view.normal.dot(&normal));
            Some(if cosine > 0.0 { Lean::of_tangent(sine / cosine) } else { Lean::ANY })
        }
    }
}

/// Returns a bound of the angle between the triangle's normal and the normals along which a vertex pushes.
/// `None` if another triangle around the vertex has a lower index.
///
/// Let n be the triangle's normal, w a unit vector perpendicular to n, and φ an angle. The vertex pushes
/// along n + w tan φ only if no edge at the vertex has a positive component along this vector. For an edge
/// along u − s·n, with a unit vector u perpendicular to n and the slope of descent s, this means tan φ (w·u)
/// ≤ s. If the edges go round the vertex counter-clockwise, w lies between the vectors u of two consecutive
/// edges, and for one of them w·u is at least the cosine of half the angle between them. So tan φ is at most
/// the largest s (`slope`) over the smallest such cosine (the root of `square`).
fn lean_of_vertex(set: &TriangleSet, view: &TriangleView, corner: usize) -> Option<Lean> {
    /// Cosine of half the angle between two edges, seen along the normal, below which there is no useful
    /// bound.
    const HALF_ANGLE_COSINE_MIN: f64 = 0.1;
    if !view.may_own_vertex(set, corner) {
        return None;
    }
    let (apex, normal) = (view.corners[corner], view.normal);
    let (mut is_lowest, mut goes_round) = (true, true);
    let (mut slope, mut square) = (0.0_f64, 1.0_f64);
    let fan = walk_fan_while(set, view.index, corner, |t, at| {
        is_lowest &= t >= view.index;
        let corners = set.corners(t);
        let edges = [corners[(at + 1) % 3] - apex, corners[(at + 2) % 3] - apex];
        let flat = edges.map(|edge| edge - normal * normal.dot(&edge));
        let lengths = flat.map(|edge| edge.norm());
        goes_round &= normal.dot(&flat[0].cross(&flat[1])) > 0.0;
        if goes_round {
            // The other edge is handled with the next triangle.
            slope = slope.max(-normal.dot(&edges[0]) / lengths[0]);
            square = square.min(0.5 + 0.5 * flat[0].dot(&flat[1]) / (lengths[0] * lengths[1]));
        }
        is_lowest
    })?;
    let is_bounded = goes_round && !fan.open && square > HALF_ANGLE_COSINE_MIN * HALF_ANGLE_COSINE_MIN;
    Some(if is_bounded { Lean::of_tangent(slope / square.sqrt()) } else { Lean::ANY })
}
