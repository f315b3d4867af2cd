//! Closed surface of planar facets, and its cut by a half space.

use super::moments::Moments;
use crate::{Vec3, divisor};

/// Closed surface of planar facets. A facet is a closed cycle of directed edges, counter-clockwise seen from
/// outside, in any order: it may be concave, have holes or consist of several parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    vertices: Vec<Vec3>,
    /// Start and end of each edge, facet after facet.
    edges: Vec<[u32; 2]>,
    /// End of each facet in `edges`.
    ends: Vec<usize>,
}

impl Surface {
    /// Makes an empty surface with room for a convex solid of so many facets.
    pub fn with_capacity(facets: usize) -> Self {
        // A convex solid has at most 2·facets − 4 vertices and 3·facets − 6 edges, each in two facets.
        Self {
            vertices: Vec::with_capacity(2 * facets),
            edges: Vec::with_capacity(6 * facets),
            ends: Vec::with_capacity(facets),
        }
    }

    /// Removes all vertices and facets.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.edges.clear();
        self.ends.clear();
    }

    /// Adds vertices, m.
    pub fn add_vertices(&mut self, vertices: impl Iterator<Item = Vec3>) {
        self.vertices.extend(vertices);
    }

    /// Adds a facet by the indices of its corners, counter-clockwise seen from outside.
    pub fn add_facet(&mut self, mut corners: impl Iterator<Item = u32>) {
        let Some(first) = corners.next() else { return };
        let mut start = first;
        for end in corners {
            self.edges.push([start, end]);
            start = end;
        }
        self.edges.push([start, first]);
        self.ends.push(self.edges.len());
    }

    /// Vertices, m.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Becomes a copy of another surface.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.vertices.clone_from(&other.vertices);
        self.edges.clone_from(&other.edges);
        self.ends.clone_from(&other.ends);
    }

    /// Facets.
    fn facets(&self) -> impl Iterator<Item = &[[u32; 2]]> {
        let firsts = std::iter::once(0).chain(self.ends.iter().copied());
        firsts.zip(&self.ends).map(|(first, &end)| &self.edges[first..end])
    }

    /// Moments of the enclosed volume about a vertex: the sum over signed tetrahedra between the vertex and
    /// triangles of the facets.
    pub(super) fn moments(&self, reference: &Vec3) -> Moments {
        let mut moments = Moments::default();
        let from = |index: u32| self.vertices[index as usize] - reference;
        for facet in self.facets() {
            let [first, _] = facet[0];
            let apex = from(first);
            // A facet that begins at the reference point adds nothing.
            if apex == Vec3::zeros() {
                continue;
            }
            for &[start, end] in facet.iter().filter(|[start, end]| *start != first && *end != first) {
                moments.add([apex, from(start), from(end)]);
            }
        }
        moments
    }

    /// Adds the edges of a facet; two edges there and back enclose no area and are left out.
    fn end_facet(&mut self, first: usize) {
        if self.edges.len() - first > 2 {
            self.ends.push(self.edges.len());
        } else {
            self.edges.truncate(first);
        }
    }
}

/// Workspace that cuts surfaces.
#[derive(Clone, Debug, Default)]
pub(super) struct Cutter {
    /// Depth of each vertex.
    depths: Vec<f64>,
    /// Index of each vertex that is kept, in the result.
    kept: Vec<u32>,
    /// Edges that the plane crosses, from their inner to their outer end, with the vertex at the crossing.
    crossings: Vec<([u32; 2], u32)>,
    /// Edges of the facet in the plane of the cut.
    cap: Vec<[u32; 2]>,
    result: Surface,
}

impl Cutter {
    /// Makes a workspace for convex solids of so many facets.
    pub fn with_capacity(facets: usize) -> Self {
        Self {
            depths: Vec::with_capacity(2 * facets),
            kept: Vec::with_capacity(2 * facets),
            crossings: Vec::with_capacity(facets),
            cap: Vec::with_capacity(facets),
            result: Surface::with_capacity(facets),
        }
    }

    /// Keeps the part of a surface where an affine function is not negative. Returns false if it has no volume.
    pub fn cut(&mut self, surface: &mut Surface, depth: impl Fn(&Vec3) -> f64) -> bool {
        self.depths.clear();
        self.depths.extend(surface.vertices.iter().map(depth));
        let least = self.depths.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = self.depths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // An empty surface has no greatest depth.
        if greatest <= 0.0 && (least < 0.0 || surface.vertices.is_empty()) {
            return false;
        }
        if least < 0.0 {
            self.keep_inner_vertices(surface);
            surface.facets().for_each(|facet| self.cut_facet(&surface.vertices, facet));
            let first = self.result.edges.len();
            self.result.edges.extend_from_slice(&self.cap);
            self.result.end_facet(first);
            std::mem::swap(surface, &mut self.result);
        }
        true
    }

    fn keep_inner_vertices(&mut self, surface: &Surface) {
        self.result.clear();
        self.crossings.clear();
        self.cap.clear();
        self.kept.clear();
        for (vertex, depth) in surface.vertices.iter().zip(&self.depths) {
            self.kept.push(self.result.vertices.len() as u32);
            if *depth >= 0.0 {
                self.result.vertices.push(*vertex);
            }
        }
    }

    /// Adds the inner part of a facet. An edge along the cut goes from where the outline leaves the half space
    /// to where it enters again; reversed, it belongs to the cap.
    ///
    /// An outline that is cut more than twice is closed by way of its first crossing. The signed edges along
    /// the line of the cut then cover each part inside once and all others zero times.
    fn cut_facet(&mut self, vertices: &[Vec3], facet: &[[u32; 2]]) {
        let first = self.result.edges.len();
        let mut pivot = None;
        for &[start, end] in facet {
            match (self.depths[start as usize] >= 0.0, self.depths[end as usize] >= 0.0) {
                (true, true) => self.add_edge(self.kept[start as usize], self.kept[end as usize]),
                (false, false) => {}
                (true, false) => {
                    let exit = self.crossing(vertices, start, end);
                    self.add_edge(self.kept[start as usize], exit);
                    self.add_along_cut(exit, *pivot.get_or_insert(exit));
                }
                (false, true) => {
                    let entry = self.crossing(vertices, end, start);
                    self.add_along_cut(*pivot.get_or_insert(entry), entry);
                    self.add_edge(entry, self.kept[end as usize]);
                }
            }
        }
        self.result.end_facet(first);
    }

    /// Vertex where an edge crosses the plane; both facets of the edge get the same one.
    fn crossing(&mut self, vertices: &[Vec3], inner: u32, outer: u32) -> u32 {
        let depth = self.depths[inner as usize];
        if depth == 0.0 {
            return self.kept[inner as usize];
        }
        if let Some((_, vertex)) = self.crossings.iter().find(|(edge, _)| *edge == [inner, outer]) {
            return *vertex;
        }
        let (inside, outside) = (&vertices[inner as usize], &vertices[outer as usize]);
        let share = depth / divisor(depth - self.depths[outer as usize]);
        let vertex = self.result.vertices.len() as u32;
        self.result.vertices.push(inside + (outside - inside) * share);
        self.crossings.push(([inner, outer], vertex));
        vertex
    }

    fn add_edge(&mut self, start: u32, end: u32) {
        if start != end {
            self.result.edges.push([start, end]);
        }
    }

    fn add_along_cut(&mut self, start: u32, end: u32) {
        if start != end {
            self.result.edges.push([start, end]);
            self.cap.push([end, start]);
        }
    }
}
