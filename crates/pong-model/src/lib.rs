//! Model files: RON text → validated, flat, immutable [`Model`].
//!
//! Stages of reading: `ron_tree` (text to values with positions), `read` (values to drafts of movable
//! groups), `hull` (one convex piece), `pieces`, `polyhedra` and `triangle_topology` (surfaces), `arrange`,
//! `tree` and `box_tree` (bounding volumes), `hash`. The format is described in `docs/model_format.md`.
//! `grouping` changes bounding volumes and leaves in the text of a file. For authoring tools, [`authored`]
//! returns a file as it is written, and [`shapes`] the faults of single shapes.

#![forbid(unsafe_code)]

/// Text of the README, whose example runs with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod arrange;
pub mod authored;
pub mod box_tree;
mod build;
mod draft;
mod element;
mod error;
mod extensions;
pub mod files;
mod filters;
pub mod flush;
mod fnv;
pub mod grouping;
mod hash;
mod hull;
pub mod join;
mod joined_files;
mod limits;
#[doc(hidden)]
pub mod mesh_formats;
pub mod model;
mod one_surface;
mod pair_table;
mod pieces;
mod polyhedra;
mod printable;
mod read;
mod regroup;
pub mod restitution;
mod ron_tree;
pub mod schema;
pub mod shapes;
mod solid;
mod solid_box;
mod solid_tree;
mod solids;
pub mod surface;
mod surface_numbers;
pub mod t_junctions;
mod tree;
mod triangle_topology;
#[doc(hidden)]
pub mod weld;
mod wholes;
pub mod write;

pub use element::Element;
pub use error::{ModelError, ModelErrors};
pub use extensions::Extensions;
pub use filters::Filters;
pub use fnv::Fnv;
pub use joined_files::{JoinError, PlacedFile, common_folder, join_files};
pub use limits::{LARGEST, LARGEST_SIZE, SMALLEST_SIZE};
pub use model::{
    Batch, ChunkBoxes, Item, Model, MovableGroup, Node, PrimitiveInfo, SegmentLanes, SphereLanes, Tree, Whole,
};
pub use pair_table::pair_entries;
pub use printable::{printable, printable_lines};
pub use solid::{FieldEdge, Solid, SolidFacet, SolidField, SolidPart};
pub use solid_box::SolidBox;
pub use solid_tree::{SolidNode, SolidTree};
pub use surface::{Exponent, FrictionLaw, NormalLaw, PairOverride, Surface};

use read::Reader;
use std::path::Path;

/// Reads a model file. Meshes are read from its folder, or from a folder that `ext` allows
/// ([`Extensions::allow_files_below`]).
///
/// # Errors
/// The file cannot be read or is not UTF-8; or all faults of the model, with line, column and tree path.
pub fn load(path: &Path, ext: &Extensions) -> Result<Model, ModelErrors> {
    let text = text_of(path)?;
    parse(&text, &path.display().to_string(), Some(path.parent().unwrap_or(Path::new(""))), ext)
}

fn text_of(path: &Path) -> Result<String, ModelErrors> {
    let file = path.display().to_string();
    match files::read(path) {
        Ok(bytes) => String::from_utf8(bytes).map_err(|error| not_text(file, &error)),
        Err(reason) => Err(unreadable(file, reason.to_string(), "name a model file that can be read")),
    }
}

/// Reads a model from text.
///
/// `file_name` is the name used in errors; meshes are searched in `mesh_dir`. Reports all faults of the text,
/// but reads nothing after a fault of notation.
///
/// # Errors
/// All faults of the model, with line, column and tree path.
pub fn parse(
    text: &str,
    file_name: &str,
    mesh_dir: Option<&Path>,
    ext: &Extensions,
) -> Result<Model, ModelErrors> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = Reader::new(text, file_name, mesh_dir, ext);
    let model = match ron_tree::parse(text) {
        Ok(node) => {
            let draft = read::document(&mut reader, &node);
            drop(node);
            draft.and_then(|draft| build::finish(&mut reader, draft))
        }
        Err(error) => {
            reader.syntax_fault(error);
            None
        }
    };
    model.ok_or_else(|| ModelErrors(reader.into_faults()))
}

fn unreadable(file: String, cause: String, cure: &str) -> ModelErrors {
    let path = "model".to_owned();
    ModelErrors(vec![ModelError {
        file,
        line: 1,
        column: 1,
        path,
        rule: "unreadable",
        cause,
        cure: cure.to_owned(),
    }])
}

fn not_text(file: String, error: &std::string::FromUtf8Error) -> ModelErrors {
    let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
    let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
    let mut errors = unreadable(file, "this is no UTF-8 text".to_owned(), "save the file as UTF-8");
    errors.0[0].line = line as u32;
    errors
}
