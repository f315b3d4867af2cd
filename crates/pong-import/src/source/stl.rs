//! STL, binary and text.

use super::reading::{Reading, stem};
use super::tree::{Node, Shape, Source, all_in_range};
use super::welder::Welder;
use crate::affine::{Affine, Up};
use crate::findings::Findings;
use pong_model::mesh_formats;
use std::path::Path;

pub(super) fn read(
    bytes: Vec<u8>,
    path: &Path,
    reading: &Reading,
    findings: &mut Findings,
) -> Option<Source> {
    let file = path.display().to_string();
    let capacity = bytes.len() / mesh_formats::STL_TRIANGLE;
    let mut welder = Welder::with_capacity(capacity / 2);
    let mut corners = Vec::with_capacity(capacity);
    let read = mesh_formats::stl(bytes, |triangle| corners.push(triangle.map(|place| welder.weld(place))));
    if let Err(reason) = read {
        return findings.refuse(&file, "damaged", reason, "export it again");
    }
    if corners.is_empty() {
        return findings.refuse(&file, "empty-mesh", "it has no triangles", "export a mesh that has some");
    }
    let mut shape = Shape { vertices: welder.vertices, triangles: corners, ..Shape::default() };
    if !all_in_range(&shape, &file, findings) {
        return None;
    }
    let up = reading.up.unwrap_or(Up::Z);
    shape.vertices.iter_mut().for_each(|place| *place = up.turned(*place) * reading.unit_m);
    let name = stem(path);
    let node = Node {
        path: name.clone(),
        name,
        parent: None,
        local: Affine::identity(),
        mark: None,
        mesh: Some(shape),
    };
    Some(Source { nodes: vec![node], settings: None })
}
