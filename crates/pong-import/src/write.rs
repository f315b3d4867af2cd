//! Text of a model file from a `Model`: its fields as values for the writer of `pong_model`.

use crate::model::{Field, Group, Model, Primitive, Record};
use nalgebra::Vector3;
use pong_model::authored::Value;
use pong_model::write;

/// Fields of a struct before they become a value.
type Fields<'f> = Vec<(&'f str, Value)>;

/// The text of a model file.
pub fn text(model: &Model) -> String {
    let mut fields: Fields<'_> = Vec::new();
    if !model.entry_memory {
        fields.push(("entry_memory", Value::Bool(false)));
    }
    let surfaces = model.surfaces.iter().map(|(name, fields)| (name.as_str(), record("", fields)));
    fields.push(("surfaces", Value::map(surfaces)));
    if !model.pairs.is_empty() {
        fields.push(("pairs", Value::list(model.pairs.iter().map(|pair| record("", pair)))));
    }
    if !model.filters.is_empty() {
        fields.push(("filters", Value::list(model.filters.iter().map(|groups| texts(groups)))));
    }
    fields.push(("root", group(&model.root)));
    let comment: String = model.comment.iter().map(|line| format!("// {line}\n")).collect();
    comment + &write::text(&Value::model(&model.name, fields))
}

fn group(node: &Group) -> Value {
    let mut fields: Fields<'_> = vec![("name", Value::text(&node.name))];
    if node.movable {
        fields.push(("movable", Value::Bool(true)));
    }
    let mut pose: Fields<'_> = Vec::new();
    if let Some(position) = node.position.filter(|position| *position != [0.0; 3]) {
        pose.push(("position", numbers(&position)));
    }
    if let Some(orientation) = node.orientation.filter(|orientation| *orientation != [1.0, 0.0, 0.0, 0.0]) {
        pose.push(("orientation", numbers(&orientation)));
    }
    if !pose.is_empty() {
        fields.push(("pose", Value::fields(pose)));
    }
    if let Some(bound) = node.bound.as_ref().filter(|bound| !bound.is_empty()) {
        fields.push(("bound", self::bound(bound)));
    }
    if let Some(surface) = &node.surface {
        fields.push(("surface", Value::text(surface)));
    }
    if let Some(contact) = node.contact {
        fields.push(("contact", Value::name(contact)));
    }
    if !node.groups.is_empty() {
        fields.push(("groups", Value::list(node.groups.iter().map(group))));
    }
    if !node.primitives.is_empty() {
        fields.push(("primitives", Value::list(node.primitives.iter().map(primitive))));
    }
    Value::fields(fields)
}

/// Name of a bounding volume, or `Custom:` and the name of a registered kind.
fn bound(bound: &str) -> Value {
    match bound.strip_prefix("Custom:") {
        Some(kind) => Value::Tuple(Some("Custom".into()), vec![Value::text(kind).into()]),
        None => Value::name(bound),
    }
}

fn primitive(item: &Primitive) -> Value {
    let mut fields: Fields<'_> = vec![("name", Value::text(&item.name))];
    if let Some(surface) = &item.surface {
        fields.push(("surface", Value::text(surface)));
    }
    fields.extend(item.fields.iter().map(|(name, field)| (name.as_str(), value(field))));
    Value::named(item.kind, fields)
}

fn record(name: &str, record: &Record) -> Value {
    let fields = record.iter().map(|(name, field)| (name.as_str(), value(field)));
    if name.is_empty() { Value::fields(fields) } else { Value::named(name, fields) }
}

fn value(field: &Field) -> Value {
    match field {
        Field::Number(number) => Value::Number(plus_zero(*number)),
        Field::Text(text) => Value::text(text),
        Field::Word(word) => Value::name(word),
        Field::Flags(flags) => Value::tuple(flags.iter().map(|flag| Value::Bool(*flag))),
        Field::Tuple(values) => numbers(values),
        Field::Texts(all) => texts(all),
        Field::Tuples(places) => Value::tuple(places.iter().map(|place| numbers(place.as_slice()))),
        Field::Numbers(values) => Value::list(values.iter().map(|value| Value::Number(plus_zero(*value)))),
        Field::Record(name, inner) => record(name, inner),
        Field::Vertices(places) => Value::rows(false, places.iter().map(coordinates)),
        Field::Triangles(triangles) => {
            Value::rows(false, triangles.iter().map(|corners| corners.map(f64::from)))
        }
        Field::Faces(faces) => {
            Value::rows(true, faces.iter().map(|face| face.iter().copied().map(f64::from)))
        }
        Field::Indices(all) => Value::list(all.iter().map(|index| Value::Number(*index as f64))),
    }
}

fn texts(texts: &[String]) -> Value {
    Value::tuple(texts.iter().map(|text| Value::text(text)))
}

fn numbers(values: &[f64]) -> Value {
    Value::numbers(&values.iter().copied().map(plus_zero).collect::<Vec<_>>())
}

fn coordinates(place: &Vector3<f64>) -> [f64; 3] {
    [place.x, place.y, place.z].map(plus_zero)
}

/// The number, with 0 for -0, which transforms leave where nothing is meant by it.
fn plus_zero(number: f64) -> f64 {
    number + 0.0
}
