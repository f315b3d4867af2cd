//! Small RON reader that keeps the position of every value in the text.
//!
//! It accepts the notation of the `ron` crate except byte strings; its tests compare the two on a corpus.
//! Long lists of number tuples (vertices and triangles of meshes) are stored as [`Rows`], about as compact as
//! the numbers themselves.

mod made;
mod number;
mod parser;
#[cfg(test)]
mod tests;
mod text;

pub(crate) use parser::{end_of_value, parse};

/// Value and its byte offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Byte offset in the text.
    pub at: u32,
    /// Value.
    pub value: Value,
}

/// Value of a model file.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `true` or `false`.
    Bool(bool),
    /// Any number.
    Number(f64),
    /// A string or a character.
    Text(String),
    /// Bare name.
    Name(Box<str>),
    /// `Name(a: 1, b: 2)` or `(a: 1, b: 2)`.
    Struct(Option<Box<str>>, Vec<Field>),
    /// `Name(1, 2)` or `(1, 2)` or `()`.
    Tuple(Option<Box<str>>, Vec<Node>),
    /// `(1, 2)`, numbers only.
    Numbers(Box<[f64]>),
    /// `[1, 2]`.
    List(Vec<Node>),
    /// `{ key: value }`.
    Map(Vec<(Node, Node)>),
    /// `[(1, 2), (3, 4)]` or `[[1, 2], [3, 4]]`, numbers only.
    Rows(Box<Rows>),
}

/// Field of a struct, with the position of its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Name.
    pub name: Box<str>,
    /// Byte offset of the name in the text.
    pub at: u32,
    /// Value of the field.
    pub value: Node,
}

/// List of tuples (or lists) of numbers, in flat arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// True if the rows are written with brackets instead of parentheses.
    pub bracketed: bool,
    /// All numbers, row after row.
    pub numbers: Vec<f64>,
    /// End of each row in `numbers`.
    pub ends: Vec<u32>,
    /// Byte offset of each row.
    pub at: Vec<u32>,
}

/// Syntax error of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SyntaxError {
    pub(crate) at: u32,
    pub(crate) rule: &'static str,
    pub(crate) cause: String,
}

impl Rows {
    /// Number of rows.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Numbers of a row.
    pub fn row(&self, index: usize) -> &[f64] {
        let start = if index == 0 { 0 } else { self.ends[index - 1] as usize };
        &self.numbers[start..self.ends[index] as usize]
    }
}

impl Value {
    /// Description for messages.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Bool(value) => format!("the truth value {value}"),
            Self::Number(value) => format!("the number {value}"),
            Self::Text(_) => "a text".to_owned(),
            Self::Name(name) => format!("the name `{name}`"),
            Self::Struct(Some(name), _) | Self::Tuple(Some(name), _) => format!("`{name}(…)`"),
            Self::Struct(None, _) => "a group of named fields".to_owned(),
            Self::Numbers(numbers) => format!("a tuple of {}", numbers.len()),
            Self::Tuple(None, items) => format!("a tuple of {}", items.len()),
            Self::List(items) => format!("a list of {}", items.len()),
            Self::Map(_) => "a map".to_owned(),
            Self::Rows(rows) => format!("a list of {}", rows.len()),
        }
    }
}
