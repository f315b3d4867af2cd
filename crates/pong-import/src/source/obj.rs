//! OBJ: objects, faces of any number of corners, lines and points; materials and texture coordinates are
//! ignored.

use super::faces::{Bent, add_face, weld};
use super::format_fault::finding;
use super::reading::{Reading, stem};
use super::tree::{Node, Shape, Source, all_in_range};
use crate::affine::{Affine, Up};
use crate::findings::Findings;
use nalgebra::Vector3;
use pong_model::mesh_formats;
use std::collections::HashMap;
use std::path::Path;

pub(super) fn read(bytes: &[u8], path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    let found = findings.ok(mesh_formats::obj(bytes).map_err(|fault| finding(fault, &file)))?;
    let place = |x: &[f64; 3]| reading.up.unwrap_or(Up::Z).turned(Vector3::from(*x)) * reading.unit_m;
    if found.without_area > 0 {
        let cause = format!("{} faces of fewer than three corners were left out", found.without_area);
        findings.note(&file, "sliver-triangle", cause, "");
    }
    let mut source = Source::default();
    let mut numbers = HashMap::new();
    let mut used = Used(vec![(u32::MAX, 0); found.places.len()]);
    let mut bent = Bent::default();
    for object in &found.objects {
        // One object may come in several parts of the same name.
        let node = node_called(&mut source, &mut numbers, &object.name, path);
        let shape = source.nodes[node].mesh.get_or_insert_with(Shape::default);
        let corners = object.corners.iter();
        let corners: Vec<u32> = corners
            .map(|&vertex| used.vertex(vertex, node, shape, || place(&found.places[vertex as usize])))
            .collect();
        let path = format!("{file}: {}", source.nodes[node].path);
        let shape = source.nodes[node].mesh.get_or_insert_with(Shape::default);
        let mut start = 0;
        for &end in &object.ends {
            add_face(shape, &corners[start..end as usize], &path, &mut bent, findings);
            start = end as usize;
        }
    }
    bent.note(findings);
    if !found.lines.is_empty() || !found.points.is_empty() {
        let node = node_called(&mut source, &mut numbers, "", path);
        let shape = source.nodes[node].mesh.get_or_insert_with(Shape::default);
        let mut vertex =
            |&vertex: &u32| used.vertex(vertex, node, shape, || place(&found.places[vertex as usize]));
        let lines: Vec<[u32; 2]> = found.lines.iter().map(|[a, b]| [vertex(a), vertex(b)]).collect();
        let points: Vec<u32> = found.points.iter().map(vertex).collect();
        (shape.lines, shape.points) = (lines, points);
    }
    for node in &mut source.nodes {
        let path = format!("{file}: {}", node.path);
        if let Some(shape) = &mut node.mesh {
            weld(shape);
            all_in_range(shape, &path, findings);
        }
    }
    if source.nodes.is_empty() {
        let cause = "it has no faces, lines or points";
        findings.fault(&file, "empty-mesh", cause, "export a mesh that has some");
    }
    findings.faults.is_empty().then_some(source)
}

/// For each vertex of the file, the last node that used it and its index there.
struct Used(Vec<(u32, u32)>);

impl Used {
    fn vertex(
        &mut self,
        vertex: u32,
        node: usize,
        shape: &mut Shape,
        place: impl Fn() -> Vector3<f64>,
    ) -> u32 {
        let (user, number) = &mut self.0[vertex as usize];
        if *user != node as u32 {
            (*user, *number) = (node as u32, shape.vertices.len() as u32);
            shape.vertices.push(place());
        }
        *number
    }
}

/// The node of that name, added if missing; elements without an object take the file's name.
fn node_called(source: &mut Source, numbers: &mut HashMap<String, usize>, name: &str, path: &Path) -> usize {
    let name = match name.trim() {
        "" => stem(path),
        name => name.to_owned(),
    };
    *numbers.entry(name.clone()).or_insert_with(|| {
        let (path, local) = (name.clone(), Affine::identity());
        source.nodes.push(Node { name, parent: None, path, local, mark: None, mesh: None });
        source.nodes.len() - 1
    })
}
