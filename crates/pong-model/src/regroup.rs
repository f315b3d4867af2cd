//! Models with other bounding volumes or leaves: other run times, the same results.

use crate::draft::GroupDraft;
use crate::extensions::Extensions;
use crate::model::{Model, MovableGroup};
use crate::{arrange, solids, tree};
use pong_geometry::bounding::{BoundKind, Volume};

impl Model {
    /// Model whose groups all have bounding volumes of one kind, fitted anew.
    ///
    /// # Errors
    /// Cause and cure, if a volume cannot be fitted.
    pub fn with_bounds(&self, kind: &BoundKind, ext: &Extensions) -> Result<Self, String> {
        self.regrouped(ext, |body| {
            let mut groups = groups_of(body);
            groups.iter_mut().for_each(|group| group.bound = kind.clone());
            groups
        })
    }

    /// Model with leaves of at most `most` elements: the authored groups are replaced by repeated halving
    /// across the longest side, in volumes of the kind of the authored root (axis-aligned boxes if that is
    /// unbounded). Unbounded elements get a leaf of their own.
    ///
    /// # Errors
    /// Cause and cure, if a volume cannot be fitted, or `most` is zero.
    pub fn with_leaves(&self, most: usize, ext: &Extensions) -> Result<Self, String> {
        if most == 0 {
            return Err("leaves are to hold 0 elements; give at least 1".to_owned());
        }
        self.regrouped(ext, |body| {
            let root = &body.tree.nodes[0];
            let template = GroupDraft { bound: kind_of(&root.volume), ..GroupDraft::new(&root.group) };
            let mut groups = vec![template];
            arrange::cut(body, body.tree.items.clone(), most, 0, &mut groups);
            groups
        })
    }

    pub(crate) fn regrouped(
        &self,
        ext: &Extensions,
        groups: impl Fn(&MovableGroup) -> Vec<GroupDraft>,
    ) -> Result<Self, String> {
        let mut model = self.clone();
        for body in &mut model.bodies {
            body.tree = tree::build(body, &groups(body), ext).map_err(|faults| {
                let reason = faults.into_iter().next().map_or(String::new(), |(_, reason)| reason);
                format!(
                    "the bounding volumes of {} cannot be fitted: {reason}; choose another kind",
                    body.path
                )
            })?;
            solids::set_leaves(body);
        }
        Ok(model)
    }
}

/// Groups from which the nodes of a body's tree were built.
pub(crate) fn groups_of(body: &MovableGroup) -> Vec<GroupDraft> {
    let nodes = body.tree.nodes.iter();
    nodes
        .map(|node| GroupDraft {
            bound: kind_of(&node.volume),
            children: node.children.clone().map(|child| child as usize).collect(),
            items: body.tree.items[node.items.start as usize..node.items.end as usize].to_vec(),
            ..GroupDraft::new(&node.group)
        })
        .collect()
}

fn kind_of(volume: &Volume) -> BoundKind {
    match volume {
        Volume::Sphere { .. } => BoundKind::Sphere,
        Volume::Obb { .. } => BoundKind::Obb,
        Volume::Custom(volume) => BoundKind::Custom(volume.kind_name().to_owned()),
        Volume::Aabb { .. } | Volume::Unbounded => BoundKind::Aabb,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Item;
    use crate::parse;

    fn model() -> Model {
        let points: Vec<String> = (0..40)
            .map(|k| {
                let (x, y) = (f64::from(k % 8), f64::from(k / 8) * 0.5);
                format!("Point(name: \"p{k}\", position: ({x:?}, {y:?}, 0.0))")
            })
            .collect();
        let text = format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e5) }}, root: (name: \"m\", \
             surface: \"s\", groups: [(name: \"a\", bound: Sphere, primitives: [{}]), (name: \"b\", primitives: \
             [Plane(name: \"floor\", normal: (0.0, 0.0, 1.0), offset: 0.0)])]))",
            points.join(",")
        );
        parse(&text, "m.ron", None, &Extensions::new()).unwrap()
    }

    fn items(model: &Model) -> Vec<Item> {
        let mut items = model.bodies[0].tree.items.clone();
        items.sort_unstable();
        items
    }

    /// No element is lost or duplicated, leaves respect the limit, and the hash, which ignores volumes, does
    /// not change.
    #[test]
    fn leaves_hold_every_element_once() {
        let model = model();
        for most in [1, 7, 8, 40, 1000] {
            let other = model.with_leaves(most, &Extensions::new()).unwrap();
            let tree = &other.bodies[0].tree;
            assert_eq!(items(&other), items(&model), "{most}");
            assert!(tree.nodes.iter().all(|node| node.items.len() <= most), "{most}");
            assert!(
                tree.nodes.iter().all(|node| node.items.is_empty() || node.children.is_empty()),
                "{most}"
            );
            let leaves = tree.nodes.iter().filter(|node| !node.items.is_empty()).count();
            assert!(leaves > 40 / most, "{most}: {leaves} leaves");
            assert_eq!(other.hash, model.hash);
        }
        assert!(model.with_leaves(0, &Extensions::new()).unwrap_err().contains("at least 1"));
    }

    #[test]
    fn bounds_take_the_kind_that_is_asked_for() {
        let model = model();
        for (kind, name) in
            [(BoundKind::Aabb, "Aabb"), (BoundKind::Sphere, "Sphere"), (BoundKind::Obb, "Obb")]
        {
            let other = model.with_bounds(&kind, &Extensions::new()).unwrap();
            let (old, new) = (&model.bodies[0].tree, &other.bodies[0].tree);
            assert_eq!(new.nodes.len(), old.nodes.len());
            for (node, before) in new.nodes.iter().zip(&old.nodes) {
                assert_eq!(node.group, before.group);
                let unbounded = matches!(before.volume, Volume::Unbounded);
                assert!(
                    unbounded || kind_of(&node.volume) == kind,
                    "{name}: {:?} at {}",
                    node.volume,
                    node.group
                );
            }
            assert_eq!(items(&other), items(&model));
        }
    }
}
