//! Mesh files of large meshes beside the model file.

use crate::findings::Findings;
use crate::model::{Field, Model, Primitive, field, value_of};
use nalgebra::Vector3;
use pong_model::mesh_formats;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Moves meshes of more than `inline_max` triangles, and those that name a file, into files and returns
/// these.
pub(super) fn split_off(
    model: &mut Model,
    inline_max: usize,
    findings: &mut Findings,
) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let stem: String = file_name(&model.name);
    let mut visit = |primitive: &mut Primitive| {
        let Some(Field::Vertices(vertices)) = value_of(&primitive.fields, "vertices") else { return };
        let faces: Vec<Vec<u32>> =
            match primitive.fields.iter().map(|(_, value)| value).find(|value| is_faces(value)) {
                Some(Field::Triangles(triangles)) => triangles.iter().map(|t| t.to_vec()).collect(),
                Some(Field::Faces(faces)) => faces.clone(),
                _ => return,
            };
        let asked = match value_of(&primitive.fields, "file") {
            Some(Field::Text(name)) => Some(name.clone()),
            _ => None,
        };
        if asked.is_none() && faces.len() <= inline_max {
            return;
        }
        let wanted = asked.unwrap_or_else(|| format!("{stem}_{}.obj", file_name(&primitive.name)));
        let (base, ending) = wanted.rsplit_once('.').unwrap_or((&wanted, ""));
        let numbered = (2..).map(|number| format!("{base}_{number}.{ending}"));
        let name = std::iter::once(wanted.clone())
            .chain(numbered)
            .find(|name| !taken.contains(name))
            .unwrap_or_default();
        taken.insert(name.clone());
        let scale = match value_of(&primitive.fields, "scale") {
            Some(Field::Number(scale)) => *scale,
            _ => 1.0,
        };
        let vertices = &vertices.iter().map(|place| place / scale).collect::<Vec<_>>();
        let contents = match ending.to_lowercase().as_str() {
            "obj" => obj(vertices, &faces),
            "stl" => match stl(vertices, &faces) {
                Ok(bytes) => bytes,
                Err(cause) => {
                    findings.fault(&primitive.name, "mesh-file-kind", cause, "name a file that ends in .obj");
                    return;
                }
            },
            _ => {
                let cause = format!("\"{wanted}\" is neither .obj nor .stl");
                findings.fault(
                    &primitive.name,
                    "mesh-file-kind",
                    cause,
                    "name a file that ends in .obj or .stl",
                );
                return;
            }
        };
        if name.contains(['\\', ':']) || name.starts_with('/') || name.split('/').any(|part| part == "..") {
            let cause = format!("\"{name}\" leads out of the model's folder");
            findings.fault(&primitive.name, "mesh-file-outside", cause, "name a file beside the model file");
            return;
        }
        primitive
            .fields
            .retain(|(key, _)| !matches!(key.as_str(), "file" | "vertices" | "triangles" | "faces"));
        primitive.fields.insert(0, field("file", Field::Text(name.clone())));
        files.push((name, contents));
    };
    model.root.each_primitive(&mut visit);
    files
}

fn is_faces(value: &Field) -> bool {
    matches!(value, Field::Triangles(_) | Field::Faces(_))
}

/// The name with all but letters, digits, `-`, `_` and `.` replaced by `_`.
fn file_name(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect()
}

/// OBJ text with all digits, so that reading gives the same bits.
fn obj(vertices: &[Vector3<f64>], faces: &[Vec<u32>]) -> Vec<u8> {
    let mut text = String::new();
    for place in vertices {
        let _ = writeln!(text, "v {:?} {:?} {:?}", place.x, place.y, place.z);
    }
    for face in faces {
        text.push('f');
        face.iter().for_each(|vertex| {
            let _ = write!(text, " {}", vertex + 1);
        });
        text.push('\n');
    }
    text.into_bytes()
}

/// Binary STL; every coordinate must be representable in single precision.
fn stl(vertices: &[Vector3<f64>], faces: &[Vec<u32>]) -> Result<Vec<u8>, String> {
    let lost = vertices.iter().flat_map(|place| place.iter()).find(|x| f64::from(**x as f32) != **x);
    if let Some(x) = lost {
        return Err(format!("STL keeps single precision, and {x} needs more"));
    }
    let mut bytes = vec![0; mesh_formats::STL_HEAD - 4];
    bytes.extend((faces.len() as u32).to_le_bytes());
    for face in faces {
        let corners: [u32; 3] = face
            .as_slice()
            .try_into()
            .map_err(|_| "STL has triangles only, and a face has more corners".to_owned())?;
        let [a, b, c] = corners.map(|vertex| vertices[vertex as usize]);
        let normal = (b - a).cross(&(c - a)).normalize();
        for x in [normal, a, b, c].iter().flat_map(|place| place.iter()) {
            bytes.extend((*x as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    Ok(bytes)
}
