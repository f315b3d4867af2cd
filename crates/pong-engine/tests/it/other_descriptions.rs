//! One scene described in two ways, in many poses: meshes that are cut or listed in another order, bodies
//! that are rotated and moved. The answers are equal, and match the expected value where there is one
//! (docs/theory.md, 2.2).

use crate::common::mesh::{Mesh, SERIES, steel};
use crate::common::*;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

/// Rounding of a force, as a fraction of stiffness times one metre.
const ROUNDING: f64 = 1e-9;
const POSES: usize = 60;

/// A mesh of some triangles.
fn mesh(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> Mesh {
    Mesh::new(vertices.iter().map(|v| Vec3::from(*v)).collect(), triangles.to_vec())
}

impl Mesh {
    fn thick(self, thickness: f64) -> Self {
        Self { thickness: Some(thickness), ..self }
    }

    fn two_sided(self) -> Self {
        Self { two_sided: true, ..self }
    }

    /// The mesh with one more vertex, connected to the corners of the triangle around it, or of the two that
    /// share the edge on which it lies.
    fn split(mut self, at: Vec3) -> Self {
        let new = self.vertices.len();
        self.vertices.push(at);
        let (mut kept, mut parts) = (Vec::new(), Vec::new());
        for triangle in &self.triangles {
            let corners = triangle.map(|index| self.vertices[index]);
            let area = |a: &Vec3, b: &Vec3, c: &Vec3| (b - a).cross(&(c - a)).norm();
            let whole = area(&corners[0], &corners[1], &corners[2]);
            let pieces = [0, 1, 2].map(|k| area(&corners[k], &corners[(k + 1) % 3], &at));
            if pieces.iter().sum::<f64>() > whole * (1.0 + 1e-9) {
                kept.push(*triangle);
                continue;
            }
            let part = |k: usize| [triangle[k], triangle[(k + 1) % 3], new];
            parts.extend((0..3).filter(|&k| pieces[k] > 1e-9 * whole).map(part));
        }
        kept.append(&mut parts);
        self.triangles = kept;
        self
    }

    /// This mesh with its triangles in another order.
    fn shuffled(&self, random: &mut Random) -> Self {
        let mut mesh = self.clone();
        for last in (1..mesh.triangles.len()).rev() {
            mesh.triangles.swap(last, (random.unit() * (last + 1) as f64) as usize);
        }
        mesh
    }
}

fn ellipsoid(semi_axes: [f64; 3]) -> String {
    let [a, b, c] = semi_axes;
    let text = format!("Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: ({a:?},{b:?},{c:?}))");
    model("ellipsoid", &steel(), &text)
}

fn sphere(radius: f64) -> String {
    model("sphere", &steel(), &format!("Sphere(name: \"s\", center: (0,0,0), radius: {radius:?})"))
}

/// Force on A at the last of some committed positions, N, in the scene's own axes. The mesh is given in other
/// axes, and the whole scene is moved.
fn force(a: &str, mesh: &Mesh, places: &[Vec3], random: &mut Random) -> Vec3 {
    let (frame, inner) = (random.rotation(), random.rotation());
    let [shift, moved] = [random.vector(2.0), random.vector(2.0)];
    let mut rig = Rig::new(a, &mesh.turned(&inner, &moved).text());
    let b = frame * inner.inverse();
    for place in places {
        rig.place([at(frame * place + shift, frame), at(shift - b * moved, b)]);
        rig.world.evaluate().unwrap();
        rig.world.commit().unwrap();
    }
    frame.inverse() * rig.wrench(0).force
}

/// Checks that all descriptions agree in every pose.
fn must_agree(a: &str, meshes: &[Mesh], places: &[Vec3], expected: Option<Vec3>) {
    let mut random = Random(7);
    let expected = expected.unwrap_or_else(|| force(a, &meshes[0], places, &mut random));
    for pose in 0..POSES {
        for (index, mesh) in meshes.iter().enumerate() {
            let shuffled = mesh.shuffled(&mut random);
            let got = force(a, &shuffled, places, &mut random);
            let off = (got - expected).norm();
            assert!(off < ROUNDING * SERIES, "mesh {index}, pose {pose}: {got:?}, not {expected:?}");
        }
    }
}

fn square() -> Mesh {
    mesh(&[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]], &[[0, 1, 2], [0, 2, 3]])
}

/// Exactly below a vertex in the middle of a flat plate, each triangle may decide that another one has the
/// centre.
#[test]
fn behind_a_vertex_of_a_flat_plate_a_ball_is_not_lost() {
    let plate = square().thick(1.0);
    let mut random = Random(29);
    for _ in 0..600 {
        let foot = Vec3::new(random.between(-0.9, 0.9), random.between(-0.9, 0.9), 0.0);
        let cut = plate.clone().split(foot).split(Vec3::new(foot.x, 0.5 * foot.y - 0.5, 0.0));
        let below = random.between(0.1, 0.9);
        let got = force(&sphere(0.5), &cut, &[foot - Vec3::z() * below], &mut random);
        let expected = Vec3::z() * (SERIES * (0.5 + below));
        assert!((got - expected).norm() < ROUNDING * SERIES, "{foot:?}: {got:?}, not {expected:?}");
    }
}

/// The wedge behind a fold ends where the fold does: beyond its ends the line of the edge continues, but no
/// wall is near.
#[test]
fn the_wedge_behind_a_fold_ends_with_the_fold() {
    let rows = [-1.0, -0.46, -0.065, 0.62, 1.0];
    let columns = [-1.0, -0.65, -0.13, 0.66, 1.0];
    let heights = [
        [0.047, -0.1, 0.096, -0.067, 0.096],
        [-0.054, 0.12, -0.11, 0.077, -0.11],
        [0.06, -0.13, 0.12, -0.087, 0.12],
        [-0.062, 0.14, -0.13, 0.089, -0.13],
        [0.047, -0.1, 0.096, -0.067, 0.096],
    ];
    let vertices: Vec<[f64; 3]> =
        (0..25).map(|i| [columns[i % 5], rows[i / 5], heights[i / 5][i % 5]]).collect();
    let cells = (0..16).map(|cell| 5 * (cell / 4) + cell % 4);
    let triangles: Vec<[usize; 3]> = cells.flat_map(|i| [[i, i + 1, i + 6], [i, i + 6, i + 5]]).collect();
    let sheet = mesh(&vertices, &triangles).thick(0.4);
    let middle =
        |mesh: &Mesh, t: usize| mesh.triangles[t].iter().map(|i| mesh.vertices[*i]).sum::<Vec3>() / 3.0;
    let edge = |a: usize, b: usize, t: f64| sheet.vertices[a] * (1.0 - t) + sheet.vertices[b] * t;
    let cut = sheet.clone().split(edge(1, 7, 0.4)).split(edge(8, 14, 0.55)).split(middle(&sheet, 12));
    let cut = cut.clone().split(edge(12, 13, 0.3)).split(edge(6, 11, 0.7));
    let mut random = Random(3);
    for _ in 0..40 {
        let place =
            Vec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.6, -0.1));
        let mut poses = Random(5);
        let [whole, pieces] = [&sheet, &cut].map(|mesh| force(&sphere(1.0), mesh, &[place], &mut poses));
        assert!((whole - pieces).norm() < ROUNDING * SERIES, "{place:?}: {whole:?} {pieces:?}");
    }
}

/// Several faces of a wavy sheet reach a ball far behind it; one culls a second, which would cull a third.
#[test]
fn the_order_of_the_triangles_does_not_choose_among_the_faces_behind_which_a_ball_lies() {
    let vertices = [
        [-0.16, 0.72, 1.4],
        [-0.092, 1.0, 0.79],
        [-0.54, 0.98, 1.2],
        [-0.34, 0.63, 0.77],
        [0.1, 0.66, 0.38],
        [-0.25, 0.81, 0.26],
        [0.2, 0.76, -0.079],
        [-0.1, 0.64, -0.15],
        [0.36, 0.64, -0.58],
        [-1.0, 0.49, 1.1],
        [-0.97, 0.8, 0.56],
        [-0.77, 0.44, 0.16],
        [-1.7, 0.76, 0.91],
        [-1.5, 0.29, 0.49],
        [-1.4, 0.56, -0.034],
        [-1.2, 0.34, -0.44],
        [-0.68, 0.53, -0.3],
        [-0.52, 0.42, -0.81],
    ];
    let triangles = [
        [0, 1, 2],
        [1, 3, 2],
        [1, 4, 3],
        [4, 5, 3],
        [4, 6, 5],
        [6, 7, 5],
        [6, 8, 7],
        [2, 3, 9],
        [3, 10, 9],
        [3, 5, 10],
        [5, 11, 10],
        [9, 10, 12],
        [10, 13, 12],
        [10, 11, 14],
        [10, 14, 13],
        [11, 15, 14],
        [16, 17, 15],
    ];
    let sheet = mesh(&vertices, &triangles);
    let mut random = Random(23);
    for _ in 0..150 {
        let place = Vec3::new(-0.4, 0.6, 0.6) + random.vector(0.5);
        let first = force(&sphere(0.9), &sheet, &[place], &mut random);
        for _ in 0..3 {
            let other = force(&sphere(0.9), &sheet.shuffled(&mut random), &[place], &mut random);
            assert!((first - other).norm() < ROUNDING * SERIES, "{place:?}: {first:?} {other:?}");
        }
    }
}

/// From the back into the plane: nothing has been crossed yet, and the side that holds the ball continues to
/// hold it.
#[test]
fn a_ball_that_comes_into_the_plane_of_a_two_sided_plate_from_its_back_is_pushed_to_the_back_alone() {
    let plate = square().two_sided();
    let meshes = [plate.clone(), plate.split(Vec3::new(0.25, 0.125, 0.0))];
    for place in [Vec3::new(0.3, -0.2, 0.0), Vec3::new(0.25, 0.125, 0.0)] {
        let places = [place - Vec3::z() * 0.1, place];
        must_agree(&sphere(0.3), &meshes, &places, Some(-Vec3::z() * (SERIES * 0.3)));
    }
}

/// A face yields to a less deep edge or face only if that one pushes. The edges of a triangle depend on how
/// the plate is cut: beside this rim the edge does not push, because the centre is behind it.
#[test]
fn a_deep_ellipsoid_beside_a_rim_does_not_depend_on_how_the_plate_is_cut() {
    let vertices = [[-1.0, -1.0, 2.8], [0.0, -1.0, 0.0], [-1.0, -0.33, 2.8]];
    let plate = mesh(&vertices, &[[0, 1, 2]]).thick(1.5767512166579494);
    let middle = plate.vertices.iter().sum::<Vec3>() / 3.0;
    let cut = plate.clone().split(middle).split(Vec3::new(-0.5, -1.0, 1.4));
    let places = [Vec3::new(-0.7, -0.78, 1.8), Vec3::new(-0.7, -0.8, 2.0)];
    let normal = Vec3::new(2.8, 0.0, 1.0).normalize();
    let depth = 1.0 - normal.dot(&(places[1] - plate.vertices[1]));
    must_agree(&ellipsoid([1.0, 0.5, 1.0]), &[plate, cut], &places, Some(normal * (SERIES * depth)));
}

/// An ellipsoid so deep over the corner of a plate that its side is nearer to the rim than its bottom: the
/// rim pushes, even if rounding turns it into a fallback candidate at the contact point of the face.
#[test]
fn over_the_corner_of_a_plate_the_less_deep_minimum_pushes() {
    let size = 0.0566794834218851;
    let vertices = [[-size, -size, -2.0 * size], [size, -size, -2.0 * size], [size, -size, 2.0 * size]];
    let plate = mesh(&vertices, &[[0, 1, 2]]).thick(0.118);
    let place = Vec3::new(-size, -0.07793428970509202, -2.0 * size);
    let mut random = Random(11);
    for _ in 0..5 * POSES {
        let inner = random.rotation();
        let mut rig = Rig::new(&ellipsoid([0.06, 0.06, 0.03]), &plate.turned(&inner, &Vec3::zeros()).text());
        let (frame, shift) = (random.rotation(), random.vector(0.1));
        rig.place([at(frame * place + shift, frame), at(shift, frame * inner.inverse())]);
        rig.world.evaluate().unwrap();
        let least = rig.world.contacts().iter().map(|contact| contact.depth).fold(f64::INFINITY, f64::min);
        assert!((least - 0.02737537342).abs() < 1e-9, "{:?}", rig.world.contacts());
    }
}

/// Deep over a ridge, both faces have a minimum of the same depth: one pushes.
#[test]
fn a_rod_exactly_above_a_ridge_is_pushed_by_one_of_two_equal_faces() {
    let vertices = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
    let roof = mesh(&vertices, &[[0, 2, 1], [0, 1, 3]]);
    let depth = (0.5_f64 * (0.1 * 0.1 + 0.4 * 0.4)).sqrt() - 0.1 * 0.5_f64.sqrt();
    let mut random = Random(19);
    for _ in 0..POSES {
        let shuffled = roof.shuffled(&mut random);
        let force = force(&ellipsoid([0.1, 0.1, 0.4]), &shuffled, &[Vec3::z() * 0.1], &mut random);
        let expected = Vec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt()) * (SERIES * depth);
        let mirrored = Vec3::new(-expected.x, 0.0, expected.z);
        let off = (force - expected).norm().min((force - mirrored).norm());
        assert!(off < ROUNDING * SERIES, "{force:?}, not {expected:?}");
    }
}

/// Three slivers of one plane, 1e-5 of their length wide, with the foot point on the seam and the centre
/// behind: of two duplicate contacts, one culls the other and is not culled in turn.
#[test]
fn on_the_seam_of_slivers_one_of_two_equal_faces_pushes() {
    let (long, step) = (0.55, 1.3e-5);
    let vertices =
        [[0.0, 0.0, 0.0], [0.0, step, 0.0], [-long, 0.0, 0.0], [-long, step, 0.0], [0.0, 2.0 * step, 0.0]];
    let mesh = mesh(&vertices, &[[0, 1, 2], [2, 1, 3], [1, 4, 3]]).thick(0.064);
    let up = Vec3::z() * (SERIES * (0.17 + 0.03));
    let foot = (mesh.vertices[1] + mesh.vertices[2]) * 0.5;
    must_agree(&ellipsoid([0.23, 0.18, 0.17]), &[mesh], &[foot - Vec3::z() * 0.03], Some(up));
}

/// An edge with the centre behind it is no face: what it yields to does not depend on the triangle that it is
/// counted with.
#[test]
fn what_an_edge_yields_to_does_not_depend_on_the_triangle_that_owns_it() {
    let vertices = [
        [0.0, 0.0, 0.0],
        [81.0, -14.0, -340.0],
        [27.0, 78.0, -310.0],
        [-66.0, 49.0, -320.0],
        [-77.0, -29.0, -260.0],
        [35.0, -75.0, -230.0],
    ];
    let bowl = mesh(&vertices, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]]).thick(17.0);
    let turn = Quat::new_normalize(pong_quaternion(0.6319, 0.3076, -0.5861, -0.4032));
    let text = format!(
        "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (6.0,7.0,3.0), orientation: ({:?},{:?},{:?},{:?}))",
        turn.w, turn.i, turn.j, turn.k
    );
    let a = model("ellipsoid", &steel(), &text);
    let mut random = Random(31);
    for pose in 0..150 {
        let aside = random.vector(if pose == 0 { 0.0 } else { 2.0 });
        let place = Vec3::new(1.0, -2.0, -0.4) + aside;
        let first = force(&a, &bowl, &[place], &mut random);
        for _ in 0..3 {
            let other = force(&a, &bowl.shuffled(&mut random), &[place], &mut random);
            assert!((first - other).norm() < 7.0 * ROUNDING * SERIES, "{place:?}: {first:?} {other:?}");
        }
    }
}

fn pong_quaternion(w: f64, i: f64, j: f64, k: f64) -> nalgebra::Quaternion<f64> {
    nalgebra::Quaternion::new(w, i, j, k)
}

/// Below the vertex at which a wall ends, its face pushes a ball one way and the vertex the other: only one
/// of them does. The ellipsoid tester finds both there, and then it is the face.
#[test]
fn no_place_pushes_both_ways() {
    let vertices = [
        [0.9615914309705094, -1.3488999657781169, -0.22891185745680542],
        [1.7764052532952843, 0.19594830313514078, 0.7851188416445705],
        [-0.04161207894864427, 0.991482476630482, 1.033993023635701],
        [1.1794974091310466, -1.4716901150192263, 1.755386397325284],
    ];
    let mesh = mesh(&vertices, &[[0, 1, 2], [1, 3, 2]]);
    let [p, q, r] = [0, 1, 2].map(|index| mesh.vertices[index]);
    let normal = (q - p).cross(&(r - p)).normalize();
    let place = r - normal * 0.042;
    let mut random = Random(13);
    for (ball, depths) in [(sphere(0.1), &[0.142, 0.0, -0.058][..]), (ellipsoid([0.1; 3]), &[0.142])] {
        for _ in 0..4 * POSES {
            let shuffled = mesh.shuffled(&mut random);
            let force = force(&ball, &shuffled, &[place], &mut random);
            let is_of = |depth: &f64| (force - normal * (SERIES * depth)).norm() < ROUNDING * SERIES;
            assert!(depths.iter().any(is_of), "{force:?}, not of {depths:?}");
        }
    }
}

/// The fallback candidate of a face at the commit is the same one after it.
#[test]
fn a_commit_does_not_change_which_wall_of_a_deep_valley_stands_in() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.62, 0.78, 1.0], [-0.22, 0.97, 1.0]];
    let bowl = mesh(&vertices, &[[0, 1, 2], [0, 2, 3]]).thick(1.599514126543054);
    let thick = mesh(&[[0.0, 0.0, 0.0], [0.37, 0.93, -2.4], [-1.0, 0.0029, -2.8]], &[[0, 1, 2]]);
    let thick = thick.two_sided().thick(0.5945102031637671);
    let mut random = Random(17);
    let mut check = |a: &str, mesh: &Mesh, places: &[Vec3], turn: Quat| {
        let (frame, shift) = (random.rotation(), random.vector(1.0));
        let mut rig = Rig::new(a, &mesh.text());
        for place in places {
            rig.place([at(frame * place + shift, frame * turn), at(shift, frame)]);
            rig.world.evaluate().unwrap();
            let before = rig.wrench(0).force;
            rig.world.commit().unwrap();
            rig.world.evaluate().unwrap();
            let after = rig.wrench(0).force;
            assert!((before - after).norm() < 1e-12 * SERIES, "{place:?}: {before:?} {after:?}");
        }
    };
    let turn = Quat::new_normalize(pong_quaternion(
        0.2099333692861111,
        -0.4343320142497147,
        -0.851525630031962,
        -0.2054,
    ));
    for _ in 0..POSES {
        check(
            &ellipsoid([0.4, 0.4, 0.4]),
            &bowl,
            &[Vec3::new(2.0, -0.03, 0.6), Vec3::new(0.5, 0.6, 0.7)],
            Quat::identity(),
        );
        let inner =
            "orientation: (0.8373285879145614, 0.3463422609201566, 0.29582474806444475, 0.302350115915851)";
        let text = format!("Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.3,0.8,0.7), {inner})");
        check(&model("e", &steel(), &text), &thick, &[Vec3::new(-0.8, 0.081, -2.6)], turn);
    }
}
