//! Surfaces and pairs of surfaces, from JSON and from the command line, as records of a model file.
//!
//! A law is `{"Linear": {"damping": 250.0}}`, `{"name": "Linear", "fields": {…}}`, or the word alone; numbers beyond
//! JSON (`inf`) come as text.

use crate::model::{Field, Record, field};
use serde_json::{Map, Value};

/// Surface of primitives that name none.
#[derive(Clone, Debug, PartialEq)]
pub struct DefaultSurface {
    /// Name in the model file.
    pub name: String,
    /// Stiffness k, N/m.
    pub stiffness: f64,
    /// Damping c of the linear law, N·s/m.
    pub damping: f64,
    /// Kinetic coefficient of friction of the bristle law; 0 for none.
    pub mu: f64,
}

impl DefaultSurface {
    /// Fields of the surface in the model file.
    pub fn record(&self) -> Record {
        let mut record = vec![field("stiffness", Field::Number(self.stiffness))];
        let law = |name: &str, key: &str, value: f64| {
            Field::Record(name.to_owned(), vec![field(key, Field::Number(value))])
        };
        if self.damping > 0.0 {
            record.push(field("normal", law("Linear", "damping", self.damping)));
        }
        if self.mu > 0.0 {
            record.push(field("friction", law("Bristle", "mu", self.mu)));
        }
        record
    }
}

/// Order of the fields of surfaces and pairs; other fields follow in their given order.
const ORDER: [&str; 6] = ["surfaces", "stiffness", "foundation", "area", "normal", "friction"];

/// Fields of a surface or pair; the error names the part that is not understood.
pub fn record(value: &Value) -> Result<Record, String> {
    let map = value.as_object().ok_or_else(|| format!("{value} is no JSON object"))?;
    let mut keys: Vec<&String> =
        map.keys().filter(|key| !map[*key].is_null() || *key == "friction").collect();
    keys.sort_by_key(|key| ORDER.iter().position(|known| known == key).unwrap_or(ORDER.len()));
    let is_pair = map.contains_key("surfaces");
    let mut record = Record::new();
    for key in keys {
        match key.as_str() {
            "normal" | "friction" => match law(&map[key])? {
                // In a surface, `None` is the default of a missing field.
                Field::Word(word) if word == "None" && !is_pair => {}
                law => record.push(field(key, law)),
            },
            "surfaces" => record.push(field(key, names(&map[key])?)),
            _ => record.push(field(key, plain(&map[key])?)),
        }
    }
    Ok(record)
}

fn names(value: &Value) -> Result<Field, String> {
    let names: Option<Vec<String>> =
        value.as_array().and_then(|all| all.iter().map(|name| name.as_str().map(str::to_owned)).collect());
    names.map(Field::Texts).ok_or_else(|| format!("{value} is no pair of names"))
}

fn law(value: &Value) -> Result<Field, String> {
    let none = || Ok(Field::Word("None".to_owned()));
    match value {
        Value::Null => none(),
        Value::String(word) if word == "None" => none(),
        Value::Object(map) => match (map.get("name").and_then(Value::as_str), map.get("fields")) {
            (Some(name), Some(Value::Object(fields))) => tagged(name, fields),
            _ => match map.iter().next() {
                Some((name, _)) if name == "None" => none(),
                Some((name, Value::Object(fields))) if map.len() == 1 => tagged(name, fields),
                _ => Err(format!("{value} is no law")),
            },
        },
        _ => Err(format!("{value} is no law")),
    }
}

fn tagged(name: &str, fields: &Map<String, Value>) -> Result<Field, String> {
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric()) {
        return Err(format!("`{name}` is no name of a law"));
    }
    let given = fields.iter().filter(|(_, value)| !value.is_null());
    let inner: Result<Record, String> = given.map(|(key, value)| Ok(field(key, plain(value)?))).collect();
    Ok(Field::Record(name.to_owned(), inner?))
}

fn plain(value: &Value) -> Result<Field, String> {
    match value {
        Value::Number(_) => number(value).map(Field::Number),
        Value::Bool(flag) => Ok(Field::Word(flag.to_string())),
        Value::String(text) => Ok(number(value).map(Field::Number).unwrap_or(Field::Text(text.clone()))),
        Value::Array(all) => Ok(Field::Numbers(all.iter().map(number).collect::<Result<_, _>>()?)),
        Value::Object(map) => {
            let inner: Result<Record, String> =
                map.iter().map(|(key, value)| Ok(field(key, plain(value)?))).collect();
            Ok(Field::Record(String::new(), inner?))
        }
        Value::Null => Err("null stands where a value belongs".to_owned()),
    }
}

fn number(value: &Value) -> Result<f64, String> {
    let infinite = |text: &str| matches!(text, "inf" | "Infinity" | "+inf").then_some(f64::INFINITY);
    let number = value.as_f64().or_else(|| value.as_str().and_then(infinite));
    number.ok_or_else(|| format!("{value} is no number"))
}
