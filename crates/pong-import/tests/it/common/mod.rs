//! Small mesh files written by code, and models read back by the engine's loader.

use pong_import::{Findings, Imported, Options};
use pong_model::{Extensions, Model};
pub use pong_testkit::meshes::*;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// An empty folder for one test.
pub fn folder(test: &str) -> PathBuf {
    pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), test)
}

pub fn options() -> Options {
    let surface =
        pong_import::DefaultSurface { name: "steel".to_owned(), stiffness: 1e6, damping: 250.0, mu: 0.2 };
    Options { surface: Some(surface), ..Options::default() }
}

pub fn run(input: &Path, options: &Options) -> Result<(Imported, Model), Findings> {
    let output = input.with_extension("ron");
    let imported = pong_import::import(input, &output, options, &mut |_| ())?;
    Ok((imported, pong_model::load(&output, &Extensions::new()).unwrap()))
}

/// Rules of faults, in order.
pub fn rules(findings: &Findings) -> Vec<&'static str> {
    findings.faults.iter().map(|fault| fault.rule).collect()
}

pub fn note_rules(imported: &Imported) -> Vec<&'static str> {
    imported.findings.notes.iter().map(|note| note.rule).collect()
}

pub fn binary_stl(triangles: &[[Place; 3]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        triangle.iter().flatten().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

pub fn text_stl(triangles: &[[Place; 3]]) -> String {
    let vertex = |[x, y, z]: &Place| format!("      vertex {x} {y} {z}\n");
    let facet = |triangle: &[Place; 3]| {
        let corners: String = triangle.iter().map(vertex).collect();
        format!("  facet normal 0 0 0\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    format!("solid cube\n{}endsolid cube\n", triangles.iter().map(facet).collect::<String>())
}

/// A glTF file under construction.
#[derive(Default)]
pub struct Gltf {
    pub json: Value,
    bytes: Vec<u8>,
}

impl Gltf {
    pub fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
            "nodes": [], "meshes": [], "accessors": [], "bufferViews": [], "buffers": [],
        });
        Self { json, bytes: Vec::new() }
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// An accessor of positions.
    pub fn positions(&mut self, places: &[Place]) -> usize {
        let offset = self.bytes.len();
        places.iter().flatten().for_each(|x| self.bytes.extend((*x as f32).to_le_bytes()));
        let length = self.bytes.len() - offset;
        let view = self.push("bufferViews", json!({"buffer": 0, "byteOffset": offset, "byteLength": length}));
        let extreme = |pick: fn(f64, f64) -> f64| -> Vec<f64> {
            let along = |axis: usize| places.iter().map(|place| place[axis]).reduce(pick).unwrap_or(0.0);
            (0..3).map(along).map(|x| f64::from(x as f32)).collect()
        };
        let (low, high) = (extreme(f64::min), extreme(f64::max));
        let accessor = json!({"bufferView": view, "componentType": 5126, "count": places.len(), "type": "VEC3",
            "min": low, "max": high});
        self.push("accessors", accessor)
    }

    pub fn indices(&mut self, indices: &[u32]) -> usize {
        let offset = self.bytes.len();
        indices.iter().for_each(|index| self.bytes.extend(index.to_le_bytes()));
        let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": 4 * indices.len()});
        let view = self.push("bufferViews", view);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": 5125, "count": indices.len(), "type": "SCALAR"}),
        )
    }

    /// A mesh of one primitive; vertices are repeated for each corner, as exporters do where normals differ.
    pub fn mesh(&mut self, mode: u64, places: &[Place]) -> usize {
        let positions = self.positions(places);
        let indices = self.indices(&(0..places.len() as u32).collect::<Vec<_>>());
        let primitive = json!({"attributes": {"POSITION": positions}, "indices": indices, "mode": mode});
        self.push("meshes", json!({"primitives": [primitive]}))
    }

    pub fn triangles(&mut self, triangles: &[[Place; 3]]) -> usize {
        let corners: Vec<Place> = triangles.iter().flatten().copied().collect();
        self.mesh(4, &corners)
    }

    /// A node below another, or a root.
    pub fn node(&mut self, parent: Option<usize>, node: Value) -> usize {
        let index = self.push("nodes", node);
        let list = match parent {
            Some(parent) => self.json["nodes"][parent].as_object_mut().unwrap().entry("children"),
            None => self.json["scenes"][0].as_object_mut().unwrap().entry("nodes"),
        };
        list.or_insert_with(|| json!([])).as_array_mut().unwrap().push(json!(index));
        index
    }

    fn finished(&self, buffer: Value) -> Value {
        let mut json = self.json.clone();
        for (key, list) in json.as_object_mut().unwrap().clone() {
            if list.as_array().is_some_and(Vec::is_empty) {
                json.as_object_mut().unwrap().remove(&key);
            }
        }
        if !self.bytes.is_empty() {
            json["buffers"] = json!([buffer]);
        }
        json
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut text = self.finished(json!({"byteLength": self.bytes.len()})).to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bin = self.bytes.clone();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let mut file = b"glTF\x02\0\0\0".to_vec();
        file.extend((28 + text.len() as u32 + bin.len() as u32).to_le_bytes());
        file.extend((text.len() as u32).to_le_bytes());
        file.extend(b"JSON");
        file.extend(&text);
        file.extend((bin.len() as u32).to_le_bytes());
        file.extend(b"BIN\0");
        file.extend(&bin);
        file
    }

    /// Text of a `.gltf` file with its bytes in `uri`.
    pub fn text(&self, uri: &str) -> String {
        self.finished(json!({"byteLength": self.bytes.len(), "uri": uri})).to_string()
    }

    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    pub fn save(&self, folder: &Path, name: &str) -> PathBuf {
        let path = folder.join(name);
        std::fs::write(&path, self.glb()).unwrap();
        path
    }
}

/// The cube as the only node.
pub fn cube_file() -> Gltf {
    let mut gltf = Gltf::new();
    let mesh = gltf.triangles(&cube());
    gltf.node(None, json!({"name": "cube", "mesh": mesh}));
    gltf
}

/// A Collada file of one node with the cube; `primitives` are lists that name its corners, `asset` and
/// `transform` are inserted as they are.
pub fn collada(asset: &str, transform: &str, primitives: &str) -> String {
    let places: String = CUBE.iter().map(|[x, y, z]| format!("{x} {y} {z} ")).collect();
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>{asset}</asset>
  <library_geometries><geometry id="cube-mesh" name="Cube"><mesh>
    <source id="places"><float_array id="numbers" count="24">{places}</float_array>
      <technique_common><accessor source="#numbers" count="8" stride="3"/></technique_common></source>
    <source id="normals"><float_array id="directions" count="3">0 0 1</float_array></source>
    <vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
    {primitives}
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="Scene">
    <node id="lamp"><lookat>0 0 0 1 1 1 0 0 1</lookat><instance_light url="#none"/></node>
    <node id="part">{transform}<instance_geometry url="#cube-mesh"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#Scene"/></scene>
</COLLADA>"##
    )
}

/// The cube as a Collada list: `triangles`, `polylist` or `polygons`, with normals beside the corners.
pub fn collada_list(kind: &str) -> String {
    let corners = |side: &[usize]| side.iter().map(|corner| format!("{corner} 0 ")).collect::<String>();
    let sides: String = match kind {
        "triangles" => {
            SIDES.iter().map(|[a, b, c, d]| corners(&[*a, *b, *c]) + &corners(&[*a, *c, *d])).collect()
        }
        "polygons" => SIDES.iter().map(|side| format!("<p>{}</p>", corners(side))).collect(),
        _ => SIDES.iter().map(|side| corners(side)).collect(),
    };
    let numbers = match kind {
        "polygons" => sides,
        "polylist" => format!("<vcount>4 4 4 4 4 4</vcount><p>{sides}</p>"),
        _ => format!("<p>{sides}</p>"),
    };
    let inputs = r##"<input semantic="VERTEX" source="#corners" offset="0"/><input semantic="NORMAL" source="#normals" offset="1"/>"##;
    let count = if kind == "triangles" { 12 } else { 6 };
    format!("<{kind} count=\"{count}\">{inputs}{numbers}</{kind}>")
}
