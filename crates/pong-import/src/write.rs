//! Text of a model file from a `Model`, in the layout of the modelling toolkit: the same model gives the same
//! bytes.

mod layout;

use crate::model::{Field, Group, Model, Primitive, Record};
use crate::number::decimal;
use layout::{Item, Shown, lay_out, quoted};
use nalgebra::Vector3;

/// The text of a model file.
pub fn text(model: &Model) -> String {
    let mut items: Vec<Item> = vec![
        ("format: ".into(), Shown::Flat(quoted("pong-model"))),
        ("version: ".into(), Shown::Flat("1".to_owned())),
        ("name: ".into(), Shown::Flat(quoted(&model.name))),
    ];
    if !model.entry_memory {
        items.push(("entry_memory: ".into(), Shown::Flat("false".to_owned())));
    }
    let surfaces = model
        .surfaces
        .iter()
        .map(|(name, fields)| (format!("{}: ", quoted(name)).into(), record("", fields)));
    items.push(("surfaces: ".into(), Shown::broken("{", surfaces.collect(), "}")));
    if !model.pairs.is_empty() {
        let pairs = model.pairs.iter().map(|fields| ("".into(), record("", fields))).collect();
        items.push(("pairs: ".into(), Shown::broken("[", pairs, "]")));
    }
    if !model.filters.is_empty() {
        let both = |[a, b]: &[String; 2]| ("".into(), Shown::Flat(format!("({}, {})", quoted(a), quoted(b))));
        items.push(("filters: ".into(), Shown::block("[", model.filters.iter().map(both).collect(), "]")));
    }
    items.push(("root: ".into(), group(&model.root)));
    let mut out: String = model.comment.iter().map(|line| format!("// {line}\n")).collect();
    lay_out("", &Shown::broken("(", items, ")"), 0, &mut out);
    // No comma follows the outermost bracket.
    out.truncate(out.len() - 2);
    out.push('\n');
    out
}

fn group(node: &Group) -> Shown {
    let mut items: Vec<Item> = vec![("name: ".into(), Shown::Flat(quoted(&node.name)))];
    let mut add = |label: &'static str, value: Shown| items.push((label.into(), value));
    if node.movable {
        add("movable: ", Shown::Flat("true".to_owned()));
    }
    let mut pose: Vec<Item> = Vec::new();
    if let Some(position) = node.position.filter(|position| *position != [0.0; 3]) {
        pose.push(("position: ".into(), Shown::Flat(tuple(&position))));
    }
    if let Some(orientation) = node.orientation.filter(|orientation| *orientation != [1.0, 0.0, 0.0, 0.0]) {
        pose.push(("orientation: ".into(), Shown::Flat(tuple(&orientation))));
    }
    if !pose.is_empty() {
        add("pose: ", Shown::block("(", pose, ")"));
    }
    if let Some(bound) = node.bound.as_ref().filter(|bound| !bound.is_empty()) {
        add("bound: ", Shown::Flat(bound.clone()));
    }
    if let Some(surface) = &node.surface {
        add("surface: ", Shown::Flat(quoted(surface)));
    }
    if !node.groups.is_empty() {
        let below = node.groups.iter().map(|below| ("".into(), group(below))).collect();
        add("groups: ", Shown::broken("[", below, "]"));
    }
    if !node.primitives.is_empty() {
        let below = node.primitives.iter().map(|item| ("".into(), primitive(item))).collect();
        add("primitives: ", Shown::broken("[", below, "]"));
    }
    Shown::broken("(", items, ")")
}

fn primitive(item: &Primitive) -> Shown {
    let mut items: Vec<Item> = vec![("name: ".into(), Shown::Flat(quoted(&item.name)))];
    if let Some(surface) = &item.surface {
        items.push(("surface: ".into(), Shown::Flat(quoted(surface))));
    }
    items.extend(fields(&item.fields));
    Shown::block(&format!("{}(", item.kind), items, ")")
}

fn record(name: &str, record: &Record) -> Shown {
    Shown::block(&format!("{name}("), fields(record).collect(), ")")
}

fn fields(record: &Record) -> impl Iterator<Item = Item> + '_ {
    record.iter().map(|(name, value)| (format!("{name}: ").into(), shown(value)))
}

fn shown(value: &Field) -> Shown {
    match value {
        Field::Number(value) => Shown::Flat(decimal(*value)),
        Field::Text(text) => Shown::Flat(quoted(text)),
        Field::Word(word) => Shown::Flat(word.clone()),
        Field::Tuple(values) => Shown::Flat(tuple(values)),
        Field::Texts(texts) => {
            Shown::Flat(format!("({})", texts.iter().map(|text| quoted(text)).collect::<Vec<_>>().join(", ")))
        }
        Field::Tuples(places) => {
            Shown::Flat(format!("({})", places.iter().map(coordinates).collect::<Vec<_>>().join(", ")))
        }
        Field::Numbers(values) => Shown::Filled(values.iter().map(|value| decimal(*value)).collect()),
        Field::Record(name, inner) => record(name, inner),
        Field::Vertices(places) => Shown::Filled(places.iter().map(coordinates).collect()),
        Field::Triangles(triangles) => {
            Shown::Filled(triangles.iter().map(|[a, b, c]| format!("({a}, {b}, {c})")).collect())
        }
        Field::Faces(faces) => Shown::Filled(faces.iter().map(|face| indices(face)).collect()),
        Field::Indices(all) => Shown::Filled(all.iter().map(usize::to_string).collect()),
    }
}

fn tuple(values: &[f64]) -> String {
    format!("({})", values.iter().map(|value| decimal(*value)).collect::<Vec<_>>().join(", "))
}

fn coordinates(place: &Vector3<f64>) -> String {
    tuple(place.as_slice())
}

fn indices(face: &[u32]) -> String {
    format!("[{}]", face.iter().map(u32::to_string).collect::<Vec<_>>().join(", "))
}
