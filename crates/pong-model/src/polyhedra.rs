//! Builds polyhedra from checked pieces, with the edges and vertices of the surface that may push, and the
//! normals along which they push.
//!
//! Pushing is decided over the whole surface: pieces joined by internal faces count as one solid, and every
//! feature belongs to the lowest piece that has it.

use crate::hull::Hull;
use crate::weld::{PositionKey, WordMap, position_key};
use pong_geometry::Vec3;
use pong_geometry::primitive::{
    EdgePush, Polyhedron, PolyhedronEdge, PolyhedronFace, PolyhedronParts, PolyhedronVertex, RimEdge,
};
use std::cmp::Ordering;

/// Sine of the angle between two faces up to which they count as flat. It is just above rounding:
/// single-precision coordinates may make a flat edge slightly convex. Such an edge must keep its small range
/// of normals, because otherwise a sphere could fall between the regions of its two faces.
const FLAT_SINE: f64 = 1e-12;

/// Number of rotations of a vertex's normal after which its cone counts as empty.
const TURNS: usize = 1000;

type EdgeKey = (u32, PositionKey, PositionKey);
type VertexKey = (u32, PositionKey);

/// Active face at an edge of the surface.
#[derive(Clone, Copy)]
struct FaceAtEdge {
    normal: Vec3,
    outward: Vec3,
}

/// Edges and faces that meet at a vertex of the surface.
#[derive(Default)]
struct VertexStar {
    directions: Vec<Vec3>,
    normal_sum: Vec3,
    active_faces: u32,
}

/// Builds the polyhedra of a movable group; `surface_of` gives each piece the lowest piece of its surface.
///
/// Also returns, for each edge at which more than two active faces meet, the index of a piece that has the
/// edge, and an end point of the edge.
pub(crate) fn build(hulls: &[Hull], surface_of: &[u32]) -> (Vec<Polyhedron>, Vec<(usize, Vec3)>) {
    let mut polyhedra: Vec<PolyhedronParts> = hulls.iter().map(piece).collect();
    let edges = edges_of_surfaces(&polyhedra, surface_of);
    let mut stars = stars_of_surfaces(&polyhedra, surface_of);
    let mut tangled = Vec::new();
    let mut done: WordMap<EdgeKey, ()> = WordMap::default();
    for (index, polyhedron) in polyhedra.iter_mut().enumerate() {
        for edge in 0..polyhedron.edges.len() {
            let key = edge_key(surface_of[index], polyhedron, edge);
            let faces = &edges[&key];
            let convex = push(faces);
            polyhedron.edges[edge].convex = convex;
            if faces.is_empty() || done.insert(key, ()).is_some() {
                continue;
            }
            if faces.len() > 2 {
                tangled
                    .push((index, polyhedron.vertices[polyhedron.edges[edge].vertices[0] as usize].position));
            }
            polyhedron.edges[edge].push = convex;
            note_edge(&mut stars, surface_of[index], polyhedron, edge);
        }
    }
    for (index, polyhedron) in polyhedra.iter_mut().enumerate() {
        set_cones(polyhedron, surface_of[index], &mut stars);
    }
    (polyhedra.into_iter().map(Polyhedron::new).collect(), tangled)
}

/// Piece with its outline, edges and vertices, none of which pushes yet.
fn piece(hull: &Hull) -> PolyhedronParts {
    let vertex =
        |&position: &Vec3| PolyhedronVertex { position, pushes: false, first_cone: 0, cone_count: 0 };
    let mut polyhedron = PolyhedronParts {
        faces: Vec::with_capacity(hull.faces.len()),
        rims: Vec::new(),
        edges: Vec::new(),
        vertices: hull.vertices.iter().map(vertex).collect(),
        cone_edges: Vec::new(),
        diameter: hull.diameter,
    };
    let mut numbers: WordMap<(u32, u32), u32> = WordMap::default();
    for (index, face) in hull.faces.iter().enumerate() {
        let first_rim = polyhedron.rims.len() as u32;
        for (place, &start) in face.outline.iter().enumerate() {
            let end = face.outline[(place + 1) % face.outline.len()];
            let mut rim = rim(&mut polyhedron, &mut numbers, index as u32, face.normal, [start, end]);
            if let Some(wall) = face.walls.get(place) {
                rim.outward = outward(wall.map(|v| hull.vertices[v as usize]), &face.normal);
            }
            polyhedron.rims.push(rim);
        }
        let rim_count = face.outline.len() as u32;
        let (normal, offset, active, closed) = (face.normal, face.offset, face.active, face.closed);
        polyhedron.faces.push(PolyhedronFace { normal, offset, active, closed, first_rim, rim_count });
    }
    set_neighbors(&mut polyhedron);
    polyhedron
}

/// Edge of a face's outline from the vertex `start` to `end`. Adds the edge to the polyhedron when the first
/// of its two faces is processed.
fn rim(
    polyhedron: &mut PolyhedronParts,
    numbers: &mut WordMap<(u32, u32), u32>,
    face: u32,
    normal: Vec3,
    [start, end]: [u32; 2],
) -> RimEdge {
    let position = |v: u32| polyhedron.vertices[v as usize].position;
    let forward = lexicographic(&position(start), &position(end)) == Ordering::Less;
    let [first, second] = if forward { [start, end] } else { [end, start] };
    let anchor = position(first);
    let direction = unit(&(position(second) - anchor));
    let edge = *numbers.entry((first, second)).or_insert_with(|| {
        let vertices = [first, second];
        polyhedron.edges.push(PolyhedronEdge {
            vertices,
            faces: [face; 2],
            direction,
            push: None,
            convex: None,
        });
        polyhedron.edges.len() as u32 - 1
    });
    polyhedron.edges[edge as usize].faces[1] = face;
    let across = unit(&direction.cross(&normal));
    RimEdge { start, edge, neighbor: face, anchor, outward: if forward { across } else { -across } }
}

/// Unit vector out of a face, perpendicular to the line between two points of its outline.
fn outward([start, end]: [Vec3; 2], normal: &Vec3) -> Vec3 {
    unit(&unit(&(end - start)).cross(normal))
}

fn set_neighbors(polyhedron: &mut PolyhedronParts) {
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let range = face.first_rim as usize..(face.first_rim + face.rim_count) as usize;
        for rim in &mut polyhedron.rims[range] {
            let [a, b] = polyhedron.edges[rim.edge as usize].faces;
            rim.neighbor = if a == index as u32 { b } else { a };
        }
    }
}

fn lexicographic(a: &Vec3, b: &Vec3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

fn unit(v: &Vec3) -> Vec3 {
    (v / v.amax()).normalize()
}

fn edge_key(surface: u32, polyhedron: &PolyhedronParts, edge: usize) -> EdgeKey {
    let [a, b] =
        polyhedron.edges[edge].vertices.map(|v| position_key(&polyhedron.vertices[v as usize].position));
    (surface, a, b)
}

/// Active faces at every edge of every surface, in the order of pieces and faces.
fn edges_of_surfaces(polyhedra: &[PolyhedronParts], surface_of: &[u32]) -> WordMap<EdgeKey, Vec<FaceAtEdge>> {
    let mut edges: WordMap<EdgeKey, Vec<FaceAtEdge>> = WordMap::default();
    for (index, polyhedron) in polyhedra.iter().enumerate() {
        for (number, face) in polyhedron.faces.iter().enumerate() {
            for rim in polyhedron.rim(number) {
                let faces =
                    edges.entry(edge_key(surface_of[index], polyhedron, rim.edge as usize)).or_default();
                if face.active {
                    faces.push(FaceAtEdge { normal: face.normal, outward: rim.outward });
                }
            }
        }
    }
    edges
}

fn stars_of_surfaces(polyhedra: &[PolyhedronParts], surface_of: &[u32]) -> WordMap<VertexKey, VertexStar> {
    let mut stars: WordMap<VertexKey, VertexStar> = WordMap::default();
    for (index, polyhedron) in polyhedra.iter().enumerate() {
        for (number, face) in polyhedron.faces.iter().enumerate().filter(|(_, face)| face.active) {
            for rim in polyhedron.rim(number) {
                let position = polyhedron.vertices[rim.start as usize].position;
                let star = stars.entry((surface_of[index], position_key(&position))).or_default();
                star.normal_sum += face.normal;
                star.active_faces += 1;
            }
        }
    }
    stars
}

/// Range of normals of a convex edge; `None` unless exactly two active faces meet, and convexly.
fn push(faces: &[FaceAtEdge]) -> Option<EdgePush> {
    let [a, b] = faces else { return None };
    // At a convex edge, each face lies below the plane of the other face.
    let convex = a.normal.dot(&b.outward) > FLAT_SINE && b.normal.dot(&a.outward) > FLAT_SINE;
    convex.then_some(EdgePush { normals: [a.normal, b.normal], outwards: [a.outward, b.outward] })
}

/// Records that an edge with an active face bounds the normal cones of both its ends.
fn note_edge(
    stars: &mut WordMap<VertexKey, VertexStar>,
    surface: u32,
    polyhedron: &PolyhedronParts,
    edge: usize,
) {
    let edge = &polyhedron.edges[edge];
    for (vertex, away) in [(edge.vertices[0], edge.direction), (edge.vertices[1], -edge.direction)] {
        let position = polyhedron.vertices[vertex as usize].position;
        let star = stars.entry((surface, position_key(&position))).or_default();
        star.directions.push(away);
    }
}

/// Sets the normal cones of the vertices. A vertex common to several pieces has its cone only in the first of
/// them.
fn set_cones(polyhedron: &mut PolyhedronParts, surface: u32, stars: &mut WordMap<VertexKey, VertexStar>) {
    for vertex in &mut polyhedron.vertices {
        let Some(star) = stars.remove(&(surface, position_key(&vertex.position))) else { continue };
        if star.has_cone() {
            vertex.pushes = true;
            vertex.first_cone = polyhedron.cone_edges.len() as u32;
            vertex.cone_count = star.directions.len() as u32;
            polyhedron.cone_edges.extend(star.directions);
        }
    }
}

impl VertexStar {
    /// Returns `true` if the vertex has a normal cone: at least three active faces meet, and some normal has
    /// a non-positive product with every edge direction. (Zero is allowed: at a vertex in the middle of a
    /// straight edge, where an internal face ends, only normals perpendicular to the edge remain, and
    /// rounding may put a centre between the two halves of the edge.)
    ///
    /// The search starts with the mean of the face normals. Where the surface is convex, it is such a normal.
    /// Elsewhere, as at the tip of a grooved spire, it may not be. It is then turned away from the worst edge
    /// until no product is positive.
    fn has_cone(&self) -> bool {
        if self.active_faces < 3 {
            return false;
        }
        let mut normal = self.normal_sum / f64::from(self.active_faces);
        for _ in 0..TURNS {
            let height = |away: &&Vec3| normal.dot(away);
            let worst = self.directions.iter().max_by(|a, b| height(a).total_cmp(&height(b)));
            match worst {
                Some(away) if normal.dot(away) > FLAT_SINE * normal.norm() => normal -= away,
                // A normal that the rotations have reduced to zero does not count.
                _ => return normal.norm() > FLAT_SINE,
            }
        }
        false
    }
}
