//! Primitives of registered custom kinds.

use super::opened_primitive::Primitive;
use super::reader::Reader;
use pong_geometry::primitive::CustomPrimitive;
use std::sync::Arc;

/// Creates a custom primitive in the frame of its movable group, because custom kinds have no poses.
pub(super) fn custom(reader: &mut Reader<'_>, p: &mut Primitive<'_, '_>) -> Option<Arc<dyn CustomPrimitive>> {
    let kind = p.fields.required(reader, "kind").and_then(|node| reader.text(node, &p.path));
    let parameters = match p.fields.optional("parameters") {
        Some(node) => reader.numbers(node, &p.path)?,
        None => Vec::new(),
    };
    let kind = kind?;
    if !reader.judges_shapes {
        return None;
    }
    let Some(factory) = reader.ext.primitive(&kind).cloned() else {
        let cause = format!("no primitive of the kind \"{kind}\" is registered");
        let cure = "register it with Extensions::add_primitive before loading";
        return reader.refuse(p.at, &p.path, "unknown-primitive", cause, cure);
    };
    if p.x != pong_geometry::Transform::identity() {
        let cause = "a custom primitive below a posed group that does not move on its own";
        let cure = "its parameters are in the frame of the movable group: put it into a group without a pose";
        return reader.refuse(p.at, &p.path, "custom-under-pose", cause, cure);
    }
    match factory(&parameters) {
        Ok(primitive) => {
            p.draft.custom_parameters.push((kind, parameters));
            Some(primitive)
        }
        Err(reason) => reader.refuse(
            p.at,
            &p.path,
            "custom-parameters",
            reason,
            format!("see the description of \"{kind}\""),
        ),
    }
}
