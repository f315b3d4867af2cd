//! Values made by programs, for the writer: without positions.

use super::{Field, Node, Rows, Value};

impl From<Value> for Node {
    fn from(value: Value) -> Self {
        Self { at: 0, value }
    }
}

impl Value {
    /// `"text"`.
    pub fn text(text: &str) -> Self {
        Self::Text(text.to_owned())
    }

    /// Bare name.
    pub fn name(name: &str) -> Self {
        Self::Name(name.into())
    }

    /// `(1.0, 2.0)`.
    pub fn numbers(numbers: &[f64]) -> Self {
        Self::Numbers(numbers.into())
    }

    /// `(a, b)`.
    pub fn tuple(items: impl IntoIterator<Item = Self>) -> Self {
        Self::Tuple(None, items.into_iter().map(Node::from).collect())
    }

    /// `[a, b]`.
    pub fn list(items: impl IntoIterator<Item = Self>) -> Self {
        Self::List(items.into_iter().map(Node::from).collect())
    }

    /// `[(1.0, 2.0), (3.0, 4.0)]`, or `[[1, 2], [3, 4]]`.
    pub fn rows<R: IntoIterator<Item = f64>>(bracketed: bool, rows: impl IntoIterator<Item = R>) -> Self {
        let mut all = Rows { bracketed, ..Rows::default() };
        for row in rows {
            all.numbers.extend(row);
            all.ends.push(all.numbers.len() as u32);
            all.at.push(0);
        }
        Self::Rows(Box::new(all))
    }

    /// `(a: …, b: …)`.
    pub fn fields<'f>(fields: impl IntoIterator<Item = (&'f str, Self)>) -> Self {
        Self::Struct(None, fields_of(fields))
    }

    /// `Name(a: …, b: …)`.
    pub fn named<'f>(name: &str, fields: impl IntoIterator<Item = (&'f str, Self)>) -> Self {
        Self::Struct(Some(name.into()), fields_of(fields))
    }

    /// `{ "name": …, }`.
    pub fn map<'k>(entries: impl IntoIterator<Item = (&'k str, Self)>) -> Self {
        Self::Map(entries.into_iter().map(|(key, value)| (Self::text(key).into(), value.into())).collect())
    }

    /// Model file with these fields after `format`, `version` and `name`.
    pub fn model<'f>(name: &str, fields: impl IntoIterator<Item = (&'f str, Self)>) -> Self {
        let head = [
            ("format", Self::text("pong-model")),
            ("version", Self::Number(1.0)),
            ("name", Self::text(name)),
        ];
        Self::Struct(None, fields_of(head.into_iter().chain(fields)))
    }
}

fn fields_of<'f>(fields: impl IntoIterator<Item = (&'f str, Value)>) -> Vec<Field> {
    fields.into_iter().map(|(name, value)| Field { name: name.into(), at: 0, value: value.into() }).collect()
}
