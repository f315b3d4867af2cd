//! Closed surface of flat polygons (*facets*), and its cut by a half space.

use super::half_space::HalfSpace;
use super::moments::{Moments, Tetrahedra};
use crate::{Transform, Vec3, divisor};

/// Bytes of an edge.
const EDGE: usize = size_of::<[u32; 2]>();

/// Closed surface of facets: flat polygons with any number of corners. A facet is stored as directed edges in
/// any order, which form one closed cycle or several. Seen from outside the solid, the edges run
/// counter-clockwise around the facet and clockwise around a hole in it. So a facet may be concave, have
/// holes or consist of several parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    vertices: Vec<Vec3>,
    /// Start and end of each edge (indices into `vertices`), facet after facet.
    edges: Vec<[u32; 2]>,
    /// For each facet, the index in `edges` after its last edge.
    ends: Vec<usize>,
}

impl Surface {
    /// Bytes that [`with_capacity`](Self::with_capacity) takes per facet.
    pub(super) const BYTES_PER_FACET: usize = 2 * size_of::<Vec3>() + 6 * EDGE + size_of::<usize>();

    /// Creates an empty surface with room for a convex solid of `facets` facets.
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

    /// Adds a facet with one outline. `corners` are indices of vertices, counter-clockwise seen from outside.
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

    /// Returns the vertices, m.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Returns the number of facets.
    pub fn facet_count(&self) -> usize {
        self.ends.len()
    }

    /// Returns the directed edges of each facet, as pairs of indices of vertices.
    pub fn facets(&self) -> impl Iterator<Item = &[[u32; 2]]> {
        let firsts = std::iter::once(0).chain(self.ends.iter().copied());
        firsts.zip(&self.ends).map(|(first, &end)| &self.edges[first..end])
    }

    /// Returns the area of all facets, m².
    pub fn area(&self) -> f64 {
        let twice = |facet: &[[u32; 2]]| {
            let apex = self.vertices[facet[0][0] as usize];
            let from = |index: u32| self.vertices[index as usize] - apex;
            facet.iter().map(|[start, end]| from(*start).cross(&from(*end))).sum::<Vec3>().norm()
        };
        self.facets().map(twice).sum::<f64>() / 2.0
    }

    /// Returns the least and the greatest coordinates of the vertices, m; +∞ and −∞ if there are none.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let none = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        self.vertices.iter().fold(none, |(low, high), vertex| (low.inf(vertex), high.sup(vertex)))
    }

    /// Returns the closed surface of the part inside a half space. It is empty if that part has no volume.
    ///
    /// The part inside the opposite half space is the rest of the solid. On the plane, the vertices of the
    /// two parts have the same bits.
    pub fn cut_by(&self, half_space: &HalfSpace) -> Self {
        let mut part = Self::default();
        match Cutter::default().cut_into(&mut part, self, |x| half_space.depth(x)) {
            Part::Nothing => Self::default(),
            Part::Whole => self.clone(),
            Part::Cut => part,
        }
    }

    /// Replaces this surface by a copy of another one. It allocates only if its own memory is too small.
    pub(super) fn copy(&mut self, other: &Self) {
        self.vertices.clone_from(&other.vertices);
        self.edges.clone_from(&other.edges);
        self.ends.clone_from(&other.ends);
    }

    /// Replaces this surface by a copy of another that is given in frame A. `x_ba` carries it into frame B.
    pub(super) fn copy_moved(&mut self, other: &Self, x_ba: &Transform) {
        self.vertices.clear();
        self.vertices.extend(other.vertices.iter().map(|vertex| x_ba.point(vertex)));
        self.edges.clone_from(&other.edges);
        self.ends.clone_from(&other.ends);
    }

    /// Returns the moments of the enclosed volume about the point `reference` (m). Each facet is divided into
    /// triangles with its first vertex as a common corner. Each triangle forms a tetrahedron with
    /// `reference`, and the moments are the sum over these tetrahedra, with signs.
    pub fn moments(&self, reference: &Vec3) -> Moments {
        let mut sums = Tetrahedra::default();
        let from = |index: u32| self.vertices[index as usize] - reference;
        for facet in self.facets() {
            let [first, _] = facet[0];
            let apex = from(first);
            // The tetrahedra of a facet that begins at the reference point have no volume.
            if apex == Vec3::zeros() {
                continue;
            }
            for &[start, end] in facet.iter().filter(|[start, end]| *start != first && *end != first) {
                sums.add([apex, from(start), from(end)]);
            }
        }
        sums.moments()
    }

    /// Returns the mean of the vertices, and the radius (m) of the ball around it that contains them.
    pub(super) fn ball(&self) -> (Vec3, f64) {
        let count = self.vertices.len().max(1) as f64;
        let center = self.vertices.iter().sum::<Vec3>() / count;
        (center, self.radius_about(&center))
    }

    /// Returns the greatest distance of a vertex from a point, m.
    pub(super) fn radius_about(&self, center: &Vec3) -> f64 {
        self.vertices.iter().map(|x| (x - center).norm_squared()).fold(0.0, greater).sqrt()
    }

    /// Ends the facet of the edges from `first` on. A facet of at most two edges has no area, so it is
    /// dropped.
    fn end_facet(&mut self, first: usize) {
        if self.edges.len() - first > 2 {
            self.ends.push(self.edges.len());
        } else {
            self.edges.truncate(first);
        }
    }
}

/// Returns the lesser of two numbers; `a` if one is not a number. It is faster than `f64::min`.
fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// Returns the greater of two numbers; `a` if one is not a number. It is faster than `f64::max`.
fn greater(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// Part of a solid inside a half space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    /// No volume.
    Nothing,
    /// The whole solid.
    Whole,
    /// The part on one side of the plane.
    Cut,
}

/// Place of a vertex of the surface that is cut.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Index of the vertex in the result, or `NONE` if it lies outside.
    kept: u32,
    /// Index of its last crossing in [`Cutter::crossings`], or `NONE`.
    crossing: u32,
}

const NONE: u32 = u32::MAX;

/// Vertex where the plane crosses an edge that begins at a vertex inside.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    /// End of the edge outside.
    outer: u32,
    /// Index of the vertex in the result.
    vertex: u32,
    /// Index of the previous crossing at the same inner vertex, or `NONE`.
    previous: u32,
}

/// Workspace for cutting surfaces. Its memory is used again for every cut.
#[derive(Clone, Debug, Default)]
pub struct Cutter {
    /// Depth of each vertex of the surface; negative outside the half space.
    depths: Vec<f64>,
    /// Place of each vertex of the surface.
    places: Vec<Place>,
    /// Vertices where edges cross the plane.
    crossings: Vec<Crossing>,
    /// Edges of the facet that closes the cut (the *cap*).
    cap: Vec<[u32; 2]>,
    result: Surface,
}

impl Cutter {
    /// Bytes that [`with_capacity`](Self::with_capacity) takes per facet.
    pub(super) const BYTES_PER_FACET: usize =
        2 * (size_of::<f64>() + size_of::<Place>()) + size_of::<Crossing>() + EDGE + Surface::BYTES_PER_FACET;

    /// Creates a workspace for convex solids of up to `facets` facets.
    pub(super) fn with_capacity(facets: usize) -> Self {
        Self {
            depths: Vec::with_capacity(2 * facets),
            places: Vec::with_capacity(2 * facets),
            crossings: Vec::with_capacity(facets),
            cap: Vec::with_capacity(facets),
            result: Surface::with_capacity(facets),
        }
    }

    /// Replaces a closed surface by its part inside a half space, as [`Surface::cut_by`] returns it.
    pub fn cut_by(&mut self, surface: &mut Surface, half_space: &HalfSpace) {
        if self.cut(surface, |x| half_space.depth(x)) == Part::Nothing {
            surface.clear();
        }
    }

    /// Cuts a surface by the half space in which the affine function `depth` is not negative, and keeps the
    /// part inside. If this part has no volume, `surface` stays as it is.
    pub(super) fn cut(&mut self, surface: &mut Surface, depth: impl Fn(&Vec3) -> f64) -> Part {
        let part = self.measure(surface, depth);
        if part == Part::Cut {
            self.cut_facets(surface);
            std::mem::swap(surface, &mut self.result);
        }
        part
    }

    /// Stores the part of a surface inside a half space in `target`, if the plane divides the surface. See
    /// [`cut`](Self::cut).
    pub(super) fn cut_into(
        &mut self,
        target: &mut Surface,
        surface: &Surface,
        depth: impl Fn(&Vec3) -> f64,
    ) -> Part {
        let part = self.measure(surface, depth);
        if part == Part::Cut {
            self.cut_facets(surface);
            std::mem::swap(target, &mut self.result);
        }
        part
    }

    /// Computes the depths of all vertices. The part inside has no volume if no depth is positive. Exception:
    /// if all depths are zero, as between two faces in one plane, it is the whole surface.
    fn measure(&mut self, surface: &Surface, depth: impl Fn(&Vec3) -> f64) -> Part {
        self.depths.clear();
        self.depths.extend(surface.vertices.iter().map(depth));
        let least = self.depths.iter().copied().fold(f64::INFINITY, lesser);
        let greatest = self.depths.iter().copied().fold(f64::NEG_INFINITY, greater);
        // For an empty surface `least` is +∞, so it is tested by `is_empty`.
        if greatest <= 0.0 && (least < 0.0 || surface.vertices.is_empty()) {
            Part::Nothing
        } else if least < 0.0 {
            Part::Cut
        } else {
            Part::Whole
        }
    }

    /// Stores the part of the surface with depths that are not negative in `result`.
    fn cut_facets(&mut self, surface: &Surface) {
        self.crossings.clear();
        self.cap.clear();
        self.keep_inner_vertices(surface);
        for facet in surface.facets() {
            let kept = |index: u32| self.places[index as usize].kept;
            // Most facets lie on one side of the plane. Each vertex of a facet begins an edge of it.
            let outside = facet.iter().map(|[start, _]| usize::from(kept(*start) == NONE)).sum::<usize>();
            if outside == 0 {
                self.result.edges.extend(facet.iter().map(|&[start, end]| [kept(start), kept(end)]));
                self.result.ends.push(self.result.edges.len());
            } else if outside < facet.len() {
                self.cut_facet(&surface.vertices, facet);
            }
        }
        let first = self.result.edges.len();
        self.result.edges.extend_from_slice(&self.cap);
        self.result.end_facet(first);
    }

    fn keep_inner_vertices(&mut self, surface: &Surface) {
        let Self { places, depths, result, .. } = self;
        result.clear();
        places.clear();
        let mut count = 0;
        places.extend(depths.iter().map(|depth| {
            let inside = *depth >= 0.0;
            let kept = if inside { count } else { NONE };
            count += u32::from(inside);
            Place { kept, crossing: NONE }
        }));
        let inner = surface.vertices.iter().zip(places.iter()).filter(|(_, place)| place.kept != NONE);
        result.vertices.extend(inner.map(|(vertex, _)| *vertex));
    }

    /// Adds the part of a facet inside the half space to the result. An edge along the cut runs from a place
    /// where the outline leaves the half space to a place where it enters again; reversed, it belongs to the
    /// cap.
    ///
    /// The outline may cross the plane more than twice, and its edges may come in any order. So each exit is
    /// joined to the first crossing (`pivot`), and the first crossing to each entry. Along the line of the
    /// cut, these directed edges add up to one edge where the facet is inside, and cancel elsewhere.
    fn cut_facet(&mut self, vertices: &[Vec3], facet: &[[u32; 2]]) {
        let first = self.result.edges.len();
        let mut pivot = NONE;
        for &[start, end] in facet {
            let (kept_start, kept_end) = (self.places[start as usize].kept, self.places[end as usize].kept);
            match (kept_start != NONE, kept_end != NONE) {
                (true, true) => self.result.edges.push([kept_start, kept_end]),
                (false, false) => {}
                (true, false) => {
                    let exit = self.crossing(vertices, start, end);
                    self.add_edge(kept_start, exit);
                    pivot = if pivot == NONE { exit } else { pivot };
                    self.add_along_cut(exit, pivot);
                }
                (false, true) => {
                    let entry = self.crossing(vertices, end, start);
                    pivot = if pivot == NONE { entry } else { pivot };
                    self.add_along_cut(pivot, entry);
                    self.add_edge(entry, kept_end);
                }
            }
        }
        self.result.end_facet(first);
    }

    /// Returns the index in `result` of the vertex where an edge crosses the plane. Both facets at the edge
    /// get the same vertex, so the surface stays closed.
    fn crossing(&mut self, vertices: &[Vec3], inner: u32, outer: u32) -> u32 {
        let depth = self.depths[inner as usize];
        let Place { kept, crossing: last } = self.places[inner as usize];
        if depth == 0.0 {
            return kept;
        }
        let mut earlier = last;
        while let Some(crossing) = self.crossings.get(earlier as usize) {
            if crossing.outer == outer {
                return crossing.vertex;
            }
            earlier = crossing.previous;
        }
        // The crossing is computed from the end nearer to the plane, so a cut by the opposite half space
        // gives the same bits.
        let height = -self.depths[outer as usize];
        let from_inner = depth < height || (depth == height && inner < outer);
        let (near, far) = if from_inner { (inner, outer) } else { (outer, inner) };
        let (near, far) = (&vertices[near as usize], &vertices[far as usize]);
        let share = depth.min(height) / divisor(depth + height);
        let vertex = self.result.vertices.len() as u32;
        self.result.vertices.push(near + (far - near) * share);
        self.places[inner as usize].crossing = self.crossings.len() as u32;
        self.crossings.push(Crossing { outer, vertex, previous: last });
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
