//! Solids of groups with `contact: Solid`: their parts, fields and areas.

use crate::common::families::FAMILIES;
use crate::common::{cube, cube_vertices, faults, load};
use pong_geometry::{Quat, Vec3};
use pong_model::{Model, Solid, SolidFacet};
use pong_testkit::{Random, samples};

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

/// The faces of the notch are internal faces with nothing behind them: all other faces are those of a box.
#[test]
fn an_l_with_an_inactive_notch_is_not_convex() {
    let foot = cube("foot", [1.0, 0.0, 0.0], [3.0, 1.0, 1.0], "[5, 1]");
    let post = cube("post", [0.0, 0.0, 0.0], [1.0, 1.0, 2.0], "[3]");
    let solid = only(&format!("{foot},\n{post}"));
    assert_eq!(counts(&solid), [[4, 2], [5, 1]]);
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

/// Triangles of a box, two for each face, counter-clockwise seen from outside.
const BOX_TRIANGLES: &str = "[(0,3,2), (0,2,1), (4,5,6), (4,6,7), (0,1,5), (0,5,4), (1,2,6), (1,6,5), (2,3,7), \
                             (2,7,6), (3,0,4), (3,4,7)]";

fn mesh(name: &str, vertices: &str, triangles: &str, more: &str) -> String {
    format!("TriangleMesh(name: \"{name}\", vertices: {vertices}, triangles: {triangles}{more})")
}

fn box_mesh() -> String {
    mesh("box", &cube_vertices([0.0; 3], [2.0, 1.0, 1.0]), BOX_TRIANGLES, "")
}

/// A mesh of indexed triangles.
fn mesh_of(vertices: &[Vec3], triangles: &[[u32; 3]], more: &str) -> String {
    let rows = |rows: Vec<String>| format!("[{}]", rows.join(", "));
    let places = vertices.iter().map(|v| format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)).collect();
    let corners = triangles.iter().map(|[a, b, c]| format!("({a}, {b}, {c})")).collect();
    mesh("mesh", &rows(places), &rows(corners), more)
}

/// A torus of `around` rings of `across` quads, each of two triangles.
fn torus(around: u32, across: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let turn = |k: u32, of: u32| f64::from(k) / f64::from(of) * std::f64::consts::TAU;
    let vertex = |i: u32, j: u32| {
        let (u, v) = (turn(i, around), turn(j, across));
        let radius = 1.0 + 0.3 * v.cos();
        Vec3::new(radius * u.cos(), radius * u.sin(), 0.3 * v.sin())
    };
    let vertices = (0..around).flat_map(|i| (0..across).map(move |j| vertex(i, j))).collect();
    let number = |i: u32, j: u32| i % around * across + j % across;
    let quads = (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    (vertices, triangles.collect())
}

#[test]
fn a_closed_mesh_of_a_box_has_six_faces() {
    let solid = only(&box_mesh());
    assert_eq!(counts(&solid), [[6, 0]]);
    assert_eq!(solid.area, 10.0);
    let normals: Vec<Vec3> = solid.fields[0].faces.iter().map(|face| face.normal_b).collect();
    let expected = [-Vec3::z(), Vec3::z(), -Vec3::y(), Vec3::x(), Vec3::y(), -Vec3::x()];
    assert_eq!(normals, expected);
}

#[test]
fn a_tetrahedral_mesh_has_four_faces() {
    let vertices = "[(0,0,0), (1,0,0), (0,1,0), (0,0,1)]";
    let solid = only(&mesh("t", vertices, "[(0,2,1), (0,1,3), (1,2,3), (2,0,3)]", ""));
    assert_eq!(counts(&solid), [[4, 0]]);
    assert!((solid.area - 1.5 - 0.75_f64.sqrt()).abs() < 1e-15, "{}", solid.area);
}

#[test]
fn a_torus_is_a_solid_without_fields() {
    let (vertices, triangles) = torus(24, 12);
    let solid = only(&mesh_of(&vertices, &triangles, ""));
    assert!(solid.fields.is_empty() && !solid.is_convex());
    let exact = std::f64::consts::TAU * std::f64::consts::TAU * 0.3;
    assert!((solid.area / exact - 1.0).abs() < 0.03, "{} {exact}", solid.area);
}

/// Number of regions that hold a place, and the depth below their facets, m.
fn regions_at(solid: &Solid, place: &Vec3) -> (usize, f64) {
    let holds = |facet: &&SolidFacet| {
        let walls = &solid.facet_walls[facet.walls.start as usize..facet.walls.end as usize];
        facet.face.depth(place) >= 0.0 && walls.iter().all(|wall| wall.depth(place) >= 0.0)
    };
    let found: Vec<f64> = solid.facets.iter().filter(holds).map(|facet| facet.face.depth(place)).collect();
    (found.len(), found.iter().copied().fold(0.0, f64::max))
}

/// Near the surface of a torus, each place inside is in one region, and each place outside in none.
#[test]
fn regions_of_a_torus_divide_the_volume_below_its_surface() {
    let (vertices, triangles) = torus(48, 24);
    let solid = only(&mesh_of(&vertices, &triangles, ""));
    assert_eq!(solid.facets.len(), triangles.len());
    assert!(solid.least_height().is_none_or(|least| least > 0.1), "{:?}", solid.least_height());
    let of_parts: usize = solid.parts.iter().map(|part| part.facets.len()).sum();
    assert_eq!(of_parts, solid.facets.len());
    let mut random = Random::new(5, 0, 0);
    let (mut once, all) = (0, samples(20_000));
    for _ in 0..all {
        let corners = triangles[random.below(triangles.len())].map(|vertex| vertices[vertex as usize]);
        let [s, t] = [random.between(0.0, 1.0), random.between(0.0, 1.0)];
        let [s, t] = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] };
        let edges = [corners[1] - corners[0], corners[2] - corners[0]];
        let normal = edges[0].cross(&edges[1]).normalize();
        let place = corners[0] + edges[0] * s + edges[1] * t;
        let depth = random.between(1e-4, 0.02);
        let (inside, found) = regions_at(&solid, &(place - normal * depth));
        once += usize::from(inside == 1);
        assert!(inside == 0 || (found / depth - 1.0).abs() < 0.05, "{inside} {found} for {depth}");
        assert_eq!(regions_at(&solid, &(place + normal * depth)).0, 0);
    }
    println!("{once} of {all}");
    assert!(once as f64 > 0.999 * all as f64, "{once} of {all}");
}

/// Vertices and triangles of an L that is 1 thick, with limbs 2 wide. The regions below its large faces end in ridges that
/// lie exactly in the opposite faces.
fn l_of_thickness_one() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let outline = [[-2.0, -4.0], [4.0, -4.0], [4.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-2.0, 1.0]];
    let vertices = [-0.5, 0.5].into_iter().flat_map(|y| outline.map(|[x, z]| Vec3::new(x, y, z)));
    let ends = [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]];
    let opposite = ends.map(|[a, b, c]| [a + 6, c + 6, b + 6]);
    let sides = (0..6).flat_map(|at| {
        let [here, next] = [at, (at + 1) % 6];
        [[here, here + 6, next + 6], [here, next + 6, next]]
    });
    (vertices.collect(), ends.into_iter().chain(opposite).chain(sides).collect())
}

/// A triangle that a region touches, without volume in common, bounds its height whatever the axes of the mesh are, and both
/// of two opposite triangles alike.
#[test]
fn heights_of_regions_do_not_depend_on_the_axes() {
    let (vertices, triangles) = l_of_thickness_one();
    let heights = |turn: &Quat| -> Vec<f64> {
        let turned: Vec<Vec3> = vertices.iter().map(|vertex| turn * vertex).collect();
        only(&mesh_of(&turned, &triangles, "")).facets.iter().map(|facet| facet.height).collect()
    };
    let expected = heights(&Quat::identity());
    for index in 0..3 {
        assert_eq!((expected[index], expected[4 + index]), (0.5, 0.5), "{expected:?}");
    }
    let mut random = Random::new(46, 1, 0);
    for _ in 0..samples(200) {
        let turn = Quat::from_scaled_axis(Vec3::from_fn(|_, _| random.between(-2.0, 2.0)));
        for (height, expected) in heights(&turn).into_iter().zip(&expected) {
            assert!(height == *expected || (height - expected).abs() < 1e-12, "{height} {expected}");
        }
    }
}

/// Floors from triangles that are not parallel to that of the region are the same in other axes, too.
#[test]
fn heights_of_an_l_do_not_depend_on_the_axes() {
    let places = pong_testkit::meshes::l_shape();
    let vertices: Vec<Vec3> = places.iter().flatten().map(|place| Vec3::from(*place)).collect();
    let triangles: Vec<[u32; 3]> = (0..places.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let heights = |turn: &Quat| -> Vec<f64> {
        let turned: Vec<Vec3> = vertices.iter().map(|vertex| turn * vertex).collect();
        only(&mesh_of(&turned, &triangles, "")).facets.iter().map(|facet| facet.height).collect()
    };
    let expected = heights(&Quat::identity());
    let mut random = Random::new(46, 2, 0);
    for _ in 0..samples(200) {
        let turn = Quat::from_scaled_axis(Vec3::from_fn(|_, _| random.between(-2.0, 2.0)));
        for (height, expected) in heights(&turn).into_iter().zip(&expected) {
            assert!(height == *expected || (height - expected).abs() < 1e-14, "{height} {expected}");
        }
    }
}

/// One vertex of a torus is drawn through the tube into the hole.
#[test]
fn a_mesh_that_crosses_itself_is_refused() {
    let (mut vertices, triangles) = torus(24, 12);
    vertices[0] = Vec3::new(0.4, 0.0, 0.0);
    let faults = faults(&solid_model(&mesh_of(&vertices, &triangles, "")));
    assert_eq!(faults.0[0].rule, "solid-crossing");
    assert!(faults.0[0].cause.contains("cross at ("), "{}", faults.0[0].cause);
}

fn volume(solid: &Solid) -> f64 {
    solid.parts.iter().map(|part| part.surface.moments(&solid.bound.center).volume).sum()
}

/// Enclosed volume of triangles, by tetrahedra with the origin.
fn volume_of(vertices: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let six = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
        a.dot(&b.cross(&c))
    };
    triangles.iter().map(six).sum::<f64>() / 6.0
}

/// The parts are small, lie in their boxes and have no common volume.
#[test]
fn parts_of_a_torus_add_up_to_it() {
    for (around, across) in [(8, 6), (24, 12), (120, 60)] {
        let (vertices, triangles) = torus(around, across);
        let solid = only(&mesh_of(&vertices, &triangles, ""));
        let whole = volume_of(&vertices, &triangles);
        assert!((volume(&solid) / whole - 1.0).abs() < 1e-12, "{} {whole}", volume(&solid));
        let facets: Vec<usize> = solid.parts.iter().map(|part| part.surface.facets().count()).collect();
        assert!(facets.iter().all(|facets| *facets <= 24), "{facets:?}");
        assert!(solid.parts.len() > triangles.len() / 24, "{} parts", solid.parts.len());
        assert!(
            solid.parts.len() < triangles.len() / 3,
            "{} parts of {}",
            solid.parts.len(),
            triangles.len()
        );
        for part in &solid.parts {
            let (low, high) = part.surface.bounds();
            assert_eq!((part.bound.center, part.bound.half), (0.5 * (low + high), 0.5 * (high - low)));
            assert!(part.surface.moments(&part.bound.center).volume > 0.0);
        }
    }
}

/// No plane divides the triangles of a slender double cone well, since all of them meet at its tips.
#[test]
fn parts_of_a_slender_double_cone_add_up_to_it() {
    let sides = 200;
    let turn = |k: u32| f64::from(k) / f64::from(sides) * std::f64::consts::TAU;
    let mut vertices: Vec<Vec3> = (0..sides).map(|k| Vec3::new(turn(k).cos(), turn(k).sin(), 0.0)).collect();
    vertices.extend([Vec3::new(0.0, 0.0, -50.0), Vec3::new(0.0, 0.0, 50.0)]);
    let triangles: Vec<[u32; 3]> = (0..sides)
        .flat_map(|k| {
            let next = (k + 1) % sides;
            [[k, next, sides + 1], [next, k, sides]]
        })
        .collect();
    let solid = only(&mesh_of(&vertices, &triangles, ""));
    assert_eq!(counts(&solid), [[400, 0]]);
    let whole = volume_of(&vertices, &triangles);
    assert!((volume(&solid) / whole - 1.0).abs() < 1e-12, "{} {whole}", volume(&solid));
}

#[test]
fn separate_shells_of_a_mesh_are_solids_of_their_own() {
    let eight = cube_vertices([0.0; 3], [1.0; 3]);
    let far = cube_vertices([3.0, 0.0, 0.0], [4.0, 1.0, 1.0]);
    let vertices = format!("{}, {}", eight.trim_end_matches(']'), far.trim_start_matches('['));
    let second = (0..8)
        .rev()
        .fold(BOX_TRIANGLES.to_owned(), |text, k| text.replace(&k.to_string(), &format!("<{k}>")));
    let second = (0..8).fold(second, |text, k| text.replace(&format!("<{k}>"), &(k + 8).to_string()));
    let both = format!("{}, {}", BOX_TRIANGLES.trim_end_matches(']'), second.trim_start_matches('['));
    let found = solids(&mesh("two", &vertices, &both, ""));
    assert_eq!(
        found.iter().map(|solid| (solid.primitive, solid.shell)).collect::<Vec<_>>(),
        [(0, 0), (0, 1)]
    );
    assert_eq!(found[1].bound.center, Vec3::new(3.5, 0.5, 0.5));
}

/// Every place of the box is moved and rounded to single precision.
#[test]
fn boxes_in_single_precision_keep_their_faces() {
    let mut random = Random::new(7, 0, 0);
    for _ in 0..samples(100) {
        let (turn, to) = (random.rotation_matrix(), random.vector(2.0));
        let grid = |n: u32| (0..=n).map(move |k| f64::from(k) / f64::from(n));
        // Each face of the box is a grid of 4 × 4 quads.
        let mut vertices: Vec<Vec3> = Vec::new();
        let mut triangles = Vec::new();
        for axis in 0..3 {
            for side in [0.0, 1.0] {
                let start = vertices.len() as u32;
                for (u, v) in grid(4).flat_map(|u| grid(4).map(move |v| (u, v))) {
                    let mut place = Vec3::zeros();
                    (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (side, u, v);
                    vertices.push((turn * place + to).map(|x| f64::from(x as f32)));
                }
                for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                    let at = start + 5 * i + j;
                    let [a, b, c, d] = [at, at + 5, at + 6, at + 1];
                    let two = [[a, b, c], [a, c, d]];
                    triangles.extend(two.map(|[a, b, c]| if side == 1.0 { [a, b, c] } else { [a, c, b] }));
                }
            }
        }
        let solid = only(&mesh_of(&vertices, &triangles, ""));
        assert_eq!(counts(&solid), [[6, 0]]);
    }
}

#[test]
fn an_inward_mesh_is_refused() {
    let (vertices, triangles) = torus(8, 6);
    let turned: Vec<_> = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    assert_eq!(rule(&mesh_of(&vertices, &turned, "")), "solid-volume");
}

#[test]
fn a_sheet_of_two_sides_is_refused() {
    let sheet = mesh("sheet", "[(0,0,0), (1,0,0), (0,1,0)]", "[(0,1,2), (0,2,1)]", "");
    assert_eq!(rule(&sheet), "solid-volume");
}

#[test]
fn an_open_mesh_is_refused_at_its_first_open_edge() {
    let faults =
        faults(&solid_model(&mesh("quad", "[(0,0,0), (1,0,0), (1,1,0), (0,1,0)]", "[(0,1,2), (0,2,3)]", "")));
    assert_eq!(faults.0[0].rule, "open-solid");
    assert!(faults.0[0].cause.contains("from (0, 0, 0) to (1, 0, 0)"), "{}", faults.0[0].cause);
}

#[test]
fn a_two_sided_mesh_is_refused() {
    let sheet =
        mesh("sheet", "[(0,0,0), (1,0,0), (0,1,0)]", "[(0,1,2)]", ", two_sided: true, thickness: 0.1");
    assert_eq!(rule(&sheet), "solid-two-sided");
}

/// The layer behind a flat sheet is a plate; only the face of the sheet pushes.
#[test]
fn a_flat_sheet_with_a_thickness_is_a_plate() {
    let sheet =
        mesh("sheet", "[(0,0,0), (2,0,0), (2,1,0), (0,1,0)]", "[(0,1,2), (0,2,3)]", ", thickness: 0.5");
    let solid = only(&sheet);
    assert_eq!(counts(&solid), [[1, 5]]);
    assert_eq!(solid.area, 2.0);
    assert_eq!(
        (solid.bound.center, solid.bound.half),
        (Vec3::new(1.0, 0.5, -0.25), Vec3::new(1.0, 0.5, 0.25))
    );
    assert!((volume(&solid) - 1.0).abs() < 1e-15);
}

/// The open box has sides of 1 m and no top. The normal at a vertex is the mean of two or three faces that are
/// perpendicular to each other, whatever the number of their triangles: the layer of 0.1·√3 m is 0.1 m thick at
/// the vertices of the bottom.
#[test]
fn a_layer_behind_an_open_box_has_its_thickness_along_the_normals() {
    let open = "[(0,3,2), (0,2,1), (0,1,5), (0,5,4), (1,2,6), (1,6,5), (2,3,7), (2,7,6), (3,0,4), (3,4,7)]";
    let thickness = 0.1 * 3.0_f64.sqrt();
    let solid =
        only(&mesh("open", &cube_vertices([0.0; 3], [1.0; 3]), open, &format!(", thickness: {thickness:?}")));
    assert!(solid.fields.is_empty());
    assert_eq!(solid.area, 5.0);
    // At the top, the normals are those of two faces.
    let at_top = thickness / 2.0_f64.sqrt();
    let (low, high) = ((1.0 - 0.2_f64).powi(2), (1.0 - 2.0 * at_top).powi(2));
    // The hollow is a frustum of a pyramid, 0.9 m high.
    let hollow = 0.9 / 3.0 * (low + high + (low * high).sqrt());
    assert!((volume(&solid) - (1.0 - hollow)).abs() < 1e-12, "{} {hollow}", volume(&solid));
}

/// Ridges thinner than twice the layer leave no room for it.
#[test]
fn a_layer_that_turns_over_is_refused() {
    let ridge = |thickness: f64| {
        let vertices = "[(0,0,0), (0,1,0), (0.1,0,1), (0.1,1,1), (0.2,0,0), (0.2,1,0)]";
        let triangles = "[(0,2,3), (0,3,1), (2,4,5), (2,5,3)]";
        mesh("ridge", vertices, triangles, &format!(", thickness: {thickness:?}"))
    };
    assert!(only(&ridge(0.01)).fields.is_empty());
    assert_eq!(rule(&ridge(2.0)), "solid-thickness");
}

#[test]
fn joined_meshes_of_unlike_thickness_are_refused() {
    let [one, other] = [("a", "(1,0,0)", 0.1), ("b", "(-1,0,0)", 0.2)].map(|(name, x, thickness)| {
        let vertices = format!("[(0,0,0), {x}, (0,1,0)]");
        let triangle = if name == "a" { "[(0,1,2)]" } else { "[(0,2,1)]" };
        mesh(name, &vertices, triangle, &format!(", thickness: {thickness:?}"))
    });
    assert_eq!(rule(&format!("{one},\n{other}")), "solid-thickness");
}

#[test]
fn points_and_segments_in_a_group_of_solids_are_refused() {
    let box_ = cube("a", [0.0; 3], [1.0; 3], "[]");
    assert_eq!(rule(&format!("{box_}, Point(name: \"p\", position: (9.0, 0.0, 0.0))")), "solid-corner");
    let segment = "LineSegment(name: \"s\", ends: ((9.0, 0.0, 0.0), (8.0, 0.0, 0.0)))";
    assert_eq!(rule(&format!("{box_}, {segment}")), "solid-corner");
    solids(&format!("{box_}, Sphere(name: \"b\", center: (0.0, 0.0, 0.0), radius: 0.1)"));
}

/// Points of a `Marked` group beside solids of the same rigid body: inside, on a face, and outside.
#[test]
fn points_on_or_in_a_solid_are_refused() {
    let model = |solid: &str, point: [f64; 3]| {
        let [x, y, z] = point;
        format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e6) }},\n\
             root: (name: \"m\", surface: \"s\", groups: [(name: \"a\", contact: Solid, primitives: [{solid}]),\n\
             (name: \"b\", primitives: [LineSegment(name: \"p\", ends: (({x:?}, {y:?}, {z:?}), (99.0, 9.0, 9.0)))])]))"
        )
    };
    let (vertices, triangles) = torus(24, 12);
    let torus = mesh_of(&vertices, &triangles, "");
    let corner = vertices[0] + Vec3::new(1e-8, 0.0, 0.0);
    let bad = [
        (quarters(), [1.0, 0.5, 0.5]),
        (quarters(), [2.0, 1.0, 1.0 + 1e-7]),
        (box_mesh(), [0.1, 0.1, 0.0]),
        (torus.clone(), [1.0, 0.0, 0.0]),
        (torus.clone(), corner.into()),
    ];
    for (solid, point) in bad {
        assert_eq!(faults(&model(&solid, point)).0[0].rule, "solid-corner", "{point:?}");
    }
    for (solid, point) in
        [(quarters(), [2.0, 1.0, 1.001]), (torus.clone(), [0.0; 3]), (torus, [1.2, 0.0, 0.29])]
    {
        load(&model(&solid, point));
    }
}

/// The overlap needs closed parts: each edge of a face runs the other way in another face, also in pieces whose
/// faces rounding has merged.
#[test]
fn faces_of_rounded_polyhedra_are_closed() {
    for family in FAMILIES {
        for index in 0..samples(100) as u64 {
            let mut random = Random::new(11, 0, index);
            let Some(solid) = (family.make)(&mut random) else { continue };
            let size = random.log_between(1e-4, 1e4);
            let solid = solid.posed(random.rotation_matrix(), random.vector(size), size);
            let text = solid_model(&solid.text("a"));
            let Ok(model) = pong_model::parse(&text, "m", None, &pong_model::Extensions::new()) else {
                continue;
            };
            let polyhedron = &model.bodies[0].polyhedra[0];
            let mut edges = std::collections::BTreeSet::new();
            for face in 0..polyhedron.faces.len() {
                let starts: Vec<u32> = polyhedron.rim(face).iter().map(|rim| rim.start).collect();
                let ends = starts.iter().cycle().skip(1);
                starts.iter().zip(ends).for_each(|(from, to)| assert!(edges.insert([*from, *to])));
            }
            let single = edges.iter().filter(|[from, to]| !edges.contains(&[*to, *from]));
            assert_eq!(single.count(), 0, "{} {index}", family.name);
            assert_eq!(model.bodies[0].solids[0].fields.len(), 1, "{} {index}", family.name);
        }
    }
}
