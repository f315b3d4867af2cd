//! Solids of groups with `contact: Solid`: their parts, fields and areas.

use crate::common::{cube, faults, load};
use pong_geometry::Vec3;
use pong_model::{Model, Solid};

/// Model whose root has `contact: Solid` and these primitives.
fn solid_model(primitives: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"m\",\n\
         surfaces: {{ \"steel\": (stiffness: 1e6), \"wood\": (stiffness: 1e5) }},\n\
         root: (name: \"root\", surface: \"steel\", contact: Solid, primitives: [\n{primitives}\n]))"
    )
}

fn solids(primitives: &str) -> Vec<Solid> {
    load(&solid_model(primitives)).bodies.remove(0).solids
}

fn only(primitives: &str) -> Solid {
    let solids = solids(primitives);
    assert_eq!(solids.len(), 1, "{solids:?}");
    solids.into_iter().next().expect("one")
}

/// Number of faces and of walls of each field.
fn counts(solid: &Solid) -> Vec<[usize; 2]> {
    solid.fields.iter().map(|field| [field.faces.len(), field.walls.len()]).collect()
}

fn rule(primitives: &str) -> &'static str {
    let faults = faults(&solid_model(primitives));
    faults.0[0].rule
}

/// A box of 2 × 1 × 1 m, cut across x and y into four.
fn quarters() -> String {
    [
        cube("a", [0.0, 0.0, 0.0], [1.0, 0.5, 1.0], "[3, 4]"),
        cube("b", [1.0, 0.0, 0.0], [2.0, 0.5, 1.0], "[5, 4]"),
        cube("c", [0.0, 0.5, 0.0], [1.0, 1.0, 1.0], "[3, 2]"),
        cube("d", [1.0, 0.5, 0.0], [2.0, 1.0, 1.0], "[5, 2]"),
    ]
    .join(",\n")
}

#[test]
fn a_box_is_one_solid_of_six_faces() {
    let solid = only(&cube("a", [0.0, 0.0, 0.0], [2.0, 1.0, 1.0], "[]"));
    assert_eq!((solid.primitive, solid.shell, solid.surface, solid.leaf), (0, 0, 0, 0));
    assert_eq!(counts(&solid), [[6, 0]]);
    assert_eq!(solid.area, 10.0);
    assert_eq!((solid.bound.center, solid.bound.half), (Vec3::new(1.0, 0.5, 0.5), Vec3::new(1.0, 0.5, 0.5)));
    assert_eq!(solid.parts.len(), 1);
    assert_eq!(solid.parts[0].bound, solid.bound);
    assert!(solid.is_convex());
}

#[test]
fn a_box_in_four_pieces_is_one_convex_solid() {
    let solid = only(&quarters());
    assert_eq!(counts(&solid), [[6, 0]]);
    assert_eq!(solid.parts.len(), 4);
    assert!((solid.area - 10.0).abs() < 1e-12, "{}", solid.area);
    assert_eq!(solid.fields[0].bound, solid.bound);
}

/// The two pieces of an L share the wall x = 1; the taller piece has a face above it in the same plane.
#[test]
fn an_l_of_two_pieces_has_two_fields_with_walls() {
    let foot = cube("foot", [1.0, 0.0, 0.0], [3.0, 1.0, 1.0], "[5]");
    let post = "Polyhedron(name: \"post\", vertices: [(0.0,0.0,0.0), (1.0,0.0,0.0), (1.0,1.0,0.0), (0.0,1.0,0.0), \
                (1.0,0.0,1.0), (1.0,1.0,1.0), (0.0,0.0,2.0), (1.0,0.0,2.0), (1.0,1.0,2.0), (0.0,1.0,2.0)], \
                faces: [[0,3,2,1], [6,7,8,9], [0,1,4,7,6], [1,2,5,4], [4,5,8,7], [2,3,9,8,5], [3,0,6,9]], \
                inactive_faces: [3])";
    let solid = only(&format!("{foot},\n{post}"));
    assert!(!solid.is_convex());
    assert_eq!(counts(&solid), [[5, 1], [6, 1]]);
    assert!((solid.area - 18.0).abs() < 1e-12, "{}", solid.area);
}

#[test]
fn boxes_that_are_not_joined_are_solids_of_their_own() {
    let found = solids(&format!(
        "{},\n{}",
        cube("a", [0.0; 3], [1.0; 3], "[]"),
        cube("b", [2.0, 0.0, 0.0], [3.0, 1.0, 1.0], "[]")
    ));
    assert_eq!(found.iter().map(|solid| solid.primitive).collect::<Vec<_>>(), [0, 1]);
}

/// An inactive face without a counterpart bounds the solid but does not push.
#[test]
fn an_inactive_face_with_nothing_behind_is_a_wall() {
    assert_eq!(counts(&only(&cube("a", [0.0; 3], [1.0; 3], "[3]"))), [[5, 1]]);
}

#[test]
fn pieces_of_one_solid_have_one_surface() {
    let other = quarters().replace("name: \"d\"", "name: \"d\", surface: \"wood\"");
    assert_eq!(rule(&other), "solid-surfaces");
}

#[test]
fn pieces_of_one_solid_have_one_contact() {
    let halves = |contact: &str| {
        format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e6) }},\n\
             root: (name: \"m\", surface: \"s\", contact: Solid, groups: [\n\
             (name: \"a\", primitives: [{}]), (name: \"b\", {contact} primitives: [{}])]))",
            cube("a", [0.0; 3], [1.0; 3], "[3]"),
            cube("b", [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], "[5]")
        )
    };
    assert_eq!(load(&halves("")).bodies[0].solids.len(), 1);
    assert_eq!(faults(&halves("contact: Marked,")).0[0].rule, "solid-contact");
}

/// Groups pass `contact` on, and the leaf is found again in another tree.
#[test]
fn the_leaf_is_the_node_of_the_lowest_primitive() {
    let text = format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e6) }},\n\
         root: (name: \"m\", surface: \"s\", groups: [(name: \"marked\", bound: Aabb, primitives: [{}]),\n\
         (name: \"solid\", contact: Solid, groups: [(name: \"a\", bound: Aabb, primitives: [{}]), \
         (name: \"b\", bound: Sphere, primitives: [{}])])]))",
        cube("m", [0.0; 3], [1.0; 3], "[]"),
        cube("a", [2.0, 0.0, 0.0], [3.0, 1.0, 1.0], "[]"),
        cube("b", [4.0, 0.0, 0.0], [5.0, 1.0, 1.0], "[]")
    );
    let model = load(&text);
    let has_leaves = |model: &Model, count| {
        let body = &model.bodies[0];
        assert_eq!(body.solids.iter().map(|solid| solid.primitive).collect::<Vec<_>>(), [1, 2]);
        for solid in &body.solids {
            let node = &body.tree.nodes[solid.leaf as usize];
            let items = &body.tree.items[node.items.start as usize..node.items.end as usize];
            assert!(items.iter().any(|item| item.primitive == solid.primitive), "{solid:?}");
            assert_eq!(items.len(), count);
        }
    };
    has_leaves(&model, 1);
    has_leaves(&model.with_leaves(8, &pong_model::Extensions::new()).expect("fits"), 3);
    assert_ne!(model.hash, load(&text.replace("contact: Solid,", "")).hash);
}

/// Model with one surface.
fn surface_model(surface: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": {surface} }},\n\
         root: (name: \"m\", surface: \"s\", primitives: [Point(name: \"p\", position: (0.0, 0.0, 0.0))]))"
    )
}

#[test]
fn a_surface_gives_a_foundation_or_an_area() {
    let values = |surface: &str| {
        let model = load(&surface_model(surface));
        (model.surfaces[0].foundation, model.surfaces[0].area, model.hash)
    };
    let (none, nothing, hash) = values("(stiffness: 1e6)");
    assert_eq!((none, nothing), (None, None));
    let (foundation, area, other) = values("(stiffness: 1e6, foundation: 3e9)");
    assert_eq!((foundation, area), (Some(3e9), None));
    assert_ne!(other, hash);
    let (foundation, area, third) = values("(stiffness: 1e6, area: Some(0.25))");
    assert_eq!((foundation, area), (None, Some(0.25)));
    assert!(third != hash && third != other);
    values("(stiffness: 1e6, foundation: 3e9, normal: HuntCrossley(exponent: 1.0, dissipation: 0.2))");
}

#[test]
fn foundations_of_no_linear_spring_are_refused() {
    let rule = |surface: &str| faults(&surface_model(surface)).0[0].rule;
    assert_eq!(rule("(stiffness: inf, foundation: 3e9)"), "foundation-law");
    assert_eq!(rule("(stiffness: inf, area: 0.1)"), "foundation-law");
    assert_eq!(rule("(stiffness: 1e6, area: 0.1, normal: HuntCrossley(exponent: 1.5))"), "foundation-law");
    assert_eq!(rule("(stiffness: 1e6, area: 0.1, normal: Custom(name: \"mine\"))"), "foundation-law");
    assert_eq!(rule("(stiffness: 1e6, area: 0.1, foundation: 1e7)"), "either-or");
    assert_eq!(rule("(stiffness: 1e6, area: 0.0)"), "not-positive");
    assert_eq!(rule("(stiffness: 1e6, foundation: -1.0)"), "not-positive");
    assert_eq!(rule("(stiffness: 1e6, foundation: 1e-101)"), "foundation-range");
    assert_eq!(rule("(stiffness: 1e6, area: 1e-99)"), "foundation-range");
}
