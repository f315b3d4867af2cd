//! OBJ: objects, faces of any number of corners, lines and points; materials and texture coordinates are left aside.

use super::reading::{Reading, stem};
use super::tree::{Node, Shape, Source, all_in_range};
use crate::affine::{Affine, Up};
use crate::findings::Findings;
use nalgebra::Vector3;
use pong_model::mesh_formats;
use pong_model::weld::Welder;
use std::collections::HashMap;
use std::path::Path;

/// Faces of more corners are refused: cutting one takes up to the square of their number.
const MOST_CORNERS: usize = 10_000;

pub(super) fn read(bytes: &[u8], path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    // The mark that some editors put before UTF-8 would hide the keyword of the first line.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let loose = match loose_elements(bytes) {
        Ok(loose) => loose,
        Err((line, rule, cause)) => {
            return findings.refuse(
                &format!("{file}:{line}"),
                rule,
                cause,
                "export plain faces, lines and points",
            );
        }
    };
    // Of polylines and lists of points the crate would make faces.
    let without_loose = loose.as_ref().map(|loose| loose.rest.as_slice()).unwrap_or(bytes);
    let models = match mesh_formats::obj(without_loose) {
        Ok(models) => models,
        Err(reason) => return findings.refuse(&file, "damaged", reason, "export it again"),
    };
    let place =
        |x: &[f64]| reading.up.unwrap_or(Up::Z).turned(Vector3::new(x[0], x[1], x[2])) * reading.unit_m;
    let mut source = Source::default();
    let mut numbers = HashMap::new();
    let mut bent = Bent::default();
    for model in models {
        // One object with several materials comes in several parts of one name.
        let node = node_called(&mut source, &mut numbers, &model.name, path);
        let shape = source.nodes[node].mesh.get_or_insert_with(Shape::default);
        add_faces(shape, &model.mesh, place, &format!("{file}: {}", model.name), (&mut bent, findings));
    }
    bent.note(findings);
    if let Some(loose) = loose {
        let node = node_called(&mut source, &mut numbers, "", path);
        let shape = source.nodes[node].mesh.get_or_insert_with(Shape::default);
        let first = shape.vertices.len() as u32;
        shape.vertices.extend(loose.places.iter().map(|x| place(x)));
        shape.lines.extend(loose.lines.iter().map(|line| line.map(|vertex| first + vertex)));
        shape.points.extend(loose.points.iter().map(|vertex| first + vertex));
    }
    for node in &mut source.nodes {
        let path = format!("{file}: {}", node.path);
        if let Some(shape) = &mut node.mesh {
            weld(shape);
            all_in_range(shape, &path, findings);
        }
    }
    if source.nodes.is_empty() {
        findings.fault(
            &file,
            "empty-mesh",
            "it has no faces, lines or points",
            "export a mesh that has some",
        );
    }
    findings.faults.is_empty().then_some(source)
}

/// The node of that name, new if there is none; what belongs to no object is called like the file.
fn node_called(source: &mut Source, numbers: &mut HashMap<String, usize>, name: &str, path: &Path) -> usize {
    let name = match name.trim() {
        "" | "unnamed_object" => stem(path),
        name => name.to_owned(),
    };
    *numbers.entry(name.clone()).or_insert_with(|| {
        let (path, local) = (name.clone(), Affine::identity());
        source.nodes.push(Node { name, parent: None, path, local, mark: None, mesh: None });
        source.nodes.len() - 1
    })
}

fn add_faces(
    shape: &mut Shape,
    mesh: &tobj::Mesh,
    place: impl Fn(&[f64]) -> Vector3<f64>,
    path: &str,
    (bent, findings): (&mut Bent, &mut Findings),
) {
    let first = shape.vertices.len() as u32;
    shape.vertices.extend(mesh.positions.chunks_exact(3).map(place));
    if mesh.face_arities.is_empty() {
        let triangles = mesh.indices.chunks_exact(3);
        shape.triangles.extend(triangles.map(|face| [first + face[0], first + face[1], first + face[2]]));
        return;
    }
    let mut start = 0;
    for &corners in &mesh.face_arities {
        let end = start + corners as usize;
        let face: Vec<u32> = mesh.indices[start..end].iter().map(|vertex| first + vertex).collect();
        start = end;
        if face.len() > MOST_CORNERS {
            let cause =
                format!("a face of {corners} corners; at most {MOST_CORNERS} can be cut into triangles");
            findings.fault(path, "face-not-cut", cause, "triangulate it where it was made");
            continue;
        }
        bent.see(shape, &face, path);
        if !cut(shape, &face) {
            let cause = format!("a face of {corners} corners could not be cut into triangles");
            findings.fault(path, "face-not-cut", cause, "give it an outline that does not cross itself");
        }
    }
}

/// Faces whose corners lie in no plane: cut into triangles they have a fold that the file does not tell.
#[derive(Default)]
struct Bent {
    faces: usize,
    /// How far, m, and which.
    worst: f64,
    path: String,
}

/// Corners off their plane by less than this share of the face's size are rounding.
const FLAT: f64 = 1e-6;

impl Bent {
    fn see(&mut self, shape: &Shape, face: &[u32], path: &str) {
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

    fn note(&self, findings: &mut Findings) {
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

/// Cuts a face into triangles; `false` if its outline allows none.
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
    // Corners on a straight line are no triangle's tip and lie on the edge of one: the cut must keep them.
    let whole = order.len() == 3 * (face.len() - 2);
    if !whole {
        order = (1..face.len() as u32 - 1).flat_map(|k| [0, k, k + 1]).collect();
    }
    shape.triangles.extend(order.chunks_exact(3).map(|t| [0, 1, 2].map(|k| face[t[k] as usize])));
    true
}

/// Bit-equal places become one vertex.
fn weld(shape: &mut Shape) {
    let mut welder = Welder::default();
    let mut vertices = Vec::new();
    let number: Vec<u32> = shape.vertices.iter().map(|place| welder.weld(*place, &mut vertices)).collect();
    let new = |vertex: &mut u32| *vertex = number[*vertex as usize];
    shape.triangles.iter_mut().flatten().for_each(new);
    shape.lines.iter_mut().flatten().for_each(new);
    shape.points.iter_mut().for_each(new);
    shape.vertices = vertices;
}

/// Lines and points of a file, and the file without them.
#[derive(Default)]
struct Loose {
    places: Vec<[f64; 3]>,
    lines: Vec<[u32; 2]>,
    points: Vec<u32>,
    rest: Vec<u8>,
}

type LineFault = (usize, &'static str, String);

/// `None` if a file has neither lines nor points.
fn loose_elements(bytes: &[u8]) -> Result<Option<Loose>, LineFault> {
    let lines = || bytes.split(|&byte| byte == b'\n').enumerate();
    let keyword = |line: &[u8]| -> Vec<u8> {
        let start = line.trim_ascii_start();
        start.iter().take_while(|byte| !byte.is_ascii_whitespace()).copied().collect()
    };
    let mut any = false;
    for (number, line) in lines() {
        let line = line.trim_ascii_start();
        match line.first() {
            Some(b'l' | b'p') => any |= matches!(keyword(line).as_slice(), b"l" | b"p"),
            Some(b'c' | b's') => {
                let word = keyword(line);
                if matches!(word.as_slice(), b"curv" | b"curv2" | b"surf" | b"cstype") {
                    let word = String::from_utf8_lossy(&word).into_owned();
                    return Err((
                        number + 1,
                        "free-form",
                        format!("`{word}`: free-form curves and surfaces are not read"),
                    ));
                }
            }
            _ => {}
        }
    }
    if !any {
        return Ok(None);
    }
    let mut loose = Loose::default();
    for (number, line) in lines() {
        let text = String::from_utf8_lossy(line);
        let mut words = text.split('#').next().unwrap_or("").split_ascii_whitespace();
        let word = words.next();
        let damaged = |what: &str| (number + 1, "damaged", format!("`{what}` is not what belongs there"));
        match word {
            Some("v") => {
                let mut place = [0.0; 3];
                for x in &mut place {
                    let word = words.next().unwrap_or("");
                    *x = word.parse().map_err(|_| damaged(word))?;
                }
                loose.places.push(place);
            }
            Some("l" | "p") => {
                let count = loose.places.len() as i64;
                let index = |word: &str| {
                    let number: i64 = word.split('/').next().unwrap_or("").parse().ok()?;
                    let index = if number < 0 { count + number } else { number - 1 };
                    (0..count).contains(&index).then_some(index as u32)
                };
                let chain: Vec<u32> =
                    words.map(|word| index(word).ok_or_else(|| damaged(word))).collect::<Result<_, _>>()?;
                match word {
                    Some("l") => loose.lines.extend(chain.windows(2).map(|pair| [pair[0], pair[1]])),
                    _ => loose.points.extend(chain),
                }
            }
            _ => {}
        }
        let kept: &[u8] = if matches!(word, Some("l" | "p")) { b"" } else { line };
        loose.rest.extend_from_slice(kept);
        loose.rest.push(b'\n');
    }
    keep_used(&mut loose);
    Ok(Some(loose))
}

/// Drops the places that only faces use.
fn keep_used(loose: &mut Loose) {
    let mut number = vec![u32::MAX; loose.places.len()];
    let mut places = Vec::new();
    for vertex in loose.lines.iter_mut().flatten().chain(&mut loose.points) {
        let slot = &mut number[*vertex as usize];
        if *slot == u32::MAX {
            *slot = places.len() as u32;
            places.push(loose.places[*vertex as usize]);
        }
        *vertex = *slot;
    }
    loose.places = places;
}
