//! A model file as it is written, for tools that show and change models.
//!
//! Notation, fields, types, names and indices are judged by the rules of [`crate::parse`], and by nothing else: the
//! shapes are not. So a polyhedron that is open can be read, looked at and mended.

use crate::error::ModelErrors;
use crate::read::{self, Reader};
use crate::ron_tree;
use pong_geometry::extension::Extensions;
use std::path::Path;

pub use crate::ron_tree::{Field, Node, Rows, Value};

/// The values of a model file with their places: see [`parse`].
///
/// # Errors
/// A file that cannot be read or is no UTF-8, and all that [`parse`] refuses.
pub fn load(path: &Path) -> Result<Node, ModelErrors> {
    parse(&crate::text_of(path)?, &path.display().to_string())
}

/// The values of a model file's text with their places. Mesh files that it names are not read, and kinds of its host's own
/// need not be known.
///
/// # Errors
/// Every fault of notation, fields, types, names and indices, with line, column and tree path.
pub fn parse(text: &str, file_name: &str) -> Result<Node, ModelErrors> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let ext = Extensions::new();
    let mut reader = Reader::new(text, file_name, None, &ext);
    reader.judges_shapes = false;
    let tree = match ron_tree::parse(text) {
        Ok(tree) => {
            read::document(&mut reader, &tree);
            Some(tree)
        }
        Err(error) => {
            reader.syntax_fault(error);
            None
        }
    };
    let faults = reader.into_faults();
    tree.filter(|_| faults.is_empty()).ok_or(ModelErrors(faults))
}
