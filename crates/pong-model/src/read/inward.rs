//! Detection of closed meshes that face inwards.

use pong_geometry::Vec3;
use pong_geometry::primitive::{TriangleRecord, TriangleSet};

/// Volume enclosed by triangles that are closed and face inwards, m³; `None` if they are open, inconsistently
/// wound or face outwards.
pub(super) fn inward_volume_m3(set: &TriangleSet, triangles: &[TriangleRecord]) -> Option<f64> {
    let corners = |t: &TriangleRecord| t.vertices.map(|v| set.vertices[v as usize]);
    let origin = corners(triangles.first()?)[0];
    let six = |t: &TriangleRecord| {
        let [a, b, c]: [Vec3; 3] = corners(t).map(|corner| corner - origin);
        a.dot(&b.cross(&c))
    };
    let volume = triangles.iter().map(six).sum::<f64>() / 6.0;
    // The volume test first: most meshes then need no test of their edges.
    (volume < 0.0 && is_closed(triangles)).then_some(-volume)
}

/// Returns `true` if each edge has two triangles that run along it in opposite directions.
fn is_closed(triangles: &[TriangleRecord]) -> bool {
    let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * triangles.len());
    for [a, b, c] in triangles.iter().map(|triangle| triangle.vertices) {
        let edge = |(from, to): (u32, u32)| (from.min(to), from.max(to), from < to);
        edges.extend([(a, b), (b, c), (c, a)].map(edge));
    }
    edges.sort_unstable();
    let (pairs, rest) = edges.as_chunks::<2>();
    let joins =
        |[one, other]: &[(u32, u32, bool); 2]| (one.0, one.1) == (other.0, other.1) && one.2 != other.2;
    // If four triangles share an edge, the first two in sorted order run the same way.
    rest.is_empty() && pairs.iter().all(joins)
}
