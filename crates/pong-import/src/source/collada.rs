//! Collada 1.4 and 1.5: the node tree of the visual scene, triangles, polygons, lines.
//!
//! Unit and upward axis are those of the file. Materials, lights, cameras and physics are ignored.

mod geometry;
mod reader;
mod transform;

use super::budget::Budget;
use super::format_fault::finding;
use super::reading::{Reading, stem};
use super::tree::{Node, Shape, Source, all_in_range};
use crate::affine::{Affine, Up};
use crate::findings::{Finding, Findings};
use reader::{Reader, child, children};
use roxmltree::{Document, Node as Element};
use std::collections::HashMap;
use std::path::Path;

/// Deepest nesting of nodes.
const DEEPEST: usize = 200;

/// A tree under construction.
struct Making {
    source: Source,
    budget: Budget,
    /// Geometries read so far, by id.
    shapes: HashMap<String, Option<Shape>>,
}

pub(super) fn read(bytes: &[u8], path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    let text = findings.ok(pong_model::mesh_formats::text(bytes).map_err(|fault| finding(fault, &file)))?;
    let damaged = |cause: String| Finding {
        path: file.clone(),
        rule: "damaged",
        cause,
        cure: "export it again as Collada 1.4".to_owned(),
    };
    let document = findings.ok(Document::parse(&text).map_err(|reason| damaged(reason.to_string())))?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        findings.faults.push(damaged(format!("its root is <{}>, not <COLLADA>", root.tag_name().name())));
        return None;
    }
    let by_id = root.descendants().filter_map(|element| Some((element.attribute("id")?, element))).collect();
    let mut reader = Reader { document: &document, by_id, file, up: Up::Y, unit_m: reading.unit_m };
    reader.asset(root, reading, findings)?;
    if let Some(clips) = child(root, "library_animations").filter(|clips| clips.has_children()) {
        let cause = "its animations are left out; nodes stand where the file has them";
        findings.note(&reader.place(clips), "animation", cause, "");
    }
    let budget = Budget::new(reading.triangles_max, bytes.len());
    let mut making = Making { source: Source::default(), budget, shapes: HashMap::new() };
    match reader.scene(root, reading.scene.as_deref(), findings)? {
        Some(scene) => {
            for node in children(scene, "node") {
                reader.add_node(node, None, 0, &mut making, findings);
            }
        }
        None => reader.add_all_geometries(path, &mut making, findings),
    }
    let source = making.source;
    if source.nodes.iter().all(|node| node.mesh.is_none()) && findings.faults.is_empty() {
        let cause = "its scene has no triangles, polygons or lines";
        findings.fault(&reader.file, "empty-mesh", cause, "export a scene that shows a mesh");
    }
    findings.faults.is_empty().then_some(source)
}

impl<'a> Reader<'a> {
    /// Unit and upward axis.
    fn asset(&mut self, root: Element<'a, 'a>, reading: &Reading, findings: &mut Findings) -> Option<()> {
        let asset = child(root, "asset");
        let unit = asset.and_then(|asset| child(asset, "unit")).filter(|unit| unit.has_attribute("meter"));
        if let Some(unit) = unit {
            let text = unit.attribute("meter").unwrap_or("");
            let metres = text.trim().parse().ok().filter(|metres: &f64| *metres > 0.0 && metres.is_finite());
            let cause = || format!("its unit is \"{text}\" metres");
            let Some(metres) = metres else {
                return findings.refuse(&self.place(unit), "damaged", cause(), "give a length above zero");
            };
            self.unit_m *= metres;
        }
        let axis = asset.and_then(|asset| child(asset, "up_axis"));
        let named = match axis.and_then(|axis| axis.text()).map_or("Y_UP", str::trim) {
            "X_UP" => Up::X,
            "Y_UP" => Up::Y,
            "Z_UP" => Up::Z,
            other => {
                let cause = format!("its upward axis is `{other}`");
                return findings.refuse(&self.file, "damaged", cause, "write X_UP, Y_UP or Z_UP");
            }
        };
        self.up = reading.up.unwrap_or(named);
        Some(())
    }

    /// The visual scene of that name, or the file's default; `Some(None)` for a file without scenes.
    fn scene(
        &self,
        root: Element<'a, 'a>,
        name: Option<&str>,
        findings: &mut Findings,
    ) -> Option<Option<Element<'a, 'a>>> {
        let libraries = children(root, "library_visual_scenes");
        let scenes: Vec<Element<'a, 'a>> =
            libraries.flat_map(|library| children(library, "visual_scene")).collect();
        let shown = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
        let called = |scene: &Element<'a, 'a>| [scene.attribute("name"), scene.attribute("id")];
        let found = match (name, shown) {
            (Some(name), _) => scenes.iter().find(|scene| called(scene).contains(&Some(name))).copied(),
            (None, Some(shown)) => self.target(shown, "visual_scene", findings).map(Some)?,
            (None, None) => match scenes.first() {
                Some(first) => Some(*first),
                None => return Some(None),
            },
        };
        match found {
            Some(scene) => Some(Some(scene)),
            None => {
                let names: Vec<&str> = scenes.iter().filter_map(|scene| called(scene)[0]).collect();
                let cause = format!("there is no scene `{}` among {names:?}", name.unwrap_or(""));
                findings.refuse(&self.file, "no-scene", cause, "name a scene that the file has")
            }
        }
    }

    /// File without a scene: every geometry is placed at its own coordinates.
    fn add_all_geometries(&self, path: &Path, making: &mut Making, findings: &mut Findings) {
        let cause = "it has no visual scene: all its geometries were read, each as it is";
        findings.note(&self.file, "no-scene", cause, "");
        let libraries = children(self.document.root_element(), "library_geometries");
        for geometry in libraries.flat_map(|library| children(library, "geometry")) {
            let name = geometry.attribute("name").or(geometry.attribute("id"));
            let name = name.map_or_else(|| stem(path), str::to_owned);
            let mesh = self.shape(geometry, &name, making, findings);
            self.push(making, name, None, Affine::identity(), mesh);
        }
    }

    fn push(
        &self,
        making: &mut Making,
        name: String,
        parent: Option<usize>,
        local: Affine,
        mesh: Option<Shape>,
    ) -> usize {
        let nodes = &mut making.source.nodes;
        let path = path_below(parent.map(|parent| nodes[parent].path.as_str()), &name);
        nodes.push(Node { name, parent, path, local, mark: None, mesh });
        nodes.len() - 1
    }

    fn add_node(
        &self,
        node: Element<'a, 'a>,
        parent: Option<usize>,
        depth: usize,
        making: &mut Making,
        findings: &mut Findings,
    ) {
        // Lights and cameras have transforms of their own.
        if !shows_geometry(node) {
            return;
        }
        if depth > DEEPEST {
            let cause = format!("nodes nest deeper than {DEEPEST}, or within themselves");
            findings.fault(&self.place(node), "too-deep", cause, "flatten the tree");
            return;
        }
        let name = node.attribute("name").or(node.attribute("id")).filter(|name| !name.trim().is_empty());
        let name = name.map_or_else(|| format!("node_{}", making.source.nodes.len()), str::to_owned);
        let path = path_below(parent.map(|parent| making.source.nodes[parent].path.as_str()), &name);
        if !making.budget.take_path(&path, &self.place(node), findings) {
            return;
        }
        let Some(local) = findings.ok(transform::of(self, node)) else { return };
        let mut local = self.up.turned_transform(&local);
        local.translation *= self.unit_m;
        let own = self.push(making, name, parent, local, None);
        for element in node.children().filter(Element::is_element) {
            match element.tag_name().name() {
                "node" => self.add_node(element, Some(own), depth + 1, making, findings),
                "instance_node" => {
                    if let Some(target) = self.target(element, "node", findings) {
                        self.add_node(target, Some(own), depth + 1, making, findings);
                    }
                }
                "instance_geometry" => self.add_geometry(element, own, making, findings),
                "instance_controller" => {
                    let cause = "its mesh is moved by a skin or by morph targets; models are rigid";
                    let cure = "apply the armature before the export, or take the skin away";
                    findings.fault(&self.place(element), "skin", cause, cure);
                }
                _ => {}
            }
        }
    }

    /// Mesh of a node; a second one becomes a child node.
    fn add_geometry(
        &self,
        instance: Element<'a, 'a>,
        node: usize,
        making: &mut Making,
        findings: &mut Findings,
    ) {
        let Some(geometry) = self.target(instance, "geometry", findings) else { return };
        let path = making.source.nodes[node].path.clone();
        let mesh = self.shape(geometry, &path, making, findings);
        if making.source.nodes[node].mesh.is_none() {
            making.source.nodes[node].mesh = mesh;
            return;
        }
        let name = geometry.attribute("name").or(geometry.attribute("id")).unwrap_or("mesh").to_owned();
        self.push(making, name, Some(node), Affine::identity(), mesh);
    }

    fn shape(
        &self,
        geometry: Element<'a, 'a>,
        path: &str,
        making: &mut Making,
        findings: &mut Findings,
    ) -> Option<Shape> {
        let id = geometry.attribute("id").unwrap_or("").to_owned();
        if !making.shapes.contains_key(&id) {
            let shape = geometry::shape(self, geometry, findings);
            let whole = shape.filter(|shape| all_in_range(shape, &self.place(geometry), findings));
            making.shapes.insert(id.clone(), whole.filter(|shape| !shape.is_empty()));
        }
        let shape = making.shapes[&id].as_ref()?;
        let corners = 3 * shape.triangles.len() + 2 * shape.lines.len();
        let path = format!("{}: {path}", self.file);
        making.budget.take(corners.max(shape.vertices.len()), &path, findings).then(|| shape.clone())
    }
}

fn path_below(above: Option<&str>, name: &str) -> String {
    above.map_or_else(|| name.to_owned(), |above| format!("{above}/{name}"))
}

/// Tests whether a node or a descendant has a mesh.
fn shows_geometry(node: Element<'_, '_>) -> bool {
    let shows = ["instance_geometry", "instance_controller", "instance_node"];
    node.descendants().any(|element| shows.contains(&element.tag_name().name()))
}
