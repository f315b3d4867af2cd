//! Tests of the model format: what is read, refused and made of it.

mod accepts;
mod authored;
mod common;
mod convex_families;
mod convex_solids;
mod extensions;
mod format;
mod grouping;
mod meshes;
mod rejects;
mod round_bounds;
mod round_parts;
mod topology;
