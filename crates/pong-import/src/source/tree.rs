//! Common result of all readers: a tree of nodes with geometry.

use crate::affine::Affine;
use crate::findings::Findings;
use nalgebra::Vector3;
use serde_json::Value;

/// A file as a tree of nodes; lengths in metres, axes those of models.
#[derive(Default)]
pub struct Source {
    /// Nodes, parents before their children.
    pub nodes: Vec<Node>,
    /// `extras.pong` of the scene.
    pub settings: Option<Value>,
}

pub struct Node {
    pub name: String,
    pub parent: Option<usize>,
    /// Names from the root, separated by `/`; for messages.
    pub path: String,
    /// Transform to the parent.
    pub local: Affine,
    /// `extras.pong`.
    pub mark: Option<Value>,
    pub mesh: Option<Shape>,
}

/// Vertices in the node's frame, and the elements between them.
#[derive(Clone, Default)]
pub struct Shape {
    /// Distinct positions.
    pub vertices: Vec<Vector3<f64>>,
    /// Triangles, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle an index into `looks`; empty if all have the first.
    pub look_of: Vec<u16>,
    pub looks: Vec<Look>,
    pub lines: Vec<[u32; 2]>,
    pub points: Vec<u32>,
}

impl Shape {
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.lines.is_empty() && self.points.is_empty()
    }
}

/// Properties that a material gives its faces.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Look {
    pub surface: Option<String>,
    pub inactive: bool,
}

/// Checks that all coordinates are within the range of models; notes a fault and returns false otherwise.
pub(super) fn all_in_range(shape: &Shape, path: &str, findings: &mut Findings) -> bool {
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
