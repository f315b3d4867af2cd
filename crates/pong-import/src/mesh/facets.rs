//! Planar faces: coplanar neighbouring triangles merged to polygons.
//!
//! Regions grow from the largest triangles, whose normals are the most accurate. The plane is fitted again
//! whenever the region has doubled, so that the noise of a small seed does not decide about a large face.

use super::adjacency::{Adjacency, NONE};
use super::measures::{area_vector, ring};
use super::triangle_mesh::Mesh;
use nalgebra::Vector3;
use std::collections::{BTreeMap, VecDeque};

/// Heights above a face's plane that count as zero, in sizes of the mesh; half the tolerance of model files.
const PLANE_SHARE: f64 = 0.5e-6;
/// Below this width (in sizes of the mesh) a triangle's normal is noise.
const SURE_WIDTH: f64 = 4e-6;

/// The polygons of a mesh.
pub(crate) struct Facets {
    /// Outlines, counter-clockwise seen from the front, and the look of each.
    pub(crate) faces: Vec<(Vec<u32>, u16)>,
    /// True if every region of coplanar triangles has one simple outline.
    pub(crate) simple: bool,
}

/// Merges coplanar neighbours of the same look; regions with holes stay triangles.
pub(crate) fn facets(mesh: &Mesh, adjacency: &Adjacency, size_m: f64) -> Facets {
    let growing = Growing::new(mesh, adjacency, size_m);
    let regions = growing.regions();
    let mut region_of = vec![NONE; mesh.triangles.len()];
    for (number, region) in regions.iter().enumerate() {
        region.iter().for_each(|&triangle| region_of[triangle as usize] = number as u32);
    }
    let mut found: Vec<(u32, Vec<u32>, u16)> = Vec::new();
    let mut simple = true;
    for region in &regions {
        let look = mesh.look_of[region[0] as usize];
        let first = region.iter().copied().min().unwrap_or(0);
        match outline(mesh, adjacency, region, &region_of) {
            Some(outline) => found.push((first, outline, look)),
            None => {
                simple = false;
                let triangles = region.iter().map(|&t| (t, mesh.triangles[t as usize].to_vec(), look));
                found.extend(triangles);
            }
        }
    }
    found.sort_unstable();
    let mut faces: Vec<(Vec<u32>, u16)> =
        found.into_iter().map(|(_, outline, look)| (outline, look)).collect();
    if simple {
        drop_straight_corners(&mut faces, mesh.vertices.len());
    }
    Facets { faces, simple }
}

struct Growing<'a> {
    mesh: &'a Mesh,
    adjacency: &'a Adjacency,
    areas: Vec<Vector3<f64>>,
    sure: Vec<bool>,
    tolerance_m: f64,
}

/// A plane through a region.
struct Plane {
    normal: Vector3<f64>,
    offset: f64,
}

impl<'a> Growing<'a> {
    fn new(mesh: &'a Mesh, adjacency: &'a Adjacency, size_m: f64) -> Self {
        let areas: Vec<Vector3<f64>> =
            (0..mesh.triangles.len()).map(|triangle| area_vector(&mesh.corners(triangle))).collect();
        let width = |triangle: usize| {
            let corners = mesh.corners(triangle);
            let longest = ring(&corners).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max);
            areas[triangle].norm() / longest
        };
        let sure = (0..mesh.triangles.len()).map(|triangle| width(triangle) > SURE_WIDTH * size_m).collect();
        Self { mesh, adjacency, sure, tolerance_m: PLANE_SHARE * size_m, areas }
    }

    fn regions(&self) -> Vec<Vec<u32>> {
        let mut order: Vec<u32> = (0..self.areas.len() as u32).collect();
        let sizes: Vec<f64> = self.areas.iter().map(Vector3::norm).collect();
        order.sort_by(|&a, &b| sizes[b as usize].total_cmp(&sizes[a as usize]).then(a.cmp(&b)));
        let mut taken = vec![false; order.len()];
        let mut regions = Vec::new();
        for seed in order {
            if !taken[seed as usize] {
                regions.push(self.grow(seed, &mut taken));
            }
        }
        regions
    }

    fn grow(&self, seed: u32, taken: &mut [bool]) -> Vec<u32> {
        taken[seed as usize] = true;
        let mut region = vec![seed];
        let mut area = self.areas[seed as usize];
        let mut plane = self.plane(&region, &area);
        let mut fitted = 1;
        let mut frontier: VecDeque<u32> = self.adjacency.across[seed as usize].into();
        while let Some(triangle) = frontier.pop_front() {
            if triangle == NONE || taken[triangle as usize] || !self.joins(triangle, seed, &plane) {
                continue;
            }
            taken[triangle as usize] = true;
            region.push(triangle);
            area += self.areas[triangle as usize];
            if region.len() >= 2 * fitted {
                let better = self.plane(&region, &area);
                if region.iter().all(|&member| self.lies_in(member, &better)) {
                    plane = better;
                }
                fitted = region.len();
            }
            frontier.extend(self.adjacency.across[triangle as usize]);
        }
        region
    }

    fn plane(&self, region: &[u32], area: &Vector3<f64>) -> Plane {
        let normal = area.normalize();
        let heights =
            region.iter().flat_map(|&t| self.mesh.corners(t as usize)).map(|place| normal.dot(&place));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        Plane { normal, offset: 0.5 * (low + high) }
    }

    fn joins(&self, triangle: u32, seed: u32, plane: &Plane) -> bool {
        let index = triangle as usize;
        let same_side =
            !self.sure[index] || self.areas[index].dot(&plane.normal) > 0.5 * self.areas[index].norm();
        same_side
            && self.mesh.look_of[index] == self.mesh.look_of[seed as usize]
            && self.lies_in(triangle, plane)
    }

    fn lies_in(&self, triangle: u32, plane: &Plane) -> bool {
        let corners = self.mesh.corners(triangle as usize);
        corners.iter().all(|place| (plane.normal.dot(place) - plane.offset).abs() <= self.tolerance_m)
    }
}

/// Outline of a region, if it is one loop that passes every vertex once.
fn outline(mesh: &Mesh, adjacency: &Adjacency, region: &[u32], region_of: &[u32]) -> Option<Vec<u32>> {
    let own = region_of[region[0] as usize];
    if let [triangle] = region {
        return Some(mesh.triangles[*triangle as usize].to_vec());
    }
    let mut next: BTreeMap<u32, u32> = BTreeMap::new();
    for &triangle in region {
        for (corner, (a, b)) in ring(&mesh.triangles[triangle as usize]).enumerate() {
            let other = adjacency.across[triangle as usize][corner];
            if (other == NONE || region_of[other as usize] != own) && next.insert(a, b).is_some() {
                return None;
            }
        }
    }
    let first = *next.keys().next()?;
    let mut outline = vec![first];
    let mut here = next[&first];
    while here != first && outline.len() <= next.len() {
        outline.push(here);
        here = *next.get(&here)?;
    }
    (outline.len() == next.len()).then_some(outline)
}

/// Drops corners where only two faces meet: the edge is straight there.
fn drop_straight_corners(faces: &mut [(Vec<u32>, u16)], vertices: usize) {
    let mut users = vec![0u32; vertices];
    faces.iter().flat_map(|(outline, _)| outline).for_each(|&vertex| users[vertex as usize] += 1);
    for (outline, _) in faces.iter_mut() {
        outline.retain(|&vertex| users[vertex as usize] != 2);
    }
}
