//! Triangle meshes: cleaning, connected parts, planar faces, and recognition of convex solids.

mod adjacency;
mod clean;
mod close;
mod facets;
mod junctions;
mod measures;
mod parts;
mod shells;
mod solid;
mod triangle_mesh;
mod weld;

pub use adjacency::Adjacency;
pub(crate) use clean::clean;
pub(crate) use close::{Closed, close, count};
pub(crate) use junctions::mend;
pub use measures::{area_vector, bounds, ring};
pub use parts::parts;
pub use shells::{Shell, shells};
pub(crate) use shells::{Turned, facing_inwards, make_alike, turn_outward};
pub use solid::{Flaw, HullFinder, Polyhedron, polyhedron, volume_m3};
pub use triangle_mesh::Mesh;
pub(crate) use weld::{weld, weld_equal};
