//! STL, binary and text.

use super::reading::{Reading, stem};
use super::tree::{Node, Shape, Source, all_in_range};
use super::welder::Welder;
use crate::affine::{Affine, Up};
use crate::findings::Findings;
use std::io::Cursor;
use std::path::Path;

/// Bytes of a binary file before its first triangle, and per triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

pub(super) fn read(
    mut bytes: Vec<u8>,
    path: &Path,
    reading: &Reading,
    findings: &mut Findings,
) -> Option<Source> {
    let file = path.display().to_string();
    blank_misleading_head(&mut bytes);
    let damaged = |findings: &mut Findings, reason: std::io::Error| {
        let reason = match reason.kind() {
            std::io::ErrorKind::UnexpectedEof => "it ends before its last triangle".to_owned(),
            _ => reason.to_string(),
        };
        findings.fault(&file, "damaged", reason, "export it again");
    };
    let capacity = bytes.len() / TRIANGLE;
    let mut cursor = Cursor::new(bytes);
    let triangles = match stl_io::create_stl_reader(&mut cursor) {
        Ok(triangles) => triangles,
        Err(reason) => {
            damaged(findings, reason);
            return None;
        }
    };
    let mut welder = Welder::with_capacity(capacity / 2);
    let mut corners = Vec::with_capacity(capacity);
    for triangle in triangles {
        match triangle {
            Ok(triangle) => corners.push(triangle.vertices.map(|vertex| welder.weld(vertex.0))),
            Err(reason) => {
                damaged(findings, reason);
                return None;
            }
        }
    }
    if corners.is_empty() {
        findings.fault(&file, "empty-mesh", "it has no triangles", "export a mesh that has some");
        return None;
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

/// Some programs begin binary files with "solid", the mark of text files; the length tells them apart.
fn blank_misleading_head(bytes: &mut [u8]) {
    let Some(count) = bytes.get(80..84).and_then(|count| count.try_into().ok()) else { return };
    let count = u32::from_le_bytes(count) as usize;
    if count.checked_mul(TRIANGLE).and_then(|size| size.checked_add(HEAD)) == Some(bytes.len()) {
        bytes[..5].fill(0);
    }
}
