//! Reading of the tree of values into drafts of bodies: every field of the format, with all faults collected.

mod bristle;
mod custom;
mod document;
mod fields;
mod filters;
mod foundation;
mod group;
mod inward;
mod law_values;
mod mesh_file;
mod mesh_primitive;
mod opened_primitive;
mod place;
mod power_law;
mod primitive;
mod reader;
mod round;
mod scalar;
mod size;
mod stiffness;
mod suggest;
mod surface;

pub(crate) use document::document;
pub(crate) use filters::group_paths;
pub(crate) use mesh_primitive::{SLIVER, smallest_height_share};
pub(crate) use reader::{LISTED_PER_MESH, Reader};
