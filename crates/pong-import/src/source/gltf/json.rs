//! The JSON of a glTF file: container, extensions, numbers of double precision.

use crate::affine::Affine;
use crate::findings::{Finding, Findings};
use crate::number::widened;
use nalgebra::{Matrix3, Vector3};
use serde_json::Value;
use std::collections::HashSet;

/// Prefixes of required extensions that do not change the geometry or are supported.
const HARMLESS: [&str; 7] = [
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "EXT_texture_",
    "MSFT_texture_",
    "KHR_node_visibility",
    // Integer positions are read by their types.
    "KHR_mesh_quantization",
];

/// Look-ups that tolerate missing entries.
pub(super) trait Json {
    fn list(&self, key: &str) -> &[Value];
    fn text(&self, key: &str) -> Option<&str>;
    fn index(&self, key: &str) -> Option<usize>;
}

impl Json for Value {
    fn list(&self, key: &str) -> &[Value] {
        self.get(key).and_then(Value::as_array).map(Vec::as_slice).unwrap_or(&[])
    }

    fn text(&self, key: &str) -> Option<&str> {
        self.get(key).and_then(Value::as_str)
    }

    fn index(&self, key: &str) -> Option<usize> {
        self.get(key).and_then(Value::as_u64).map(|index| index as usize)
    }
}

fn damaged(file: &str, cause: String) -> Finding {
    let cure = "export it again as glTF 2.0".to_owned();
    Finding { path: file.to_owned(), rule: "damaged", cause, cure }
}

fn unpack<'a>(bytes: &'a [u8], file: &str) -> Result<::gltf::Glb<'a>, Finding> {
    /// Magic number, version and length of the file, four bytes each.
    const HEADER: u32 = 12;
    // The crate reads the header from the length without a check.
    if let Some(&length) = bytes.get(8..).and_then(<[u8]>::first_chunk)
        && u32::from_le_bytes(length) < HEADER
    {
        let length = u32::from_le_bytes(length);
        return Err(damaged(file, format!("its header says that the file has {length} bytes")));
    }
    ::gltf::Glb::from_slice(bytes).map_err(|reason| damaged(file, reason.to_string()))
}

/// The JSON, and the binary chunk of a `.glb` file.
pub(super) fn parse(bytes: &[u8], file: &str) -> Result<(Value, Option<Vec<u8>>), Finding> {
    let glb = if bytes.starts_with(b"glTF") { Some(unpack(bytes, file)?) } else { None };
    let text: &[u8] = glb.as_ref().map_or(bytes, |glb| &glb.json);
    let value: Value = serde_json::from_slice(text).map_err(|reason| damaged(file, reason.to_string()))?;
    let version = value.get("asset").and_then(|asset| asset.text("version")).unwrap_or("");
    if !version.starts_with("2.") {
        let cause = format!("it is glTF of version \"{version}\", not 2.0");
        return Err(Finding { rule: "version", ..damaged(file, cause) });
    }
    Ok((value, glb.and_then(|glb| glb.bin.map(|bin| bin.into_owned()))))
}

/// Refuses required extensions that change the geometry in unsupported ways.
pub(super) fn refuse_extensions(value: &Value, file: &str, findings: &mut Findings) {
    for name in value.list("extensionsRequired").iter().filter_map(Value::as_str) {
        if HARMLESS.iter().any(|start| name.starts_with(start)) {
            continue;
        }
        let cure = match name {
            "KHR_draco_mesh_compression" => "switch Draco compression off in the export",
            "EXT_meshopt_compression" | "KHR_meshopt_compression" => "export without meshopt compression",
            "EXT_mesh_gpu_instancing" => "export without instancing, one node per place",
            _ => "export without this extension",
        };
        findings.fault(file, "unsupported-extension", format!("it requires the extension {name}"), cure);
    }
}

/// Checks that positions refer to existing accessors; the crate's own check indexes them unchecked.
fn check_positions(value: &Value, file: &str) -> Result<(), Finding> {
    let accessors = value.list("accessors").len();
    let primitives = value.list("meshes").iter().flat_map(|mesh| mesh.list("primitives"));
    let mut positions = primitives.filter_map(|primitive| primitive.get("attributes")?.index("POSITION"));
    match positions.find(|index| *index >= accessors) {
        Some(index) => Err(damaged(file, format!("positions are in accessor {index} of {accessors}"))),
        None => Ok(()),
    }
}

/// Checks that the nodes are trees whose roots are the scenes' roots; cycles would never end.
fn check_nodes(value: &Value, file: &str) -> Result<(), Finding> {
    let mut below = HashSet::new();
    let children = value.list("nodes").iter().flat_map(|node| node.list("children"));
    for child in children.filter_map(Value::as_u64) {
        if !below.insert(child) {
            return Err(damaged(file, format!("node {child} stands below two nodes, or twice below one")));
        }
    }
    for scene in value.list("scenes") {
        let mut roots = HashSet::new();
        for root in scene.list("nodes").iter().filter_map(Value::as_u64) {
            if below.contains(&root) || !roots.insert(root) {
                let cause = format!("node {root}, which a scene lists, stands below another or twice");
                return Err(damaged(file, cause));
            }
        }
    }
    Ok(())
}

/// The document for the crate, checked by its rules.
pub(super) fn document(value: &Value, file: &str) -> Result<::gltf::Document, Finding> {
    check_positions(value, file)?;
    check_nodes(value, file)?;
    let mut plain = value.clone();
    if let Some(fields) = plain.as_object_mut() {
        fields.remove("extensionsRequired");
    }
    let text = plain.to_string();
    let root = ::gltf::json::Root::from_str(&text).map_err(|reason| damaged(file, reason.to_string()))?;
    ::gltf::Document::from_json(root).map_err(|reason| match reason {
        ::gltf::Error::Validation(all) => {
            let told: Vec<String> =
                all.iter().take(5).map(|(path, what)| format!("{path}: {what}")).collect();
            damaged(file, told.join(", "))
        }
        other => damaged(file, other.to_string()),
    })
}

/// Widens a number of single precision to the decimal that was typed; others stay.
fn number(value: f64) -> f64 {
    let single = value as f32;
    if f64::from(single) == value { widened(single) } else { value }
}

/// Array of `N` numbers; `None` if the field is missing.
fn numbers<const N: usize>(node: &Value, key: &str, path: &str) -> Result<Option<[f64; N]>, Finding> {
    let Some(value) = node.get(key) else { return Ok(None) };
    let all: Option<Vec<f64>> =
        value.as_array().map(|all| all.iter().filter_map(Value::as_f64).map(number).collect());
    match all.and_then(|all| <[f64; N]>::try_from(all).ok()) {
        Some(numbers) => Ok(Some(numbers)),
        None => Err(damaged(path, format!("its {key} is not {N} numbers"))),
    }
}

/// A node's transform to its parent, in the axes and units of the file.
pub(super) fn transform(node: &Value, path: &str) -> Result<Affine, Finding> {
    if let Some(m) = numbers::<16>(node, "matrix", path)? {
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return Err(damaged(path, "its matrix is no affine transform".to_owned()));
        }
        let linear = Matrix3::new(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);
        return Ok(Affine { linear, translation: Vector3::new(m[12], m[13], m[14]) });
    }
    let translation = numbers::<3>(node, "translation", path)?.unwrap_or([0.0; 3]);
    let rotation = numbers::<4>(node, "rotation", path)?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = numbers::<3>(node, "scale", path)?.unwrap_or([1.0; 3]);
    let affine = Affine::from_parts(translation.into(), rotation, scale.into());
    affine.ok_or_else(|| damaged(path, "its rotation is no quaternion".to_owned()))
}
