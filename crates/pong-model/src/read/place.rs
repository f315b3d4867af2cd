//! Destination and names of groups and primitives.

use super::fields::Fields;
use super::reader::Reader;
use super::suggest;
use crate::draft::BodyDraft;
use crate::ron_tree::{Node, Value};
use crate::surface::Surface;
use pong_geometry::Pose;
use std::collections::HashSet;

/// State of reading groups: reader, inputs and the lists that are filled.
pub(super) struct GroupReader<'r, 'a> {
    pub(super) reader: &'r mut Reader<'a>,
    pub(super) surfaces: &'r [Surface],
    pub(super) bodies: &'r mut Vec<BodyDraft>,
}

/// Destination of primitives.
pub(super) struct Place {
    pub(super) path: String,
    pub(super) body: usize,
    pub(super) group: usize,
    pub(super) x_bg: Pose,
    pub(super) surface: Option<u32>,
    /// True for `contact: Solid`.
    pub(super) solid: bool,
    /// Outermost group of this body above the primitives that is declared one surface (index into its groups).
    pub(super) one_surface: Option<u32>,
}

/// Name of a group or primitive, if it has a usable one, so that all its faults carry its path.
pub(super) fn authored_name(node: &Node) -> Option<&str> {
    let Value::Struct(_, fields) = &node.value else { return None };
    match &fields.iter().find(|field| field.name.as_ref() == "name")?.value.value {
        Value::Text(name) if !name.is_empty() => Some(name),
        _ => None,
    }
}

/// Reads the name of a group or primitive: present, not empty, without `/`, unique among its siblings.
pub(super) fn read_name(
    reader: &mut Reader<'_>,
    fields: &Fields<'_>,
    path: &str,
    siblings: &mut HashSet<String>,
) -> Option<String> {
    let node = fields.required(reader, "name")?;
    let name = reader.text(node, path)?;
    if name.is_empty() {
        return reader.refuse(node.at, path, "empty-name", "the name is empty", "name it");
    }
    if name.contains('/') {
        let cause = format!("the name \"{name}\" contains a `/`");
        reader.fault(
            node.at,
            path,
            "slash-in-name",
            cause,
            "a `/` separates the names of a path; use another sign",
        );
    }
    if !siblings.insert(name.clone()) {
        let cause = format!("the name \"{name}\" is taken by a sibling");
        reader.fault(node.at, path, "repeated-name", cause, "names are unique within a group; rename one");
    }
    Some(name)
}

/// Index of a surface, by name.
pub(super) fn surface_index(
    reader: &mut Reader<'_>,
    surfaces: &[Surface],
    node: &Node,
    path: &str,
) -> Option<u32> {
    let name = reader.text(node, path)?;
    if let Some(index) = reader.surface_called(surfaces, &name) {
        return Some(index);
    }
    let cause = format!("there is no surface \"{name}\"");
    let cure =
        suggest::cure_among(&name, surfaces.len(), surfaces.iter().map(|surface| surface.name.as_str()));
    reader.fault(node.at, path, "unknown-surface", cause, cure);
    // Any index will do: the model is refused, and no second fault should follow from this one.
    Some(0)
}
