//! Narrow phase: pairs of primitives give contact candidates.
//!
//! Predicates about the side of a triangle, or of a surface of triangles, on which a point lies. The last
//! column tells whether the region of the predicate contains its own boundary; tolerances are in code. The
//! first eight predicates are in `pong_geometry::interference`, the others in this folder.
//!
//! | predicate | question | used by | boundary |
//! |---|---|---|---|
//! | `triangle_reach::InReach::of` | Can the sphere touch any feature of the triangle? | `sphere_triangle` | in, by `REACH_SLACK` |
//! | `pushing_features::mark_pushing` | May this edge or vertex push at all, and how far from the face normal? | loader | – |
//! | `triangle_features::TriangleEdges::is_beyond` | Does the point lie beyond an edge, along the plane? | `sphere_triangle`, `ellipsoid_triangle` | out: a face has its edges |
//! | `triangle_features::TriangleEdges::has_on_seam` | In front and beyond both faces of a silent edge: has this face the point? | same | out; the lower face has it |
//! | `behind_triangle::has_behind` | Behind and beyond an edge or a vertex: has this triangle the point? | same | planes in; edges and `thickness` out |
//! | `triangle_features::vertex_pushes` | Is the direction in the normal cone of the vertex? | same | in; `Some(false)` within rounding |
//! | `nearest_on_triangle::is_in_front_at` | Is the point in front of the surface, given its nearest point there? | `Nearby::is_in_front` | in |
//! | `triangle_features::is_in_front_of_a_face` | Is the point in front of any face at a feature? | `Nearby::is_behind`, `TriangleEntry` | in, by `rounding` |
//! | `nearest_side::Nearby::is_behind` | Is the centre behind all faces at the feature of a contact? | `on_triangle`, `TriangleEntry` | out, by `ROUNDING`; for a back in |
//! | `nearest_side::Nearby::is_in_front_of_triangle` | Is an end of a path in front of the plane of the triangle? | `TriangleEntry` | in, by `ROUNDING`; for a back out |
//! | `nearest_side::Nearby::is_in_front` | Is the centre in front of the whole surface? | `on_triangle`, `TriangleEntry` | in, by `ROUNDING` |
//! | `side_of_entry::TriangleEntry::role` | Does the contact push, by the side from which the centre came? | `on_triangle` | – |
//!
//! A two-sided triangle is two triangles, a front and a *back*; a centre in their plane is in front of the
//! front.

pub(crate) mod candidate;
pub(crate) mod element_pair;
pub(crate) mod nearest_side;
pub(crate) mod on_triangle;
pub(crate) mod pair_table;
mod registered;
mod side_of_bore;
mod side_of_entry;
pub(crate) mod single_element;
pub(crate) mod testers;
