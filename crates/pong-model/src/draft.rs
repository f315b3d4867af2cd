//! Output of the reader for the builder: movable groups with all their elements, without adjacency.

use crate::hull::Hull;
use crate::model::{Item, MovableGroup};
use crate::surface::{PairOverride, Surface};
use crate::weld::Welder;
use pong_geometry::bounding::BoundKind;
use std::sync::Arc;

/// Model as read.
pub(crate) struct ModelDraft {
    pub(crate) name: String,
    pub(crate) entry_memory: bool,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) pair_overrides: Vec<PairOverride>,
    pub(crate) filters: Vec<[String; 2]>,
    pub(crate) bodies: Vec<BodyDraft>,
}

/// Movable group as read: its elements are complete; topology, polyhedra, shells and tree are not built yet.
#[derive(Default)]
pub(crate) struct BodyDraft {
    pub(crate) body: MovableGroup,
    /// Byte offset of each primitive in the file.
    pub(crate) primitive_at: Vec<u32>,
    /// For each primitive, true if its group has `contact: Solid`.
    pub(crate) is_solid: Vec<bool>,
    /// For each primitive, the outermost group above it that is declared one surface (index into `groups`).
    pub(crate) one_surface: Vec<Option<u32>>,
    /// For each primitive, true if it is a `Triangle`, which is named by its path alone, without an index.
    pub(crate) lone_triangle: Vec<bool>,
    pub(crate) welder: Welder,
    /// Checked shapes, in the order of [`MovableGroup::polyhedra`].
    pub(crate) hulls: Vec<Hull>,
    /// Kind and parameters of each custom primitive as in the file, for the hash.
    pub(crate) custom_parameters: Vec<(String, Vec<f64>)>,
    /// Groups of this movable group; 0 is the movable one.
    pub(crate) groups: Vec<GroupDraft>,
}

/// Authored group.
pub(crate) struct GroupDraft {
    pub(crate) path: Arc<str>,
    pub(crate) at: u32,
    pub(crate) bound: BoundKind,
    /// True if the group has no volume of its own: its contents belong to the group above.
    pub(crate) above: bool,
    /// Maximum number of elements of a leaf, if limited.
    pub(crate) leaf_size: Option<usize>,
    pub(crate) children: Vec<usize>,
    pub(crate) items: Vec<Item>,
}

/// Tests whether a group that names no bounding volume has none of its own, so that its elements count to the
/// leaf above. `volume_below` tells whether a group below it in the same movable group has one.
pub(crate) fn is_above_by_default(movable: bool, leaf_size: Option<usize>, volume_below: bool) -> bool {
    !movable && leaf_size.is_none() && !volume_below
}

impl BodyDraft {
    /// Path of an element for messages, in which a triangle of a mesh is named by its index.
    pub(crate) fn triangle_path(&self, triangle: u32) -> (u32, String) {
        let owner =
            self.body.primitives.iter().position(|p| is_triangle(p) && p.elements.contains(&triangle));
        let Some(owner) = owner else { return (0, String::new()) };
        let info = &self.body.primitives[owner];
        let at = self.primitive_at[owner];
        if self.lone_triangle[owner] {
            return (at, info.path.clone());
        }
        (at, format!("{}/triangles[{}]", info.path, triangle - info.elements.start))
    }
}

fn is_triangle(info: &crate::model::PrimitiveInfo) -> bool {
    info.kind == pong_geometry::primitive::PrimitiveKind::Triangle
}
