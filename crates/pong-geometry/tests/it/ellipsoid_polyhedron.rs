//! Ellipsoid against polyhedron: the minimum translation.
//!
//! Degenerate cases: axis-aligned boxes under axis-aligned ellipsoids (feet on edges and vertices, ties), spheres,
//! spheroids upright on a vertex (a circle of minima), the centre inside, at the middle, on a face, edge, vertex;
//! grazing faces, edges, vertices; flat and thin ellipsoids; pieces joined by an inner wall.

use crate::common;
use crate::common::{
    Random, cuboid, cuboid_corners, fibonacci_sphere, hull_with_walls, moved, random_motion, scaled,
    scaled_ellipsoid, stretched_hull,
};
use pong_geometry::interference::Interference;
use pong_geometry::interference::ellipsoid_polyhedron::{ellipsoid_piece, ellipsoid_polyhedron};
use pong_geometry::primitive::{Ellipsoid, Polyhedron};
use pong_geometry::{Mat3, Vec3};
use pong_testkit::{long_samples, samples};

fn overlap(e: &Ellipsoid, p: &Polyhedron, n: &Vec3) -> f64 {
    let support =
        p.vertices.iter().map(|v| n.dot(&(v.position - e.center))).fold(f64::NEG_INFINITY, f64::max);
    e.half_width(n) + support
}

/// Reference: least overlap over all directions, by a dense scan and a pattern search from the best few.
struct Reference {
    directions: Vec<Vec3>,
}

impl Reference {
    fn new(count: usize) -> Self {
        Self { directions: fibonacci_sphere(count) }
    }

    fn least(&self, e: &Ellipsoid, p: &Polyhedron, random: &mut Random) -> (f64, Vec3) {
        let seeds = self.directions.iter().copied().chain(p.faces.iter().map(|face| face.normal));
        let mut scan: Vec<(f64, Vec3)> = seeds.map(|n| (overlap(e, p, &n), n)).collect();
        scan.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut starts: Vec<(f64, Vec3)> = Vec::new();
        for candidate in scan {
            if starts.iter().all(|s| s.1.dot(&candidate.1) < 0.97) {
                starts.push(candidate);
            }
            if starts.len() == 4 {
                break;
            }
        }
        let refined = starts.into_iter().map(|s| refine(e, p, s, random));
        let arcs =
            p.edges.iter().map(|edge| least_on_arc(e, p, edge.faces.map(|f| p.faces[f as usize].normal)));
        refined.chain(arcs).min_by(|a, b| a.0.total_cmp(&b.0)).expect("starts")
    }
}

/// Least overlap between the normals of two faces, where the overlap has a crease: a scan, then ternary
/// search.
fn least_on_arc(e: &Ellipsoid, p: &Polyhedron, normals: [Vec3; 2]) -> (f64, Vec3) {
    const COUNT: usize = 16;
    let at = |s: f64| {
        let n = (normals[0] * (1.0 - s) + normals[1] * s).normalize();
        (overlap(e, p, &n), n)
    };
    let scanned = (0..=COUNT).map(|k| k as f64 / COUNT as f64).min_by(|a, b| at(*a).0.total_cmp(&at(*b).0));
    let middle = scanned.expect("samples");
    let (mut low, mut high) =
        ((middle - 1.0 / COUNT as f64).max(0.0), (middle + 1.0 / COUNT as f64).min(1.0));
    for _ in 0..45 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a).0 < at(b).0 { high = b } else { low = a }
    }
    at(0.5 * (low + high))
}

fn refine(e: &Ellipsoid, p: &Polyhedron, start: (f64, Vec3), random: &mut Random) -> (f64, Vec3) {
    let (mut value, mut n) = start;
    let mut step = 0.1;
    let mut drift = Vec3::zeros();
    while step > 1e-13 {
        let mut improved = false;
        let trials = [drift, random.direction(), random.direction(), random.direction(), random.direction()];
        for trial in trials {
            for sign in [1.0, -1.0] {
                let next = (n + trial * (sign * step)).normalize();
                let next_value = overlap(e, p, &next);
                if next_value < value {
                    drift = (next - n) / step;
                    value = next_value;
                    n = next;
                    improved = true;
                }
            }
        }
        step *= if improved { 1.3 } else { 0.6 };
        step = step.min(0.3);
    }
    (value, n)
}

fn random_ellipsoid(random: &mut Random, semi_axes: Vec3, reach: f64) -> Ellipsoid {
    Ellipsoid {
        center: random.direction() * random.between(0.0, reach),
        axes: random.rotation_matrix(),
        semi_axes,
    }
}

fn check_contact(e: &Ellipsoid, p: &Polyhedron, contact: &Interference, depth_slack: f64) {
    let size = p.diameter + e.semi_axes.max();
    assert!((contact.normal_b.norm() - 1.0).abs() < 1e-14);
    assert!(
        (overlap(e, p, &contact.normal_b) - contact.depth).abs() < depth_slack * size,
        "not the overlap of n"
    );
    assert!((contact.deepest_b - e.support(&-contact.normal_b)).norm() < 1e-13 * size);
}

#[derive(Default)]
struct Tally {
    contacts: usize,
    faces: usize,
    edges: usize,
    vertices: usize,
    above: f64,
    stalled: usize,
    normal: f64,
}

/// Compares random ellipsoids with the reference: `cases` of them in a run of the night, an eighth in a full one.
fn compare(p: &Polyhedron, semi_axes: Vec3, reach: f64, cases: usize, seed: u64) -> Tally {
    let reference = Reference::new(1500);
    let mut random = Random(seed);
    let mut tally = Tally::default();
    for case in 0..long_samples(cases / 8, cases) {
        let e = random_ellipsoid(&mut random, semi_axes, reach);
        let (least, n) = reference.least(&e, p, &mut random);
        let Some(contact) = ellipsoid_polyhedron(&e, p) else {
            assert!(least < 1e-9, "case {case}: lost an overlap of {least} along {n:?} of {e:?}");
            continue;
        };
        assert!(least > -1e-12, "case {case}: contact though apart by {least}");
        check_contact(&e, p, &contact, 1e-13);
        // A search can stop above the minimum, never below: its excess is recorded, not judged.
        let above = (contact.depth - least) / (least.abs() + 1e-3);
        assert!(
            above < 1e-9,
            "case {case}: depth {} reference {least}, {:?}",
            contact.depth,
            contact.feature
        );
        if above < -1e-9 {
            tally.stalled += 1;
        } else {
            tally.above = tally.above.max(above.abs());
        }
        if above.abs() < 1e-12 && contact.normal_b.dot(&n) > 0.9 {
            tally.normal = tally.normal.max((contact.normal_b - n).norm());
        }
        tally.contacts += 1;
        match contact.feature.0 >> 30 {
            0 => tally.faces += 1,
            1 => tally.edges += 1,
            _ => tally.vertices += 1,
        }
    }
    println!(
        "{} faces: {} contacts ({} faces, {} edges, {} vertices), depth within {:e}, normal within {:e}, search stalled {}",
        p.faces.len(),
        tally.contacts,
        tally.faces,
        tally.edges,
        tally.vertices,
        tally.above,
        tally.normal,
        tally.stalled
    );
    assert!(tally.stalled * 100 < tally.contacts, "the reference is too weak to tell");
    tally
}

const HULL: Vec3 = Vec3::new(0.5, 0.4, 0.3);
const ELLIPSOID: Vec3 = Vec3::new(0.2, 0.12, 0.08);

/// The rim of a disc of 64 corners exceeds the capacity of a search. The contact's depth is the overlap along
/// its own normal, and at most that along the normal of any face.
#[test]
fn a_face_of_many_corners_is_searched_to_the_end() {
    /// Error of supports of a disc of a metre, in directions computed with roots, m.
    const ROUNDING: f64 = 1e-13;
    let mut random = Random(71);
    let corners: Vec<Vec3> = (0..64)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 64.0)
        .flat_map(|angle| [-0.2, 0.2].map(|z| Vec3::new(angle.cos(), angle.sin(), z)))
        .collect();
    let disc = hull_with_walls(&corners, &|_, _| false);
    let mut found = 0;
    let wanted = samples(500);
    while found < wanted {
        let angle = random.between(0.0, 6.3);
        let e = Ellipsoid {
            center: Vec3::new(angle.cos(), angle.sin(), 0.2) * random.between(0.8, 1.2),
            axes: random.rotation_matrix(),
            semi_axes: Vec3::from_fn(|_, _| random.between(0.05, 0.4)),
        };
        let Some(contact) = ellipsoid_polyhedron(&e, &disc) else { continue };
        found += 1;
        assert!(
            (overlap(&e, &disc, &contact.normal_b) - contact.depth).abs() < ROUNDING,
            "{e:?}: {contact:?}"
        );
        assert!(disc.faces.iter().all(|face| overlap(&e, &disc, &face.normal) > contact.depth - ROUNDING));
    }
}

#[test]
fn minimum_of_twelve_faces() {
    let tally = compare(&stretched_hull(8, HULL), ELLIPSOID, 0.6, 5000, 31);
    assert!(tally.edges >= samples(25) && tally.vertices >= samples(5));
}

#[test]
fn minimum_of_thirty_two_faces() {
    compare(&stretched_hull(18, HULL), ELLIPSOID, 0.6, 5000, 32);
}

#[test]
fn minimum_of_a_hundred_and_twenty_eight_faces() {
    compare(&stretched_hull(66, HULL), ELLIPSOID, 0.6, 3000, 33);
}

#[test]
fn minimum_of_large_flat_and_long_ellipsoids_on_a_box() {
    let p = cuboid(Vec3::new(-0.5, -0.4, -0.3), Vec3::new(0.5, 0.4, 0.3));
    for (k, semi_axes) in [
        Vec3::new(1.0, 0.9, 0.1),
        Vec3::new(2.0, 0.1, 0.15),
        Vec3::new(1.0, 1.0, 0.2),
        Vec3::new(0.3, 0.3, 0.3),
        Vec3::new(1.0, 0.2, 0.2),
        Vec3::new(0.05, 3.0, 0.6),
    ]
    .into_iter()
    .enumerate()
    {
        compare(&p, semi_axes, 0.6 + semi_axes.max(), 1500, 40 + k as u64);
    }
}

#[test]
fn minimum_of_large_flat_ellipsoids_on_hulls() {
    compare(&stretched_hull(8, HULL), Vec3::new(1.0, 0.8, 0.1), 1.2, 1500, 51);
    compare(&stretched_hull(18, Vec3::new(0.5, 0.5, 0.05)), Vec3::new(0.3, 0.8, 0.1), 1.0, 1500, 52);
    compare(&stretched_hull(10, Vec3::new(0.1, 0.1, 1.0)), Vec3::new(0.3, 0.8, 0.1), 1.0, 1500, 53);
}

#[test]
fn aspect_ratio_of_ten_thousand_keeps_the_overlap_of_its_normal() {
    let p = stretched_hull(18, HULL);
    let mut random = Random(61);
    let reference = Reference::new(1500);
    for _ in 0..samples(800) {
        let e = random_ellipsoid(&mut random, Vec3::new(1.0, 1e-2, 1e-4), 0.6);
        let (least, _) = reference.least(&e, &p, &mut random);
        match ellipsoid_polyhedron(&e, &p) {
            Some(contact) => {
                check_contact(&e, &p, &contact, 1e-13);
                assert!(contact.depth < least + 1e-9);
            }
            None => assert!(least < 1e-9),
        }
    }
}

#[test]
fn aligned_ellipsoid_over_a_box_face_edge_and_corner() {
    let p = cuboid(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
    let at = |x: f64, y: f64, z: f64| Ellipsoid {
        center: Vec3::new(x, y, z),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(0.3, 0.2, 0.4),
    };
    let contact = ellipsoid_polyhedron(&at(0.1, -0.3, 1.39), &p).expect("face");
    assert!(
        (contact.depth - 0.01).abs() < 1e-15 && contact.normal_b == Vec3::z() && contact.feature.is_face()
    );
    // Straight above an edge and straight above a corner, face and feature agree.
    for (x, y) in [(1.0, 0.0), (-1.0, 0.2), (1.0, 1.0), (-1.0, 1.0), (0.0, -1.0)] {
        let contact = ellipsoid_polyhedron(&at(x, y, 1.39), &p).expect("rim");
        assert!((contact.depth - 0.01).abs() < 1e-15, "{x} {y}: {contact:?}");
        assert!((contact.normal_b - Vec3::z()).norm() < 1e-9);
    }
    // Beside the edge x = 1 = z, along a normal of the ellipse.
    let n = Vec3::new(0.6, 0.0, 0.8);
    let half_width = (0.3_f64 * 0.6).hypot(0.4 * 0.8);
    let reach = Vec3::new(0.09 * 0.6, 0.0, 0.16 * 0.8) / half_width;
    for depth in [1e-2, 1e-6, 1e-10] {
        let c = Vec3::new(1.0, 0.1, 1.0) + reach - n * depth;
        let contact = ellipsoid_polyhedron(&at(c.x, c.y, c.z), &p).expect("edge");
        assert!(
            (contact.depth - depth).abs() < 2e-15 && (contact.normal_b - n).norm() < 1e-13,
            "{contact:?}"
        );
        assert!(!contact.feature.is_face());
    }
    assert!(ellipsoid_polyhedron(&at(1.0 + reach.x + 1e-12, 0.1, 1.0 + reach.z + 1e-12), &p).is_none());
}

#[test]
fn centre_at_the_middle_on_faces_edges_and_corners() {
    let p = cuboid(Vec3::new(-1.0, -2.0, -3.0), Vec3::new(1.0, 2.0, 3.0));
    for semi_axes in
        [Vec3::new(0.3, 0.2, 0.4), Vec3::repeat(0.3), Vec3::new(0.3, 0.3, 0.1), Vec3::new(9.0, 8.0, 7.0)]
    {
        for x in [-1.0, 0.0, 1.0] {
            for y in [-2.0, 0.0, 2.0] {
                for z in [-3.0, 0.0, 3.0] {
                    let e = Ellipsoid { center: Vec3::new(x, y, z), axes: Mat3::identity(), semi_axes };
                    let contact = ellipsoid_polyhedron(&e, &p).expect("overlap");
                    check_contact(&e, &p, &contact, 1e-13);
                    let expected = (0..3)
                        .map(|i| semi_axes[i] + p.vertices[7].position[i] - e.center[i].abs())
                        .fold(f64::INFINITY, f64::min);
                    assert!(contact.depth <= expected + 1e-14, "{e:?} {contact:?}");
                    assert_eq!(ellipsoid_polyhedron(&e, &p), Some(contact));
                }
            }
        }
    }
}

#[test]
fn spheres_as_by_the_nearest_point() {
    let p = stretched_hull(18, HULL);
    let mut random = Random(71);
    for _ in 0..3000 {
        let r = 0.15;
        let e = random_ellipsoid(&mut random, Vec3::repeat(r), 0.7);
        let least_face = p.faces.iter().map(|f| r - f.height(&e.center)).fold(f64::INFINITY, f64::min);
        if let Some(contact) = ellipsoid_polyhedron(&e, &p) {
            check_contact(&e, &p, &contact, 1e-13);
            assert!(contact.depth <= least_face + 1e-14);
            if contact.depth < r {
                let touched = e.center - contact.normal_b * (r - contact.depth);
                assert!(
                    p.faces.iter().all(|f| f.height(&touched) < 1e-12),
                    "the touched point is on the surface"
                );
            }
        }
    }
}

#[test]
fn upright_spheroid_deep_on_a_corner_has_a_circle_of_minima() {
    // A blunt pyramid: the corner lies on the long axis, above the centre of curvature.
    for tilt in [0.0, 1e-15, 1e-9] {
        let mut corners: Vec<Vec3> = (0..5)
            .map(|i| (f64::from(i) * 1.2566, 1.0))
            .map(|(t, r)| Vec3::new(r * t.cos(), r * t.sin(), -0.7))
            .collect();
        corners.push(Vec3::new(tilt, 0.0, 0.0));
        let p = common::hull(&corners);
        let e = Ellipsoid {
            center: Vec3::new(0.0, 0.0, 0.5),
            axes: Mat3::identity(),
            semi_axes: Vec3::new(0.2, 0.2, 1.0),
        };
        let contact = ellipsoid_polyhedron(&e, &p).expect("overlap");
        check_contact(&e, &p, &contact, 1e-13);
        let (least, _) = Reference::new(4000).least(&e, &p, &mut Random(5));
        assert!((contact.depth - least).abs() < 1e-8, "{contact:?} {least}");
    }
}

#[test]
fn rigid_motion_and_scale_change_nothing() {
    let mut random = Random(81);
    for vertices in [8, 18, 66] {
        let p = stretched_hull(vertices, HULL);
        for _ in 0..500 {
            let e = random_ellipsoid(&mut random, ELLIPSOID, 0.6);
            let contact = ellipsoid_polyhedron(&e, &p);
            let x = random_motion(&mut random, 2.0);
            let far = ellipsoid_polyhedron(&e.carried(&x), &moved(&p, &x));
            assert_same(&contact, &far, 1.0, |v| x.vector(v));
            for factor in [1e-4, 1e4] {
                let big = ellipsoid_polyhedron(&scaled_ellipsoid(&e, factor), &scaled(&p, factor));
                assert_same(&contact, &big, factor, |v| *v);
            }
        }
    }
}

fn assert_same(
    a: &Option<Interference>,
    b: &Option<Interference>,
    factor: f64,
    turn: impl Fn(&Vec3) -> Vec3,
) {
    match (a, b) {
        (Some(a), Some(b)) => {
            assert!((a.depth * factor - b.depth).abs() < 1e-12 * factor, "{a:?} {b:?}");
            assert!((turn(&a.normal_b) - b.normal_b).norm() < 1e-8, "{a:?} {b:?}");
        }
        (None, None) => {}
        _ => panic!("{a:?} {b:?}"),
    }
}

#[test]
fn depth_is_continuous_along_a_path_over_edges_and_corners() {
    let p = cuboid(Vec3::new(-0.5, -0.4, -0.3), Vec3::new(0.5, 0.4, 0.3));
    let axes = Random(91).rotation_matrix();
    let at = |s: f64| Ellipsoid {
        center: Vec3::new(-0.7 + s, -0.55 + 0.7 * s, 0.36 - 0.03 * s),
        axes,
        semi_axes: Vec3::new(0.25, 0.12, 0.08),
    };
    let steps = samples(200_000);
    let mut before: Option<f64> = None;
    for k in 0..=steps {
        let depth = ellipsoid_polyhedron(&at(1.6 * k as f64 / steps as f64), &p).map_or(0.0, |c| c.depth);
        if let Some(before) = before {
            assert!((depth - before).abs() < 1.3 * 1.6 / steps as f64, "step at {k}: {before} {depth}");
        }
        before = Some(depth);
    }
}

#[test]
fn grazing_contacts_fade_to_nothing() {
    let p = stretched_hull(8, HULL);
    let mut random = Random(92);
    for _ in 0..300 {
        let axes = random.rotation_matrix();
        let outward = random.direction();
        let at = |s: f64| Ellipsoid { center: outward * s, axes, semi_axes: ELLIPSOID };
        let (mut touching, mut apart) = (0.0, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (touching + apart);
            if ellipsoid_polyhedron(&at(middle), &p).is_some() { touching = middle } else { apart = middle }
        }
        let last = ellipsoid_polyhedron(&at(touching), &p).expect("touching");
        assert!(last.depth < 1e-14, "the last contact at {touching} is {last:?}, {:?}", at(apart));
        let near = ellipsoid_polyhedron(&at(touching - 1e-7), &p).expect("touching");
        assert!(near.depth < 1.001e-7 && (near.normal_b - last.normal_b).norm() < 1e-3, "{near:?} {last:?}");
    }
}

#[test]
fn abutting_pieces_push_as_one_plate() {
    let wall_at_zero = |n: &Vec3, d: f64| n.x.abs() > 0.9 && d.abs() < 1e-9;
    let piece = |low: f64, high: f64| {
        hull_with_walls(&cuboid_corners(Vec3::new(low, -1.0, -0.5), Vec3::new(high, 1.0, 0.0)), &wall_at_zero)
    };
    let (left, right) = (piece(-1.0, 0.0), piece(0.0, 1.0));
    let axes = Random(93).rotation_matrix();
    for k in -500..=500 {
        let x = 1e-3 * f64::from(k);
        let mut e = Ellipsoid { center: Vec3::new(x, 0.1, 0.0), axes, semi_axes: Vec3::new(0.3, 0.12, 0.2) };
        e.center.z = e.half_width(&Vec3::z()) - 0.01;
        let contacts = [ellipsoid_polyhedron(&e, &left), ellipsoid_polyhedron(&e, &right)];
        let pushing: Vec<_> = contacts.iter().flatten().collect();
        assert!(!pushing.is_empty());
        for contact in pushing {
            assert!(
                (contact.normal_b - Vec3::z()).norm() < 1e-15 && (contact.depth - 0.01).abs() < 1e-15,
                "{x} {contact:?}"
            );
        }
    }
}

/// Two minima of one body, each found by the piece that has it; the body decides which is less deep.
#[test]
fn a_piece_finds_the_minimum_of_its_own_features() {
    let wall = |n: &Vec3, d: f64| n.z > 0.9 && d.abs() < 1e-9;
    // Wide, so that the far side below is the nearest active face.
    let corners = cuboid_corners(Vec3::new(-3.0, -3.0, -1.0), Vec3::new(3.0, 3.0, 0.0));
    let lower = hull_with_walls(&corners, &wall);
    for z in [0.2, -0.7] {
        let e = Ellipsoid {
            center: Vec3::new(0.1, 0.0, z),
            axes: Mat3::identity(),
            semi_axes: Vec3::new(0.4, 0.4, 0.3),
        };
        let contact = ellipsoid_polyhedron(&e, &lower).expect("the far side");
        assert!(contact.normal_b == -Vec3::z() && (contact.depth - 1.3 - z).abs() < 1e-15, "{contact:?}");
    }
}

/// If all feet lie outside a piece, its least active face is the fallback, with the overlap along its own
/// normal.
#[test]
fn a_piece_without_a_foot_has_a_stand_in() {
    let wall_at_zero = |n: &Vec3, d: f64| n.x > 0.9 && d.abs() < 1e-9;
    let corners = cuboid_corners(Vec3::new(-1.0, -1.0, -0.5), Vec3::new(0.0, 1.0, 0.0));
    let left = hull_with_walls(&corners, &wall_at_zero);
    let e = Ellipsoid {
        center: Vec3::new(0.1, 0.2, 0.05),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(0.4, 0.3, 0.2),
    };
    assert_eq!(ellipsoid_polyhedron(&e, &left), None);
    let found = ellipsoid_piece(&e, &left).expect("they overlap");
    assert!(found.stands_in, "{found:?}");
    assert!(found.interference.normal_b == Vec3::z() && (found.interference.depth - 0.15).abs() < 1e-15);
}

#[test]
fn pieces_of_a_split_box_push_as_the_whole_box() {
    let (low, high) = (Vec3::new(-1.0, -1.0, -0.5), Vec3::new(1.0, 1.0, 0.5));
    let whole = cuboid(low, high);
    let mut random = Random(94);
    for slope in [0.0, 0.5, -0.9] {
        let wall_normal = Vec3::new(1.0, 0.0, slope).normalize();
        let is_wall = |n: &Vec3, d: f64| (n.dot(&wall_normal).abs() > 0.999_999) && d.abs() < 1e-9;
        let cut =
            [(-1.0, -0.5), (-1.0, 0.5), (1.0, -0.5), (1.0, 0.5)].map(|(y, z)| Vec3::new(-slope * z, y, z));
        let piece = |side: f64| {
            let mut corners: Vec<Vec3> =
                cuboid_corners(low, high).into_iter().filter(|c| c.x * side > 0.0).collect();
            corners.extend(cut);
            hull_with_walls(&corners, &is_wall)
        };
        let pieces = [piece(-1.0), piece(1.0)];
        let (mut lost, mut extra, mut checked) = (0, 0, 0);
        let wanted = samples(5000);
        while checked < wanted {
            let semi_axes = Vec3::from_fn(|_, _| random.between(0.05, 0.4));
            let mut e = random_ellipsoid(&mut random, semi_axes, 0.0);
            e.center =
                Vec3::new(random.between(-1.4, 1.4), random.between(-1.4, 1.4), random.between(-0.9, 0.9));
            let Some(expected) = ellipsoid_polyhedron(&e, &whole) else {
                assert!(pieces.iter().all(|p| ellipsoid_polyhedron(&e, p).is_none()));
                continue;
            };
            if expected.depth > 0.2 * semi_axes.min() {
                continue;
            }
            checked += 1;
            let found: Vec<_> = pieces.iter().filter_map(|p| ellipsoid_polyhedron(&e, p)).collect();
            let same = |c: &Interference| {
                (c.depth - expected.depth).abs() < 1e-13 && (c.normal_b - expected.normal_b).norm() < 1e-7
            };
            lost += usize::from(!found.iter().any(same));
            extra += found.iter().filter(|c| !same(c)).count();
            if found.len() > 1 {
                let foot = expected.deepest_b + expected.normal_b * expected.depth;
                assert!(
                    wall_normal.dot(&foot).abs() < 1e-9,
                    "both push though the foot is in one: {found:?}"
                );
            }
        }
        println!("slope {slope}: {checked} shallow contacts, {lost} lost, {extra} extra");
        assert_eq!(lost, 0);
        assert_eq!(extra, 0);
    }
}
