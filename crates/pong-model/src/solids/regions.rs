//! Regions below the facets of a mesh that is not convex (docs/theory.md, 2.12): where each facet is the nearest
//! face.

use super::crossing::TOUCH;
use super::facets::Facet;
use super::thickened::Triangles;
use crate::hull::PLANE_TOLERANCE;
use crate::solid::SolidFacet;
use crate::solid_box::SolidBox;
use crate::solid_tree::SolidTree;
use crate::weld::WordMap;
use pong_geometry::Vec3;
use pong_geometry::overlap::{Cutter, HalfSpace, Surface};

/// Greatest height of a region, relative to the longest edge of its triangle. It keeps the regions of fine meshes
/// small, so that few of them are near a contact.
const GREATEST_HEIGHT: f64 = 2.0;

/// Distance to which the first block of a region reaches beside its triangle, relative to the greatest height. Walls
/// that lean outwards more than this (174° between two faces) count as leaning this much.
const REACH: f64 = 20.0;

/// Workspace for the regions of a mesh.
#[derive(Default)]
struct Work {
    cutter: Cutter,
    /// Part of a triangle inside a region, and the part of it inside the next plane.
    polygons: [Vec<Vec3>; 2],
}

/// Region below one triangle.
struct Region {
    triangle: u32,
    walls: Vec<HalfSpace>,
    /// The region as a closed surface.
    surface: Surface,
    height: f64,
}

/// Mesh with what regions are made from.
struct Mesh<'m> {
    closed: &'m Triangles,
    /// Planes of the triangles. That of a triangle without a height is the plane of a neighbour.
    planes: Vec<HalfSpace>,
    /// For each triangle, the triangles beyond its edges.
    beyond: Vec<[u32; 3]>,
    /// For each vertex, its triangles: `around[starts[v]..starts[v + 1]]`.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// For each vertex, whether it has a re-entrant edge but no convex one.
    is_reentrant: Vec<bool>,
    is_thin: Vec<bool>,
    tolerance: f64,
}

/// Regions of the triangles of a mesh that push, each with its triangle, and the walls of all regions. `tree` has the
/// boxes around all triangles.
pub(super) fn regions(
    closed: &Triangles,
    facets: &[Facet],
    tree: &SolidTree,
    diameter: f64,
) -> (Vec<(u32, SolidFacet)>, Vec<HalfSpace>) {
    let mesh = Mesh::new(closed, facets, PLANE_TOLERANCE * diameter);
    let (mut found, mut walls, mut near) = (Vec::new(), Vec::new(), Vec::new());
    let mut work = Work::default();
    for triangle in 0..closed.outer as u32 {
        let Some(mut region) = mesh.region(triangle, &mut work) else { continue };
        near.clear();
        tree.meeting(&SolidBox::around(region.surface.vertices()).wider(region.touch()), &mut near);
        mesh.lower(&mut region, &near, &mut work);
        let first = walls.len() as u32;
        let face = mesh.planes[triangle as usize];
        let bound = SolidBox::around(region.surface.vertices());
        walls.append(&mut region.walls);
        found.push((
            region.triangle,
            SolidFacet { bound, face, walls: first..walls.len() as u32, height: region.height },
        ));
    }
    (found, walls)
}

impl<'m> Mesh<'m> {
    fn new(closed: &'m Triangles, facets: &[Facet], tolerance: f64) -> Self {
        let triangles = &closed.triangles;
        let beyond = beyond(triangles);
        let is_thin: Vec<bool> = facets.iter().map(|facet| facet.is_thin(tolerance)).collect();
        let mut planes: Vec<HalfSpace> = facets.iter().map(|facet| facet.plane).collect();
        adopt_planes(&mut planes, facets, &beyond, &is_thin);
        let mut starts = vec![0_u32; closed.vertices.len() + 1];
        triangles.iter().flatten().for_each(|&vertex| starts[vertex as usize + 1] += 1);
        (1..starts.len()).for_each(|at| starts[at] += starts[at - 1]);
        let (mut next, mut around) = (starts.clone(), vec![0; 3 * triangles.len()]);
        for (number, triangle) in (0..).zip(triangles) {
            for &vertex in triangle {
                around[next[vertex as usize] as usize] = number;
                next[vertex as usize] += 1;
            }
        }
        let is_reentrant = Vec::new();
        let mut mesh = Self { closed, planes, beyond, starts, around, is_reentrant, is_thin, tolerance };
        mesh.is_reentrant = mesh.reentrant_vertices();
        mesh
    }

    fn place(&self, vertex: u32) -> &Vec3 {
        &self.closed.vertices[vertex as usize]
    }

    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.closed.triangles[triangle as usize].map(|vertex| *self.place(vertex))
    }

    fn around(&self, vertex: u32) -> &[u32] {
        let range = self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize;
        &self.around[range]
    }

    /// Height of the far corner of the triangle beyond edge `edge` above the plane of a triangle, m: negative at a
    /// convex edge.
    fn bend(&self, triangle: u32, edge: usize) -> f64 {
        let other = self.beyond[triangle as usize][edge];
        let own = self.closed.triangles[triangle as usize];
        let plane = &self.planes[triangle as usize];
        let heights = self.closed.triangles[other as usize].iter().filter(|vertex| !own.contains(vertex));
        heights.map(|&vertex| -plane.depth(self.place(vertex))).sum()
    }

    /// For each vertex, whether it has a re-entrant edge but no convex one.
    fn reentrant_vertices(&self) -> Vec<bool> {
        let mut has = vec![[false; 2]; self.closed.vertices.len()];
        for (number, triangle) in (0..).zip(&self.closed.triangles) {
            for edge in 0..3 {
                let bend = self.bend(number, edge);
                for vertex in [triangle[edge], triangle[(edge + 1) % 3]] {
                    has[vertex as usize][0] |= bend < -self.tolerance;
                    has[vertex as usize][1] |= bend > self.tolerance;
                }
            }
        }
        has.into_iter().map(|[convex, reentrant]| reentrant && !convex).collect()
    }

    /// Region below a triangle, cut off at its greatest height only; `None` if it has no volume.
    fn region(&self, triangle: u32, work: &mut Work) -> Option<Region> {
        if self.is_thin[triangle as usize] {
            return None;
        }
        let face = &self.planes[triangle as usize];
        let corners = self.corners(triangle);
        let longest = (0..3).map(|k| (corners[(k + 1) % 3] - corners[k]).norm()).fold(0.0, f64::max);
        let height = GREATEST_HEIGHT * longest;
        let mut region =
            Region { triangle, walls: Vec::new(), surface: block(face, &corners, height), height };
        (0..3).for_each(|edge| region.cut(self.wall(triangle, edge), work));
        for (corner, &vertex) in self.closed.triangles[triangle as usize].iter().enumerate() {
            // Beyond the two edges at the vertex.
            let [next, last] = [corner, (corner + 2) % 3].map(|edge| self.beyond[triangle as usize][edge]);
            for &other in self.around(vertex) {
                if ![triangle, next, last].contains(&other) && !self.is_thin[other as usize] {
                    let wall = self.vertex_wall(triangle, other, self.is_reentrant[vertex as usize]);
                    region.cut_if_crossed(wall, self.tolerance, work);
                }
            }
        }
        (region.surface.facet_count() > 3).then_some(region)
    }

    /// Wall through an edge of a triangle. It halves the angle to the neighbour, because there both faces are
    /// equally near. Behind a convex edge to a face that does not push, it is that face.
    fn wall(&self, triangle: u32, edge: usize) -> HalfSpace {
        let other = self.beyond[triangle as usize][edge];
        if other as usize >= self.closed.outer && self.bend(triangle, edge) <= 0.0 {
            return self.planes[other as usize];
        }
        let own = self.closed.triangles[triangle as usize];
        let (from, to) = (own[edge], own[(edge + 1) % 3]);
        // Computed from the lower vertex, so that both triangles have the same bits.
        let (low, high) = (self.place(from.min(to)), self.place(from.max(to)));
        let [one, two] = [triangle.min(other), triangle.max(other)].map(|t| self.planes[t as usize].normal_b);
        let mut middle = one + two;
        // Faces that are folded back on each other have no plane between them.
        if middle.norm() < 1e-6 {
            middle = self.planes[triangle as usize].normal_b;
        }
        let normal_b = (high - low).cross(&middle).normalize();
        let plane = HalfSpace { normal_b, offset: normal_b.dot(low) };
        if from < to { plane } else { plane.opposite() }
    }

    /// Wall of the region of a triangle towards another at one of its vertices: points not deeper below the triangle
    /// than below the other. If no edge at the vertex is convex, the deeper face has the points. Elsewhere, a
    /// triangle that is not below the plane of the other has no wall.
    fn vertex_wall(&self, triangle: u32, other: u32, is_reentrant: bool) -> Option<HalfSpace> {
        let beyond = &self.planes[other as usize];
        let is_below = self.corners(triangle).iter().all(|corner| beyond.depth(corner) >= -self.tolerance);
        let sign = match (is_below, is_reentrant) {
            (_, true) => -1.0,
            (true, false) => 1.0,
            (false, false) => return None,
        };
        // Rounding turns the plane between faces that are almost in one plane.
        let bends = |of: u32, by: u32| {
            let plane = &self.planes[of as usize];
            self.corners(by).iter().any(|corner| plane.depth(corner).abs() > self.tolerance)
        };
        if !bends(triangle, other) || !bends(other, triangle) {
            return None;
        }
        let [own, other] = [triangle, other].map(|t| &self.planes[t as usize]);
        let apart = (other.normal_b - own.normal_b) * sign;
        let length = apart.norm();
        (length > 1e-9).then(|| HalfSpace {
            normal_b: apart / length,
            offset: (other.offset - own.offset) * sign / length,
        })
    }

    /// Cuts a region off so that it ends half-way to the next of some triangles that lies in it or touches it. Triangles
    /// with a common vertex are bounded by walls.
    ///
    /// A triangle that only touches the region counts, because rounding would decide whether it lies in the region. A
    /// place on the triangle of the region itself does not.
    fn lower(&self, region: &mut Region, near: &[u32], work: &mut Work) {
        let own = self.closed.triangles[region.triangle as usize];
        let face = &self.planes[region.triangle as usize];
        let (mut height, touch) = (region.height, region.touch());
        for &other in near {
            let corners = self.closed.triangles[other as usize];
            if corners.iter().any(|vertex| own.contains(vertex)) {
                continue;
            }
            let share = if (other as usize) < self.closed.outer { 0.5 } else { 1.0 };
            let planes = || std::iter::once(face).chain(&region.walls);
            let corners = self.corners(other);
            // Most of the triangles near a region are outside of one of its planes.
            if planes().any(|plane| corners.iter().all(|corner| plane.depth(corner) < -touch)) {
                continue;
            }
            let [polygon, next] = &mut work.polygons;
            polygon.clear();
            polygon.extend(corners);
            for plane in planes() {
                clip(polygon, &HalfSpace { offset: plane.offset + touch, ..*plane }, next);
                std::mem::swap(polygon, next);
            }
            let depths = polygon.iter().map(|place| face.depth(place)).filter(|depth| *depth > touch);
            height = depths.map(|depth| share * depth).fold(height, f64::min);
        }
        let floor = HalfSpace { normal_b: -face.normal_b, offset: height - face.offset };
        let deepest = region.surface.vertices().iter().map(|place| face.depth(place)).fold(0.0, f64::max);
        if height < deepest - touch || deepest >= 0.999 * region.height {
            region.cut(floor, work);
            region.height = height;
        } else {
            region.height = f64::INFINITY;
        }
    }
}

impl Region {
    /// Distance up to which a triangle touches the region before it is cut off, m. It follows from the triangle of the
    /// region alone, because heights are known to this distance, and must not depend on axes.
    fn touch(&self) -> f64 {
        TOUCH * self.height
    }

    fn cut(&mut self, wall: HalfSpace, work: &mut Work) {
        work.cutter.cut_by(&mut self.surface, &wall);
        self.walls.push(wall);
    }

    fn cut_if_crossed(&mut self, wall: Option<HalfSpace>, tolerance: f64, work: &mut Work) {
        let crosses = |wall: &HalfSpace| self.surface.vertices().iter().any(|x| wall.depth(x) < -tolerance);
        if let Some(wall) = wall.filter(crosses) {
            self.cut(wall, work);
        }
    }
}

/// Block below a triangle, wider than the triangle on all sides.
fn block(face: &HalfSpace, corners: &[Vec3; 3], height: f64) -> Surface {
    let along = (corners[1] - corners[0]).normalize();
    let across = face.normal_b.cross(&along).normalize();
    let extent = |axis: &Vec3| {
        let places = corners.map(|corner| axis.dot(&corner));
        let low = places.iter().copied().fold(f64::INFINITY, f64::min) - REACH * height;
        let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max) + REACH * height;
        [low, high]
    };
    let (x, y, z) = (extent(&along), extent(&across), [face.offset - height, face.offset]);
    let mut surface = Surface::with_capacity(6);
    surface.add_vertices(
        (0..8).map(|k| along * x[k & 1] + across * y[k >> 1 & 1] + face.normal_b * z[k >> 2 & 1]),
    );
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.iter().for_each(|side| surface.add_facet(side.iter().copied()));
    surface
}

/// Stores the part of a convex polygon inside a half space in `inside`.
fn clip(polygon: &[Vec3], plane: &HalfSpace, inside: &mut Vec<Vec3>) {
    inside.clear();
    for (index, place) in polygon.iter().enumerate() {
        let next = &polygon[(index + 1) % polygon.len()];
        let (depth, after) = (plane.depth(place), plane.depth(next));
        if depth >= 0.0 {
            inside.push(*place);
        }
        if (depth > 0.0) != (after > 0.0) && depth != 0.0 && after != 0.0 {
            inside.push(place + (next - place) * (depth / (depth - after)));
        }
    }
}

/// For each triangle, the triangles beyond its edges; the triangle itself beyond an edge without a neighbour.
fn beyond(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let edges = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let mut of_edge: WordMap<[u32; 2], u32> = WordMap::default();
    for (number, triangle) in (0..).zip(triangles) {
        edges(*triangle).into_iter().for_each(|edge| _ = of_edge.insert(edge, number));
    }
    let other = |number: u32, [a, b]: [u32; 2]| of_edge.get(&[b, a]).copied().unwrap_or(number);
    (0..).zip(triangles).map(|(number, triangle)| edges(*triangle).map(|edge| other(number, edge))).collect()
}

/// Gives each triangle without a height the plane of the neighbour beyond its longest edge, because rounding turns
/// its own normal. Several such triangles may lie side by side.
fn adopt_planes(planes: &mut [HalfSpace], facets: &[Facet], beyond: &[[u32; 3]], is_thin: &[bool]) {
    let mut open: Vec<usize> = (0..planes.len()).filter(|&number| is_thin[number]).collect();
    let mut is_known: Vec<bool> = is_thin.iter().map(|thin| !thin).collect();
    loop {
        let before = open.len();
        open.retain(|&number| {
            let corners = &facets[number].corners;
            let length = |edge: &usize| (corners[(edge + 1) % 3] - corners[*edge]).norm();
            let known = (0..3).filter(|&edge| is_known[beyond[number][edge] as usize]);
            let Some(edge) = known.max_by(|a, b| length(a).total_cmp(&length(b))) else { return true };
            planes[number] = planes[beyond[number][edge] as usize];
            is_known[number] = true;
            false
        });
        if open.is_empty() || open.len() == before {
            return;
        }
    }
}
