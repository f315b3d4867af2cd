//! Filters: groups that never touch each other, and models whose leaves do not mix such groups with others.

use crate::extensions::Extensions;
use crate::model::{Item, Model, MovableGroup};
use crate::{arrange, regroup};
use std::collections::BTreeMap;

/// Pairs of groups that never touch: the first in one Object's model, the second in another's, each with
/// everything below it. Groups are given by their full paths, `root/arm`.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Filters(Vec<[String; 2]>);

impl Filters {
    /// Filters of these pairs of groups, in any order.
    pub fn new(mut pairs: Vec<[String; 2]>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        Self(pairs)
    }

    /// Returns `true` if there are no filters.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Pairs of groups, sorted.
    pub fn pairs(&self) -> &[[String; 2]] {
        &self.0
    }

    /// Filters with the two Objects exchanged.
    pub fn turned(&self) -> Self {
        Self::new(self.0.iter().map(|[a, b]| [b.clone(), a.clone()]).collect())
    }

    /// Returns `true` if two primitives, given by their paths, never touch; the first belongs to the first
    /// Object.
    pub fn keep_apart(&self, a: &str, b: &str) -> bool {
        self.0.iter().any(|[group_a, group_b]| holds(group_a, a) && holds(group_b, b))
    }

    /// Indices of the pairs whose group on this side (0 or 1) contains a primitive. Primitives with equal
    /// results are kept apart from the same others.
    pub fn that_hold(&self, side: usize, primitive: &str) -> Vec<usize> {
        let numbered = self.0.iter().enumerate();
        numbered.filter(|(_, groups)| holds(&groups[side], primitive)).map(|(number, _)| number).collect()
    }
}

/// Returns `true` if a primitive lies in a group or below it, judged by their paths.
fn holds(group: &str, primitive: &str) -> bool {
    primitive.strip_prefix(group).is_some_and(|below| below.starts_with('/'))
}

impl Model {
    /// Full path of a group, movable or not, from its full path (`root/arm/tip`), its path below the root
    /// (`arm/tip`), or its bare name if that is unique; the root for an empty name. `None` if there is no
    /// such group.
    pub fn group_path(&self, name: &str) -> Option<&str> {
        resolved(&self.groups, name)
    }

    /// The model's own filters, as filters of an Object with itself.
    pub fn filters_within(&self) -> Filters {
        let both = self.filters.iter().flat_map(|[a, b]| [[a.clone(), b.clone()], [b.clone(), a.clone()]]);
        Filters::new(both.collect())
    }

    /// Returns `true` if two groups, given by their full paths, lie with everything below them in the same
    /// movable group.
    pub fn is_within_one_body(&self, groups: [&str; 2]) -> bool {
        let bodies_of = |group: &str| {
            let owner = self.bodies.iter().filter(|body| body.path == group || holds(&body.path, group));
            let owner = owner.map(|body| body.path.len()).max();
            let is_part = |body: &MovableGroup| {
                holds(group, &body.path)
                    || (owner == Some(body.path.len()) && (body.path == group || holds(&body.path, group)))
            };
            (0..self.bodies.len()).filter(|&body| is_part(&self.bodies[body])).collect::<Vec<_>>()
        };
        let [a, b] = groups.map(bodies_of);
        a.len() == 1 && a == b
    }

    /// Model in which every leaf lies entirely inside or outside each of the given groups; `None` if this
    /// model is such a model already. Results do not change.
    ///
    /// # Errors
    /// Cause and cure, if a volume cannot be fitted.
    pub fn with_groups_apart(&self, groups: &[&str], ext: &Extensions) -> Result<Option<Self>, String> {
        let is_mixed = |body: &MovableGroup| {
            let leaves = body.tree.nodes.iter().map(|node| &node.items);
            let mut contents = leaves.map(|of| &body.tree.items[of.start as usize..of.end as usize]);
            contents.any(|items| parts(body, items, groups).len() > 1)
        };
        if !self.bodies.iter().any(is_mixed) {
            return Ok(None);
        }
        let made = self.regrouped(ext, |body| {
            let mut drafts = regroup::groups_of(body);
            for leaf in 0..drafts.len() {
                let parts = parts(body, &drafts[leaf].items, groups);
                if parts.len() > 1 {
                    drafts[leaf].items = Vec::new();
                    for part in parts {
                        let child = arrange::push(&mut drafts, leaf);
                        drafts[child].items = part;
                    }
                }
            }
            drafts
        });
        made.map(Some)
    }
}

/// Full path that a name stands for, among those of all groups, the root's first.
pub(crate) fn resolved<'g>(groups: &'g [String], name: &str) -> Option<&'g str> {
    let root = groups.first()?;
    let below =
        |path: &str| path.strip_prefix(root.as_str()).and_then(|rest| rest.strip_prefix('/')) == Some(name);
    let bare = || {
        let mut named = groups.iter().filter(|path| path.rsplit('/').next() == Some(name));
        named.next().filter(|_| named.next().is_none())
    };
    let found = if name.is_empty() { Some(root) } else { groups.iter().find(|path| *path == name) };
    found.or_else(|| groups.iter().find(|path| below(path))).or_else(bare).map(String::as_str)
}

/// Splits items by the groups that contain them, keeping their order.
fn parts(body: &MovableGroup, items: &[Item], groups: &[&str]) -> Vec<Vec<Item>> {
    let mut parts: BTreeMap<Vec<usize>, Vec<Item>> = BTreeMap::new();
    for item in items {
        let path = &body.primitives[item.primitive as usize].path;
        let of = (0..groups.len()).filter(|&group| holds(groups[group], path)).collect();
        parts.entry(of).or_default().push(*item);
    }
    parts.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;

    fn model(filters: &str) -> Result<Model, crate::ModelErrors> {
        let text = format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e5) }}, {filters}
             root: (name: \"m\", surface: \"s\", groups: [
                (name: \"plug\", bound: Above, primitives: [Point(name: \"p\", position: (0, 0, 0))]),
                (name: \"lugs\", bound: Above, groups: [
                    (name: \"left\", bound: Above, primitives: [Sphere(name: \"l\", center: (0, 1, 0), radius: 0.1)]),
                    (name: \"right\", bound: Above, primitives: [Sphere(name: \"r\", center: (0, 2, 0), radius: 0.1)])]),
                (name: \"arm\", movable: true, groups: [
                    (name: \"tip\", primitives: [Point(name: \"t\", position: (0, 0, 0))])])]))"
        );
        parse(&text, "m.ron", None, &Extensions::new())
    }

    #[test]
    fn groups_go_by_full_path_path_below_the_root_and_bare_name() {
        let model = model("").unwrap();
        for name in ["m/lugs/left", "lugs/left", "left"] {
            assert_eq!(model.group_path(name), Some("m/lugs/left"), "{name}");
        }
        assert_eq!(model.group_path(""), Some("m"));
        assert_eq!(model.group_path("arm/tip"), Some("m/arm/tip"));
        for name in ["lugs/l", "middle", "m/", "/"] {
            assert_eq!(model.group_path(name), None, "{name}");
        }
    }

    #[test]
    fn leaves_are_parted_by_group_and_lose_nothing() {
        let model = model("").unwrap();
        assert_eq!(
            model.bodies[0].tree.nodes.len(),
            1,
            "groups without a volume give what they hold to the root"
        );
        let apart = model.with_groups_apart(&["m/lugs", "m/lugs/left"], &Extensions::new()).unwrap().unwrap();
        let tree = &apart.bodies[0].tree;
        assert_eq!(tree.nodes.iter().filter(|node| !node.items.is_empty()).count(), 3);
        let mut items = tree.items.clone();
        items.sort_unstable();
        assert_eq!(items.len(), 3);
        assert_eq!(apart.hash, model.hash);
        let again = apart.with_groups_apart(&["m/lugs"], &Extensions::new()).unwrap();
        assert!(again.is_none(), "nothing is mixed any more");
    }

    #[test]
    fn filters_of_a_model_are_read_checked_and_hashed() {
        let without = model("").unwrap();
        let with = model("filters: [(\"lugs\", \"arm/tip\")],").unwrap();
        assert_eq!(with.filters, [["m/lugs".to_owned(), "m/arm/tip".to_owned()]]);
        assert_ne!(with.hash, without.hash);
        let within = with.filters_within();
        assert!(within.keep_apart("m/lugs/left/l", "m/arm/tip/t"));
        assert!(within.keep_apart("m/arm/tip/t", "m/lugs/left/l"));
        assert!(!within.keep_apart("m/plug/p", "m/arm/tip/t"));
        for (filters, rule, cure) in [
            ("filters: [(\"lugz\", \"arm\")],", "unknown-group", "did you mean `lugs`?"),
            ("filters: [(\"lugs\", \"arm\"), (\"arm\", \"m/lugs\")],", "repeated-filter", "keep one entry"),
            ("filters: [(\"lugs\", \"plug\")],", "idle-filter", "movable"),
            ("filters: [(\"lugs\")],", "wrong-type", "write (\"arm\", \"tip\")"),
        ] {
            let errors = model(filters).unwrap_err();
            assert_eq!(errors.0.len(), 1, "{errors}");
            assert_eq!(errors.0[0].rule, rule);
            assert!(errors.0[0].cure.contains(cure), "{errors}");
        }
    }
}
