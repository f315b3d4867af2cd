//! Surfaces: connected pieces, the features that push, and seams without effect.

use crate::common::{CUBE_FACES, cube, cube_vertices, load, model_of};
use pong_geometry::Vec3;
use pong_geometry::primitive::{NO_NEIGHBOR, Polyhedron, PrimitiveKind};
use pong_geometry::simd::Portable;
use pong_model::box_tree::{Child, NarrowBox, lanes};
use pong_model::{Model, MovableGroup};
use std::collections::BTreeSet;

fn body(primitives: &str) -> MovableGroup {
    let model = load(&model_of(primitives));
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
    model.bodies.into_iter().next().unwrap()
}

fn warnings(primitives: &str) -> Vec<String> {
    load(&model_of(primitives)).warnings
}

fn text(v: &Vec3) -> String {
    format!("{:.6} {:.6} {:.6}", v.x + 0.0, v.y + 0.0, v.z + 0.0)
}

fn pushing_edges(pieces: &[Polyhedron]) -> Vec<(Vec3, Vec3)> {
    let of = |piece: &Polyhedron| -> Vec<_> {
        let ends = |v: u32| piece.vertices[v as usize].position;
        let pushing = piece.edges.iter().filter(|edge| edge.push.is_some());
        pushing.map(|edge| (ends(edge.vertices[0]), ends(edge.vertices[1]))).collect()
    };
    pieces.iter().flat_map(of).collect()
}

/// Returns `true` if a vertex lies in the middle of a straight edge, where an internal face ends. Its cone
/// catches a centre that rounding puts between the two halves of the edge, and adds no other contact.
fn is_within_an_edge(cone: &[Vec3]) -> bool {
    cone.iter().any(|one| cone.iter().any(|other| one.dot(other) < -1.0 + 1e-9))
}

/// Corners with their cones.
fn pushing_vertices(pieces: &[Polyhedron]) -> BTreeSet<(String, BTreeSet<String>)> {
    let of = |piece: &Polyhedron| -> Vec<_> {
        let cone = |v: usize| piece.cone(v).iter().map(text).collect();
        let is_corner = |v: usize| !is_within_an_edge(piece.cone(v));
        let all = piece.vertices.iter().enumerate().filter(|(v, vertex)| vertex.pushes && is_corner(*v));
        all.map(|(v, vertex)| (text(&vertex.position), cone(v))).collect()
    };
    pieces.iter().flat_map(of).collect()
}

/// Total length of pushing edges along each line, with the normals between which they push.
fn edge_lines(pieces: &[Polyhedron]) -> BTreeSet<String> {
    let mut lines: std::collections::BTreeMap<String, f64> = Default::default();
    for piece in pieces {
        for edge in &piece.edges {
            let Some(push) = edge.push else { continue };
            let [a, b] = edge.vertices.map(|v| piece.vertices[v as usize].position);
            let mut normals = push.normals.map(|n| text(&n));
            normals.sort();
            let foot = a - edge.direction * edge.direction.dot(&a);
            let key = format!("{} | {} | {normals:?}", text(&edge.direction), text(&foot));
            *lines.entry(key).or_default() += (b - a).norm();
        }
    }
    lines.into_iter().map(|(line, length)| format!("{line} {length:.9}")).collect()
}

#[test]
fn a_cube_in_two_halves_is_the_cube() {
    let whole = body(&cube("c", [0.0; 3], [2.0, 1.0, 1.0], "[]"));
    // Face 3 looks along +x, face 5 along −x.
    let halves = body(&format!(
        "{},\n{}",
        cube("low", [0.0; 3], [1.0; 3], "[3]"),
        cube("high", [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], "[5]")
    ));
    assert_eq!((whole.shell_count, halves.shell_count), (1, 1));
    assert_eq!(edge_lines(&halves.polyhedra), edge_lines(&whole.polyhedra));
    assert_eq!(pushing_vertices(&halves.polyhedra), pushing_vertices(&whole.polyhedra));
    assert_eq!(pushing_edges(&halves.polyhedra).len(), 16, "the four long edges are in two parts");
    assert_eq!(pushing_vertices(&halves.polyhedra).len(), 8);
}

#[test]
fn twin_walls_lie_in_exactly_one_plane_that_belongs_to_the_lower_piece() {
    let wall = 1.0 / 3.0;
    let bodies = body(&format!(
        "{},\n{}",
        cube("low", [0.0; 3], [wall + 1e-7, 1.0, 1.0], "[3]"),
        cube("high", [wall, 0.0, 0.0], [1.0; 3], "[5]")
    ));
    let [low, high] = bodies.polyhedra.as_slice() else { panic!() };
    let inner = |piece: &Polyhedron| *piece.faces.iter().find(|face| !face.active).unwrap();
    let (a, b) = (inner(low), inner(high));
    assert_eq!((a.normal, a.offset), (-b.normal, -b.offset));
    assert_eq!((a.closed, b.closed), (true, false));
    let on_wall = Vec3::new(a.offset, 0.5, 0.5);
    assert!(low.contains(&on_wall) && !high.contains(&on_wall));
}

#[test]
fn a_cube_in_eight_is_the_cube_and_each_point_of_the_walls_has_one_owner() {
    let mut pieces = Vec::new();
    for piece in 0..8_usize {
        let at = [0, 1, 2].map(|axis| (piece >> axis & 1) as f64);
        let inner = [[3, 5], [4, 2], [1, 0]];
        let walls: Vec<_> = (0..3).map(|axis| inner[axis][piece >> axis & 1]).collect();
        pieces.push(cube(&format!("p{piece}"), at, at.map(|x| x + 1.0), &format!("{walls:?}")));
    }
    let eighths = body(&pieces.join(",\n"));
    let whole = body(&cube("c", [0.0; 3], [2.0; 3], "[]"));
    assert_eq!(edge_lines(&eighths.polyhedra), edge_lines(&whole.polyhedra));
    assert_eq!(pushing_vertices(&eighths.polyhedra), pushing_vertices(&whole.polyhedra));
    for p in [[1.0, 0.5, 0.5], [0.5, 1.0, 1.5], [1.0, 1.0, 0.5], [1.0, 1.0, 1.0]] {
        let p = Vec3::from(p);
        let owners: Vec<_> = (0..8).filter(|&piece| eighths.polyhedra[piece].contains(&p)).collect();
        let lowest = (0..8).find(|&piece| (0..6).all(|f| eighths.polyhedra[piece].height(f, &p) <= 0.0));
        assert_eq!(owners, [lowest.unwrap()], "{p:?}");
    }
}

#[test]
fn an_inner_corner_never_pushes() {
    // An L of two boxes: the arm stands on the floor's left half.
    let l = body(&format!(
        "{},\n{},\n{}",
        cube("left", [0.0; 3], [1.0; 3], "[1, 3]"),
        cube("right", [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], "[5]"),
        cube("arm", [0.0, 0.0, 1.0], [1.0, 1.0, 2.0], "[0]")
    ));
    assert_eq!(l.shell_count, 1);
    let along_y = |(a, b): &(Vec3, Vec3)| (b - a).normalize().y == 1.0;
    let inner = |(a, _): &(Vec3, Vec3)| a.x == 1.0 && a.z == 1.0;
    let edges = pushing_edges(&l.polyhedra);
    assert!(!edges.iter().any(|edge| along_y(edge) && inner(edge)), "the concave edge");
    assert_eq!(edges.iter().filter(|edge| along_y(edge)).count(), 5, "the outer ones");
    let corners = pushing_vertices(&l.polyhedra);
    assert_eq!(corners.len(), 10, "an L has 12 corners, two of them inner");
    assert!(!corners.iter().any(|(place, _)| place == &text(&Vec3::new(1.0, 0.0, 1.0))));
}

#[test]
fn a_step_keeps_the_edges_of_both_heights() {
    // The taller box is flush with the lower one on one side only in part: internal faces overlap, edges do
    // not match.
    let model = load(&model_of(&format!(
        "{},\n{}",
        cube("low", [0.0; 3], [1.0; 3], "[3]"),
        cube("tall", [1.0, -1.0, 0.0], [2.0, 2.0, 1.0], "[5]")
    )));
    assert_eq!(model.bodies[0].shell_count, 1);
    assert!(model.warnings.is_empty());
}

#[test]
fn an_inactive_face_without_a_twin_is_told_and_its_rim_never_pushes() {
    let found = warnings(&cube("c", [0.0; 3], [1.0; 3], "[1]"));
    assert_eq!(found.len(), 1);
    assert!(found[0].contains("root/c/faces[1]") && found[0].contains("twin"), "{found:?}");
    let model = load(&model_of(&cube("c", [0.0; 3], [1.0; 3], "[1]")));
    let piece = &model.bodies[0].polyhedra;
    assert!(!piece[0].faces.iter().any(|face| face.closed));
    assert_eq!(pushing_edges(piece).len(), 8);
    assert_eq!(pushing_vertices(piece).len(), 4);
}

#[test]
fn touching_pieces_with_active_faces_are_two_surfaces() {
    let two = body(&format!(
        "{},\n{}",
        cube("a", [0.0; 3], [1.0; 3], "[]"),
        cube("b", [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], "[]")
    ));
    assert_eq!(two.shell_count, 2);
    assert_eq!(pushing_edges(&two.polyhedra).len(), 24);
}

#[test]
fn walls_that_meet_only_in_an_edge_are_no_twins() {
    let found = warnings(&format!(
        "{},\n{}",
        cube("a", [0.0; 3], [1.0; 3], "[3]"),
        cube("b", [1.0, 1.0, 0.0], [2.0, 2.0, 1.0], "[5]")
    ));
    assert_eq!(found.len(), 2, "{found:?}");
}

/// Points on a sphere, and the hull's triangles by brute force.
fn fibonacci_hull(count: usize, round: bool) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let place = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let turn = i as f64 * 2.399_963_229_728_653;
        let r = (1.0 - z * z).sqrt();
        let p = [0.5 * r * turn.cos(), 0.4 * r * turn.sin(), 0.3 * z];
        if round { p.map(|x| f64::from(x as f32)) } else { p }
    };
    let points: Vec<[f64; 3]> = (0..count).map(place).collect();
    let v = |i: usize| Vec3::from(points[i]);
    let mut faces = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            for c in a + 1..count {
                let n = (v(b) - v(a)).cross(&(v(c) - v(a)));
                if b != c && (0..count).all(|d| [a, b, c].contains(&d) || n.dot(&(v(d) - v(a))) <= 0.0) {
                    faces.push([a, b, c]);
                }
            }
        }
    }
    (points, faces)
}

fn polyhedron(points: &[[f64; 3]], faces: &[impl std::fmt::Debug]) -> String {
    let points: Vec<_> = points.iter().map(|[x, y, z]| format!("({x:?}, {y:?}, {z:?})")).collect();
    format!("Polyhedron(name: \"h\", vertices: [{}], faces: {faces:?})", points.join(", "))
}

#[test]
fn hulls_rounded_to_f32_are_accepted_at_every_size() {
    for scale in [1e-4, 1.0, 1e4] {
        for count in [8, 18, 66] {
            let (points, faces) = fibonacci_hull(count, true);
            let points: Vec<_> = points.iter().map(|p| p.map(|x| f64::from((x * scale) as f32))).collect();
            let hull = body(&polyhedron(&points, &faces));
            assert_eq!(hull.polyhedra[0].faces.len(), 2 * count - 4);
            assert_eq!(pushing_edges(&hull.polyhedra).len(), 3 * count - 6);
            assert_eq!(pushing_vertices(&hull.polyhedra).len(), count);
        }
    }
}

/// Prism over a polygon, rotated so that nothing is exact, rounded to `f32`, its sides and caps triangulated.
fn rough_prism(corners: usize, height: f64, fan: bool) -> String {
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, 0.5, 0.7);
    let place = |i: usize, z: f64| {
        let angle = std::f64::consts::TAU * i as f64 / corners as f64;
        let p = turn * Vec3::new(angle.cos(), angle.sin(), z);
        [p.x, p.y, p.z].map(|x| f64::from(x as f32))
    };
    let points: Vec<_> =
        (0..corners).map(|i| place(i, 0.0)).chain((0..corners).map(|i| place(i, height))).collect();
    let mut faces: Vec<Vec<usize>> = Vec::new();
    for i in 0..corners {
        let j = (i + 1) % corners;
        faces.push(vec![i, j, corners + j]);
        faces.push(vec![i, corners + j, corners + i]);
    }
    for i in 1..corners - 1 {
        // A fan, or a zigzag with its many slivers.
        let t = if fan { [0, i, i + 1] } else { zigzag(i, corners) };
        faces.push(vec![t[2], t[1], t[0]]);
        faces.push(t.iter().map(|v| v + corners).collect());
    }
    polyhedron(&points, &faces)
}

fn zigzag(step: usize, corners: usize) -> [usize; 3] {
    let (low, high) = ((step - 1).div_ceil(2), corners - 1 - (step - 1) / 2);
    if step % 2 == 1 { [low, low + 1, high] } else { [low, high - 1, high] }
}

#[test]
fn triangulated_prisms_rounded_to_f32_have_their_faces_back() {
    for corners in [3, 6, 24, 100] {
        for fan in [true, false] {
            let prism = body(&rough_prism(corners, 1.0, fan));
            let piece = &prism.polyhedra[0];
            assert_eq!(piece.faces.len(), corners + 2, "{corners} {fan}");
            assert_eq!((piece.edges.len(), piece.vertices.len()), (3 * corners, 2 * corners));
            assert!(piece.edges.iter().all(|edge| edge.push.is_some()));
            assert!(piece.vertices.iter().all(|v| v.pushes));
        }
    }
}

#[test]
fn a_vertex_within_a_flat_face_or_edge_never_pushes() {
    // One side of the cube is a fan around its middle, and one edge has an additional vertex.
    let vertices = cube_vertices([0.0; 3], [1.0; 3]).replace(']', ", (0.5,0.5,1), (0.5,0,0)]");
    let faces =
        "[[0,3,2,1,9], [4,5,8],[5,6,8],[6,7,8],[7,4,8], [0,9,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]]";
    let one = body(&format!("Polyhedron(name: \"h\", vertices: {vertices}, faces: {faces})"));
    let piece = &one.polyhedra[0];
    assert_eq!((piece.faces.len(), piece.vertices.len(), piece.edges.len()), (6, 9, 13));
    assert_eq!(pushing_vertices(&one.polyhedra).len(), 8);
    assert_eq!(edge_lines(&one.polyhedra), edge_lines(&body(&cube("c", [0.0; 3], [1.0; 3], "[]")).polyhedra));
}

#[test]
fn repeated_vertices_of_a_polyhedron_are_merged() {
    let vertices = cube_vertices([0.0; 3], [1.0; 3]).replace(']', ", (-0.0,0,0)]");
    let faces = CUBE_FACES.replace("[0,1,5,4]", "[8,1,5,4]");
    let one = body(&format!("Polyhedron(name: \"h\", vertices: {vertices}, faces: {faces})"));
    assert_eq!(one.polyhedra[0].vertices.len(), 8);
}

const SQUARE: &str = "vertices: [(0,0,0),(1,0,0),(1,1,0),(0,1,0)], triangles: [(0,1,2),(0,2,3)]";

#[test]
fn triangles_are_welded_across_leaves_and_primitives() {
    let text = "(format: \"pong-model\", version: 1, name: \"m\", surfaces: { \"s\": (stiffness: 1) },\n\
        root: (name: \"root\", surface: \"s\", groups: [\n\
        (name: \"a\", primitives: [Triangle(name: \"t\", vertices: ((0,0,0),(1,0,0),(0,1,0)))]),\n\
        (name: \"b\", pose: (position: (1,0,0)), primitives: [\n\
        Triangle(name: \"t\", vertices: ((0,0,0),(0,1,0),(-1,1,0)))])]))";
    let model: Model = load(text);
    let set = &model.bodies[0].triangles;
    assert_eq!((set.vertices.len(), model.bodies[0].shell_count), (4, 1));
    assert_eq!(set.triangles[0].neighbors, [NO_NEIGHBOR, 1, NO_NEIGHBOR]);
    assert_eq!(set.triangles[1].neighbors.iter().filter(|&&n| n == 0).count(), 1);
}

#[test]
fn negative_zero_is_zero() {
    let one = body(
        "Triangle(name: \"a\", vertices: ((0,0,0),(1,0,0),(0,1,0))),\n\
         Triangle(name: \"b\", vertices: ((-0.0,-0.0,0),(-1,0,-0.0),(0,-1,0)))",
    );
    assert_eq!((one.triangles.vertices.len(), one.shell_count), (5, 1));
    assert!(one.triangles.vertices.iter().all(|v| v.iter().all(|x| x.to_bits() != (-0.0_f64).to_bits())));
}

#[test]
fn triangles_that_share_a_vertex_only_are_one_shell_without_being_neighbors() {
    let one = body(
        "Triangle(name: \"a\", vertices: ((0,0,0),(1,0,0),(0,1,0))),\n\
         Triangle(name: \"b\", vertices: ((0,0,0),(-1,0,0),(0,-1,0))),\n\
         Sphere(name: \"c\", center: (0,0,0), radius: 1),\n\
         Triangle(name: \"d\", vertices: ((9,0,0),(8,0,0),(9,-1,0)))",
    );
    assert_eq!(one.shell_count, 3);
    let shells: Vec<_> = one.triangles.triangles.iter().map(|t| t.shell).collect();
    assert_eq!(shells, [0, 0, 2]);
    assert_eq!(one.primitives.iter().map(|p| p.shell).collect::<Vec<_>>(), [0, 0, 1, 2]);
    assert!(one.triangles.triangles.iter().all(|t| t.neighbors == [NO_NEIGHBOR; 3]));
}

#[test]
fn a_two_sided_mesh_has_a_mirror_image_of_its_own() {
    let one = body(&format!("TriangleMesh(name: \"m\", {SQUARE}, two_sided: true)"));
    let info = &one.primitives[0];
    assert_eq!((info.elements.clone(), info.first_mirror, one.shell_count), (0..4, 2, 2));
    for k in 0..2 {
        let (front, mirror) = (one.triangles.normal(k), one.triangles.normal(k + 2));
        assert_eq!(front, -mirror);
        let mut corners = one.triangles.triangles[k as usize].vertices;
        let mut mirrored = one.triangles.triangles[k as usize + 2].vertices;
        corners.sort_unstable();
        mirrored.sort_unstable();
        assert_eq!(corners, mirrored);
    }
    assert!(one.triangles.triangles[0].neighbors.contains(&1));
    assert!(one.triangles.triangles[2].neighbors.contains(&3));
    assert_eq!(one.triangles.triangles.iter().map(|t| t.shell).collect::<Vec<_>>(), [0, 0, 1, 1]);
    assert_eq!(one.tree.items.len(), 4);
}

#[test]
fn an_edge_of_three_triangles_is_free_and_told() {
    let crowd = "Triangle(name: \"a\", vertices: ((0,0,0),(1,0,0),(0,1,0))),\n\
         Triangle(name: \"b\", vertices: ((1,0,0),(0,0,0),(0,-1,0))),\n\
         Triangle(name: \"c\", vertices: ((1,0,0),(0,0,0),(0,0,1)))";
    let found = warnings(crowd);
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("test.ron:3: root/a: 3 triangles share an edge"), "{found:?}");
    let model = load(&model_of(crowd));
    assert!(model.bodies[0].triangles.triangles.iter().all(|t| t.neighbors == [NO_NEIGHBOR; 3]));
}

#[test]
fn triangles_wound_against_each_other_are_no_neighbors_and_told() {
    let found = warnings(
        "TriangleMesh(name: \"m\", vertices: [(0,0,0),(1,0,0),(1,1,0),(0,1,0)], triangles: [(0,1,2),(0,3,2)])",
    );
    assert_eq!(found.len(), 1);
    assert!(
        found[0].contains("root/m/triangles[0]") && found[0].contains("root/m/triangles[1]"),
        "{found:?}"
    );
}

#[test]
fn a_vertex_within_a_free_edge_is_told_once_and_nowhere_else() {
    let found = warnings(
        "TriangleMesh(name: \"m\", vertices: [(0,0,0),(2,0,0),(1,2,0),(1,0,0),(0,-1,0),(2,-1,0)],\n\
        triangles: [(0,1,2),(0,4,3),(3,5,1),(3,4,5)])",
    );
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("T-junction") && found[0].contains("(1, 0, 0)"), "{found:?}");
    assert!(found[0].contains("root/m/triangles[0]"));
    assert!(warnings(&format!("TriangleMesh(name: \"m\", {SQUARE})")).is_empty());
}

#[test]
fn t_junctions_are_found_at_any_place_and_size() {
    for (scale, at) in [(1e-4, 0.0), (1.0, 1.0), (1e4, -3e4)] {
        let p = |x: f64, y: f64| format!("({:?},{:?},{:?})", at + scale * x, scale * y, scale * (x + y));
        let mesh = format!(
            "TriangleMesh(name: \"m\", vertices: [{},{},{},{},{}], triangles: [(0,1,2),(0,3,4)])",
            p(0.0, 0.0),
            p(4.0, 4.0),
            p(0.0, 4.0),
            p(4.0, 0.0),
            p(1.0, 1.0)
        );
        assert_eq!(warnings(&mesh).len(), 1, "{scale} {at}");
    }
}

#[test]
fn large_leaves_are_split_and_everything_stays_inside_its_volume() {
    for bound in ["Aabb", "Sphere", "Obb"] {
        let balls: Vec<_> = (0..700_u32)
            .map(|i| {
                let f = |p: u32| f64::from(i.wrapping_mul(p) % 1009) / 100.0;
                format!(
                    "Sphere(name: \"b{i}\", center: ({:?},{:?},{:?}), radius: 0.1)",
                    f(7919),
                    f(104_729),
                    f(31)
                )
            })
            .collect();
        let text = model_of(&balls.join(",\n"))
            .replace("surface: \"steel\"", &format!("bound: {bound}, surface: \"steel\""));
        let model = load(&text);
        let body = &model.bodies[0];
        check_tree(body, 0, &mut BTreeSet::new());
        assert_eq!(body.tree.items.iter().map(|i| i.element).collect::<BTreeSet<_>>().len(), 700);
        assert_eq!(body.tree.nodes.len(), 1, "one authored group, one node");
        assert_eq!(body.tree.nodes[0].volume.kind_name(), bound);
        check_batch(body, &body.tree.batches[0]);
        assert_eq!(model.hash, load(&text).hash);
        assert!(load(&text).bodies[0].tree.items == body.tree.items);
    }
}

/// Every sphere lies in its batch's box, and in the lane given by its index.
fn check_batch(body: &MovableGroup, batch: &pong_model::Batch) {
    batch.boxes.visit(Portable, &NarrowBox::EVERYTHING, |node, met| {
        for lane in lanes(met) {
            let Child::Element(place) = node.child(lane) else { panic!("a bottom node") };
            let item = body.tree.items[(batch.items.start + place) as usize];
            let ball = &body.spheres[item.element as usize];
            let one = batch
                .boxes
                .narrowed(&ball.center.add_scalar(-ball.radius), &ball.center.add_scalar(ball.radius));
            assert!(node.boxes.lane(lane).join(&one) == node.boxes.lane(lane), "{item:?}");
            let (eight, lane) = (&batch.spheres[place as usize / 8], place as usize % 8);
            assert_eq!((eight.centers.x[lane], eight.radii[lane]), (ball.center.x, ball.radius));
        }
    });
}

/// Line segments and capsules are in lanes, in the order of the box tree, with the values of the model.
#[test]
fn rods_stand_in_the_lanes_of_their_places() {
    let at = |i: u32, p: u32| f64::from((i + 1).wrapping_mul(p) % 1009) / 100.0;
    let ends = |i: u32| {
        let corner = |p: [u32; 3]| format!("({:?},{:?},{:?})", at(i, p[0]), at(i, p[1]), at(i, p[2]));
        format!("ends: ({},{})", corner([7919, 104_729, 31]), corner([101, 17, 6007]))
    };
    let rods: Vec<_> = (0..75)
        .map(|i| match i % 2 {
            0 => format!("LineSegment(name: \"r{i}\", {})", ends(i)),
            _ => format!("Capsule(name: \"r{i}\", {}, radius: {:?})", ends(i), 0.01 + at(i, 53)),
        })
        .collect();
    let model = load(&model_of(&rods.join(",\n")));
    let body = &model.bodies[0];
    let batches = body.tree.batches.iter().filter(|batch| !batch.segments.is_empty());
    let mut seen = 0;
    for batch in batches {
        let items = &body.tree.items[batch.items.start as usize..batch.items.end as usize];
        assert_eq!(batch.segments.len(), items.len().div_ceil(8));
        for place in 0..8 * batch.segments.len() {
            let (eight, lane) = (&batch.segments[place / 8], place % 8);
            // Unused lanes repeat the last element.
            let element = items[place.min(items.len() - 1)].element as usize;
            let (ends, radius) = match batch.kind {
                PrimitiveKind::LineSegment => (body.segments[element].ends, 0.0),
                _ => (body.capsules[element].ends, body.capsules[element].radius),
            };
            let of_lane = eight.ends.map(|ends| ends.get(lane));
            assert_eq!((of_lane, eight.radii[lane]), (ends, radius), "{:?} {place}", batch.kind);
            seen += usize::from(place < items.len());
        }
    }
    assert_eq!(seen, 75);
}

/// Checks every volume below a node; returns the items below.
fn check_tree(body: &MovableGroup, node: usize, seen: &mut BTreeSet<usize>) -> Vec<usize> {
    use pong_geometry::bounding::Volume;
    assert!(seen.insert(node));
    let n = &body.tree.nodes[node];
    assert!(n.children.is_empty() != n.items.is_empty());
    let mut items: Vec<usize> = n.items.clone().map(|i| i as usize).collect();
    for child in n.children.clone() {
        assert!(child as usize > node);
        items.extend(check_tree(body, child as usize, seen));
    }
    for &item in &items {
        let ball = &body.spheres[body.tree.items[item].element as usize];
        let r = ball.radius;
        let inside = match &n.volume {
            Volume::Aabb { center, half } => {
                (0..3).all(|i| (ball.center[i] - center[i]).abs() + r <= half[i])
            }
            Volume::Sphere { center, radius } => (ball.center - center).norm() + r <= *radius,
            Volume::Obb { center, axes, half } => {
                let local = axes.tr_mul(&(ball.center - center));
                (0..3).all(|i| local[i].abs() + r <= half[i])
            }
            _ => false,
        };
        assert!(inside, "{node} {item} {:?}", n.volume);
    }
    items
}

#[test]
fn a_plane_makes_its_leaf_and_all_above_unbounded_but_not_its_neighbours() {
    let balls: Vec<_> =
        (0..40).map(|i| format!("Sphere(name: \"b{i}\", center: ({i},0,0), radius: 0.1)")).collect();
    let text = format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1) }},\n\
         root: (name: \"root\", surface: \"s\", groups: [\n\
         (name: \"a\", bound: Aabb, primitives: [Plane(name: \"p\", normal: (0,0,1), offset: 0), {}]),\n\
         (name: \"b\", bound: Aabb, primitives: [Point(name: \"p\", position: (0,0,0))]),\n\
         (name: \"c\", groups: [(name: \"d\", movable: true, primitives: [Plane(name: \"p\", normal: (0,0,1), offset: 0)])])]))",
        balls.join(", ")
    );
    let model = load(&text);
    let tree = &model.bodies[0].tree;
    let unbounded =
        |i: u32| matches!(tree.nodes[i as usize].volume, pong_geometry::bounding::Volume::Unbounded);
    assert!(unbounded(0));
    assert_eq!(tree.nodes[0].children, 1..3, "c holds nothing of this body");
    assert!(unbounded(1) && !unbounded(2));
    let everywhere = |i: u32| tree.batches[i as usize].boxes.around == NarrowBox::EVERYTHING;
    let below: Vec<_> =
        tree.nodes[1].batches.clone().map(|i| (tree.batches[i as usize].kind, everywhere(i))).collect();
    assert_eq!(below, [(PrimitiveKind::Sphere, false), (PrimitiveKind::Plane, true)]);
    assert_eq!(tree.items.len(), 42);
}

#[test]
fn a_body_without_geometry_has_an_empty_leaf() {
    let model = load(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: { \"s\": (stiffness: 1) },\n\
         root: (name: \"root\", surface: \"s\", groups: [(name: \"a\", movable: true, primitives: [Point(name: \"p\", position: (0,0,0))])]))",
    );
    let tree = &model.bodies[0].tree;
    assert_eq!((tree.nodes.len(), tree.items.len()), (1, 0));
    assert_eq!(model.bodies[1].tree.items.len(), 1);
}

#[test]
fn the_hash_knows_what_decides_the_numbers_and_nothing_else() {
    let text = model_of(&cube("c", [0.0; 3], [1.0; 3], "[]"));
    let hash = |text: &str| load(text).hash;
    assert_eq!(hash(&text), 0xa745_5f68_b962_ec36, "stable on every machine and from version to version");
    assert_eq!(hash(&text), hash(&text.replace("\"c\"", "\"other name\"")));
    assert_eq!(hash(&text), hash(&text.replace("surface:", "bound: Obb, surface:")));
    for (old, new) in
        [("1e6", "2e6"), ("1.0,1.0,1.0", "1.0,1.0000001,1.0"), ("inactive_faces: []", "inactive_faces: [1]")]
    {
        assert_ne!(hash(&text), hash(&text.replace(old, new)), "{old}");
    }
    assert_ne!(hash(&text), hash(&text.replace("version: 1,", "version: 1, entry_memory: false,")));
}

#[test]
fn volumes_have_room_for_radius_reach_and_thickness() {
    use pong_geometry::bounding::Volume;
    let extent = |primitive: &str| {
        let Volume::Aabb { center, half } = body(primitive).tree.nodes[0].volume else { panic!() };
        (center - half, center + half)
    };
    let near = |a: Vec3, b: [f64; 3]| (a - Vec3::from(b)).norm() < 1e-9;
    let (low, high) = extent("Ray(name: \"r\", origin: (0,0,0), direction: (0,0,1), length: 2, reach: 0.5)");
    assert!(near(low, [0.0, 0.0, -0.5]) && near(high, [0.0, 0.0, 2.0]));
    let (low, high) = extent("Triangle(name: \"t\", vertices: ((0,0,0),(1,0,0),(0,1,0)), thickness: 0.25)");
    // Half a sphere behind the front: a ray that still hits may start beside the prism.
    assert!(near(low, [-0.25, -0.25, -0.25]) && near(high, [1.25, 1.25, 0.0]), "{low} {high}");
    let (low, high) = extent(
        "Ellipsoid(name: \"e\", center: (1,0,0), semi_axes: (3,2,1), \
         orientation: (0.7071067811865476,0,0,0.7071067811865476))",
    );
    // A triangle may push it at a foot beside it, as far from the centre as √((3 − 1)² + 1²).
    let feet = 5.0_f64.sqrt();
    assert!(near(low, [1.0 - feet, -3.0, -feet]) && near(high, [1.0 + feet, 3.0, feet]), "{low} {high}");
}

/// Piece under a triangle with its lowest corner on the axis: a slice of a spire.
fn slice(name: &str, [a, b]: [[f64; 2]; 2], inactive: &str) -> String {
    let ([ax, ay], [bx, by]) = (a, b);
    format!(
        "Polyhedron(name: \"{name}\", vertices: [(0,0,0), ({ax:?},{ay:?},0), ({bx:?},{by:?},0), (0,0,1)], \
         faces: [[0,2,1], [1,2,3], [0,1,3], [2,0,3]], inactive_faces: {inactive})"
    )
}

#[test]
fn a_ridge_shared_by_two_pieces_pushes_once_between_the_faces_of_both() {
    let whole = body(
        "Polyhedron(name: \"roof\", vertices: [(-1,0,0),(1,0,0),(0,0,1),(-1,3,0),(1,3,0),(0,3,1)], \
         faces: [[0,1,2],[4,3,5],[0,3,4,1],[1,4,5,2],[3,0,2,5]])",
    );
    let halves = body(
        "Polyhedron(name: \"left\", vertices: [(-1,0,0),(0,0,0),(0,0,1),(-1,3,0),(0,3,0),(0,3,1)], \
         faces: [[0,1,2],[4,3,5],[0,3,4,1],[1,4,5,2],[3,0,2,5]], inactive_faces: [3]),\n\
         Polyhedron(name: \"right\", vertices: [(0,0,0),(1,0,0),(0,0,1),(0,3,0),(1,3,0),(0,3,1)], \
         faces: [[0,1,2],[4,3,5],[0,3,4,1],[1,4,5,2],[3,0,2,5]], inactive_faces: [4])",
    );
    assert_eq!(edge_lines(&halves.polyhedra), edge_lines(&whole.polyhedra));
    let places = |body: &MovableGroup| {
        pushing_vertices(&body.polyhedra).into_iter().map(|(at, _)| at).collect::<Vec<_>>()
    };
    assert_eq!(places(&halves), places(&whole));
    let of_piece = |piece| pushing_vertices(std::slice::from_ref(piece)).len();
    let pushing: Vec<_> = halves.polyhedra.iter().map(of_piece).collect();
    assert_eq!(pushing, [4, 2], "common corners belong to the lower piece");
}

#[test]
fn the_tip_of_a_spire_with_grooves_pushes_and_its_grooves_do_not() {
    let corners = [
        [1.0, 0.0],
        [0.2, 0.2],
        [0.0, 1.0],
        [-0.2, 0.2],
        [-1.0, 0.0],
        [-0.2, -0.2],
        [0.0, -1.0],
        [0.2, -0.2],
    ];
    let slices: Vec<_> =
        (0..8).map(|i| slice(&format!("s{i}"), [corners[i], corners[(i + 1) % 8]], "[2, 3]")).collect();
    let spire = body(&slices.join(",\n"));
    assert_eq!(spire.shell_count, 1);
    let at_tip = |(place, _): &&(String, BTreeSet<String>)| place == &text(&Vec3::z());
    let vertices = pushing_vertices(&spire.polyhedra);
    assert_eq!(vertices.iter().find(at_tip).map(|(_, cone)| cone.len()), Some(8));
    let steep = pushing_edges(&spire.polyhedra).iter().filter(|(a, b)| a.z != b.z).count();
    assert_eq!(steep, 4, "four ridges, four grooves");
}

#[test]
fn the_tip_of_a_leaning_spire_pushes_though_the_mean_normal_does_not_suit_it() {
    let corners = [[0.2, 0.1], [-0.4, 0.9], [-0.1, 0.1], [0.3, -0.9], [0.2, -0.2], [0.4, 0.0]];
    let leaning = |i: usize| {
        let upright = slice(&format!("s{i}"), [corners[i], corners[(i + 1) % 6]], "[2, 3]");
        upright.replace("(0,0,1)", "(-3,-3,1)")
    };
    let spire = body(&(0..6).map(leaning).collect::<Vec<_>>().join(",\n"));
    let tip = text(&Vec3::new(-3.0, -3.0, 1.0));
    assert_eq!(pushing_vertices(&spire.polyhedra).iter().filter(|(place, _)| *place == tip).count(), 1);
}

#[test]
fn a_vertex_of_an_inactive_face_pushes_where_three_active_faces_meet() {
    let pyramid = |inactive: &str| {
        let model = load(&model_of(&format!(
            "Polyhedron(name: \"p\", vertices: [(0,0,0),(1,0,0),(1,1,0),(0,1,0),(0.5,0.5,1)], \
             faces: [[0,3,2,1],[0,1,4],[1,2,4],[2,3,4],[3,0,4]], inactive_faces: {inactive})"
        )));
        pushing_vertices(&model.bodies[0].polyhedra)
    };
    assert_eq!(pyramid("[]").len(), 5);
    let one = pyramid("[1]");
    assert_eq!(one.len(), 3, "the tip and the two far corners");
    assert!(one.iter().all(|(_, cone)| cone.len() >= 3));
    assert_eq!(pyramid("[1, 3]").len(), 0);
}

#[test]
fn slivers_whose_normals_are_noise_merge_into_their_face() {
    // The top has a vertex 3e-8 beside the middle of an edge and 6e-8 below the plane.
    let vertices = cube_vertices([0.0; 3], [1.0; 3]).replace(']', ", (0.5, 3e-8, 0.99999994)]");
    let faces = "[[0,3,2,1], [4,5,8],[5,6,8],[6,7,8],[7,4,8], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]]";
    let one = body(&format!("Polyhedron(name: \"h\", vertices: {vertices}, faces: {faces})"));
    assert_eq!(one.polyhedra[0].faces.len(), 6);
    assert_eq!(pushing_vertices(&one.polyhedra).len(), 8);
}
