//! Degenerate cases raise no floating-point exception at any instruction-set level: no 0/0 and no division by
//! zero, not even in unused lanes. The results are tested elsewhere.

use crate::common::{cuboid, levels, surface_of};
use pong_geometry::Vec3;
use pong_geometry::interference::line_segment_polyhedron::line_segment_polyhedron;
use pong_geometry::interference::point_polyhedron::entry_of_line;
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::sphere_sphere::sphere_sphere;
use pong_geometry::pose::carry_by_smallest_rotation;
use pong_geometry::primitive::{LineSegment, Polyhedron, Ray, Sphere};
use pong_geometry::simd::{Level, set_level};
use pong_testkit::exceptions::are_raised_by;
use std::hint::black_box;

fn assert_none(what: &str, work: impl Fn()) {
    let _turn = levels::Turn::wait();
    for level in Level::available() {
        set_level(level);
        assert!(!are_raised_by(&work), "{what}, {}", level.name());
    }
}

/// Lines along the faces of a box: in the plane of one, above it, below it; through the box and past it.
fn lines_along_faces() -> impl Iterator<Item = [Vec3; 2]> {
    let heights = [1.0, 2.0, 0.5, 0.0, -1.0];
    heights.into_iter().flat_map(move |y| {
        heights
            .into_iter()
            .flat_map(move |z| [[-3.0, 3.0], [0.5, 3.0], [2.0, 3.0]].map(|xs| xs.map(|x| Vec3::new(x, y, z))))
    })
}

fn solid() -> Polyhedron {
    cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0))
}

#[test]
fn lines_along_the_faces_of_a_solid() {
    let solid = solid();
    for ends in lines_along_faces() {
        assert_none(&format!("ray along {ends:?}"), || {
            let ray = Ray::between(&ends[0], &ends[1]).expect("two places");
            black_box(ray_polyhedron(black_box(&ray), &solid));
        });
        assert_none(&format!("segment along {ends:?}"), || {
            black_box(line_segment_polyhedron(black_box(&LineSegment { ends }), &solid));
        });
        assert_none(&format!("line along {ends:?}"), || {
            black_box(entry_of_line(black_box(&ends[0]), &ends[1], &solid));
        });
    }
}

#[test]
fn lines_along_triangles() {
    let set = surface_of(&solid());
    for ends in lines_along_faces() {
        let ray = Ray::between(&ends[0], &ends[1]).expect("two places");
        for triangle in 0..set.triangles.len() as u32 {
            assert_none(&format!("ray along {ends:?}, triangle {triangle}"), || {
                black_box(ray_triangle(black_box(&ray), &set, triangle, 0.0));
            });
        }
    }
}

/// A line without length has no direction, nor has one whose length overflows; a loop around it changes
/// nothing.
#[test]
fn lines_without_length_and_beyond_numbers() {
    let far = Vec3::repeat(f64::MAX);
    for (from, to) in [(Vec3::zeros(), Vec3::zeros()), (Vec3::x(), Vec3::x()), (far, far), (-far, far)] {
        assert_none(&format!("from {from:?} to {to:?}"), || {
            let (from, to) = black_box((from, to));
            let is_any = (0..black_box(3)).any(|_| black_box(Ray::between(&from, &to)).is_some());
            assert!(!is_any);
        });
    }
}

#[test]
fn places_that_coincide() {
    let ball = Sphere { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.5 };
    assert_none("two balls in one place", || {
        black_box(sphere_sphere(black_box(&ball), &ball));
    });
    assert_none("opposite normals", || {
        black_box(carry_by_smallest_rotation(black_box(&Vec3::y()), &Vec3::x(), &-Vec3::x()));
    });
}
