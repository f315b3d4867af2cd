//! Neighbours and shells of the triangles of one movable group, and warnings about them.
//!
//! Mirror images of two-sided meshes are neighbours only of mirror images. All searches work on sorted lists,
//! so that none takes quadratic time.

use crate::model::MovableGroup;
use crate::pieces::Sets;
use crate::t_junctions;
use pong_geometry::interference::pushing_features::mark_pushing;
use pong_geometry::primitive::{Lean, MayPush, NO_NEIGHBOR, PrimitiveKind, TriangleRecord, TriangleSet};
use std::collections::BTreeSet;

/// Maximum number of T-junctions reported.
const JUNCTIONS_TOLD: usize = 1000;

/// Warning about a mesh.
pub(crate) enum MeshWarning {
    /// Edge shared by three or more triangles.
    CrowdedEdge { triangles: Vec<u32> },
    /// Two neighbours of opposite winding: both run along their common edge in the same direction.
    Winding { triangle: u32, other: u32 },
    /// Vertex inside another triangle's free edge.
    TJunction { triangle: u32, vertex: u32 },
}

/// Findings from connecting the triangles.
#[derive(Default)]
pub(crate) struct TopologyReport {
    pub(crate) mesh_warnings: Vec<MeshWarning>,
    /// Triangles that repeat an earlier one: (repeated, earlier).
    pub(crate) duplicates: Vec<(u32, u32)>,
    /// For each triangle, the triangle of lowest index in its shell.
    pub(crate) shell_leader: Vec<u32>,
}

/// Edge of a triangle: its two vertices in increasing order, packed into one number; then three times the
/// index of the triangle plus the index of the edge in it.
type HalfEdge = (u64, u32);

/// Sets the neighbours of all triangles and the features that may push. Returns warnings, duplicates and
/// shells.
///
/// `one_surface` gives, for each primitive, the group that declares it one surface with others. A triangle that
/// repeats one of the same declared surface is no fault: it has no neighbours, and only its face pushes.
pub(crate) fn build_adjacency(body: &mut MovableGroup, one_surface: &[Option<u32>]) -> TopologyReport {
    let mut findings =
        TopologyReport { shell_leader: vec![0; body.triangles.triangles.len()], ..TopologyReport::default() };
    let declared = declared_triangles(body, one_surface);
    let mut repeated = Vec::new();
    for mirrors in [false, true] {
        let mut part = triangles_of(body, mirrors);
        let set = &mut body.triangles;
        let mut found = connect(set, &part);
        let again = repeated_in_declared(set, &found, &declared);
        if !again.is_empty() {
            part.iter().for_each(|&triangle| set.triangles[triangle as usize].neighbors = [NO_NEIGHBOR; 3]);
            part.retain(|triangle| !again.contains(triangle));
            again.iter().for_each(|&triangle| findings.shell_leader[triangle as usize] = triangle);
            found = connect(set, &part);
            repeated.extend(again);
        }
        lead_shells(set, &part, &mut findings.shell_leader);
        if !mirrors {
            let junctions = t_junctions::find(&set.vertices, &found.free_edges, JUNCTIONS_TOLD);
            let odd = |(vertex, edge): (u32, usize)| MeshWarning::TJunction {
                triangle: found.free_owner[edge],
                vertex,
            };
            found.mesh_warnings.extend(junctions.into_iter().map(odd));
            findings.duplicates = duplicates(set, &found.suspects);
            findings.mesh_warnings = found.mesh_warnings;
        }
    }
    mark_pushing(&mut body.triangles);
    for triangle in repeated {
        let record = &mut body.triangles.triangles[triangle as usize];
        (record.may_push, record.edge_lean, record.vertex_lean) = (MayPush(0), Lean::NONE, Lean::NONE);
    }
    findings
}

/// For each triangle, the group that declares it one surface with others; empty if no group does.
fn declared_triangles(body: &MovableGroup, one_surface: &[Option<u32>]) -> Vec<Option<u32>> {
    if one_surface.iter().all(Option::is_none) {
        return Vec::new();
    }
    let mut declared = vec![None; body.triangles.triangles.len()];
    for (info, group) in body.primitives.iter().zip(one_surface) {
        if info.kind == PrimitiveKind::Triangle {
            declared[info.elements.start as usize..info.elements.end as usize].fill(*group);
        }
    }
    declared
}

/// Triangles that repeat an earlier triangle of the same declared surface.
fn repeated_in_declared(set: &TriangleSet, found: &Connections, declared: &[Option<u32>]) -> BTreeSet<u32> {
    if declared.is_empty() {
        return BTreeSet::new();
    }
    let group = |triangle: u32| declared[triangle as usize];
    let pairs = duplicates(set, &found.suspects).into_iter();
    pairs
        .filter(|(repeated, earlier)| group(*repeated).is_some() && group(*repeated) == group(*earlier))
        .map(|(repeated, _)| repeated)
        .collect()
}

/// Front triangles of a movable group or, if `mirrors` is true, the mirror images of two-sided meshes; in
/// order.
fn triangles_of(body: &MovableGroup, mirrors: bool) -> Vec<u32> {
    let meshes = body.primitives.iter().filter(|info| info.kind == PrimitiveKind::Triangle);
    meshes
        .flat_map(|info| {
            let (start, middle, end) = (info.elements.start, info.first_mirror, info.elements.end);
            if mirrors { middle..end } else { start..middle }
        })
        .collect()
}

#[derive(Default)]
struct Connections {
    mesh_warnings: Vec<MeshWarning>,
    /// Triangles at crowded or inconsistently wound edges. Only these can be duplicates, because both copies
    /// run along their common edges in the same direction.
    suspects: BTreeSet<u32>,
    free_edges: Vec<[u32; 2]>,
    free_owner: Vec<u32>,
}

fn connect(set: &mut TriangleSet, part: &[u32]) -> Connections {
    let edges = sorted_edges(set, part);
    let mut found = Connections::default();
    for group in edges.chunk_by(|a, b| a.0 == b.0) {
        let triangle = |half: &HalfEdge| half.1 / 3;
        match group {
            [one] => {
                found.free_edges.push([(one.0 >> 32) as u32, one.0 as u32]);
                found.free_owner.push(triangle(one));
            }
            [one, other] if starts_at(set, one) != starts_at(set, other) => {
                set_neighbor(set, one, triangle(other));
                set_neighbor(set, other, triangle(one));
            }
            crowd => {
                found.suspects.extend(crowd.iter().map(triangle));
                let first = triangle(&crowd[0]);
                found.mesh_warnings.push(match crowd {
                    [_, other] => MeshWarning::Winding { triangle: first, other: triangle(other) },
                    _ => MeshWarning::CrowdedEdge { triangles: crowd.iter().map(triangle).collect() },
                });
            }
        }
    }
    found
}

fn sorted_edges(set: &TriangleSet, part: &[u32]) -> Vec<HalfEdge> {
    let mut edges = Vec::with_capacity(3 * part.len());
    for &triangle in part {
        let [a, b, c] = set.triangles[triangle as usize].vertices;
        for (k, (start, end)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            let key = u64::from(start.min(end)) << 32 | u64::from(start.max(end));
            edges.push((key, 3 * triangle + k as u32));
        }
    }
    edges.sort_unstable();
    edges
}

fn starts_at(set: &TriangleSet, half: &HalfEdge) -> u32 {
    set.triangles[(half.1 / 3) as usize].vertices[(half.1 % 3) as usize]
}

fn set_neighbor(set: &mut TriangleSet, half: &HalfEdge, neighbor: u32) {
    set.triangles[(half.1 / 3) as usize].neighbors[(half.1 % 3) as usize] = neighbor;
}

/// Sets, for each triangle in `part`, its `leader`: the triangle of lowest index in its shell. Triangles that
/// share a vertex belong to one shell.
fn lead_shells(set: &TriangleSet, part: &[u32], leader: &mut [u32]) {
    let mut vertices = Sets::new(set.vertices.len());
    for &triangle in part {
        let [a, b, c] = set.triangles[triangle as usize].vertices;
        vertices.join(a, b);
        vertices.join(b, c);
    }
    let mut first_of = vec![NO_NEIGHBOR; set.vertices.len()];
    for &triangle in part {
        let first = &mut first_of[vertices.find(set.triangles[triangle as usize].vertices[0]) as usize];
        *first = (*first).min(triangle);
        leader[triangle as usize] = *first;
    }
}

fn duplicates(set: &TriangleSet, suspects: &BTreeSet<u32>) -> Vec<(u32, u32)> {
    let mut keyed: Vec<([u32; 3], u32)> =
        suspects.iter().map(|&t| (rotated(&set.triangles[t as usize]), t)).collect();
    keyed.sort_unstable();
    let same = keyed.chunk_by(|a, b| a.0 == b.0);
    same.flat_map(|group| group[1..].iter().map(|repeated| (repeated.1, group[0].1))).collect()
}

/// Vertices rotated so that the lowest is first; the winding stays.
fn rotated(triangle: &TriangleRecord) -> [u32; 3] {
    let [a, b, c] = triangle.vertices;
    match a.min(b).min(c) {
        least if least == a => [a, b, c],
        least if least == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// Maximum number of triangles of one movable group: three times a triangle's index must fit into a
/// [`HalfEdge`].
pub(crate) const TRIANGLE_LIMIT: usize = u32::MAX as usize / 3;
