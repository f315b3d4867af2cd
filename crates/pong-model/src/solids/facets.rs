//! Faces of solids, and the planes of a mesh.

use crate::hull::area;
use crate::weld::WordMap;
use pong_geometry::Vec3;
use pong_geometry::overlap::HalfSpace;

/// Flat face of a solid.
pub(super) struct Facet {
    pub(super) plane: HalfSpace,
    pub(super) corners: Vec<Vec3>,
}

impl Facet {
    /// Tests whether the height of a triangle is at most `tolerance`, m.
    pub(super) fn is_thin(&self, tolerance: f64) -> bool {
        is_thin(self, area(&self.corners), tolerance)
    }
}

/// Sum of the areas of facets, m².
pub(super) fn total_area(facets: &[Facet]) -> f64 {
    facets.iter().map(|facet| area(&facet.corners)).sum()
}

/// Planes of the triangles of a mesh. A plane is that of its largest triangle, and also of all triangles connected
/// with it whose corners lie within `tolerance` (m) of it. A triangle that is thinner than `tolerance` has no plane
/// of its own, because rounding turns its normal. The planes are in the order of their largest triangles.
pub(super) fn planes_of_mesh(facets: &[Facet], triangles: &[[u32; 3]], tolerance: f64) -> Vec<HalfSpace> {
    let neighbors = neighbors(triangles);
    let areas: Vec<f64> = facets.iter().map(|facet| area(&facet.corners)).collect();
    let mut largest_first: Vec<usize> = (0..facets.len()).collect();
    largest_first.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]).then(a.cmp(&b)));
    let mut is_done = vec![false; facets.len()];
    let mut seeds = Vec::new();
    for seed in largest_first {
        if is_done[seed] || is_thin(&facets[seed], areas[seed], tolerance) {
            continue;
        }
        seeds.push(seed);
        is_done[seed] = true;
        let mut open = vec![seed];
        while let Some(facet) = open.pop() {
            for &next in &neighbors[facet] {
                let next = next as usize;
                if !is_done[next] && lies_near(&facets[next], &facets[seed].plane, tolerance) {
                    is_done[next] = true;
                    open.push(next);
                }
            }
        }
    }
    seeds.sort_unstable();
    seeds.into_iter().map(|seed| facets[seed].plane).collect()
}

/// Tests whether the height of a triangle is at most `tolerance`.
fn is_thin(facet: &Facet, area: f64, tolerance: f64) -> bool {
    let [a, b, c] = [0, 1, 2].map(|k| (facet.corners[(k + 1) % 3] - facet.corners[k]).norm());
    2.0 * area <= tolerance * a.max(b).max(c)
}

/// Tests whether the corners of a facet lie near a plane. A facet that faces the other way is not part of it.
fn lies_near(facet: &Facet, plane: &HalfSpace, tolerance: f64) -> bool {
    facet.plane.normal_b.dot(&plane.normal_b) > 0.5
        && facet.corners.iter().all(|corner| plane.depth(corner).abs() <= tolerance)
}

/// For each triangle, the triangles that share an edge with it.
fn neighbors(triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut at_edge: WordMap<[u32; 2], Vec<u32>> = WordMap::default();
    for (number, &[a, b, c]) in (0..).zip(triangles) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            at_edge.entry([from.min(to), from.max(to)]).or_default().push(number);
        }
    }
    let around = |number: u32, [a, b, c]: [u32; 3]| {
        let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to)]);
        let all = edges.iter().flat_map(|edge| at_edge[edge].iter().copied());
        all.filter(|&other| other != number).collect()
    };
    (0..).zip(triangles).map(|(number, triangle)| around(number, *triangle)).collect()
}
