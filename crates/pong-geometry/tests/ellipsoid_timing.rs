//! Nanoseconds per query of the ellipsoid testers, printed (run with `--ignored --nocapture`).

mod common;

use common::{Random, stretched_hull, surface_of};
use pong_geometry::Vec3;
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_polyhedron;
use pong_geometry::interference::ellipsoid_triangle::ellipsoid_triangle;
use pong_geometry::interference::point_ellipsoid::point_ellipsoid;
use pong_geometry::primitive::{Ellipsoid, Polyhedron};
use std::hint::black_box;
use std::time::Instant;

/// The least of several passes over all queries, so that a busy machine counts little.
fn least_ns(queries: usize, mut pass: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..15 {
        let start = Instant::now();
        pass();
        least = least.min(start.elapsed().as_nanos() as f64 / queries as f64);
    }
    least
}

/// Ellipsoids at a hull: pushed `low` to `high` (m) deep along a random line from where they just touch.
fn posed(p: &Polyhedron, low: f64, high: f64) -> Vec<Ellipsoid> {
    let mut random = Random(7);
    (0..2000)
        .map(|_| {
            let (axes, line) = (random.rotation_matrix(), random.direction());
            let at = |s: f64| Ellipsoid { center: line * s, axes, semi_axes: Vec3::new(0.2, 0.12, 0.08) };
            let (mut touching, mut apart) = (0.0, 1.0);
            for _ in 0..40 {
                let middle = 0.5 * (touching + apart);
                if ellipsoid_polyhedron(&at(middle), p).is_some() {
                    touching = middle
                } else {
                    apart = middle
                }
            }
            at(touching - random.between(low, high))
        })
        .collect()
}

#[test]
#[ignore = "prints times"]
fn time_per_query() {
    for vertices in [8, 18, 66] {
        let p = stretched_hull(vertices, Vec3::new(0.5, 0.4, 0.3));
        let set = surface_of(&p);
        for (low, high) in [(0.0005, 0.005), (0.005, 0.1), (-0.3, -0.005)] {
            let ellipsoids = posed(&p, low, high);
            let polyhedron = least_ns(ellipsoids.len(), || {
                for e in &ellipsoids {
                    black_box(ellipsoid_polyhedron(black_box(e), &p));
                }
            });
            let triangle = least_ns(ellipsoids.len() * set.triangles.len(), || {
                for e in &ellipsoids {
                    for t in 0..set.triangles.len() as u32 {
                        ellipsoid_triangle(black_box(e), &set, t, 0.08, &mut |c| {
                            black_box(c);
                        });
                    }
                }
            });
            println!(
                "{} faces, {low} to {high} m deep: polyhedron {polyhedron:.0} ns, triangle {triangle:.0} ns",
                p.faces.len()
            );
        }
    }
    let mut random = Random(9);
    let queries: Vec<(Vec3, Ellipsoid)> = (0..2000)
        .map(|_| {
            let e = Ellipsoid {
                center: random.direction(),
                axes: random.rotation_matrix(),
                semi_axes: Vec3::from_fn(|_, _| random.between(0.1, 1.0)),
            };
            (e.center + e.axes * random.direction().component_mul(&e.semi_axes) * random.unit(), e)
        })
        .collect();
    let point = least_ns(queries.len(), || {
        for (p, e) in &queries {
            black_box(point_ellipsoid(black_box(p), e));
        }
    });
    println!("point_ellipsoid {point:.0} ns");
}
