//! Closed meshes that are not convex touch each other: the wrench is the derivative of the stored energy where the
//! depth is small beside the regions of the facets, and that of the same solid in convex pieces.

use super::solids::{Pair, SOFT, STIFF, directions, moved, pose, power, random_vector, solid};
use crate::common::Rig;
use crate::common::stage::workers;
use pong_engine::{Config, DeepInMeshReport, StatusBits, WorkerSettings};
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_testkit::meshes::{Place, l_shape, torus};
use pong_testkit::ron::{box_polyhedron, triangle_mesh};
use pong_testkit::{Random, long_samples};

/// Model of one mesh of triangles; equal places become one vertex.
fn mesh(surface: &str, triangles: &[[Place; 3]]) -> String {
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut known = std::collections::HashMap::new();
    let mut number = |place: &Place| {
        *known.entry(place.map(f64::to_bits)).or_insert_with(|| {
            vertices.push(Vec3::from(*place));
            vertices.len() - 1
        })
    };
    let corners: Vec<[usize; 3]> =
        triangles.iter().map(|triangle| [0, 1, 2].map(|k| number(&triangle[k]))).collect();
    solid(surface, &triangle_mesh("mesh", &vertices, &corners, ""))
}

fn l_mesh(surface: &str) -> String {
    mesh(surface, &l_shape())
}

/// An L like that of `l_mesh`, as two boxes.
fn l_boxes(surface: &str) -> String {
    let lower = box_polyhedron("lower", [0.0, 0.0, -0.03], [0.1, 0.08, 0.03], "");
    let upper = box_polyhedron("upper", [-0.05, 0.0, 0.03], [0.05, 0.08, 0.03], "");
    solid(surface, &format!("{lower}, {upper}"))
}

/// Distance along a direction at which A, turned, begins to touch B at the origin, coming from `from`, m.
fn touch(pair: &mut Pair, turn: Quat, along: Vec3, from: f64) -> Option<f64> {
    let energy = |pair: &mut Pair, at: f64| pair.at(&Pose { position: along * at, orientation: turn }).1;
    let mut apart = from;
    while energy(pair, apart - 2e-3) == 0.0 {
        apart -= 2e-3;
        if apart < 0.0 {
            return None;
        }
    }
    let mut within = apart - 2e-3;
    for _ in 0..30 {
        let middle = 0.5 * (apart + within);
        if energy(pair, middle) > 0.0 { within = middle } else { apart = middle }
    }
    Some(within)
}

/// Error of the wrench against central differences of the energy, relative to the wrench.
fn error_of_gradient(pair: &mut Pair, at: &Pose, step: f64) -> f64 {
    let (wrench, _) = pair.at(at);
    let size = wrench.force.norm() + wrench.moment.norm() / 0.1;
    let mut worst = 0.0_f64;
    for along in directions() {
        let mut energy = |sign: f64| {
            let by = Twist { linear: along.linear * (sign * step), angular: along.angular * (sign * step) };
            pair.at(&moved(at, &by)).1
        };
        let slope = (energy(1.0) - energy(-1.0)) / (2.0 * step);
        worst = worst.max((power(&wrench, &along) + slope).abs() / size);
    }
    worst
}

/// At random touches of a small depth the wrench is minus the derivative of the energy. Where more than three planes
/// meet at a vertex with convex and re-entrant edges, as at all vertices on the inner side of a torus, the regions have
/// gaps of the order of the depth cubed, and the error is largest where little else touches: at one of 600 touches of
/// the coarse tori there is a gap alone, without any force.
#[test]
fn wrench_of_meshes_is_the_derivative_of_the_energy() {
    let ring = |sides: usize| torus(0.1, 0.03, 2 * sides, sides);
    let pairs = [
        ("L on L", l_mesh(SOFT), l_mesh(STIFF), [1e-6, 1e-6]),
        ("coarse tori", mesh(SOFT, &ring(5)), mesh(STIFF, &ring(6)), [1e-2, 0.1]),
        ("fine tori", mesh(SOFT, &ring(12)), mesh(STIFF, &ring(16)), [1e-5, 1e-3]),
        ("L mesh on L of boxes", l_mesh(SOFT), l_boxes(STIFF), [1e-6, 1e-6]),
    ];
    for (name, a, b, limits) in pairs {
        let mut pair = Pair::new(&a, &b);
        let mut random = Random::new(31, 0, 0);
        let mut errors: Vec<f64> = Vec::new();
        for _ in 0..long_samples(200, 600) {
            let turn = Quat::from_scaled_axis(random_vector(&mut random, 2.0));
            let along = random_vector(&mut random, 1.0).normalize();
            let Some(at) = touch(&mut pair, turn, along, 0.4) else { continue };
            let at = Pose { position: along * (at - 2e-4), orientation: turn };
            let error = error_of_gradient(&mut pair, &at, 1e-8);
            errors.push(error);
        }
        errors.sort_by(f64::total_cmp);
        let count = errors.len();
        let [median, most, nearly_all, worst] =
            [count / 2, count * 95 / 100, count * 99 / 100, count - 1].map(|at| errors[at]);
        println!(
            "{name}: {count} touches, median {median:.1e}, 95 % {most:.1e}, 99 % {nearly_all:.1e}, worst {worst:.1e}"
        );
        assert!(
            median < 1e-6 && most < limits[0] && nearly_all < limits[1],
            "{name}: {median} {most} {nearly_all}"
        );
    }
}

/// The bottom of an L, 0.2 × 0.16 m, lies on the upper end of another, 0.1 × 0.16 m: K·a·δ, whether the two are meshes
/// or boxes, on either side.
#[test]
fn flat_contact_of_meshes_is_that_of_boxes() {
    let depth = 1e-8;
    let at = pose([0.0, 0.0, 0.12 - depth], [0.0; 3]);
    let force = 2e7 * 5e7 / 7e7 * 0.1 * 0.16 * depth;
    let wrenches =
        [(l_mesh(SOFT), l_mesh(STIFF)), (l_boxes(SOFT), l_mesh(STIFF)), (l_boxes(SOFT), l_boxes(STIFF))]
            .map(|(a, b)| Pair::new(&a, &b).at(&at).0);
    for wrench in &wrenches {
        assert!((wrench.force.z / force - 1.0).abs() < 1e-6, "{wrench:?} for {force}");
        assert!((wrench.force - wrenches[0].force).norm() < 1e-6 * force, "{wrenches:?}");
        assert!((wrench.moment - wrenches[0].moment).norm() < 1e-6 * 0.1 * force, "{wrenches:?}");
    }
}

/// An L sinks into another one. The arm of A is 0.06 m thick, so the regions below its bottom are 0.03 m high. The upper
/// end of B is far from every other side.
#[test]
fn contacts_deeper_than_the_regions_are_reported() {
    let at_depth = |a: &str, b: &str, depth: f64| {
        let mut pair = Pair::new(a, b);
        pair.at(&pose([0.0, 0.0, 0.12 - depth], [0.0; 3]));
        let names = |report: DeepInMeshReport| (report.mesh, report.other) == (pair.roots[0], pair.roots[1]);
        let found = pair.world.deep_in_mesh().map(|report| (names(report), report.facets));
        let is_set = pair.world.report().status.contains(StatusBits::DEEP_IN_MESH);
        assert_eq!(found.is_some(), is_set, "{depth} m");
        found
    };
    let (soft, stiff) = (l_mesh(SOFT), l_mesh(STIFF));
    for depth in [-0.001, 1e-6, 0.02, 0.0299] {
        assert_eq!(at_depth(&soft, &stiff, depth), None, "{depth} m");
    }
    // The two triangles of the bottom, and some of the sides.
    for depth in [0.0301, 0.04] {
        let (is_named, facets) = at_depth(&soft, &stiff, depth).unwrap();
        assert!(is_named && facets >= 2, "{depth} m: {facets}");
    }
    // Convex pieces have no regions.
    assert_eq!(at_depth(&l_boxes(SOFT), &l_boxes(STIFF), 0.04), None);
}

/// Two rings linked like those of a chain, A pulled along x by more than the chain is long: the force on A points back,
/// and the wrenches are opposite.
#[test]
fn linked_rings_hold_each_other() {
    let ring = |surface: &str| mesh(surface, &torus(0.1, 0.03, 48, 24));
    let mut pair = Pair::new(&ring(SOFT), &ring(STIFF));
    // B lies in the plane of x and y, A in that of x and z.
    let upright = Quat::from_scaled_axis(Vec3::x() * std::f64::consts::FRAC_PI_2);
    for tilt in [0.0, 0.1] {
        let across = Quat::from_scaled_axis(Vec3::y() * tilt);
        let at = Pose { position: Vec3::new(0.14 + 5e-4, 0.0, 0.0), orientation: across * upright };
        let (wrench, energy) = pair.at(&at);
        assert!(energy > 0.0 && wrench.force.x < 0.0, "{tilt}: {energy} {wrench:?}");
        assert!(wrench.force.yz().norm() < 0.2 * -wrench.force.x, "{tilt}: {wrench:?}");
        let on_b = pair.world.wrench_common(pair.roots[1]).unwrap();
        assert!(
            (wrench.force + on_b.force).norm() < 1e-9 * wrench.force.norm(),
            "{tilt}: {wrench:?} {on_b:?}"
        );
    }
}

/// A height field over a square of 1 m with a flat bottom: `cells` squares of two triangles along each side, and ten by
/// ten bumps.
fn bumpy_plate(cells: usize) -> String {
    let step = 1.0 / cells as f64;
    let height = |i: usize, j: usize| {
        let wave = |k: usize| (std::f64::consts::PI * 10.0 * k as f64 * step).sin().powi(2);
        0.1 + 0.02 * wave(i) * wave(j)
    };
    let side = cells + 1;
    let places = |top: bool| {
        (0..side * side).map(move |at| {
            let (i, j) = (at % side, at / side);
            let z = if top { height(i, j) } else { 0.0 };
            Vec3::new(i as f64 * step - 0.5, j as f64 * step - 0.5, z)
        })
    };
    let vertices: Vec<Vec3> = places(true).chain(places(false)).collect();
    let top = |i: usize, j: usize| j * side + i;
    let below = side * side;
    let mut triangles = Vec::new();
    for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
        let [a, b, c, d] = [top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
        triangles.extend([[a, c, b], [a, d, c]].map(|triangle| triangle.map(|vertex| vertex + below)));
    }
    for k in 0..cells {
        let rim = [
            [top(k + 1, 0), top(k, 0)],
            [top(k, cells), top(k + 1, cells)],
            [top(0, k), top(0, k + 1)],
            [top(cells, k + 1), top(cells, k)],
        ];
        for [a, b] in rim {
            triangles.extend([[a, b, b + below], [a, b + below, a + below]]);
        }
    }
    solid(SOFT, &triangle_mesh("plate", &vertices, &triangles, ""))
}

/// A mesh of many parts is divided into slices, which threads share. Each of the hundred bumps of a plate touches that of
/// the other plate, whichever slice has it, and the bits do not depend on the threads.
#[test]
fn every_slice_of_a_large_mesh_is_tested_on_any_number_of_workers() {
    let text = bumpy_plate(60);
    let deep = |height: f64, workers: Option<WorkerSettings>| {
        let Rig { world, interfaces: roots, .. } =
            Rig::with_config(Config { workers, ..Config::default() }, &text, &text);
        let mut pair = Pair { world, roots };
        let (wrench, energy) = pair.at(&pose([0.0, 0.0, height], [std::f64::consts::PI, 0.0, 0.0]));
        let contacts: Vec<_> = pair.contacts().iter().map(|contact| (contact.point, contact.force)).collect();
        (wrench, energy, contacts)
    };
    let alone = deep(0.24 - 1e-4, None);
    let bumps: std::collections::BTreeSet<[i64; 2]> =
        alone.2.iter().map(|(point, _)| [0, 1].map(|axis| (point[axis] * 10.0).floor() as i64)).collect();
    assert_eq!(bumps.len(), 100);
    let (force, moment) = (alone.0.force, alone.0.moment);
    assert!(force.z > 0.0 && moment.norm() < 1e-9 * force.z, "{force:?} {moment:?}");
    for count in [1, 3] {
        assert!(deep(0.24 - 1e-4, workers(count)) == alone, "{count} workers");
    }
    assert_eq!(deep(0.24 + 1e-6, workers(1)).2, []);
}

/// Times of loading and of frames of two bumpy plates whose 81 to 100 bumps touch. `PLATE_CELLS` sets their size: 500
/// are a million triangles each.
#[test]
#[ignore = "a measurement"]
fn times_of_two_large_meshes() {
    let cells = std::env::var("PLATE_CELLS").map_or(100, |cells| cells.parse().expect("a number"));
    let text = bumpy_plate(cells);
    let start = std::time::Instant::now();
    let mut pair = Pair::new(&text, &text);
    println!("{} triangles: two loaded and sealed in {:?}", 4 * cells * cells + 8 * cells, start.elapsed());
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    println!("{}", status.lines().find(|line| line.starts_with("VmHWM")).unwrap_or(""));
    // The upper plate is turned over about x, so that its bumps meet those of the lower one.
    for (name, height) in [("apart", 0.3), ("bumps touch", 0.24 - 1e-5), ("deeper", 0.24 - 1e-4)] {
        let at = pose([0.0, 0.0, height], [std::f64::consts::PI, 0.0, 0.0]);
        pair.at(&at);
        let contacts = pair.contacts().len();
        let start = std::time::Instant::now();
        let frames = 20;
        (0..frames).for_each(|_| _ = pair.world.evaluate().unwrap());
        println!("{name}: {contacts} contacts, {:?} a frame", start.elapsed() / frames);
    }
}
