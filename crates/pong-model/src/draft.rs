//! What the reader hands to the builder: bodies with all their elements, without adjacency.

use crate::hull::Hull;
use crate::model::{Item, MovableGroup};
use crate::surface::{PairOverride, Surface};
use crate::weld::Welder;
use pong_geometry::bounding::BoundKind;
use std::sync::Arc;

/// A model as read.
pub(crate) struct ModelDraft {
    pub(crate) name: String,
    pub(crate) entry_memory: bool,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) pair_overrides: Vec<PairOverride>,
    pub(crate) filters: Vec<[String; 2]>,
    pub(crate) bodies: Vec<BodyDraft>,
}

/// A body as read: its elements are in place, its topology, polyhedra, shells and tree are not.
#[derive(Default)]
pub(crate) struct BodyDraft {
    pub(crate) body: MovableGroup,
    /// Where each primitive begins in the file.
    pub(crate) primitive_at: Vec<u32>,
    /// Whether each primitive is a `Triangle`: it is named by its path alone, not by an index.
    pub(crate) lone_triangle: Vec<bool>,
    pub(crate) welder: Welder,
    /// Checked shapes, in the order of [`MovableGroup::polyhedra`].
    pub(crate) hulls: Vec<Hull>,
    /// What the file says of each custom primitive, for the hash.
    pub(crate) custom_parameters: Vec<(String, Vec<f64>)>,
    /// The groups of this body; 0 is the movable one.
    pub(crate) groups: Vec<GroupDraft>,
}

/// An authored group.
pub(crate) struct GroupDraft {
    pub(crate) path: Arc<str>,
    pub(crate) at: u32,
    pub(crate) bound: BoundKind,
    /// It has no volume of its own: what it holds counts to the group above.
    pub(crate) above: bool,
    /// Most elements of a leaf, if it has any.
    pub(crate) leaf_size: Option<usize>,
    pub(crate) children: Vec<usize>,
    pub(crate) items: Vec<Item>,
}

impl BodyDraft {
    /// Path of an element for messages: a triangle of a mesh is named by its index.
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
