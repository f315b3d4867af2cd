//! Mesh files (glTF, OBJ, STL) to model files.
//!
//! The way of a file: `source` (any format to a tree of nodes with geometry), `marks` (what `extras.pong` says),
//! `mesh` (cleaning, parts, planar faces, convexity), `build` (nodes to a model), `write` (a model to text),
//! `files` (read back by the engine's loader, then put in place). `pong-decompose`, a crate beside this one,
//! makes convex pieces of what is read; it is built on [`parts`].
//! The commands are described in `docs/importing.md`.

#![forbid(unsafe_code)]

mod affine;
mod build;
mod files;
mod findings;
mod import;
mod laws;
mod marks;
mod mesh;
mod model;
mod number;
mod source;
mod write;

pub use affine::Up;
pub use findings::{Finding, Findings};
pub use import::{Imported, Options, import};
pub use laws::DefaultSurface;
pub use mesh::{HullFinder, Mesh, Polyhedron};

/// The steps of an import by themselves, for tools that make something else of a mesh file. No stable interface: it follows
/// the importer.
#[doc(hidden)]
pub mod parts {
    pub use crate::affine::Affine;
    pub use crate::build::{Building, default_surface, meshes};
    pub use crate::files::write_checked;
    pub use crate::mesh;
    pub use crate::model::{Field, Group, Model, Primitive, field};
    pub use crate::number::Grid;
    pub use crate::source::{Reading, Shape, Source, read};
    pub use crate::write::text;
}
