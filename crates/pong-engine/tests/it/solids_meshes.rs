//! Closed meshes that are not convex touch each other: the wrench is the derivative of the stored energy where the
//! depth is small beside the regions of the facets, and that of the same solid in convex pieces.

use super::solids::{Pair, SOFT, STIFF, directions, moved, power, random_vector, solid};
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_testkit::Random;
use pong_testkit::meshes::{Place, torus};
use pong_testkit::ron::{box_polyhedron, triangle_mesh};
use pong_testkit::samples::samples;

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

/// An L: an outline of six corners in x and z, from −0.08 m to 0.08 m along y.
fn l_mesh(surface: &str) -> String {
    let outline = [[-0.1, -0.06], [0.1, -0.06], [0.1, 0.0], [0.0, 0.0], [0.0, 0.06], [-0.1, 0.06]];
    let place = |corner: usize, y: f64| [outline[corner][0], y, outline[corner][1]];
    let mut triangles = Vec::new();
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]] {
        triangles.push([a, b, c].map(|corner| place(corner, -0.08)));
        triangles.push([a, c, b].map(|corner| place(corner, 0.08)));
    }
    for a in 0..6 {
        let b = (a + 1) % 6;
        let [low, high] = [-0.08, 0.08];
        triangles.push([place(a, low), place(a, high), place(b, high)]);
        triangles.push([place(a, low), place(b, high), place(b, low)]);
    }
    mesh(surface, &triangles)
}

/// The same L as two boxes.
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

/// At random touches of a small depth the wrench is minus the derivative of the energy.
#[test]
fn wrench_of_meshes_is_the_derivative_of_the_energy() {
    let ring = |sides: usize| torus(0.1, 0.03, 2 * sides, sides);
    let pairs = [
        ("L on L", l_mesh(SOFT), l_mesh(STIFF)),
        ("coarse tori", mesh(SOFT, &ring(5)), mesh(STIFF, &ring(6))),
        ("fine tori", mesh(SOFT, &ring(12)), mesh(STIFF, &ring(16))),
        ("L mesh on L of boxes", l_mesh(SOFT), l_boxes(STIFF)),
    ];
    for (name, a, b) in pairs {
        let mut pair = Pair::new(&a, &b);
        let mut random = Random::new(31, 0, 0);
        let mut errors: Vec<f64> = Vec::new();
        for _ in 0..samples(600) {
            let turn = Quat::from_scaled_axis(random_vector(&mut random, 2.0));
            let along = random_vector(&mut random, 1.0).normalize();
            let Some(at) = touch(&mut pair, turn, along, 0.4) else { continue };
            let at = Pose { position: along * (at - 2e-4), orientation: turn };
            let error = error_of_gradient(&mut pair, &at, 1e-8);
            errors.push(error);
        }
        errors.sort_by(f64::total_cmp);
        let [median, most, worst] =
            [errors[errors.len() / 2], errors[errors.len() * 95 / 100], errors[errors.len() - 1]];
        println!("{name}: {} touches, median {median:.1e}, 95 % {most:.1e}, worst {worst:.1e}", errors.len());
    }
}
