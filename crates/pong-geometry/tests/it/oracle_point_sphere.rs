//! Points and spheres against planes, spheres and polyhedra, each compared with a plain search.
//!
//! Degenerate cases: concentric spheres, a point at a sphere's centre; centres on faces, edges and vertices of a
//! box, on an inner wall, at the crossing of walls; depths of exactly zero.

use crate::common;
use crate::common::{Random, cuboid, hull, hull_with_walls, moved, random_motion, stretched_hull};
use crate::oracle_support;
use crate::oracle_support::{Worst, join_pieces, nearest_on_polyhedron, polygon};
use pong_geometry::Vec3;
use pong_geometry::interference::point_plane::point_plane;
use pong_geometry::interference::point_polyhedron::{point_below_face, shallowest_face};
use pong_geometry::interference::point_sphere::point_sphere;
use pong_geometry::interference::sphere_plane::sphere_plane;
use pong_geometry::interference::sphere_polyhedron::{
    sphere_inside_polyhedron, sphere_outside_polyhedron, sphere_polyhedron,
};
use pong_geometry::interference::sphere_sphere::sphere_sphere;
use pong_geometry::primitive::{Plane, Point, Polyhedron, Sphere};

/// Largest φ(n) = min n·a − max n·b over a fan of directions that is narrowed repeatedly.
fn best_separation(phi: &dyn Fn(&Vec3) -> f64, random: &mut Random) -> (f64, Vec3) {
    let mut best = (f64::NEG_INFINITY, Vec3::x());
    for _ in 0..200 {
        let n = random.direction();
        let value = phi(&n);
        if value > best.0 {
            best = (value, n);
        }
    }
    let mut reach = 0.5;
    while reach > 1e-9 {
        let mut improved = false;
        for _ in 0..8 {
            let n = (best.1 + random.direction() * reach).normalize();
            let value = phi(&n);
            if value > best.0 {
                best = (value, n);
                improved = true;
            }
        }
        if !improved {
            reach *= 0.6;
        }
    }
    best
}

#[test]
fn planes_against_three_points_of_the_plane() {
    let mut random = Random(101);
    let mut worst = Worst::new("plane depth, relative");
    for _ in 0..10_000 {
        let n = random.direction();
        let offset = random.between(-3.0, 3.0);
        let plane = Plane { normal: n, offset };
        // The plane recomputed from three of its points; height by volume over area.
        let u = n.cross(&random.direction()).normalize();
        let v = n.cross(&u);
        let corners = [n * offset, n * offset + u * 2.0, n * offset + v * 2.0];
        let p = random.direction() * random.between(0.0, 4.0);
        let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let height = area.dot(&(p - corners[1])) / area.norm();
        let radius = random.between(0.01, 2.0);
        let point = point_plane(&Point { position: p }, &plane);
        let ball = sphere_plane(&Sphere { center: p, radius }, &plane);
        for (contact, expected, nearest) in [(point, -height, p), (ball, radius - height, p - n * radius)] {
            match contact {
                Some(contact) => {
                    worst.note((contact.depth - expected).abs() / 4.0, 1e-14);
                    assert_eq!(contact.normal_b, n);
                    worst.note((contact.deepest_b - nearest).norm() / 4.0, 1e-14);
                }
                None => assert!(expected <= 1e-14),
            }
        }
    }
}

#[test]
fn spheres_against_the_search_over_directions() {
    let mut random = Random(102);
    let (mut depth, mut normal) = (Worst::new("sphere–sphere depth"), Worst::new("sphere–sphere normal"));
    let mut touching = 0;
    for round in 0..10_000 {
        let a = Sphere { center: random.direction() * random.unit(), radius: random.between(0.05, 1.0) };
        let b = Sphere { center: random.direction() * random.unit(), radius: random.between(0.05, 1.0) };
        let distance = (0..3).map(|i| (a.center[i] - b.center[i]).powi(2)).sum::<f64>().sqrt();
        let contact = sphere_sphere(&a, &b);
        let point = point_sphere(&Point { position: a.center }, &b);
        assert_eq!(contact.is_some(), distance < a.radius + b.radius);
        assert_eq!(point.is_some(), distance < b.radius);
        if let Some(point) = point {
            depth.note((point.depth - (b.radius - distance)).abs(), 1e-15);
            assert_eq!(point.deepest_b, a.center);
        }
        let Some(contact) = contact else { continue };
        touching += 1;
        depth.note((contact.depth - (a.radius + b.radius - distance)).abs(), 1e-15);
        let support = a.center - contact.normal_b * a.radius;
        depth.note((contact.deepest_b - support).norm(), 1e-15);
        // Direct evaluation of the definition for some of them.
        if round % 10 == 0 {
            let phi = |n: &Vec3| n.dot(&a.center) - a.radius - (n.dot(&b.center) + b.radius);
            let (value, n) = best_separation(&phi, &mut random);
            depth.note((contact.depth + value).abs() * 1e-2, 1e-14);
            normal.note((contact.normal_b - n).norm() * distance, 1e-6);
        }
    }
    assert!(touching > 4000);
}

#[test]
fn coinciding_centres_are_finite_and_the_same_every_time() {
    let ball = Sphere { center: Vec3::new(0.1, -0.2, 0.3), radius: 0.5 };
    let contact = sphere_sphere(&ball, &ball).expect("they overlap");
    assert_eq!((contact.depth, contact.normal_b), (1.0, Vec3::x()));
    let contact = point_sphere(&Point { position: ball.center }, &ball).expect("inside");
    assert_eq!((contact.depth, contact.normal_b), (0.5, Vec3::x()));
    for apart in [1e-300, 1e-200, 1e-100, 5e-324] {
        let other = Sphere { center: ball.center * 0.0 + Vec3::new(0.0, apart, 0.0), radius: 1.0 };
        let contact = sphere_sphere(&other, &Sphere { center: Vec3::zeros(), radius: 1.0 }).expect("overlap");
        assert!(contact.depth == 2.0 && (contact.normal_b.norm() - 1.0).abs() < 1e-15, "{contact:?}");
    }
    // Exactly touching is no contact.
    let touching = Sphere { center: Vec3::x(), radius: 0.5 };
    assert!(sphere_sphere(&touching, &Sphere { center: Vec3::zeros(), radius: 0.5 }).is_none());
    assert!(sphere_plane(&touching, &Plane { normal: Vec3::x(), offset: 0.5 }).is_none());
    assert!(point_plane(&Point { position: Vec3::x() }, &Plane { normal: Vec3::x(), offset: 1.0 }).is_none());
}

fn shapes(random: &mut Random) -> Vec<Polyhedron> {
    let mut shapes = vec![
        cuboid(Vec3::new(-1.0, -0.7, -0.4), Vec3::new(1.0, 0.7, 0.4)),
        stretched_hull(14, Vec3::new(1.0, 0.8, 0.6)),
        stretched_hull(40, Vec3::new(1.0, 1.0, 1.0)),
        hull(&[Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()].map(|v| v * 1.5 - Vec3::repeat(0.3))),
    ];
    let outline = [(1.0, 0.0), (0.6, 0.9), (-0.8, 0.7), (-1.0, -0.3), (0.2, -1.0)];
    let prism: Vec<Vec3> =
        outline.iter().flat_map(|&(x, y)| [-0.4, 0.5].map(|z| Vec3::new(x, y, z))).collect();
    shapes.push(hull(&prism));
    shapes.iter().map(|shape| moved(shape, &random_motion(random, 1.0))).collect()
}

fn middle(shape: &Polyhedron) -> Vec3 {
    shape.vertices.iter().map(|v| v.position).sum::<Vec3>() / shape.vertices.len() as f64
}

/// Depth below every face by volume over area, from the corners of the face alone.
fn depths(shape: &Polyhedron, p: &Vec3) -> Vec<f64> {
    (0..shape.faces.len())
        .map(|face| {
            let c = polygon(shape, face);
            let mut area = Vec3::zeros();
            for k in 1..c.len() - 1 {
                area += (c[k] - c[0]).cross(&(c[k + 1] - c[0]));
            }
            -area.dot(&(p - c[0])) / area.norm()
        })
        .collect()
}

#[test]
fn points_and_spheres_inside_find_the_least_depth() {
    let mut random = Random(103);
    let mut worst = Worst::new("inside a polyhedron: depth");
    let shapes = shapes(&mut random);
    let mut inside = 0;
    while inside < 10_000 {
        let shape = &shapes[(random.bits() % shapes.len() as u64) as usize];
        let p = middle(shape) + random.direction() * random.between(0.0, 1.0);
        let depths = depths(shape, &p);
        let least = depths.iter().copied().fold(f64::INFINITY, f64::min);
        if least.abs() > 1e-13 {
            assert_eq!(shape.contains(&p), least > 0.0);
        }
        if least < 1e-13 {
            assert!(least > -1e-13 || !shape.contains(&p));
            continue;
        }
        inside += 1;
        let face = shallowest_face(&p, shape).expect("active faces");
        let contact = point_below_face(&p, shape, face).expect("inside");
        worst.note((contact.depth - least).abs(), 1e-14);
        // For a point, nearest face, nearest surface point and minimum translation coincide.
        let (foot, _) = nearest_on_polyhedron(shape, &p);
        worst.note(((foot - p).norm() - contact.depth).abs(), 1e-14);
        let radius = random.between(0.001, 2.0);
        let ball = sphere_inside_polyhedron(&Sphere { center: p, radius }, shape, face);
        worst.note((ball.depth - (least + radius)).abs(), 1e-14);
        worst.note((ball.deepest_b - (p - contact.normal_b * radius)).norm(), 1e-14);
        assert_eq!((ball.normal_b, ball.feature), (contact.normal_b, contact.feature));
        assert_eq!(sphere_polyhedron(&Sphere { center: p, radius }, shape), Some(ball));
    }
}

#[test]
fn spheres_outside_meet_the_nearest_surface_point() {
    let mut random = Random(104);
    let mut depth = Worst::new("sphere outside a polyhedron: depth");
    let mut turn = Worst::new("sphere outside a polyhedron: normal × distance");
    let shapes = shapes(&mut random);
    let (mut outside, mut touching) = (0, 0);
    while touching < 10_000 {
        let shape = &shapes[(random.bits() % shapes.len() as u64) as usize];
        let center = middle(shape) + random.direction() * random.between(0.2, 2.5);
        if shape.contains(&center) {
            continue;
        }
        outside += 1;
        let sphere = Sphere { center, radius: random.between(0.01, 2.0) };
        let (foot, _) = nearest_on_polyhedron(shape, &center);
        let distance = (center - foot).norm();
        match sphere_outside_polyhedron(&sphere, shape) {
            Some(contact) => {
                touching += 1;
                depth.note((contact.depth - (sphere.radius - distance)).abs(), 1e-13);
                turn.note((contact.normal_b * distance - (center - foot)).norm(), 1e-13);
                let support = center - contact.normal_b * sphere.radius;
                depth.note((contact.deepest_b - support).norm(), 1e-15);
            }
            None => assert!(distance > sphere.radius - 1e-14, "lost: {distance} < {}", sphere.radius),
        }
    }
    assert!(outside > touching);
}

/// Box in three pieces along two internal faces; the outer surface is that of the whole box.
fn box_in_pieces() -> (Vec<Polyhedron>, Polyhedron) {
    let cuts = [-1.0, -0.31, 0.42, 1.0];
    let mut pieces: Vec<Polyhedron> = (0..3)
        .map(|i| {
            let corners =
                common::cuboid_corners(Vec3::new(cuts[i], -0.7, -0.4), Vec3::new(cuts[i + 1], 0.7, 0.4));
            hull_with_walls(&corners, &|n, d| {
                n.x.abs() > 0.9 && (n.x * d + 1.0).abs() > 1e-9 && (n.x * d - 1.0).abs() > 1e-9
            })
        })
        .collect();
    oracle_support::close_lower_walls(&mut pieces);
    join_pieces(&mut pieces);
    (pieces, cuboid(Vec3::new(-1.0, -0.7, -0.4), Vec3::new(1.0, 0.7, 0.4)))
}

#[test]
fn every_point_inside_belongs_to_exactly_one_piece() {
    let (pieces, whole) = box_in_pieces();
    let mut random = Random(105);
    for round in 0..20_000 {
        let mut p = Vec3::from_fn(|_, _| random.between(-1.1, 1.1));
        if round % 2 == 0 {
            // On an internal face, and one ulp beside it.
            let wall = if round % 4 == 0 { -0.31 } else { 0.42 };
            p.x = oracle_support::nudge(wall, (round / 4) % 3 - 1);
        }
        let owners = pieces.iter().filter(|piece| piece.contains(&p)).count();
        assert_eq!(owners, usize::from(whole.contains(&p)), "{p:?}");
    }
    // On an internal face: the lower piece.
    for (x, owner) in [(-0.31, 0), (0.42, 1)] {
        let p = Vec3::new(x, 0.1, 0.1);
        assert_eq!(pieces.iter().position(|piece| piece.contains(&p)), Some(owner));
    }
}

/// Load sharing decides which of the pieces' contacts count; the deepest of them is that of the whole box.
#[test]
fn spheres_over_pieces_see_the_whole_box() {
    let (pieces, whole) = box_in_pieces();
    let mut random = Random(106);
    let mut worst = Worst::new("sphere over pieces: depth and normal");
    let mut touching = 0;
    while touching < 10_000 {
        let mut center = Vec3::from_fn(|_, _| random.between(-1.6, 1.6));
        if touching % 3 == 0 {
            let wall = if random.bits().is_multiple_of(2) { -0.31 } else { 0.42 };
            center.x = oracle_support::nudge(wall, (random.bits() % 5) as i64 - 2);
        }
        if whole.contains(&center) {
            continue;
        }
        let sphere = Sphere { center, radius: 0.6 };
        let contacts: Vec<_> =
            pieces.iter().filter_map(|piece| sphere_outside_polyhedron(&sphere, piece)).collect();
        let (foot, _) = nearest_on_polyhedron(&whole, &center);
        let distance = (center - foot).norm();
        if distance >= 0.6 - 1e-13 {
            assert!(contacts.is_empty());
            continue;
        }
        touching += 1;
        let deepest = contacts.iter().max_by(|a, b| a.depth.total_cmp(&b.depth)).expect("a contact");
        worst.note((deepest.depth - (0.6 - distance)).abs(), 1e-14);
        worst.note((deepest.normal_b * distance - (center - foot)).norm(), 1e-14);
        // A convex surface has one nearest point: a piece that pushes elsewhere would push a second time.
        for contact in &contacts {
            worst.note((contact.deepest_b + contact.normal_b * contact.depth - foot).norm(), 1e-13);
        }
    }
}

#[test]
fn centres_on_features_count_as_outside_and_are_finite() {
    let shape = cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    for x in [-1.0, 0.0, 1.0] {
        for y in [-1.0, 0.0, 1.0] {
            for z in [-1.0, 0.0, 1.0] {
                let center = Vec3::new(x, y, z);
                let zeros = [x, y, z].iter().filter(|c| **c == 0.0).count();
                if zeros == 3 {
                    continue;
                }
                assert!(!shape.contains(&center));
                let contact =
                    sphere_outside_polyhedron(&Sphere { center, radius: 0.25 }, &shape).expect("touches");
                assert_eq!(contact.depth, 0.25);
                // Straight out along the lowest of the faces that meet there.
                let meets = |face: &usize| shape.height(*face, &center) == 0.0;
                let lowest = (0..shape.faces.len()).find(meets).expect("on a face");
                assert_eq!(contact.normal_b, shape.faces[lowest].normal);
            }
        }
    }
}
