//! glTF 2.0, `.gltf` and `.glb`: node tree, triangles, lines, points, `extras.pong`.
//!
//! Nodes are read from the JSON itself, with numbers in double precision; accessors by the `gltf` crate.

mod accessors;
mod buffers;
mod json;

use super::budget::Budget;
use super::reading::Reading;
use super::tree::{Look, Node, Shape, Source, all_in_range};
use super::welder::Welder;
use crate::affine::{Affine, Up};
use crate::findings::Findings;
use accessors::{Positions, indices, positions};
use json::Json;
use serde_json::Value;
use std::path::Path;

/// State of a glTF reader.
struct Reader<'a> {
    json: &'a Value,
    document: ::gltf::Document,
    buffers: Vec<Vec<u8>>,
    up: Up,
    unit_m: f64,
    file: String,
}

pub(super) fn read(bytes: &[u8], path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    let (value, blob) = findings.ok(json::parse(bytes, &file))?;
    json::refuse_extensions(&value, &file, findings);
    let document = findings.ok(json::document(&value, &file));
    if !findings.faults.is_empty() {
        return None;
    }
    let document = document?;
    let buffers = findings.ok(buffers::load(&document, blob, path, &reading.allowed))?;
    let (up, unit_m) = (reading.up.unwrap_or(Up::Y), reading.unit_m);
    let reader = Reader { json: &value, document, buffers, up, unit_m, file };
    reader.notes(findings);
    let scene = reader.scene(reading.scene.as_deref(), findings)?;
    let mut source = Source {
        settings: scene.get("extras").and_then(|extras| extras.get("pong")).cloned(),
        ..Source::default()
    };
    let length = bytes.len() + reader.buffers.iter().map(Vec::len).sum::<usize>();
    let mut budget = Budget::new(reading.triangles_max, length);
    for root in scene.list("nodes") {
        reader.add_node(root, None, (&mut source, &mut budget), findings);
    }
    findings.faults.is_empty().then_some(source)
}

impl Reader<'_> {
    fn notes(&self, findings: &mut Findings) {
        let animations = self.json.list("animations").len();
        if animations > 0 {
            let cause = format!("{animations} animations are left out; nodes stand where the file has them");
            findings.note(&self.file, "animation", cause, "");
        }
    }

    /// The scene of that name, or the default one.
    fn scene(&self, name: Option<&str>, findings: &mut Findings) -> Option<&Value> {
        let scenes = self.json.list("scenes");
        let called: Vec<&str> = scenes.iter().map(|scene| scene.text("name").unwrap_or("")).collect();
        let chosen = match name {
            Some(name) => called.iter().position(|other| *other == name),
            None => Some(self.json.index("scene").unwrap_or(0)),
        };
        let found = chosen.and_then(|index| scenes.get(index));
        if found.is_none() {
            let cause = match name {
                Some(name) => format!("there is no scene `{name}` among {called:?}"),
                None => "it has no scene".to_owned(),
            };
            findings.fault(&self.file, "no-scene", cause, "name a scene that the file has, or add one");
        } else if scenes.len() > 1 && name.is_none() {
            let cause =
                format!("of {} scenes only `{}` is imported", scenes.len(), called[chosen.unwrap_or(0)]);
            findings.note(&self.file, "several-scenes", cause, "--scene chooses another");
        }
        found
    }

    fn add_node(
        &self,
        index: &Value,
        parent: Option<usize>,
        (source, budget): (&mut Source, &mut Budget),
        findings: &mut Findings,
    ) {
        let number = index.as_u64().unwrap_or(u64::MAX) as usize;
        let Some(node) = self.json.list("nodes").get(number) else { return };
        let mesh = node.index("mesh");
        let name = match (node.text("name"), mesh) {
            (Some(name), _) if !name.is_empty() => name.to_owned(),
            (_, Some(mesh)) => self.mesh_name(mesh),
            _ => format!("node_{number}"),
        };
        let above = parent.map(|parent: usize| format!("{}/", source.nodes[parent].path)).unwrap_or_default();
        let path = format!("{above}{name}");
        if path.matches('/').count() > 200 {
            findings.fault(&self.place(&path), "too-deep", "nodes nest deeper than 200", "flatten the tree");
            return;
        }
        if !budget.take_path(&path, &self.file, findings) {
            return;
        }
        let local = findings.ok(json::transform(node, &self.place(&path)));
        let mark = node.get("extras").and_then(|extras| extras.get("pong")).cloned();
        self.refuse_deformation(node, mesh, &self.place(&path), findings);
        let mesh = mesh.and_then(|mesh| self.shape(mesh, &self.place(&path), budget, findings));
        let mut local = self.up.turned_transform(&local.unwrap_or(Affine::identity()));
        local.translation *= self.unit_m;
        source.nodes.push(Node { name, parent, path, local, mark, mesh });
        let own = source.nodes.len() - 1;
        for child in node.list("children") {
            self.add_node(child, Some(own), (source, budget), findings);
        }
    }

    fn place(&self, path: &str) -> String {
        format!("{}: {path}", self.file)
    }

    fn mesh_name(&self, mesh: usize) -> String {
        let name = self.json.list("meshes").get(mesh).and_then(|mesh| mesh.text("name"));
        name.filter(|name| !name.is_empty()).map_or(format!("mesh_{mesh}"), str::to_owned)
    }

    /// Refuses skins and morph targets: no model can represent them.
    fn refuse_deformation(&self, node: &Value, mesh: Option<usize>, path: &str, findings: &mut Findings) {
        if node.get("skin").is_some() {
            let cure = "apply the armature before the export, or take the skin away";
            findings.fault(path, "skin", "its mesh is moved by a skin; models are rigid", cure);
        }
        if node.get("extensions").is_some_and(|all| all.get("EXT_mesh_gpu_instancing").is_some()) {
            let cause = "its mesh stands in several places by EXT_mesh_gpu_instancing";
            findings.fault(
                path,
                "unsupported-extension",
                cause,
                "export without instancing, one node per place",
            );
        }
        let mesh = mesh.and_then(|mesh| self.json.list("meshes").get(mesh));
        let weights = node.get("weights").or_else(|| mesh.and_then(|mesh| mesh.get("weights")));
        let moved =
            weights.and_then(Value::as_array).is_some_and(|all| all.iter().any(|w| w.as_f64() != Some(0.0)));
        if moved {
            let cause = "its mesh is moved by morph targets; only the unmoved one could be imported";
            findings.fault(
                path,
                "morph-targets",
                cause,
                "apply shape keys before the export, or set their weights to 0",
            );
        }
    }

    /// All primitives of a mesh as one shape.
    fn shape(&self, mesh: usize, path: &str, budget: &mut Budget, findings: &mut Findings) -> Option<Shape> {
        let mesh = self.document.meshes().nth(mesh)?;
        let mut shape = Shape::default();
        let mut welder = Welder::default();
        for primitive in mesh.primitives() {
            let look = self.look(primitive.material().index());
            let Some(length) = findings.ok(accessors::length(&primitive, &self.buffers, path)) else {
                continue;
            };
            if !budget.take(length, path, findings) {
                return None;
            }
            let read = positions(&primitive, &self.buffers, path).and_then(|places| {
                indices(&primitive, &self.buffers, places.len(), path).map(|order| (places, order))
            });
            let Some((places, order)) = findings.ok(read) else { continue };
            let numbers: Vec<u32> = match places {
                Positions::Single(places) => places.into_iter().map(|place| welder.weld(place)).collect(),
                Positions::Double(places) => {
                    places.into_iter().map(|place| welder.weld_wide(place)).collect()
                }
            };
            let order: Vec<u32> = order.into_iter().map(|index| numbers[index as usize]).collect();
            add_elements(&mut shape, primitive.mode(), &order, look);
        }
        shape.vertices = welder.vertices;
        shape.vertices.iter_mut().for_each(|place| *place = self.up.turned(*place) * self.unit_m);
        all_in_range(&shape, path, findings).then_some(shape)
    }

    /// Look of a material, from its `extras.pong`.
    fn look(&self, material: Option<usize>) -> Look {
        let material = material.and_then(|index| self.json.list("materials").get(index));
        let pong = material.and_then(|material| material.get("extras")).and_then(|extras| extras.get("pong"));
        let surface = pong.and_then(|pong| pong.text("surface")).filter(|name| !name.is_empty());
        let inactive = pong.and_then(|pong| pong.get("inactive")).and_then(Value::as_bool) == Some(true);
        Look { surface: surface.map(str::to_owned), inactive }
    }
}

/// Triangles, lines or points from a list of corners.
fn add_elements(shape: &mut Shape, mode: ::gltf::mesh::Mode, order: &[u32], look: Look) {
    use ::gltf::mesh::Mode;
    let count = order.len();
    let triangle = |a: usize, b: usize, c: usize| [order[a], order[b], order[c]];
    let before = shape.triangles.len();
    match mode {
        Mode::Points => shape.points.extend(order),
        Mode::Lines => shape.lines.extend(order.chunks_exact(2).map(|pair| [pair[0], pair[1]])),
        Mode::LineStrip | Mode::LineLoop => {
            shape.lines.extend(order.windows(2).map(|pair| [pair[0], pair[1]]));
            if mode == Mode::LineLoop && count > 2 {
                shape.lines.push([order[count - 1], order[0]]);
            }
        }
        Mode::Triangles => shape.triangles.extend(order.chunks_exact(3).map(|t| [t[0], t[1], t[2]])),
        Mode::TriangleStrip => {
            let turned = |k: usize| {
                if k.is_multiple_of(2) { triangle(k, k + 1, k + 2) } else { triangle(k + 1, k, k + 2) }
            };
            shape.triangles.extend((0..count.saturating_sub(2)).map(turned));
        }
        Mode::TriangleFan => {
            shape.triangles.extend((1..count.saturating_sub(1)).map(|k| triangle(0, k, k + 1)));
        }
    }
    let number = shape.looks.iter().position(|other| *other == look).unwrap_or_else(|| {
        shape.looks.push(look);
        shape.looks.len() - 1
    });
    shape.look_of.extend(std::iter::repeat_n(number as u16, shape.triangles.len() - before));
}
