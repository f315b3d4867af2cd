//! Side of entry (docs/theory.md, 2.2 and 2.4).

use crate::common::*;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const K: f64 = 1e5;

fn steel() -> String {
    surface(K, "")
}

fn tip() -> String {
    model("tip", &steel(), "Point(name: \"p\", position: (0,0,0))")
}

fn ball(radius: f64) -> String {
    model("ball", &steel(), &format!("Sphere(name: \"s\", center: (0,0,0), radius: {radius:?})"))
}

/// A wall 10 mm thick, its faces normal to x.
fn wall() -> String {
    model("wall", &steel(), &box_polyhedron("w", [0.0, 0.0, 0.0], [0.005, 0.5, 0.5], ""))
}

fn push_at(rig: &mut Rig, x: f64) -> Vec3 {
    rig.place_a(Vec3::new(x, 0.01, 0.02), Quat::identity());
    rig.world.step().unwrap();
    rig.wrench(0).force
}

/// A point pushed through a plate is pushed back to its side of entry until it has left.
#[test]
fn a_point_is_pushed_back_to_its_side_of_entry() {
    for from in [-1.0, 1.0] {
        let mut rig = Rig::new(&tip(), &wall());
        push_at(&mut rig, from * 0.006);
        for step in 0..9 {
            let depth = 1e-3 * (f64::from(step) + 0.5);
            let force = push_at(&mut rig, from * (0.005 - depth));
            // Two surfaces of equal stiffness in series.
            assert!((force.x * from - 0.5 * K * depth).abs() < 1e-9, "{from} {depth}: {force:?}");
        }
        // Out on the other side: no contact; back in from there: pushed to that side.
        assert_eq!(push_at(&mut rig, -from * 0.0051), Vec3::zeros());
        assert!(push_at(&mut rig, -from * 0.0049).x * -from > 0.0);
    }
}

#[test]
fn a_sphere_whose_centre_goes_under_keeps_its_side() {
    let mut rig = Rig::new(&ball(0.02), &wall());
    for step in 0..30 {
        let x = 0.024 - 1e-3 * f64::from(step);
        let force = push_at(&mut rig, x);
        let expected = if x > -0.005 { 0.5 * K * (0.025 - x) } else { f64::NAN };
        if expected.is_finite() {
            assert!((force.x - expected).abs() < 1e-9 * K, "x = {x}: {force:?}");
        }
    }
}

/// After a clear, or a frame in which the pair was off, there is no earlier position and no path: the nearest
/// face pushes.
#[test]
fn what_has_no_past_came_in_by_the_nearest_face() {
    for switch_off in [false, true] {
        let mut rig = Rig::new(&tip(), &wall());
        push_at(&mut rig, -0.006);
        if switch_off {
            rig.world.set_pair_enabled(rig.pair, false).unwrap();
            rig.world.step().unwrap();
            rig.world.set_pair_enabled(rig.pair, true).unwrap();
        } else {
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
        }
        let force = push_at(&mut rig, 0.004);
        assert!((force.x - 0.5 * K * 1e-3).abs() < 1e-9, "{switch_off}: {force:?}");
    }
}

#[test]
fn without_memory_the_least_deep_face_pushes() {
    let forgetful =
        wall().replace("name: \"wall\", surfaces", "name: \"wall\", entry_memory: false, surfaces");
    let mut rig = Rig::new(&tip(), &forgetful);
    push_at(&mut rig, -0.006);
    assert!(push_at(&mut rig, -0.001).x < 0.0);
    assert!(push_at(&mut rig, 0.001).x > 0.0);
}

/// Fast through an active face and on through the internal face within one frame: the face of entry counts.
#[test]
fn the_face_of_entry_is_found_through_inner_walls() {
    let pieces = [
        box_polyhedron("near", [-0.5, 0.0, 0.0], [0.5, 0.5, 0.5], "5"),
        box_polyhedron("far", [0.5, 0.0, 0.0], [0.5, 0.5, 0.5], "4"),
    ];
    let body = model("pieces", &steel(), &pieces.join(","));
    let mut rig = Rig::new(&tip(), &body);
    let mut put = |x: f64, z: f64| {
        rig.place_a(Vec3::new(x, 0.0, z), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force
    };
    put(-0.3, 0.8);
    // Through the top of the near piece, then through the internal face: the far piece pushes up as well.
    let force = put(0.2, 0.3);
    assert!((force - Vec3::new(0.0, 0.0, 0.5 * K * 0.2)).norm() < 1e-6, "{force:?}");
    let force = put(-0.2, 0.3);
    assert!((force - Vec3::new(0.0, 0.0, 0.5 * K * 0.2)).norm() < 1e-6, "{force:?}");
}

/// Out of one piece and into another within one frame: the old face of entry is dropped for the new one.
#[test]
fn leaving_one_piece_ends_the_memory_before_another_is_entered() {
    // A step: the low piece ends where the tall one begins; its internal face is the lower part of the tall
    // one's side.
    let low = "Polyhedron(name: \"low\", vertices: [(-1,-1,-1),(0,-1,-1),(0,1,-1),(-1,1,-1),(-1,-1,0),(0,-1,0),(0,1,0),(-1,1,0)], \
               faces: [[0,3,2,1],[4,5,6,7],[0,1,5,4],[2,3,7,6],[0,4,7,3],[1,2,6,5]], inactive_faces: [5])";
    let base = "Polyhedron(name: \"base\", vertices: [(0,-1,-1),(1,-1,-1),(1,1,-1),(0,1,-1),(0,-1,0),(1,-1,0),(1,1,0),(0,1,0)], \
                faces: [[0,3,2,1],[4,5,6,7],[0,1,5,4],[2,3,7,6],[0,4,7,3],[1,2,6,5]], inactive_faces: [4,1])";
    let top = "Polyhedron(name: \"top\", vertices: [(0,-1,0),(1,-1,0),(1,1,0),(0,1,0),(0,-1,1),(1,-1,1),(1,1,1),(0,1,1)], \
               faces: [[0,3,2,1],[4,5,6,7],[0,1,5,4],[2,3,7,6],[0,4,7,3],[1,2,6,5]], inactive_faces: [0])";
    let body = model("step", &steel(), &[low, base, top].join(","));
    let mut rig = Rig::new(&tip(), &body);
    let mut put = |x: f64, z: f64| {
        rig.place_a(Vec3::new(x, 0.0, z), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force
    };
    put(-0.2, 0.05);
    assert!((put(-0.2, -0.05) - Vec3::new(0.0, 0.0, 0.5 * K * 0.05)).norm() < 1e-6);
    // Up through the low top face, then through the riser: pushed out of the riser.
    let force = put(0.05, 0.2);
    assert!((force - Vec3::new(-0.5 * K * 0.05, 0.0, 0.0)).norm() < 1e-6, "{force:?}");
}

/// From one wall of a trough into the other within one frame, across the gap: the side of entry of the first
/// wall, which faces the other way, does not apply to the second.
#[test]
fn across_a_gap_the_memory_of_the_first_wall_ends() {
    let piece = |name, x: f64, z: f64, half_x: f64, inner| {
        box_polyhedron(name, [x, 0.0, z], [half_x, 1.0, 0.5], inner)
    };
    let pieces = [
        piece("left_base", -1.5, -0.5, 0.5, "5, 1"),
        piece("middle", 0.0, -0.5, 1.0, "4, 5"),
        piece("right_base", 1.5, -0.5, 0.5, "4, 1"),
        piece("left", -1.5, 0.5, 0.5, "0"),
        piece("right", 1.5, 0.5, 0.5, "0"),
    ];
    let mut rig = Rig::new(&tip(), &model("trough", &steel(), &pieces.join(",")));
    let mut put = |x: f64| {
        rig.place_a(Vec3::new(x, 0.0, 0.5), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force
    };
    put(0.0);
    let push = Vec3::new(0.5 * K * 0.05, 0.0, 0.0);
    assert!((put(-1.05) - push).norm() < 1e-6);
    let force = put(1.05);
    assert!((force + push).norm() < 1e-6, "{force:?}");
}

/// The side of entry follows a faceted curve, but never goes round a sharp rim.
#[test]
fn memory_follows_a_faceted_curve() {
    // A prism of 24 sides: a drum of radius 0.5 around y.
    let n = 24;
    let mut vertices = Vec::new();
    for i in 0..n {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        for y in [-0.5, 0.5] {
            vertices.push(format!("({:?},{y:?},{:?})", 0.5 * angle.cos(), 0.5 * angle.sin()));
        }
    }
    let mut faces: Vec<String> = (0..n)
        .map(|i| {
            let j = (i + 1) % n;
            format!("[{},{},{},{}]", 2 * i, 2 * i + 1, 2 * j + 1, 2 * j)
        })
        .collect();
    let low: Vec<String> = (0..n).map(|i| (2 * i).to_string()).collect();
    let high: Vec<String> = (0..n).rev().map(|i| (2 * i + 1).to_string()).collect();
    faces.push(format!("[{}]", low.join(",")));
    faces.push(format!("[{}]", high.join(",")));
    let drum =
        format!("Polyhedron(name: \"d\", vertices: [{}], faces: [{}])", vertices.join(","), faces.join(","));
    let drum = model("drum", &steel(), &drum);
    let mut rig = Rig::new(&tip(), &drum);
    let mut around = |angle: f64, radius: f64, y: f64| {
        rig.place_a(Vec3::new(radius * angle.cos(), y, radius * angle.sin()), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force
    };
    around(0.1, 0.51, 0.0);
    for step in 0..400 {
        let angle = 0.1 + 0.02 * f64::from(step);
        let force = around(angle, 0.45, 0.0);
        let outward = Vec3::new(angle.cos(), 0.0, angle.sin());
        assert!(force.normalize().dot(&outward) > 0.99, "{angle}: {force:?}");
    }
    // Deep towards the end cap, but never pushed out of it while the side of entry is another neighbour.
    let force = around(0.1 + 0.02 * 400.0, 0.45, 0.2);
    assert!(force.y.abs() < 1e-9);
}

fn sheet() -> String {
    let mesh = plate_mesh("m", 6, 1.0, |x, y| Vec3::new(0.0, x, y));
    model("sheet", &steel(), &mesh)
}

/// The front of `sheet` looks along +x: a ball from behind passes through and is not pushed to the front.
#[test]
fn a_ball_from_behind_is_not_pushed_to_the_front() {
    let mut rig = Rig::new(&ball(0.05), &sheet());
    let mut x = -0.2;
    while x < 0.2 {
        assert_eq!(push_at(&mut rig, x), Vec3::zeros(), "x = {x}");
        x += 0.007;
    }
    // From the front it is stopped, and pushed back even with its centre behind, within its own radius.
    while x > -0.045 {
        let force = push_at(&mut rig, x);
        let expected = if x < 0.05 { 0.5 * K * (0.05 - x) } else { 0.0 };
        assert!((force - Vec3::new(expected, 0.0, 0.0)).norm() < 1e-9 * K, "x = {x}: {force:?}");
        x -= 0.007;
    }
    // Farther behind than its thickness, the sheet releases the ball for good.
    assert_eq!(push_at(&mut rig, -0.06), Vec3::zeros());
    assert_eq!(push_at(&mut rig, -0.03), Vec3::zeros());
}

#[test]
fn a_two_sided_sheet_stops_from_both_sides() {
    let both = sheet().replace("TriangleMesh(name", "TriangleMesh(two_sided: true, name");
    for side in [-1.0, 1.0] {
        let mut rig = Rig::new(&ball(0.05), &both);
        for step in 0..24 {
            let x = side * (0.06 - 0.0045 * f64::from(step));
            let force = push_at(&mut rig, x);
            let expected = (0.5 * K * (0.05 - side * x)).max(0.0) * side;
            assert!((force - Vec3::new(expected, 0.0, 0.0)).norm() < 1e-9 * K, "x = {x}: {force:?}");
        }
    }
}

/// Going round a free edge is not coming from behind.
#[test]
fn a_ball_that_goes_round_the_rim_is_stopped_in_front() {
    let mut rig = Rig::new(&ball(0.05), &sheet());
    let mut put = |x: f64, y: f64| {
        rig.place_a(Vec3::new(x, y, 0.02), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force
    };
    put(-0.2, 0.0);
    put(-0.2, 0.8);
    put(0.2, 0.8);
    put(0.2, 0.1);
    assert!((put(0.04, 0.1).x - 0.5 * K * 0.01).abs() < 1e-9 * K);
}

/// A sheet whose height falls by |x|, its front above; cut along these x, and every 5 cm along y.
fn ridge(cuts: &[f64]) -> String {
    let rows = 41;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for row in 0..rows {
        let y = -1.0 + 0.05 * row as f64;
        vertices.extend(cuts.iter().map(|x| format!("({x:?},{y:?},{:?})", -x.abs())));
    }
    for (row, column) in (0..rows - 1).flat_map(|row| (0..cuts.len() - 1).map(move |column| (row, column))) {
        let a = row * cuts.len() + column;
        let [b, c, d] = [a + 1, a + 1 + cuts.len(), a + cuts.len()];
        triangles.push(format!("({a},{b},{c}),({a},{c},{d})"));
    }
    let (vertices, triangles) = (vertices.join(","), triangles.join(","));
    model(
        "ridge",
        &steel(),
        &format!("TriangleMesh(name: \"m\", vertices: [{vertices}], triangles: [{triangles}])"),
    )
}

/// A ball with its centre behind both faces of a ridge is pushed only by the less deep one, as by a solid,
/// for any number of triangles per face.
#[test]
fn behind_a_ridge_only_the_less_deep_face_pushes() {
    let fine = [-1.0, -0.05, -0.01, -0.005, 0.0, 0.005, 0.01, 0.05, 1.0];
    for (ridge, side) in [ridge(&[-1.0, 0.0, 1.0]), ridge(&fine)].iter().flat_map(|r| [(r, -1.0), (r, 1.0)]) {
        for y in [0.1, 0.11, 0.13] {
            let mut rig = Rig::new(&ball(0.1), ridge);
            // Without an earlier pose: 14 mm below the nearer face and 28 mm below the other.
            rig.place_a(Vec3::new(side * 0.01, y, -0.03), Quat::identity());
            rig.world.step().unwrap();
            let force = rig.wrench(0).force;
            let depth = (0.03 - 0.01) / 2.0_f64.sqrt();
            let outward = Vec3::new(side, 0.0, 1.0).normalize();
            assert_eq!(rig.world.contact_count(), 1);
            assert!((force - outward * (0.5 * K * (0.1 + depth))).norm() < 1e-6, "{force:?}");
        }
    }
}

/// A centre whose path goes through the edge or a vertex of a ridge from outside has not come out of the
/// ridge: the face beyond pushes it, whichever of the two faces rounding lets it cross last.
#[test]
fn a_line_over_a_ridge_has_crossed_nothing() {
    let ridge = ridge(&[-1.0, 0.0, 1.0]);
    let mut random = Random(61);
    for round in 0..60 {
        let orientation = Quat::from_matrix(&random.rotation_matrix());
        let mut rig = Rig::new(&ball(0.1), &ridge);
        let y = if round % 2 == 0 { 0.1 } else { random.between(-0.5, 0.5) };
        for x in [-0.5, random.between(0.05, 0.12)] {
            let place = orientation * Vec3::new(x, y, 0.0);
            rig.place([at(place, orientation), at(Vec3::zeros(), orientation)]);
            rig.world.step().unwrap();
            let depth = (0.1 - x.abs() / 2.0_f64.sqrt()).max(0.0);
            let force = orientation.inverse() * rig.wrench(0).force;
            let expected = Vec3::new(1.0, 0.0, 1.0).normalize() * (0.5 * K * depth);
            assert!(
                (force - expected).norm() < 1e-9 * K,
                "round {round}, x = {x}: {force:?}, not {expected:?}"
            );
        }
    }
}

/// A cube from −0.5 to 0.5, every side in `n` × `n` squares of two triangles.
fn cube_of_triangles(n: usize) -> String {
    let mut corners: Vec<[usize; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for (axis, top) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let mut corner = |i: usize, j: usize| {
                let mut at = [0; 3];
                (at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]) = (if top { n } else { 0 }, i, j);
                corners.iter().position(|known| *known == at).unwrap_or_else(|| {
                    corners.push(at);
                    corners.len() - 1
                })
            };
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            let [b, d] = if top { [b, d] } else { [d, b] };
            triangles.push(format!("({a},{b},{c}),({a},{c},{d})"));
        }
    }
    let place = |k: usize| k as f64 / n as f64 - 0.5;
    let vertices: Vec<_> = corners
        .iter()
        .map(|at| format!("({:?},{:?},{:?})", place(at[0]), place(at[1]), place(at[2])))
        .collect();
    let (vertices, triangles) = (vertices.join(","), triangles.join(","));
    let mesh = format!("TriangleMesh(name: \"m\", vertices: [{vertices}], triangles: [{triangles}])");
    model("cube", &steel(), &mesh)
}

/// An ellipsoid with its centre below the surface by less than the thickness is pushed by a mesh as by a
/// solid.
#[test]
fn below_the_surface_of_a_cube_a_mesh_pushes_as_the_solid() {
    let egg =
        model("egg", &steel(), "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.05, 0.06, 0.08))");
    let solid = model("solid", &steel(), &box_polyhedron("w", [0.0; 3], [0.5; 3], ""));
    let meshes = [cube_of_triangles(1), cube_of_triangles(12)];
    // A nanometre of depth: vertices at multiples of 1/12 m are rounded, and so are the normals.
    let tolerance = 1e-9 * K;
    let mut random = Random(7);
    for _ in 0..40 {
        // Below the top, beside an edge.
        let place = Vec3::new(
            0.5 - random.between(0.0, 0.049),
            random.between(-0.4, 0.4),
            0.5 - random.between(0.0, 0.049),
        );
        let turn = random.rotation();
        let force_of = |body: &str| {
            let mut rig = Rig::new(&egg, body);
            rig.place_a(place, turn);
            rig.world.step().unwrap();
            rig.wrench(0).force
        };
        let expected = force_of(&solid);
        for mesh in &meshes {
            let force = force_of(mesh);
            assert!((force - expected).norm() < tolerance, "{place:?} {turn:?}: {force:?}, {expected:?}");
        }
    }
}
