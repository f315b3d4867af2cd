//! Triangulation of faces with any number of corners; non-planar faces are noted.

use super::tree::Shape;
use crate::findings::Findings;
use nalgebra::Vector3;
use pong_model::weld::Welder;

/// Faces of more corners are refused: triangulation takes up to quadratic time.
const MOST_CORNERS: usize = 10_000;

pub(super) fn add_face(
    shape: &mut Shape,
    face: &[u32],
    path: &str,
    bent: &mut Bent,
    findings: &mut Findings,
) {
    if face.len() > MOST_CORNERS {
        let cause =
            format!("a face of {} corners; at most {MOST_CORNERS} can be cut into triangles", face.len());
        findings.fault(path, "face-not-cut", cause, "triangulate it where it was made");
        return;
    }
    bent.see(shape, face, path);
    if !cut(shape, face) {
        let cause = format!("a face of {} corners could not be cut into triangles", face.len());
        findings.fault(path, "face-not-cut", cause, "give it an outline that does not cross itself");
    }
}

/// Non-planar faces: their triangulation has a fold that is not in the file.
#[derive(Default)]
pub(super) struct Bent {
    faces: usize,
    /// Largest distance from the plane, m, and its face.
    worst: f64,
    path: String,
}

/// Corners off their plane by less than this share of the face's size count as rounding.
const FLAT: f64 = 1e-6;

impl Bent {
    pub(super) fn see(&mut self, shape: &Shape, face: &[u32], path: &str) {
        if face.len() < 4 {
            return;
        }
        let first = shape.vertices[face[0] as usize];
        let arms: Vec<Vector3<f64>> = face.iter().map(|&v| shape.vertices[v as usize] - first).collect();
        let size = arms.iter().map(Vector3::norm).fold(0.0, f64::max);
        let area: Vector3<f64> = arms.windows(2).map(|pair| (pair[0] / size).cross(&(pair[1] / size))).sum();
        let Some(normal) = area.try_normalize(0.0) else { return };
        let heights: Vec<f64> = arms.iter().map(|arm| normal.dot(arm)).collect();
        let middle = heights.iter().sum::<f64>() / heights.len() as f64;
        let off = heights.iter().map(|h| (h - middle).abs()).fold(0.0, f64::max);
        if off > FLAT * size {
            self.faces += 1;
            if off > self.worst {
                (self.worst, self.path) = (off, path.to_owned());
            }
        }
    }

    pub(super) fn note(&self, findings: &mut Findings) {
        if self.faces > 0 {
            let which = if self.faces == 1 {
                "a face is bent".to_owned()
            } else {
                format!("{} faces are bent", self.faces)
            };
            let cause = format!(
                "{which}: corners are up to {:.2e} m off the face's plane; where the triangles fold was chosen here",
                self.worst
            );
            findings.note(&self.path, "bent-face", cause, "export triangles to choose it yourself");
        }
    }
}

/// Triangulates a face; `false` if its outline cannot be triangulated.
fn cut(shape: &mut Shape, face: &[u32]) -> bool {
    if let [a, b, c] = *face {
        shape.triangles.push([a, b, c]);
        return true;
    }
    let corners: Vec<[f64; 3]> = face.iter().map(|&vertex| shape.vertices[vertex as usize].into()).collect();
    let mut flat = Vec::new();
    let mut order: Vec<u32> = Vec::new();
    if !earcut::utils3d::project3d_to_2d(&corners, corners.len(), &mut flat) {
        return false;
    }
    earcut::Earcut::new().earcut(flat.iter().copied(), &[], &mut order);
    // Collinear corners are no triangle's tip but lie on an edge: the triangulation must keep them.
    let whole = order.len() == 3 * (face.len() - 2);
    if !whole {
        order = (1..face.len() as u32 - 1).flat_map(|k| [0, k, k + 1]).collect();
    }
    shape.triangles.extend(order.chunks_exact(3).map(|t| [0, 1, 2].map(|k| face[t[k] as usize])));
    true
}

/// Merges bit-equal vertices.
pub(super) fn weld(shape: &mut Shape) {
    let mut welder = Welder::default();
    let mut vertices = Vec::new();
    let number: Vec<u32> = shape.vertices.iter().map(|place| welder.weld(*place, &mut vertices)).collect();
    let new = |vertex: &mut u32| *vertex = number[*vertex as usize];
    shape.triangles.iter_mut().flatten().for_each(new);
    shape.lines.iter_mut().flatten().for_each(new);
    shape.points.iter_mut().for_each(new);
    shape.vertices = vertices;
}
