//! Mesh files (glTF, OBJ, STL) to model files, and convex decomposition.
//!
//! The way of a file: `source` (any format to a tree of nodes with geometry), `marks` (what `extras.pong` says),
//! `mesh` (cleaning, parts, planar faces, convexity), `build` (nodes to a model), `write` (a model to text),
//! `files` (read back by the engine's loader, then put in place). `decompose` makes convex pieces of what was read.
//! The commands are described in `docs/importing.md`.

#![forbid(unsafe_code)]

mod affine;
mod build;
#[cfg(feature = "decompose")]
mod decompose;
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
#[cfg(feature = "decompose")]
pub use decompose::{DecomposeOptions, Decomposed, Deviation, Distances, Method, Report, decompose};
pub use findings::{Finding, Findings};
pub use import::{Imported, Options, import};
pub use laws::DefaultSurface;
