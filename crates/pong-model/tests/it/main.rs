//! Tests of the model format: accepted files, refused files, and the loaded models.

mod accepts;
mod authored;
mod common;
mod convex_families;
mod convex_solids;
mod extensions;
mod format;
mod grouping;
mod meshes;
mod one_surface;
mod rejects;
mod round_bounds;
mod round_parts;
mod schema;
mod solids;
mod topology;
mod wholes;
mod written;
