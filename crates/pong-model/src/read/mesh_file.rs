//! Shapes from OBJ and STL files next to the model file.

use super::reader::Reader;
use crate::files;
use crate::mesh_formats::{self, FormatFault};
use crate::ron_tree::Node;
use pong_geometry::Vec3;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

/// Vertices and faces, as written.
#[derive(Default)]
pub(super) struct Mesh {
    pub(super) vertices: Vec<Vec3>,
    /// Vertex indices, face after face.
    pub(super) corners: Vec<u32>,
    /// End of each face in `corners`.
    pub(super) ends: Vec<u32>,
    /// Byte offset of each face in the model file; empty for a mesh from a mesh file.
    pub(super) at: Vec<u32>,
}

impl Mesh {
    pub(super) fn face_count(&self) -> usize {
        self.ends.len()
    }

    pub(super) fn face(&self, face: usize) -> &[u32] {
        let start = if face == 0 { 0 } else { self.ends[face - 1] as usize };
        &self.corners[start..self.ends[face] as usize]
    }

    pub(super) fn face_at(&self, face: usize) -> Option<u32> {
        self.at.get(face).copied()
    }
}

/// Reads the file named by `node`; every coordinate is multiplied by the scale.
pub(super) fn from_file(
    reader: &mut Reader<'_>,
    node: &Node,
    scale: Option<&Node>,
    path: &str,
) -> Option<Mesh> {
    let scale = match scale {
        Some(node) => reader.positive(node, path, "the scale"),
        None => Some(1.0),
    };
    let name = reader.text(node, path)?;
    if !reader.judges_shapes {
        return None;
    }
    let file = allowed_path(reader, node, path, &name)?;
    let folders = reader.mesh_dir.into_iter().chain(reader.ext.folders_allowed());
    let bytes = match files::read_below(&file, folders) {
        Ok(bytes) => bytes,
        Err(reason) if reason.kind() == ErrorKind::PermissionDenied && file.exists() => {
            let cause = format!("\"{name}\" cannot be read: {reason}");
            let cure = "put the file itself beside the model file, or have the host allow the folder that it lies in";
            return reader.refuse(node.at, path, "mesh-file-outside", cause, cure);
        }
        Err(reason) => {
            let cause = format!("\"{name}\" cannot be read: {reason}");
            return reader.refuse(
                node.at,
                path,
                "mesh-file-unreadable",
                cause,
                "put the file beside the model file",
            );
        }
    };
    let mesh = match extension(&name).as_str() {
        "obj" => obj(&bytes).map(|(mesh, without_area)| {
            if without_area > 0 {
                let what = format!(
                    "{without_area} faces of \"{name}\" have fewer than three corners and were left out"
                );
                reader.warn(node.at, path, &what);
            }
            mesh
        }),
        "stl" => stl(&bytes).map(|(mesh, unfinished)| {
            if unfinished {
                let what =
                    format!("\"{name}\" ends without `endsolid`: if it was cut off, triangles are missing");
                reader.warn(node.at, path, &what);
            }
            mesh
        }),
        _ => {
            let cause = format!("\"{name}\" is neither .obj nor .stl");
            return reader.refuse(node.at, path, "mesh-file-kind", cause, "export it as OBJ or STL");
        }
    };
    match mesh {
        Ok(mut mesh) => {
            let scale = scale?;
            if scale != 1.0 {
                mesh.vertices.iter_mut().for_each(|v| *v *= scale);
            }
            Some(mesh)
        }
        Err(fault) => {
            let cause = format!("\"{name}\" is damaged: {fault}");
            reader.refuse(node.at, path, "mesh-file-damaged", cause, fault.cure)
        }
    }
}

fn extension(name: &str) -> String {
    Path::new(name).extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// Path of a mesh, which must lie in the model file's folder or below it, so that a model can be moved as a
/// whole.
fn allowed_path(reader: &mut Reader<'_>, node: &Node, path: &str, name: &str) -> Option<PathBuf> {
    let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    if name.contains(['\\', ':', '\0']) || !Path::new(name).components().all(inside) {
        let cause = format!("\"{name}\" leads out of the model's folder");
        return reader.refuse(
            node.at,
            path,
            "mesh-file-outside",
            cause,
            "name a file beside the model file, with `/` alone",
        );
    }
    let Some(folder) = reader.mesh_dir else {
        let cause = format!("\"{name}\" cannot be found: the model was not read from a file");
        return reader.refuse(
            node.at,
            path,
            "mesh-file-no-folder",
            cause,
            "load the model by path, or name a folder for meshes",
        );
    };
    Some(folder.join(name))
}

/// Faces, of any number of corners, of all objects, with the vertices of each object in the order of first
/// use; and the number of faces that were skipped.
fn obj(bytes: &[u8]) -> Result<(Mesh, usize), FormatFault> {
    let found = mesh_formats::obj(bytes)?;
    let mut mesh = Mesh::default();
    let mut number = vec![u32::MAX; found.places.len()];
    for object in &found.objects {
        let first = mesh.vertices.len() as u32;
        for &corner in &object.corners {
            let slot = &mut number[corner as usize];
            // Indices below `first` belong to an earlier object.
            if *slot == u32::MAX || *slot < first {
                *slot = mesh.vertices.len() as u32;
                mesh.vertices.push(Vec3::from(found.places[corner as usize]));
            }
            mesh.corners.push(*slot);
        }
        let before = mesh.ends.last().copied().unwrap_or(0);
        mesh.ends.extend(object.ends.iter().map(|end| before + end));
    }
    Ok((mesh, found.without_area))
}

/// Triangles of all solids, and `true` if the file ends without `endsolid`.
fn stl(bytes: &[u8]) -> Result<(Mesh, bool), FormatFault> {
    let mut mesh = Mesh::default();
    let found = mesh_formats::stl(bytes, |_, corners| {
        for [x, y, z] in corners.map(|corner| corner.map(f64::from)) {
            mesh.corners.push(mesh.vertices.len() as u32);
            mesh.vertices.push(Vec3::new(x, y, z));
        }
        mesh.ends.push(mesh.corners.len() as u32);
    })?;
    Ok((mesh, found.unfinished))
}
