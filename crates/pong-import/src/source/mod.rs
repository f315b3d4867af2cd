//! What the readers of glTF, OBJ and STL files have in common: a tree of nodes with geometry.

mod gltf;
mod guesses;
mod obj;
mod stl;
mod welder;

use crate::affine::{Affine, Up};
use crate::findings::{Finding, Findings};
use nalgebra::Vector3;
use serde_json::Value;
use std::path::{Path, PathBuf};

pub(crate) use welder::{Welder, WordMap};

/// How a file is to be read.
pub struct Reading {
    /// `None` for what the format is known for: y in glTF, z in OBJ and STL.
    pub up: Option<Up>,
    /// Metres in one unit of the file.
    pub unit_m: f64,
    /// Name of the scene to read; glTF only.
    pub scene: Option<String>,
    /// Folders beside the file's own that files which it names may lie in.
    pub allowed: Vec<PathBuf>,
}

/// A file as a tree of nodes; lengths in metres, axes those of models.
#[derive(Default)]
pub struct Source {
    /// Parents before their children.
    pub nodes: Vec<Node>,
    /// `extras.pong` of the scene.
    pub settings: Option<Value>,
}

pub struct Node {
    pub name: String,
    pub parent: Option<usize>,
    /// Names from the top, with `/` between; for messages.
    pub path: String,
    /// To the parent.
    pub local: Affine,
    /// `extras.pong`.
    pub mark: Option<Value>,
    pub mesh: Option<Shape>,
}

/// Vertices in the node's frame and what they span.
#[derive(Default)]
pub struct Shape {
    /// Distinct places.
    pub vertices: Vec<Vector3<f64>>,
    /// Triangles, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle an index into `looks`; empty if all have the first.
    pub look_of: Vec<u16>,
    pub looks: Vec<Look>,
    pub lines: Vec<[u32; 2]>,
    pub points: Vec<u32>,
}

/// What a material says of its faces.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Look {
    pub surface: Option<String>,
    pub inactive: bool,
}

/// Reads a file by the ending of its name.
pub fn read(path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !matches!(ending.as_str(), "glb" | "gltf" | "obj" | "stl") {
        let cause = "the name ends in none of .glb, .gltf, .obj and .stl";
        findings.fault(&file, "unknown-format", cause, "export the mesh in one of these formats");
        return None;
    }
    let bytes = findings.ok(bytes_of(path, &file))?;
    let source = match ending.as_str() {
        "obj" => obj::read(&bytes, path, reading, findings),
        "stl" => stl::read(bytes, path, reading, findings),
        _ => return gltf::read(&bytes, path, reading, findings),
    }?;
    guesses::tell(&source, reading, &file, findings);
    Some(source)
}

/// The bytes of the file that the caller named.
fn bytes_of(path: &Path, called: &str) -> Result<Vec<u8>, Finding> {
    let unreadable = |reason: String| Finding {
        path: called.to_owned(),
        rule: "unreadable",
        cause: format!("it cannot be read: {reason}"),
        cure: "name a mesh file that can be read".to_owned(),
    };
    pong_model::files::read(path).map_err(|reason| unreadable(reason.to_string()))
}

/// The file's name without folder and ending: what a model without a name is called.
fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Whether all coordinates are numbers that a model may hold; else a fault is noted.
fn all_in_range(shape: &Shape, path: &str, findings: &mut Findings) -> bool {
    let in_range = |x: &f64| x.abs() <= pong_model::LARGEST;
    let Some(index) = shape.vertices.iter().position(|place| !place.iter().all(in_range)) else {
        return true;
    };
    let (rule, cause) = match shape.vertices[index].iter().all(|x| x.is_finite()) {
        true => ("too-large", format!("vertex {index} lies beyond {:e} m", pong_model::LARGEST)),
        false => ("not-finite", format!("vertex {index} is not finite")),
    };
    findings.fault(path, rule, cause, "repair the mesh where it was made");
    false
}

impl Shape {
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.lines.is_empty() && self.points.is_empty()
    }
}
