//! Bounds and leaf sizes of a text, changed and read back: only the trees differ.

use pong_geometry::bounding::{BoundKind, Volume};
use pong_model::grouping::{Bound, Regrouped, groups, mesh_files, regrouped};
use pong_model::{Extensions, Item, Model, Tree};

fn load(text: &str) -> Model {
    pong_model::parse(text, "test.ron", None, &Extensions::new()).unwrap_or_else(|errors| panic!("{errors}"))
}

fn points(prefix: &str, count: u32, x: f64) -> String {
    let point = |k: u32| {
        format!(
            "Point(name: \"{prefix}{k}\", position: ({:?}, {:?}, 0.0))",
            x + f64::from(k),
            f64::from(k % 2)
        )
    };
    (0..count).map(point).collect::<Vec<_>>().join(", ")
}

/// Two groups of points below a group, a group of points beside it, and a movable group.
fn text() -> String {
    format!(
        "// A comment: name: \"no\"\n(\n    format: \"pong-model\", version: 1, name: \"m\",\n    surfaces: {{ \"s\": (stiffness: 1e5) }},\n    \
         root: (\n        name: \"m\", // the root\n        surface: \"s\",\n        groups: [\n            (\n                name: \"a\",\n                \
         groups: [(name: \"left\", bound: Some(Obb), primitives: [{}]), (name: \"right\", leaf_size: 3, primitives: [{}])],\n            ),\n            \
         (name: \"b\", bound: /* small */ Sphere, primitives: [{}]),\n            (name: \"arm\", movable: true, primitives: [{}]),\n        ],\n    ),\n)\n",
        points("l", 6, 0.0),
        points("r", 7, 100.0),
        points("b", 5, -50.0),
        points("m", 2, 0.0),
    )
}

fn change(path: &str, bound: Bound, leaf_size: Option<usize>) -> Regrouped {
    Regrouped { path: path.to_owned(), bound, leaf_size }
}

fn around(kind: BoundKind) -> Bound {
    Bound::Around(kind)
}

/// Path and number of elements of each leaf.
fn leaves(tree: &Tree) -> Vec<(String, usize)> {
    let leaves = tree.nodes.iter().filter(|node| !node.items.is_empty());
    leaves.map(|node| (node.group.to_string(), node.items.len())).collect()
}

fn items(model: &Model) -> Vec<Vec<Item>> {
    let sorted = |tree: &Tree| {
        let mut items = tree.items.clone();
        items.sort_unstable();
        items
    };
    model.bodies.iter().map(|body| sorted(&body.tree)).collect()
}

/// Checks everything that must not depend on bounds: every primitive with its path, every element, the hash.
fn assert_same_but_for_trees(a: &Model, b: &Model) {
    assert_eq!(a.hash, b.hash);
    assert_eq!(items(a), items(b));
    for (a, b) in a.bodies.iter().zip(&b.bodies) {
        assert_eq!((&a.primitives, &a.path, &a.points), (&b.primitives, &b.path, &b.points));
    }
    assert_eq!(a.surfaces, b.surfaces);
}

#[test]
fn groups_are_told_in_the_order_of_the_file() {
    let found = groups(&text()).unwrap();
    let told: Vec<_> = found
        .iter()
        .map(|g| (g.path.as_str(), g.above, g.movable, g.bound.to_string(), g.leaf_size, g.holds_primitives))
        .collect();
    let expected = [
        ("m", None, true, "Aabb".to_owned(), None, false),
        ("m/a", Some(0), false, "Aabb".to_owned(), None, false),
        ("m/a/left", Some(1), false, "Obb".to_owned(), None, true),
        ("m/a/right", Some(1), false, "Aabb".to_owned(), Some(3), true),
        ("m/b", Some(0), false, "Sphere".to_owned(), None, true),
        ("m/arm", Some(0), true, "Aabb".to_owned(), None, true),
    ];
    assert_eq!(told, expected);
}

#[test]
fn leaves_of_a_limited_size_hold_every_element_once() {
    let model = load(&text());
    let tree = &model.bodies[0].tree;
    let right: Vec<_> = leaves(tree).into_iter().filter(|(path, _)| path == "m/a/right").collect();
    assert!(right.len() == 3 && right.iter().all(|(_, count)| *count <= 3), "{right:?}");
    assert_eq!(tree.items.len(), 18);
    let unlimited = text().replace("leaf_size: 3, ", "");
    assert_same_but_for_trees(&model, &load(&unlimited));
}

/// Both groups below `a` are in one leaf of the root; beside them `b`, which keeps its own.
#[test]
fn what_a_group_without_a_volume_holds_is_in_the_leaf_of_the_group_above() {
    let changes = [
        change("m/a", Bound::Above, None),
        change("m/a/left", Bound::Above, None),
        change("m/a/right", Bound::Above, None),
    ];
    let changed = regrouped(&text(), &changes).unwrap();
    let (before, after) = (load(&text()), load(&changed));
    assert_same_but_for_trees(&before, &after);
    let tree = &after.bodies[0].tree;
    assert_eq!(leaves(tree), [("m".to_owned(), 13), ("m/b".to_owned(), 5)]);
    assert!(tree.nodes.iter().all(|node| node.items.is_empty() || node.children.is_empty()));
    // With `b` changed as well, the root is the leaf.
    let mut all = changes.to_vec();
    all.push(change("m/b", Bound::Above, None));
    let tree = load(&regrouped(&text(), &all).unwrap()).bodies[0].tree.clone();
    assert_eq!((tree.nodes.len(), leaves(&tree)), (1, vec![("m".to_owned(), 18)]));
    // The leaf size applies to contents from below.
    all.push(change("m", around(BoundKind::Obb), Some(5)));
    let tree = load(&regrouped(&text(), &all).unwrap()).bodies[0].tree.clone();
    assert!(
        leaves(&tree).len() == 4 && leaves(&tree).iter().all(|(_, count)| *count <= 5),
        "{:?}",
        leaves(&tree)
    );
    assert!(tree.nodes.iter().all(|node| matches!(node.volume, Volume::Obb { .. })), "{:?}", tree.nodes);
}

/// A group that names no bound has a volume only around volumes of its body, or to cut its contents into leaves.
#[test]
fn groups_that_name_no_bound_are_part_of_the_leaf_above() {
    let plain = text().replace("bound: Some(Obb), ", "").replace("leaf_size: 3, ", "");
    let no_bound = plain.replace("bound: /* small */ Sphere, ", "");
    let (one_leaf, kept) = (load(&no_bound), load(&plain));
    assert_same_but_for_trees(&load(&text()), &one_leaf);
    assert_eq!(leaves(&one_leaf.bodies[0].tree), [("m".to_owned(), 18)]);
    assert_eq!(leaves(&one_leaf.bodies[1].tree), [("m/arm".to_owned(), 2)]);
    assert_eq!(leaves(&kept.bodies[0].tree), [("m".to_owned(), 13), ("m/b".to_owned(), 5)]);
    // A volume below a group keeps that of the group, and is no reason for one beside it.
    let nested = load(&text().replace("leaf_size: 3, ", ""));
    let expected = [("m/a", 7), ("m/a/left", 6), ("m/b", 5)].map(|(path, count)| (path.to_owned(), count));
    let mut found = leaves(&nested.bodies[0].tree);
    found.sort();
    assert_eq!(found, expected);
    for text in [&no_bound, &plain] {
        let bounds = groups(text).unwrap().into_iter().map(|group| group.bound.to_string());
        let b = if text == &plain { "Sphere" } else { "Above" };
        assert_eq!(bounds.collect::<Vec<_>>(), ["Aabb", "Above", "Above", "Above", b, "Aabb"]);
    }
}

/// A new volume below groups that name no bound does not give them one.
#[test]
fn a_change_leaves_the_volumes_of_other_groups_alone() {
    let text = text().replace("bound: Some(Obb), ", "").replace("leaf_size: 3, ", "");
    let changed = regrouped(&text, &[change("m/a/left", around(BoundKind::Obb), None)]).unwrap();
    let after = groups(&changed).unwrap();
    let bounds: Vec<_> = after.iter().map(|group| group.bound.to_string()).collect();
    assert_eq!(bounds, ["Aabb", "Above", "Obb", "Above", "Sphere", "Aabb"]);
    let back = regrouped(&changed, &[change("m/a/left", Bound::Above, None)]).unwrap();
    assert_eq!(groups(&back).unwrap(), groups(&text).unwrap());
}

/// Only the necessary parts of a text change; a change can be reverted.
#[test]
fn a_text_keeps_all_but_the_fields_that_change() {
    let text = text();
    let same: Vec<_> =
        groups(&text).unwrap().into_iter().map(|g| change(&g.path, g.bound, g.leaf_size)).collect();
    assert_eq!(regrouped(&text, &same).unwrap(), text);

    let changes = [
        change("m/b", around(BoundKind::Obb), Some(2)),
        change("m", around(BoundKind::Sphere), None),
        change("m/a/right", around(BoundKind::Aabb), None),
        change("m/arm", around(BoundKind::Obb), None),
    ];
    let changed = regrouped(&text, &changes).unwrap();
    let expected = text
        .replace(
            "(name: \"b\", bound: /* small */ Sphere",
            "(name: \"b\", leaf_size: 2, bound: /* small */ Obb",
        )
        .replace("name: \"m\", // the root", "name: \"m\",\n        bound: Sphere, // the root")
        .replace("(name: \"right\", leaf_size: 3", "(name: \"right\", bound: Aabb, leaf_size: None")
        .replace("(name: \"arm\", movable", "(name: \"arm\", bound: Obb, movable");
    assert_eq!(changed, expected);
    assert_same_but_for_trees(&load(&text), &load(&changed));
    let marked = format!("\u{feff}{text}");
    assert_eq!(regrouped(&marked, &changes).unwrap(), format!("\u{feff}{expected}"));
    let windows = regrouped(&text.replace('\n', "\r\n"), &changes).unwrap();
    assert_eq!(windows, expected.replace('\n', "\r\n"));
}

#[test]
fn what_is_not_there_cannot_be_changed() {
    let refused = regrouped(&text(), &[change("m/c", Bound::Above, None)]).unwrap_err();
    assert!(refused.contains("m/c"), "{refused}");
    assert!(groups("(format: 1)").unwrap_err().contains("no model"));
    assert!(groups("(format:").is_err());
}

/// Authors are warned of a leaf size without effect.
#[test]
fn a_size_of_leaves_without_a_leaf_is_warned_of() {
    let on = |path: &str, bound| {
        let changed = regrouped(&text(), &[change(path, bound, Some(4))]).unwrap();
        load(&changed).warnings.iter().filter(|warning| warning.contains("leaf_size")).count()
    };
    assert_eq!(on("m", around(BoundKind::Aabb)), 1);
    assert_eq!(on("m/a/left", Bound::Above), 1);
    assert_eq!(on("m/b", around(BoundKind::Aabb)), 0);
    assert_eq!(on("m/arm", around(BoundKind::Aabb)), 0);
}

/// A plane in a leaf that is split gets a leaf of its own, so that the rest is bounded.
#[test]
fn unbounded_elements_stand_apart_in_a_leaf_that_is_cut() {
    let text = format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e5) }}, root: (name: \"m\", \
         surface: \"s\", leaf_size: 100, primitives: [{}, Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)]))",
        points("p", 9, 0.0)
    );
    let tree = load(&text).bodies[0].tree.clone();
    let volumes: Vec<_> =
        tree.nodes.iter().map(|node| (matches!(node.volume, Volume::Unbounded), node.items.len())).collect();
    assert_eq!(volumes, [(true, 0), (false, 9), (true, 1)]);
}

#[test]
fn meshes_are_told_by_their_files() {
    let text = "(root: (groups: [(primitives: [TriangleMesh(name: \"a\", file: \"x/a.stl\"), Polyhedron(file: Some(\"b.obj\"))]), \
                (primitives: [Polyhedron(file: \"b.obj\"), Custom(file: \"no\")])]))";
    assert_eq!(mesh_files(text).unwrap(), ["x/a.stl", "b.obj"]);
    assert_eq!(mesh_files(&self::text()).unwrap(), Vec::<String>::new());
}
