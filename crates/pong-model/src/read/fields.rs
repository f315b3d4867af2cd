//! Named fields of a value.

use super::reader::Reader;
use super::suggest;
use crate::ron_tree::{Field, Node, Value};
use crate::schema;

/// Fields of one struct, checked against the allowed names.
pub(crate) struct Fields<'n> {
    /// Byte offset of the struct.
    pub(crate) at: u32,
    path: String,
    fields: &'n [Field],
}

impl<'n> Fields<'n> {
    /// Opens a struct with the fields of these tables; reports unknown and repeated ones.
    ///
    /// `None` only if the node is not a struct.
    pub(crate) fn open(
        reader: &mut Reader<'_>,
        node: &'n Node,
        path: &str,
        tables: &[&'static [schema::Field]],
    ) -> Option<Self> {
        let allowed: Vec<&str> = tables.iter().copied().flatten().map(|field| field.name).collect();
        let fields: &[Field] = match &node.value {
            Value::Struct(_, fields) => fields,
            Value::Tuple(_, items) if items.is_empty() => &[],
            Value::Name(_) => &[],
            other => {
                let cause = format!("expected named fields in parentheses, found {}", other.describe());
                return reader.refuse(
                    node.at,
                    path,
                    "wrong-type",
                    cause,
                    format!("write ({}: …)", allowed.join(": …, ")),
                );
            }
        };
        check_names(reader, fields, path, &allowed);
        Some(Self { at: node.at, path: path.to_owned(), fields })
    }

    /// Opens a struct without reporting faults, for a second look at values that are read elsewhere.
    pub(crate) fn peek(node: &'n Node) -> Option<Self> {
        let Value::Struct(_, fields) = &node.value else { return None };
        Some(Self { at: node.at, path: String::new(), fields })
    }

    /// Optional field; `Some(x)` is `x`, and `None` counts as absent.
    pub(crate) fn optional(&self, name: &str) -> Option<&'n Node> {
        let node = &self.fields.iter().find(|field| field.name.as_ref() == name)?.value;
        match &node.value {
            Value::Name(word) if word.as_ref() == "None" => None,
            Value::Tuple(Some(word), items) if word.as_ref() == "Some" && items.len() == 1 => Some(&items[0]),
            _ => Some(node),
        }
    }

    /// Field as written, where `None` has a meaning of its own.
    pub(crate) fn literal(&self, name: &str) -> Option<&'n Node> {
        self.fields.iter().find(|field| field.name.as_ref() == name).map(|field| &field.value)
    }

    /// Required field.
    pub(crate) fn required(&self, reader: &mut Reader<'_>, name: &str) -> Option<&'n Node> {
        let node = self.optional(name);
        if node.is_none() {
            let cause = format!("the field `{name}` is missing");
            reader.fault(self.at, &self.path, "missing-field", cause, format!("add `{name}: …`"));
        }
        node
    }

    /// Byte offset of a field's name, or of the struct if the field is absent.
    pub(crate) fn at_field(&self, name: &str) -> u32 {
        self.fields.iter().find(|field| field.name.as_ref() == name).map_or(self.at, |field| field.at)
    }
}

fn check_names(reader: &mut Reader<'_>, fields: &[Field], path: &str, allowed: &[&str]) {
    for (index, field) in fields.iter().enumerate() {
        let name = field.name.as_ref();
        if !allowed.contains(&name) {
            let cause = format!("there is no field `{name}` here");
            reader.fault(field.at, path, "unknown-field", cause, suggest::cure(name, allowed));
        } else if fields[..index].iter().any(|earlier| earlier.name.as_ref() == name) {
            let cause = format!("the field `{name}` is given twice");
            reader.fault(field.at, path, "repeated-field", cause, "keep one of them");
        }
    }
}
