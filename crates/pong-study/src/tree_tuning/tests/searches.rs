//! Models whose best grouping is known.

use super::{Folder, Ready, ball_on_sheet, price, scene};
use crate::runs::subject::{Setting, Shape};
use crate::tree_tuning::moves::{Reach, applied, moves};
use pong_geometry::bounding::BoundKind;
use pong_model::grouping::{self, Bound};

/// Groups that hold only one group each: a single test of two volumes remains.
#[test]
fn groups_nested_for_nothing_are_merged() {
    let folder = Folder::new("nested");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let found = ready.search();
    let (before, after) = (ready.counts(&ready.authored()), ready.counts(&found.best));
    assert_eq!(before.volumes_tested()[0], 6 * before.frames, "{before:?}");
    assert_eq!(after.volumes_tested()[0], after.frames, "{after:?}");
    assert_eq!(before.primitives_tested(), after.primitives_tested());
    assert!(found.refused.is_empty() && found.timed > 0 && found.compared > 0);
    let trees: Vec<usize> = ready
        .subjects
        .iter()
        .zip(&found.best)
        .map(|(subject, grouping)| subject.make(grouping).unwrap().model.bodies[0].tree.nodes.len())
        .collect();
    assert_eq!(trees, [1, 1]);
}

fn two_clusters(count: i32, element: impl Fn(String, f64, f64, f64) -> String) -> String {
    let one = |k: i32| {
        let side = if k % 2 == 0 { -10.0 } else { 10.0 };
        let (column, row) = (f64::from(k / 2 % 16), f64::from(k / 32));
        element(format!("e{k}"), side + 0.1 * column, 0.1 * row - 1.6, 0.01 * column)
    };
    (0..count).map(one).collect::<Vec<_>>().join(", ")
}

const BLOCK: &str = "primitives: [Polyhedron(name: \"block\", vertices: [(-0.1, -0.1, -0.1), (0.1, -0.1, -0.1), \
                     (0.1, 0.1, -0.1), (-0.1, 0.1, -0.1), (-0.1, -0.1, 0.1), (0.1, -0.1, 0.1), (0.1, 0.1, 0.1), \
                     (-0.1, 0.1, 0.1)], faces: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], \
                     [3, 0, 4, 7]])]";

/// A thousand points in one leaf, in two clusters far from the block between them: after the cut, no box
/// below a leaf is tested.
#[test]
fn a_leaf_of_clusters_far_apart_is_cut() {
    let folder = Folder::new("clusters");
    let points = two_clusters(1000, |name, x, y, z| {
        format!("Point(name: \"{name}\", position: ({x:?}, {y:?}, {z:?}))")
    });
    let cloud = format!("primitives: [{points}]");
    let ready = Ready::new(&scene(&folder, ("cloud", &cloud), ("block", BLOCK), "position: (0, 0, 0)"));
    assert_cut(&ready, 512);
}

/// A thousand triangles in the same two clusters, and a ball between them.
#[test]
fn a_mesh_of_clusters_far_apart_is_cut() {
    let folder = Folder::new("far_triangles");
    let triangles = two_clusters(1000, |name, x, y, z| {
        let corner = |dx: f64, dy: f64| format!("({:?}, {:?}, {z:?})", x + dx, y + dy);
        format!(
            "Triangle(name: \"{name}\", vertices: ({}, {}, {}))",
            corner(0.0, 0.0),
            corner(0.05, 0.0),
            corner(0.0, 0.05)
        )
    });
    let far = format!("primitives: [{triangles}]");
    let ball = "primitives: [Sphere(name: \"skin\", center: (0, 0, 0), radius: 0.1)]";
    let ready = Ready::new(&scene(&folder, ("ball", ball), ("far", &far), "position: (0, 0, 0)"));
    assert_cut(&ready, 512);
}

fn assert_cut(ready: &Ready, most: usize) {
    let found = ready.search();
    let (before, after) = (ready.counts(&ready.authored()), ready.counts(&found.best));
    assert!(before.boxes > 0 && before.leaf_pairs > 0, "{before:?}");
    assert_eq!((after.boxes, after.leaf_pairs), (0, 0), "{after:?}");
    assert!(price(&after) < price(&before));
    let sizes: Vec<usize> = found.best.iter().flatten().filter_map(|setting| setting.leaf_size).collect();
    assert!(sizes.len() == 1 && sizes[0] <= most, "{sizes:?}");
}

#[test]
fn equal_measurements_give_equal_proposals() {
    let folder = Folder::new("deterministic");
    let scene = ball_on_sheet(&folder);
    let searched = || {
        let ready = Ready::new(&scene);
        let found = ready.search();
        let texts: Vec<String> = ready
            .subjects
            .iter()
            .zip(&found.best)
            .map(|(subject, best)| subject.text(best).unwrap())
            .collect();
        (texts, found.compared, found.timed)
    };
    assert_eq!(searched(), searched());
}

fn shape() -> Shape {
    let text = "(root: (name: \"r\", groups: [\n\
                (name: \"arm\", movable: true, groups: [(name: \"p\", bound: Aabb, primitives: [1]), \
                (name: \"q\", bound: Aabb, primitives: [1])]),\n\
                (name: \"own\", bound: Custom(\"mine\"), primitives: [1]),\n\
                (name: \"leaf\", bound: Aabb, primitives: [1])]))";
    let groups = grouping::groups(text).unwrap();
    Shape { name: "r".to_owned(), elements: vec![0, 0, 40, 9, 5, 200], groups }
}

/// Bodies keep a volume, volumes of the host's kinds stay, and sizes are only at leaves that are larger.
#[test]
fn moves_leave_alone_what_is_not_theirs() {
    let shape = shape();
    let start = shape.authored();
    let own = shape.groups.iter().position(|group| group.path == "r/own").unwrap();
    for reach in [Reach::Model, Reach::Family, Reach::Group] {
        let all = moves(&shape, &start, reach);
        assert!(all.len() > 5, "{all:?}");
        for change in &all {
            let then = applied(&shape, &start, change);
            assert_ne!(then, start);
            for (group, setting) in shape.groups.iter().zip(&then) {
                assert!(!group.movable || setting.bound != Bound::Above, "{change:?}");
            }
            assert_eq!(then[own].bound, Bound::Around(BoundKind::Custom("mine".to_owned())));
            for (index, setting) in then.iter().enumerate() {
                assert!(setting.leaf_size.is_none_or(|size| shape.leaf(&then, index) > size), "{change:?}");
            }
        }
        let alike = |a: usize, b: usize| applied(&shape, &start, &all[a]) == applied(&shape, &start, &all[b]);
        assert!((0..all.len()).all(|a| (0..a).all(|b| !alike(a, b))), "two moves of {reach:?} are the same");
    }
}

/// A leaf size is removed with the leaf.
#[test]
fn a_group_that_gives_up_its_volume_has_no_size_of_leaves() {
    let shape = shape();
    let mut start = shape.authored();
    let p = shape.groups.iter().position(|group| group.path == "r/arm/p").unwrap();
    start[p].leaf_size = Some(8);
    assert_eq!(shape.leaf(&start, p), 40);
    let above =
        crate::tree_tuning::moves::Move(vec![(p, Setting { bound: Bound::Above, leaf_size: Some(8) })]);
    let then = applied(&shape, &start, &above);
    assert_eq!((then[p].leaf_size, shape.leaf(&then, p), shape.leaf(&then, p - 1)), (None, 0, 40));
}
