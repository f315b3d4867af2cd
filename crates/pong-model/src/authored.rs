//! Model files as written, for tools that show and change models.
//!
//! Notation, fields, types, names and indices are checked by the rules of [`crate::parse`]; shapes are not.
//! So a polyhedron that is open can be read, shown and repaired.

use crate::error::ModelErrors;
use crate::extensions::Extensions;
use crate::read::{self, Reader};
use crate::ron_tree;
use std::path::Path;

pub use crate::ron_tree::{Field, Node, Rows, Value};

/// Reads a model file into its values with their positions: see [`parse`].
///
/// # Errors
/// The file cannot be read or is not UTF-8, or [`parse`] refuses it.
pub fn load(path: &Path) -> Result<Node, ModelErrors> {
    parse(&crate::text_of(path)?, &path.display().to_string())
}

/// Reads the text of a model file into its values with their positions. Mesh files it names are not read, and
/// custom kinds need not be registered.
///
/// # Errors
/// All faults of notation, fields, types, names and indices, with line, column and tree path.
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
