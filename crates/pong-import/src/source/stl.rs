//! STL, binary and text.

use super::format_fault::finding;
use super::reading::{Reading, stem};
use super::tree::{Node, Shape, Source, all_in_range};
use super::welder::Welder;
use crate::affine::{Affine, Up};
use crate::findings::Findings;
use crate::mesh::Adjacency;
use pong_model::mesh_formats;
use std::path::Path;

/// One solid of a file.
#[derive(Default)]
struct Solid {
    welder: Welder,
    triangles: Vec<[u32; 3]>,
}

pub(super) fn read(bytes: &[u8], path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    let mut solids: Vec<Solid> = Vec::new();
    let read = mesh_formats::stl(bytes, |solid, triangle| {
        if solids.len() <= solid {
            solids.resize_with(solid + 1, Solid::default);
        }
        let Solid { welder, triangles } = &mut solids[solid];
        triangles.push(triangle.map(|place| welder.weld(place)));
    });
    let found = findings.ok(read.map_err(|fault| finding(fault, &file)))?;
    let mut named: Vec<(String, Solid)> = found.solids.into_iter().zip(solids).collect();
    named.retain(|(_, solid)| !solid.triangles.is_empty());
    if named.is_empty() {
        return findings.refuse(&file, "empty-mesh", "it has no triangles", "export a mesh that has some");
    }
    if found.unfinished {
        let cause = "it ends without `endsolid`: if it was cut off, triangles are missing";
        findings.note(&file, "no-endsolid", cause, "");
    }
    let up = reading.up.unwrap_or(Up::Z);
    let shapes = shapes(named, path, findings);
    let mut nodes = Vec::new();
    for (name, mut shape) in shapes {
        if !all_in_range(&shape, &format!("{file}: {name}"), findings) {
            return None;
        }
        shape.vertices.iter_mut().for_each(|place| *place = up.turned(*place) * reading.unit_m);
        let (path, local) = (name.clone(), Affine::identity());
        nodes.push(Node { path, name, parent: None, local, mark: None, mesh: Some(shape) });
    }
    Some(Source { nodes, settings: None })
}

/// One shape for each solid if every one is closed. Some programs write one body as several solids, one for
/// each face: those become one shape.
fn shapes(named: Vec<(String, Solid)>, path: &Path, findings: &mut Findings) -> Vec<(String, Shape)> {
    let count = named.len();
    let apart = count > 1 && named.iter().all(|(_, solid)| Adjacency::new(&solid.triangles).is_closed());
    if apart {
        let shape = |(name, solid): (String, Solid)| {
            let name = if name.trim().is_empty() { stem(path) } else { name.trim().to_owned() };
            let Solid { welder, triangles } = solid;
            (name, Shape { vertices: welder.vertices, triangles, ..Shape::default() })
        };
        return named.into_iter().map(shape).collect();
    }
    if count > 1 {
        let cause = format!("its {count} solids do not each have a closed surface: they became one mesh");
        findings.note(&path.display().to_string(), "solids-joined", cause, "");
    }
    let mut named = named.into_iter();
    let mut whole = named.next().map(|(_, solid)| solid).unwrap_or_default();
    for (_, Solid { welder, triangles }) in named {
        let number: Vec<u32> = welder
            .vertices
            .iter()
            .map(|place| whole.welder.weld((*place).map(|x| x as f32).into()))
            .collect();
        whole.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(|v| number[v as usize])));
    }
    let Solid { welder, triangles } = whole;
    vec![(stem(path), Shape { vertices: welder.vertices, triangles, ..Shape::default() })]
}
