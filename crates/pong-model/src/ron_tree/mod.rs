//! A small reader of RON that remembers where everything stands in the text.
//!
//! It accepts the notation of the `ron` crate but for byte strings; its tests compare the two on a corpus.
//! Long lists of number tuples (the vertices and triangles of meshes) are kept as [`Rows`], about as compact
//! as the numbers themselves.

mod number;
mod parser;
#[cfg(test)]
mod tests;
mod text;

pub(crate) use parser::{end_of_value, parse};

/// A value and the byte offset at which it begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Byte offset in the text.
    pub at: u32,
    /// What stands there.
    pub value: Value,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `true` or `false`.
    Bool(bool),
    /// Any number.
    Number(f64),
    /// A string or a character.
    Text(String),
    /// A name that stands alone.
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

/// A field of a struct and where its name stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: Box<str>,
    /// Byte offset of the name in the text.
    pub at: u32,
    /// What it holds.
    pub value: Node,
}

/// A list of tuples (or of lists) of numbers, in flat arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// Whether the rows are written with brackets instead of parentheses.
    pub bracketed: bool,
    /// All numbers, row after row.
    pub numbers: Vec<f64>,
    /// Where each row ends in `numbers`.
    pub ends: Vec<u32>,
    /// Byte offset at which each row begins.
    pub at: Vec<u32>,
}

/// Why a text is not RON.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SyntaxError {
    pub(crate) at: u32,
    pub(crate) rule: &'static str,
    pub(crate) cause: String,
}

impl Rows {
    /// How many rows there are.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The numbers of a row.
    pub fn row(&self, index: usize) -> &[f64] {
        let start = if index == 0 { 0 } else { self.ends[index - 1] as usize };
        &self.numbers[start..self.ends[index] as usize]
    }
}

impl Value {
    /// What it is, for messages.
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
