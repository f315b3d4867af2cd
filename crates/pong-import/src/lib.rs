//! Mesh files (glTF, OBJ, STL) to model files.
//!
//! Data flow: `source` (any format to a tree of nodes with geometry), `marks` (the content of `extras.pong`),
//! `mesh` (cleaning, parts, planar faces, convexity), `round` (parts that are capsules, cylinders, cones,
//! bores), `build` (nodes to a model), `write` (a model to text), `files` (read back by the engine's loader,
//! then moved into place). The crate `pong-decompose` makes convex pieces; it uses the modules that are
//! public here, which are no stable interface. The commands are described in `docs/importing.md`.

#![forbid(unsafe_code)]

#[doc(hidden)]
pub mod affine;
#[doc(hidden)]
pub mod build;
#[doc(hidden)]
pub mod files;
mod findings;
mod import;
mod laws;
mod marks;
#[doc(hidden)]
pub mod mesh;
#[doc(hidden)]
pub mod model;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod round;
#[doc(hidden)]
pub mod source;
#[doc(hidden)]
pub mod write;

pub use affine::Up;
pub use findings::{Finding, Findings};
pub use import::{Imported, Options, import};
pub use laws::DefaultSurface;
pub use mesh::{HullFinder, Mesh, Polyhedron};
