//! Builds the finished model from the drafts of its movable groups.

use crate::draft::{BodyDraft, ModelDraft};
use crate::model::{Model, MovableGroup};
use crate::pieces::join_walls;
use crate::read::{LISTED_PER_MESH, Reader, group_paths};
use crate::surface::Surface;
use crate::triangle_topology::{self, MeshWarning, TopologyReport};
use crate::weld::Welder;
use crate::weld::WordMap;
use crate::{arrange, hash, one_surface, polyhedra, solids, tree, wholes};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;

/// Finishes every movable group; faults and warnings go to the reader. `None` if there was any fault.
pub(crate) fn finish(reader: &mut Reader<'_>, draft: ModelDraft) -> Option<Model> {
    let ModelDraft { name, entry_memory, surfaces, pair_overrides, filters, bodies: mut drafts } = draft;
    for draft in &mut drafts {
        finish_body(reader, draft, &surfaces);
    }
    if reader.fault_count() > 0 {
        return None;
    }
    let bodies = drafts.iter_mut().map(|draft| std::mem::take(&mut draft.body)).collect();
    let warnings = std::mem::take(&mut reader.warnings);
    let groups = group_paths(&drafts);
    let mut model =
        Model { name, hash: 0, entry_memory, surfaces, pair_overrides, groups, filters, bodies, warnings };
    model.hash = hash::hash(&model, &drafts);
    Some(model)
}

/// Finishes one movable group: neighbours, pieces, shells and tree. The tree is built last, and only if there
/// is no fault so far, because it relies on valid elements.
fn finish_body(reader: &mut Reader<'_>, draft: &mut BodyDraft, surfaces: &[Surface]) {
    draft.welder = Welder::default();
    let findings = connect_triangles(reader, draft);
    let surface_of = join_pieces(reader, draft);
    set_shells(&mut draft.body, &findings, &surface_of);
    one_surface::join_shells(draft);
    draft.body.wholes = wholes::wholes(&draft.body);
    if reader.fault_count() == 0 {
        solids::fill(reader, draft, surfaces);
    }
    if reader.fault_count() > 0 {
        return;
    }
    for group in arrange::without_leaf(&draft.groups) {
        let group = &draft.groups[group];
        let what = "`leaf_size` has no effect: nothing below is a leaf of this group; remove it";
        reader.warn(group.at, &group.path, what);
    }
    let groups = arrange::arranged(&draft.body, &draft.groups);
    match tree::build(&draft.body, &groups, reader.ext) {
        Ok(tree) => {
            draft.body.tree = tree;
            solids::set_leaves(&mut draft.body);
        }
        Err(faults) => {
            for (group, reason) in faults {
                let group = &groups[group];
                let cause = format!("its bounding volume cannot be fitted: {reason}");
                reader.fault(group.at, &group.path, "bound", cause, "choose another kind of volume");
            }
        }
    }
}

fn connect_triangles(reader: &mut Reader<'_>, draft: &mut BodyDraft) -> TopologyReport {
    if draft.body.triangles.triangles.len() > triangle_topology::TRIANGLE_LIMIT {
        let cause = "more triangles than one body may have";
        let cure = format!("{} is the most", triangle_topology::TRIANGLE_LIMIT);
        reader.fault(draft.groups[0].at, &draft.body.path, "too-many-triangles", cause, cure);
        return TopologyReport::default();
    }
    let findings = triangle_topology::build_adjacency(&mut draft.body, &draft.one_surface);
    for &(repeated, earlier) in findings.duplicates.iter().take(LISTED_PER_MESH) {
        let (at, path) = draft.triangle_path(repeated);
        let (_, other) = draft.triangle_path(earlier);
        let cause = format!("the same triangle as {other}");
        reader.fault(at, &path, "duplicate-triangle", cause, "remove one of them");
    }
    for mesh_warning in findings.mesh_warnings.iter().take(LISTED_PER_MESH) {
        tell(reader, draft, mesh_warning);
    }
    if findings.mesh_warnings.len() > LISTED_PER_MESH {
        let more = findings.mesh_warnings.len() - LISTED_PER_MESH;
        let what = format!("{more} more edges of this body's meshes do not fit together");
        reader.warn(draft.groups[0].at, &draft.body.path, &what);
    }
    findings
}

fn tell(reader: &mut Reader<'_>, draft: &BodyDraft, mesh_warning: &MeshWarning) {
    let set = &draft.body.triangles;
    let (triangle, what) = match *mesh_warning {
        MeshWarning::CrowdedEdge { ref triangles } => {
            let (first, count) = (triangles[0], triangles.len());
            (first, format!("{count} triangles share an edge near {}; it counts as free", middle(set, first)))
        }
        MeshWarning::Winding { triangle, other } => {
            let other = draft.triangle_path(other).1;
            (triangle, format!("wound against its neighbour {other}; their common edge counts as free"))
        }
        MeshWarning::TJunction { triangle, vertex } => {
            let v = set.vertices[vertex as usize];
            (triangle, format!("T-junction: the vertex {} lies within a free edge", place(&v)))
        }
    };
    let (at, path) = draft.triangle_path(triangle);
    reader.warn(at, &path, &what);
}

fn middle(set: &pong_geometry::primitive::TriangleSet, triangle: u32) -> String {
    let [a, b, c] = set.corners(triangle);
    place(&((a + b + c) / 3.0))
}

fn place(p: &Vec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}

/// Builds the polyhedra; returns, for each of them, the lowest piece of its surface.
fn join_pieces(reader: &mut Reader<'_>, draft: &mut BodyDraft) -> Vec<u32> {
    let mut hulls = std::mem::take(&mut draft.hulls);
    let wall_groups = one_surface::wall_groups(draft, hulls.len());
    let closed = one_surface::close_walls(&mut hulls, &wall_groups);
    let (surface_of, lonely) = join_walls(&mut hulls);
    let primitives = draft.body.primitives.iter().zip(&draft.primitive_at);
    let pieces = primitives.filter(|(info, _)| info.kind == PrimitiveKind::Polyhedron);
    let owners: WordMap<u32, (u32, &str)> =
        pieces.map(|(info, at)| (info.elements.start, (*at, &*info.path))).collect();
    let owner = |piece: u32| owners.get(&piece).map(|(at, path)| (*at, (*path).to_owned()));
    for (piece, face) in lonely.into_iter().filter(|wall| !closed.lonely.contains(wall)) {
        let authored = hulls[piece as usize].faces[face].authored;
        if let Some((at, path)) = owner(piece) {
            let what = "this inactive face has no twin in another piece of the body";
            reader.warn(at, &format!("{path}/faces[{authored}]"), what);
        }
    }
    for (piece, face) in closed.in_part {
        let authored = hulls[piece as usize].faces[face].authored;
        if let Some((at, path)) = owner(piece) {
            let what = "this face lies against another piece of the same surface only in part and pushes what is deep \
                        at the joint; divide the piece at the edges of the other one";
            reader.warn(at, &format!("{path}/faces[{authored}]"), what);
        }
    }
    let (polyhedra, tangled) = polyhedra::build(&hulls, &surface_of);
    for (piece, at_edge) in tangled {
        if let Some((at, path)) = owner(piece as u32) {
            let what = format!(
                "more than two active faces meet at the edge from {}; it never pushes",
                place(&at_edge)
            );
            reader.warn(at, &path, &what);
        }
    }
    draft.body.polyhedra = polyhedra;
    surface_of
}

/// Numbers the shells in the order of their first element.
fn set_shells(body: &mut MovableGroup, findings: &TopologyReport, surface_of: &[u32]) {
    let mut count = 0;
    let mut next = || {
        count += 1;
        count - 1
    };
    let mut of_piece = vec![None; surface_of.len()];
    let mut of_triangle = vec![None; findings.shell_leader.len()];
    for info in &mut body.primitives {
        info.shell = match info.kind {
            PrimitiveKind::Polyhedron => {
                let surface = surface_of[info.elements.start as usize] as usize;
                *of_piece[surface].get_or_insert_with(&mut next)
            }
            PrimitiveKind::Triangle => {
                for triangle in info.elements.clone() {
                    let leader = findings.shell_leader[triangle as usize] as usize;
                    let shell = *of_triangle[leader].get_or_insert_with(&mut next);
                    body.triangles.triangles[triangle as usize].shell = shell;
                }
                body.triangles.triangles[info.elements.start as usize].shell
            }
            _ => next(),
        };
    }
    body.shell_count = count;
}
