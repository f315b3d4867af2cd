//! Closed surface of planar facets, and its cut by a half space.

use super::moments::Moments;
use crate::{Vec3, divisor};

/// Closed surface of planar facets. A facet is a closed cycle of directed edges, counter-clockwise seen from
/// outside, in any order: it may be concave, have holes or consist of several parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    edges: Vec<Edge>,
    /// End of each facet in `edges`.
    ends: Vec<usize>,
    /// Edges of the facet in the plane of the cut.
    cap: Vec<Edge>,
}

/// Directed edge, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    pub start: Vec3,
    pub end: Vec3,
}

impl Surface {
    /// Makes an empty surface with room for a convex solid of so many facets.
    pub fn with_capacity(facets: usize) -> Self {
        // A convex solid has at most 3·facets − 6 edges, each in two facets.
        let edges = 6 * facets;
        Self {
            edges: Vec::with_capacity(edges),
            ends: Vec::with_capacity(facets),
            cap: Vec::with_capacity(facets),
        }
    }

    /// Removes all facets.
    pub fn clear(&mut self) {
        self.edges.clear();
        self.ends.clear();
    }

    /// Adds a facet by its corners, counter-clockwise seen from outside, m.
    pub fn push(&mut self, corners: impl Iterator<Item = Vec3>) {
        let first = self.edges.len();
        for corner in corners {
            if let Some(last) = self.edges[first..].last_mut() {
                last.end = corner;
            }
            self.edges.push(Edge { start: corner, end: corner });
        }
        if let [start, .., last] = &mut self.edges[first..] {
            last.end = start.start;
        }
        self.ends.push(self.edges.len());
    }

    /// Becomes a copy of another surface.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.edges.clone_from(&other.edges);
        self.ends.clone_from(&other.ends);
    }

    /// Vertices, m, each as often as edges start there.
    pub(super) fn vertices(&self) -> impl Iterator<Item = &Vec3> {
        self.edges.iter().map(|edge| &edge.start)
    }

    /// Facets.
    fn facets(&self) -> impl Iterator<Item = &[Edge]> {
        let firsts = std::iter::once(0).chain(self.ends.iter().copied());
        firsts.zip(&self.ends).map(|(first, &end)| &self.edges[first..end])
    }

    /// Keeps the part where an affine function is not negative. Returns false if it has no volume.
    pub(super) fn clip(&mut self, depth: impl Fn(&Vec3) -> f64, spare: &mut Self) -> bool {
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        for depth in self.vertices().map(&depth) {
            (least, greatest) = (least.min(depth), greatest.max(depth));
        }
        // An empty surface has no greatest depth.
        if greatest <= 0.0 && (least < 0.0 || self.edges.is_empty()) {
            return false;
        }
        if least < 0.0 {
            spare.clear();
            spare.cap.clear();
            self.facets().for_each(|facet| spare.push_clipped(facet, &depth));
            spare.close();
            std::mem::swap(self, spare);
        }
        true
    }

    /// Adds the part of a facet where `depth` is not negative. Edges along the cut go from where the outline
    /// leaves the half space to where it enters again; reversed, they belong to the cap.
    ///
    /// An outline that is cut more than twice is closed by way of its first crossing. The signed edges along
    /// the line of the cut then cover each part inside once and all others zero times.
    fn push_clipped(&mut self, facet: &[Edge], depth: impl Fn(&Vec3) -> f64) {
        let first = self.edges.len();
        let mut pivot = None;
        for edge in facet {
            let (start, end) = (depth(&edge.start), depth(&edge.end));
            match (start >= 0.0, end >= 0.0) {
                (true, true) => self.edges.push(*edge),
                (false, false) => {}
                (true, false) => {
                    let exit = crossing((&edge.start, start), (&edge.end, end));
                    self.push_edge(edge.start, exit);
                    self.push_along_cut(exit, *pivot.get_or_insert(exit));
                }
                (false, true) => {
                    let entry = crossing((&edge.end, end), (&edge.start, start));
                    self.push_along_cut(*pivot.get_or_insert(entry), entry);
                    self.push_edge(entry, edge.end);
                }
            }
        }
        // Two edges there and back enclose no area.
        if self.edges.len() - first > 2 {
            self.ends.push(self.edges.len());
        } else {
            self.edges.truncate(first);
        }
    }

    fn push_edge(&mut self, start: Vec3, end: Vec3) {
        if start != end {
            self.edges.push(Edge { start, end });
        }
    }

    fn push_along_cut(&mut self, start: Vec3, end: Vec3) {
        self.push_edge(start, end);
        if start != end {
            self.cap.push(Edge { start: end, end: start });
        }
    }

    /// Adds the cap as a facet.
    fn close(&mut self) {
        if self.cap.len() > 2 {
            self.edges.extend_from_slice(&self.cap);
            self.ends.push(self.edges.len());
        }
    }

    /// Moments of the enclosed volume about a reference point, which should lie near by: the sum over signed
    /// tetrahedra between the point and triangles of the facets.
    pub fn moments(&self, reference: &Vec3) -> Moments {
        let mut moments = Moments::default();
        // A facet through the reference point adds nothing.
        for facet in self.facets().filter(|facet| facet.iter().all(|edge| edge.start != *reference)) {
            let apex = facet[0].start;
            for edge in facet.iter().filter(|edge| edge.start != apex && edge.end != apex) {
                moments.add([apex - reference, edge.start - reference, edge.end - reference]);
            }
        }
        moments
    }
}

/// Point of an edge where the depth is zero. Both facets of an edge pass the inner end first, so both get the
/// same bits.
fn crossing((inside, depth): (&Vec3, f64), (outside, beyond): (&Vec3, f64)) -> Vec3 {
    inside + (outside - inside) * (depth / divisor(depth - beyond))
}
