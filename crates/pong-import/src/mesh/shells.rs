//! Shells: triangles connected by edges, whatever their winding; closedness and orientation of each.

use super::adjacency::NONE;
use super::measures::{bounds, ring};
use super::solid::volume_of;
use super::triangle_mesh::Mesh;
use nalgebra::Vector3;

/// Triangles joined by edges of exactly two triangles.
pub struct Shell {
    pub triangles: Vec<u32>,
    /// True if every edge joins two triangles.
    pub closed: bool,
    /// Triangles wound against the rest (the set of smaller area). Empty for a one-sided surface such as a
    /// Möbius strip.
    pub against: Vec<u32>,
}

/// Outcome of `turn_outward`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Turned {
    /// Triangles that were wound against their neighbours.
    pub(crate) triangles: usize,
    /// Closed shells that faced inwards.
    pub(crate) shells: usize,
}

/// Shells of a mesh, in the order of their first triangles.
pub fn shells(mesh: &Mesh) -> Vec<Shell> {
    let Neighbors { across, open } = Neighbors::of(&mesh.triangles);
    // Winding of each triangle relative to the first one of its shell; true if opposite.
    let mut against: Vec<Option<bool>> = vec![None; mesh.triangles.len()];
    let mut shells = Vec::new();
    for first in 0..mesh.triangles.len() {
        if against[first].is_some() {
            continue;
        }
        against[first] = Some(false);
        let (mut triangles, mut next, mut has_sides) = (vec![first as u32], 0, true);
        while next < triangles.len() {
            let here = triangles[next] as usize;
            next += 1;
            for (other, same) in across[here].into_iter().filter(|(other, _)| *other != NONE) {
                let wanted = against[here].map(|here| here != same);
                match against[other as usize] {
                    None => {
                        against[other as usize] = wanted;
                        triangles.push(other);
                    }
                    found => has_sides &= found == wanted,
                }
            }
        }
        triangles.sort_unstable();
        let closed = triangles.iter().all(|&triangle| !open[triangle as usize]);
        let against = if has_sides { lesser(mesh, &triangles, &against) } else { Vec::new() };
        shells.push(Shell { triangles, closed, against });
    }
    shells
}

/// The set of smaller area among the two windings.
fn lesser(mesh: &Mesh, triangles: &[u32], against: &[Option<bool>]) -> Vec<u32> {
    let area = |triangle: &u32| super::measures::area_vector(&mesh.corners(*triangle as usize)).norm();
    let (turned, rest): (Vec<u32>, Vec<u32>) =
        triangles.iter().partition(|&&triangle| against[triangle as usize] == Some(true));
    let [turned_m2, rest_m2] = [&turned, &rest].map(|part| part.iter().map(area).sum::<f64>());
    if turned_m2 <= rest_m2 { turned } else { rest }
}

struct Neighbors {
    /// Neighbours of each triangle across edges of two triangles, and whether both have the same winding
    /// there.
    across: Vec<[(u32, bool); 3]>,
    /// Triangles with an edge that does not join two.
    open: Vec<bool>,
}

impl Neighbors {
    fn of(triangles: &[[u32; 3]]) -> Self {
        let mut edges: Vec<(u64, u32)> = Vec::with_capacity(3 * triangles.len());
        for (index, triangle) in triangles.iter().enumerate() {
            for (corner, (a, b)) in ring(triangle).enumerate() {
                edges.push((
                    u64::from(a.min(b)) << 32 | u64::from(a.max(b)),
                    4 * index as u32 + corner as u32,
                ));
            }
        }
        edges.sort_unstable();
        let mut found =
            Self { across: vec![[(NONE, false); 3]; triangles.len()], open: vec![false; triangles.len()] };
        let place = |half: u32| ((half / 4) as usize, (half % 4) as usize);
        for group in edges.chunk_by(|a, b| a.0 == b.0) {
            let [(_, one), (_, other)] = *group else {
                group.iter().for_each(|(_, half)| found.open[place(*half).0] = true);
                continue;
            };
            let [(a, i), (b, j)] = [one, other].map(place);
            let same = triangles[a][i] == triangles[b][j];
            found.across[a][i] = (b as u32, same);
            found.across[b][j] = (a as u32, same);
        }
        found
    }
}

/// Makes the winding of each shell consistent.
pub(crate) fn make_alike(mesh: &mut Mesh) -> usize {
    let against: Vec<u32> = shells(mesh).into_iter().flat_map(|shell| shell.against).collect();
    turn(mesh, &against);
    against.len()
}

/// Makes the winding of each shell consistent, and closed shells outward; a closed shell within the box of
/// another is a cavity and faces inwards.
pub(crate) fn turn_outward(mesh: &mut Mesh) -> Turned {
    let mut turned = Turned { triangles: make_alike(mesh), shells: 0 };
    let inward = facing_inwards(mesh);
    turned.shells = inward.len();
    inward.iter().for_each(|(triangles, _)| turn(mesh, triangles));
    turned
}

/// Closed shells of consistent winding that face inwards and are no cavity, with their volumes, m³.
pub(crate) fn facing_inwards(mesh: &Mesh) -> Vec<(Vec<u32>, f64)> {
    let closed = shells(mesh).into_iter().filter(|shell| shell.closed && shell.against.is_empty());
    let measured: Vec<(Vec<u32>, f64, [Vector3<f64>; 2])> = closed
        .map(|shell| {
            let corners = shell.triangles.iter().flat_map(|&t| mesh.corners(t as usize));
            let (low, high) = bounds(&corners.collect::<Vec<_>>());
            let volume = volume_of(mesh, shell.triangles.iter().map(|&t| t as usize), &(0.5 * (low + high)));
            (shell.triangles, volume, [low, high])
        })
        .collect();
    let is_cavity = |[low, high]: &[Vector3<f64>; 2]| {
        measured.iter().any(|(_, _, [outer_low, outer_high])| {
            (0..3).all(|axis| outer_low[axis] < low[axis] && high[axis] < outer_high[axis])
        })
    };
    let inward = measured.iter().filter(|(_, volume, bounds)| *volume < 0.0 && !is_cavity(bounds));
    inward.map(|(triangles, volume, _)| (triangles.clone(), *volume)).collect()
}

fn turn(mesh: &mut Mesh, triangles: &[u32]) {
    triangles.iter().for_each(|&triangle| mesh.triangles[triangle as usize].swap(1, 2));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(at: f64, edge: f64, mesh: &mut Mesh) {
        let vertices = pong_testkit::meshes::cube();
        let mut part = Mesh::default();
        for triangle in vertices {
            let corners = triangle.map(|corner| {
                let place = Vector3::from(corner.map(|x| at + edge * x));
                let found = part.vertices.iter().position(|other| *other == place);
                found.unwrap_or_else(|| (part.vertices.push(place), part.vertices.len() - 1).1) as u32
            });
            part.triangles.push(corners);
            part.look_of.push(0);
        }
        mesh.append(&part);
    }

    #[test]
    fn the_triangle_that_runs_against_the_others_is_found_and_turned() {
        let mut mesh = Mesh::default();
        cube(0.0, 1.0, &mut mesh);
        let whole = mesh.triangles.clone();
        let volume = super::super::volume_m3(&mesh);
        mesh.triangles[4].swap(0, 1);
        let found = shells(&mesh);
        assert!(found.len() == 1 && found[0].closed && found[0].against == [4]);
        assert_eq!(turn_outward(&mut mesh), Turned { triangles: 1, shells: 0 });
        assert_eq!(super::super::volume_m3(&mesh), volume);
        mesh.triangles = whole;
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        assert_eq!(facing_inwards(&mesh)[0].1, -volume);
        assert_eq!(turn_outward(&mut mesh), Turned { triangles: 0, shells: 1 });
        assert_eq!(super::super::volume_m3(&mesh), volume);
    }

    #[test]
    fn cavities_face_inwards_and_open_shells_stay() {
        let mut mesh = Mesh::default();
        cube(0.0, 4.0, &mut mesh);
        let volume = super::super::volume_m3(&mesh);
        let mut inner = Mesh::default();
        cube(0.0, 1.0, &mut inner);
        let inner_volume = super::super::volume_m3(&inner);
        inner.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        mesh.append(&inner);
        assert!(facing_inwards(&mesh).is_empty());
        assert_eq!(turn_outward(&mut mesh), Turned::default());
        assert!((super::super::volume_m3(&mesh) - (volume - inner_volume)).abs() < 1e-12);
        inner.triangles.pop();
        assert!(facing_inwards(&inner).is_empty() && !shells(&inner)[0].closed);
    }
}
