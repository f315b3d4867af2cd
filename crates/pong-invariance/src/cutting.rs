//! Cutting solids into convex pieces and triangles into more triangles, without a gap.

use crate::random::Random;
use crate::scene::{Mesh, Solid};
use pong_geometry::Vec3;
use std::collections::BTreeMap;

/// Least thickness of a piece and least distance of corners, relative to the whole: rounding of a sliver's
/// plane would mask real defects.
const LEAST_PART: f64 = 0.02;

/// Cuts a solid by the plane n·x = d into a piece behind it and one in front; the cut is an internal face of
/// both. `None` if the plane misses the solid or passes close to a corner.
pub fn cut_solid(solid: &Solid, n: &Vec3, d: f64) -> Option<[Solid; 2]> {
    let least = LEAST_PART * extent(&solid.vertices);
    let heights: Vec<f64> = solid.vertices.iter().map(|v| n.dot(v) - d).collect();
    // A corner in the plane becomes a corner of the cut; one close to it would make a sliver.
    let tiny = 1e-12 * extent(&solid.vertices);
    if heights.iter().any(|height| (tiny..least).contains(&height.abs())) {
        return None;
    }
    let side = |index: usize| if heights[index].abs() < tiny { 0.0 } else { heights[index].signum() };
    let is_cut = [-1.0, 1.0].map(|sign| (0..heights.len()).any(|index| side(index) == sign));
    (is_cut == [true, true]).then_some(())?;
    let crossing = |i: usize, j: usize| {
        // Both faces at an edge, and all pieces that share it, must compute the same bits.
        let mut ends = [i, j];
        ends.sort_by(|a, b| order(&solid.vertices[*a], &solid.vertices[*b]));
        let [from, to] = ends;
        let t = heights[from] / (heights[from] - heights[to]);
        solid.vertices[from] + (solid.vertices[to] - solid.vertices[from]) * t
    };
    let pieces = [-1.0, 1.0].map(|sign| {
        let mut piece = Pieces::default();
        for (index, face) in solid.faces.iter().enumerate() {
            let mut corners = Vec::new();
            for (at, &i) in face.iter().enumerate() {
                let j = face[(at + 1) % face.len()];
                if side(i) * sign >= 0.0 {
                    corners.push(piece.vertex(&solid.vertices[i], side(i) == 0.0));
                }
                if side(i) * side(j) < 0.0 {
                    corners.push(piece.vertex(&crossing(i, j), true));
                }
            }
            corners.dedup();
            if corners.len() > 2 && !corners.iter().all(|corner| piece.is_on_wall[*corner]) {
                if solid.inactive.contains(&index) {
                    piece.solid.inactive.push(piece.solid.faces.len());
                }
                piece.solid.faces.push(corners);
            }
        }
        piece.close(&(n * sign))
    });
    let [behind, before] = pieces;
    Some([behind?, before?])
}

#[derive(Default)]
struct Pieces {
    solid: Solid,
    is_on_wall: Vec<bool>,
}

impl Pieces {
    fn vertex(&mut self, place: &Vec3, is_on_wall: bool) -> usize {
        let known = self.solid.vertices.iter().position(|vertex| vertex == place);
        known.unwrap_or_else(|| {
            self.solid.vertices.push(*place);
            self.is_on_wall.push(is_on_wall);
            self.is_on_wall.len() - 1
        })
    }

    /// Adds the internal face, seen from outside: against `inward`.
    fn close(mut self, inward: &Vec3) -> Option<Solid> {
        let mut wall: Vec<usize> =
            (0..self.is_on_wall.len()).filter(|index| self.is_on_wall[*index]).collect();
        (wall.len() > 2).then_some(())?;
        let vertices = &self.solid.vertices;
        let middle = wall.iter().map(|index| vertices[*index]).sum::<Vec3>() / wall.len() as f64;
        let x = (vertices[wall[0]] - middle).normalize();
        let y = x.cross(inward);
        let angle = |index: &usize| {
            let arm = vertices[*index] - middle;
            libm::atan2(arm.dot(&y), arm.dot(&x))
        };
        wall.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        let least = LEAST_PART * 0.1 * extent(vertices);
        let next = |at: usize| wall[(at + 1) % wall.len()];
        let is_short = |(at, index): (usize, &usize)| (vertices[*index] - vertices[next(at)]).norm() < least;
        (!wall.iter().enumerate().any(is_short)).then_some(())?;
        self.solid.inactive.push(self.solid.faces.len());
        self.solid.faces.push(wall);
        Some(self.solid)
    }
}

fn order(a: &Vec3, b: &Vec3) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

fn extent(vertices: &[Vec3]) -> f64 {
    vertices.iter().map(|v| (v - vertices[0]).norm()).fold(0.0, f64::max)
}

/// Cuts every piece by the same plane; missed pieces stay whole. `None` if a piece cannot be cut well.
pub fn cut_all(pieces: &[Solid], n: &Vec3, d: f64) -> Option<Vec<Solid>> {
    let mut parts = Vec::new();
    for piece in pieces {
        let tiny = 1e-12 * extent(&piece.vertices);
        let is_cut =
            [-1.0, 1.0].map(|sign| piece.vertices.iter().any(|v| sign * (n.dot(v) - d) > tiny)) == [true; 2];
        match is_cut {
            true => parts.extend(cut_solid(piece, n, d)?),
            false => parts.push(piece.clone()),
        }
    }
    Some(parts)
}

/// Cuts a mesh: each step inserts a vertex in an edge (splitting both triangles) or in a triangle.
pub fn cut_mesh(mesh: &Mesh, random: &mut Random, steps: usize) -> Mesh {
    let mut mesh = mesh.clone();
    for _ in 0..steps {
        let triangle = random.below(mesh.triangles.len());
        match random.chance(0.6) {
            true => {
                let at = random.below(3);
                let any = random.between(0.2, 0.8);
                let t = random.pick(&[0.25, 0.5, any]);
                let ends = [mesh.triangles[triangle][at], mesh.triangles[triangle][(at + 1) % 3]];
                split_edge(&mut mesh, ends, t);
            }
            false => split_triangle(&mut mesh, triangle, random),
        }
    }
    mesh
}

fn split_edge(mesh: &mut Mesh, [i, j]: [usize; 2], t: f64) {
    // The same edge may join other corners at the same positions.
    let ends = [mesh.vertices[i], mesh.vertices[j]];
    let new = mesh.vertices.len();
    mesh.vertices.push(ends[0] + (ends[1] - ends[0]) * t);
    let mut parts = Vec::with_capacity(mesh.triangles.len() + 2);
    for triangle in &mesh.triangles {
        let cut = (0..3).find(|at| {
            let [p, q] = [triangle[*at], triangle[(at + 1) % 3]].map(|index| mesh.vertices[index]);
            [p, q] == ends || [q, p] == ends
        });
        match cut {
            Some(at) => {
                let [p, q, r] = [0, 1, 2].map(|k| triangle[(at + k) % 3]);
                parts.extend([[p, new, r], [new, q, r]]);
            }
            None => parts.push(*triangle),
        }
    }
    mesh.triangles = parts;
}

fn split_triangle(mesh: &mut Mesh, triangle: usize, random: &mut Random) {
    let [p, q, r] = mesh.triangles[triangle];
    let weights = [0; 3].map(|_| random.between(0.3, 1.0));
    let sum: f64 = weights.iter().sum();
    let corner = |at: usize, index: usize| mesh.vertices[index] * (weights[at] / sum);
    let middle = corner(0, p) + corner(1, q) + corner(2, r);
    let new = mesh.vertices.len();
    mesh.vertices.push(middle);
    mesh.triangles[triangle] = [p, q, new];
    mesh.triangles.extend([[q, r, new], [r, p, new]]);
}

/// Cuts every triangle into four.
pub fn cut_in_four(mesh: &Mesh) -> Mesh {
    let mut fine = Mesh { triangles: Vec::new(), ..mesh.clone() };
    let mut middles = BTreeMap::new();
    let mut middle = |vertices: &mut Vec<Vec3>, i: usize, j: usize| {
        *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
            let (from, to) = (vertices[i.min(j)], vertices[i.max(j)]);
            vertices.push((from + to) * 0.5);
            vertices.len() - 1
        })
    };
    for &[a, b, c] in &mesh.triangles {
        let [d, e, f] = [(a, b), (b, c), (c, a)].map(|(i, j)| middle(&mut fine.vertices, i, j));
        fine.triangles.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
    }
    fine
}

/// Inserts a vertex under a point, in the nearest triangle or in that triangle's nearest edge.
pub fn cut_at(mesh: &mut Mesh, place: &Vec3, into_edge: bool) {
    let barycentric = |triangle: &[usize; 3]| {
        let [p, q, r] = triangle.map(|index| mesh.vertices[index]);
        let normal = (q - p).cross(&(r - p));
        let part =
            |from: &Vec3, to: &Vec3| (to - from).cross(&(place - from)).dot(&normal) / normal.norm_squared();
        let off = normal.dot(&(place - p)).abs() / normal.norm();
        ([part(&q, &r), part(&r, &p), part(&p, &q)], off)
    };
    let inside = |(index, triangle): (usize, &[usize; 3])| {
        let (parts, off) = barycentric(triangle);
        parts.iter().all(|part| *part > 0.05).then_some((index, parts, off))
    };
    let nearest = mesh.triangles.iter().enumerate().filter_map(inside).min_by(|a, b| a.2.total_cmp(&b.2));
    let Some((index, parts, _)) = nearest else { return };
    let [p, q, r] = mesh.triangles[index];
    if into_edge {
        // The edge opposite the corner of least weight.
        let at = (0..3).min_by(|a, b| parts[*a].total_cmp(&parts[*b])).unwrap_or(0);
        let [from, to] = [(at + 1) % 3, (at + 2) % 3];
        let t = parts[to] / (parts[from] + parts[to]);
        let ends = [from, to].map(|corner| mesh.triangles[index][corner]);
        split_edge(mesh, ends, t);
    } else {
        let middle = mesh.vertices[p] * parts[0] + mesh.vertices[q] * parts[1] + mesh.vertices[r] * parts[2];
        let new = mesh.vertices.len();
        mesh.vertices.push(middle);
        mesh.triangles[index] = [p, q, new];
        mesh.triangles.extend([[q, r, new], [r, p, new]]);
    }
}
