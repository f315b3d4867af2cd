//! Top level of a model file.

use super::fields::Fields;
use super::filters;
use super::group::read_root;
use super::place::GroupReader;
use super::reader::Reader;
use super::surface;
use crate::draft::{BodyDraft, ModelDraft};
use crate::ron_tree::{Node, Value};
use crate::schema;

/// Reads the whole file; `None` only if it is not a struct. Faults go to the reader.
pub(crate) fn document(reader: &mut Reader<'_>, node: &Node) -> Option<ModelDraft> {
    if is_scene(node) {
        let cure = "run it with `pong run`; the models that it lists are files of their own";
        return reader.refuse(node.at, "model", "format", "this is a scene, not a model", cure);
    }
    let fields = Fields::open(reader, node, "model", &[schema::MODEL])?;
    check_format(reader, &fields);
    let name = fields.required(reader, "name").and_then(|node| model_name(reader, node));
    let entry_memory = match fields.optional("entry_memory") {
        Some(node) => reader.boolean(node, "model"),
        None => Some(true),
    };
    let surfaces = match fields.required(reader, "surfaces") {
        Some(node) => surface::surfaces(reader, node),
        None => Vec::new(),
    };
    let pair_overrides = match fields.optional("pairs") {
        Some(node) => surface::pairs(reader, node, name.as_deref().unwrap_or_default(), &surfaces),
        None => Vec::new(),
    };
    let mut bodies: Vec<BodyDraft> = Vec::new();
    if let Some(root) = fields.required(reader, "root") {
        read_root(&mut GroupReader { reader, surfaces: &surfaces, bodies: &mut bodies }, root);
    }
    let filters = match fields.optional("filters") {
        Some(node) => filters::filters(reader, node, &bodies),
        None => Vec::new(),
    };
    Some(ModelDraft {
        name: name.unwrap_or_default(),
        entry_memory: entry_memory.unwrap_or(true),
        surfaces,
        pair_overrides,
        filters,
        bodies,
    })
}

/// Returns `true` if the file declares itself a scene: its fields are then not reported as faults of a model.
fn is_scene(node: &Node) -> bool {
    let Value::Struct(_, fields) = &node.value else { return false };
    let format = fields.iter().find(|field| field.name.as_ref() == "format");
    format.is_some_and(|field| field.value.value == Value::Text("pong-scene".to_owned()))
}

fn check_format(reader: &mut Reader<'_>, fields: &Fields<'_>) {
    if let Some(node) = fields.required(reader, "format")
        && node.value != Value::Text("pong-model".to_owned())
    {
        let cause = format!("the format is {}", describe(&node.value));
        reader.fault(node.at, "model", "format", cause, "write format: \"pong-model\"");
    }
    if let Some(node) = fields.required(reader, "version")
        && node.value != Value::Number(1.0)
    {
        let cause = format!("the version is {}", describe(&node.value));
        reader.fault(node.at, "model", "version", cause, "this engine reads version: 1");
    }
}

fn describe(value: &Value) -> String {
    match value {
        Value::Text(text) => format!("{text:?}"),
        other => other.describe(),
    }
}

fn model_name(reader: &mut Reader<'_>, node: &Node) -> Option<String> {
    let name = reader.text(node, "model")?;
    if name.is_empty() {
        reader.fault(node.at, "model", "empty-name", "the model has no name", "name it");
    }
    Some(name)
}
