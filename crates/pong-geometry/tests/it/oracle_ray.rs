//! Rays against planes, triangles and polyhedra, compared with independent closed forms; no leaks at seams.
//!
//! Degenerate cases: rays along a surface, from behind, aimed exactly at edges and vertices, running within an
//! inner wall, starting inside; hits exactly at the length and at the reach.

use crate::common;
use crate::common::{Random, cuboid_corners, hull_with_walls, moved, random_motion, stretched_hull};
use crate::oracle_support;
use crate::oracle_support::{
    Worst, close_lower_walls, dented_ball, fan_plate, hilly_sheet, join_pieces, moved_surface, polygon,
    rounded_to_f32, skin, surface, winding_number,
};
use pong_geometry::Vec3;
use pong_geometry::interference::ray_plane::{RayHit, ray_contact, ray_plane};
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::primitive::{Plane, Polyhedron, Ray, RayResponse, TriangleSet};

fn ray(origin: Vec3, direction: Vec3, length: f64, reach: Option<f64>) -> Ray {
    Ray { origin, direction, length, reach, response: RayResponse::Normal }
}

fn random_ray(random: &mut Random) -> Ray {
    let reach = (random.bits().is_multiple_of(2)).then(|| random.between(0.0, 0.5));
    ray(random.direction() * random.between(0.0, 2.0), random.direction(), random.between(0.1, 4.0), reach)
}

/// Intersection of a line with the plane through three points, by the ratio of two volumes.
fn meets(r: &Ray, [a, b, c]: &[Vec3; 3]) -> (f64, Vec3) {
    let volume = |p: &Vec3, q: &Vec3, s: &Vec3| p.dot(&q.cross(s));
    let (u, v) = (b - a, c - a);
    let t = -volume(&(r.origin - a), &u, &v) / volume(&r.direction, &u, &v);
    (t, r.origin + r.direction * t)
}

#[test]
fn planes_against_volumes() {
    let mut random = Random(301);
    let mut worst = Worst::new("ray–plane: distance × slope, depth, tip");
    let mut hits = 0;
    while hits < 10_000 {
        let normal = random.direction();
        let plane = Plane { normal, offset: random.between(-1.0, 1.0) };
        let u = normal.cross(&random.direction()).normalize();
        let corner = normal * plane.offset;
        let mut r = random_ray(&mut random);
        let (t, _) = meets(&r, &[corner, corner + u, corner + normal.cross(&u)]);
        let closing = r.direction.dot(&normal);
        let reach = r.reach.unwrap_or(0.0);
        let expected = closing < 0.0 && -reach < t && t < r.length;
        let hit = ray_plane(&r, &plane);
        if hit.is_some() != expected {
            assert!((t + reach).abs().min((t - r.length).abs()) < 1e-12);
            continue;
        }
        let Some(hit) = hit else { continue };
        hits += 1;
        worst.note((hit.distance - t).abs() * -closing / (4.0 + t.abs()), 1e-14);
        let below = plane.offset - normal.dot(&(r.origin + r.direction * r.length));
        let contact = ray_contact(&r, &hit);
        worst.note((contact.depth - below).abs() / 5.0, 1e-14);
        assert_eq!(contact.normal_b, normal);
        worst.note((contact.deepest_b - (r.origin + r.direction * r.length)).norm(), 1e-15);
        r.response = RayResponse::Axial;
        let contact = ray_contact(&r, &hit);
        assert_eq!((contact.depth, contact.normal_b), (r.length - hit.distance, -r.direction));
    }
}

/// Signed areas of the three parts into which a point divides a triangle, over its area; the least.
fn least_share([a, b, c]: &[Vec3; 3], p: &Vec3) -> f64 {
    let area = (b - a).cross(&(c - a));
    [(a, b), (b, c), (c, a)]
        .map(|(from, to)| (from - p).cross(&(to - p)).dot(&area) / area.norm_squared())
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn triangles_against_volumes() {
    let mut random = Random(302);
    let mut worst = Worst::new("ray–triangle: distance × slope");
    let (mut hits, mut rounds) = (0, 0);
    while hits < 10_000 {
        rounds += 1;
        let corners = [0; 3].map(|_| random.direction() * random.between(0.1, 1.5));
        let set = surface(corners.to_vec(), &[[0, 1, 2]]);
        let r = random_ray(&mut random);
        // Aimed at the neighbourhood of the triangle.
        let aim =
            (corners[0] + corners[1] + corners[2]) / 3.0 + random.direction() * random.between(0.0, 0.5);
        let r = ray(r.origin, (aim - r.origin).normalize(), r.length, r.reach);
        let reach = random.between(0.0, 0.4);
        let (t, p) = meets(&r, &corners);
        let closing = r.direction.dot(&set.normal(0));
        let margin = [least_share(&corners, &p), t + reach, r.length - t, -closing]
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        if margin.abs() < 1e-9 {
            continue;
        }
        let hit = ray_triangle(&r, &set, 0, reach);
        assert_eq!(hit.is_some(), margin > 0.0, "{r:?} {corners:?}");
        if let Some(hit) = hit {
            hits += 1;
            worst.note((hit.distance - t).abs() * closing.abs() * least_height(&corners) / 4.0, 1e-14);
            worst.note((hit.normal_b - set.normal(0)).norm(), 0.0);
        }
    }
    println!("{hits} hits of {rounds}");
}

/// Least height of a triangle over its longest side (at most 1), to which the rounding of its normal is
/// inversely proportional.
fn least_height([a, b, c]: &[Vec3; 3]) -> f64 {
    let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
    (b - a).cross(&(c - a)).norm() / (longest * longest)
}

/// Reference: among the faces that the ray's line meets within their polygon from the front, the one that
/// counts; and true if the origin has not passed the solid.
fn polyhedron_hit(r: &Ray, shape: &Polyhedron) -> Option<(f64, usize, f64)> {
    let mut entry = None;
    let (mut exit, mut margin) = (f64::NEG_INFINITY, f64::INFINITY);
    for face in 0..shape.faces.len() {
        let c = polygon(shape, face);
        let (t, p) = meets(r, &[c[0], c[1], c[2]]);
        let inside = (1..c.len() - 1)
            .map(|k| least_share(&[c[0], c[k], c[k + 1]], &p))
            .fold(f64::NEG_INFINITY, f64::max);
        margin = margin.min(inside.abs());
        if inside > 0.0 {
            if r.direction.dot(&shape.faces[face].normal) < 0.0 {
                entry = Some((t, face));
            } else {
                exit = t;
            }
        }
    }
    let (t, face) = entry?;
    let reach = r.reach.unwrap_or(0.0);
    let good = shape.faces[face].active && -reach < t && t < r.length && exit > 0.0;
    margin = margin.min((t + reach).abs()).min((t - r.length).abs()).min(exit.abs());
    good.then_some((t, face, margin))
}

#[test]
fn polyhedra_against_their_polygons() {
    let mut random = Random(303);
    let mut worst = Worst::new("ray–polyhedron: distance × slope");
    let shapes = [
        stretched_hull(12, Vec3::new(1.0, 0.7, 0.5)),
        // Few faces are kept in registers, many are not.
        stretched_hull(18, Vec3::new(1.0, 0.7, 0.5)),
        stretched_hull(60, Vec3::new(1.0, 0.7, 0.5)),
        hull_with_walls(&cuboid_corners(Vec3::repeat(-0.6), Vec3::repeat(0.7)), &|n, _| n.x > 0.9),
    ]
    .map(|shape| moved(&shape, &random_motion(&mut random, 0.2)));
    let (mut hits, mut border) = (0, 0);
    while hits < 10_000 {
        let shape = &shapes[(random.bits() % 4) as usize];
        let mut r = random_ray(&mut random);
        r.direction = (random.direction() * 0.7 - r.origin).normalize();
        if random.bits().is_multiple_of(4) {
            r.direction = -r.direction;
        }
        let expected = polyhedron_hit(&r, shape);
        let hit = ray_polyhedron(&r, shape);
        match (expected, hit) {
            (Some((t, face, _)), Some(RayHit { distance, feature, normal_b: normal }))
                if feature.index() == face =>
            {
                hits += 1;
                worst.note((distance - t).abs() * -r.direction.dot(&normal) / 4.0, 2e-14);
            }
            (None, None) => {}
            // Only on a border may the two disagree.
            _ => {
                let wavers = (0..24).any(|_| {
                    let near = Ray { origin: r.origin + random.direction() * 1e-7, ..r };
                    polyhedron_hit(&near, shape).map(|h| h.1) != expected.map(|h| h.1)
                });
                assert!(wavers, "{r:?}: {expected:?} {hit:?}");
                border += 1;
            }
        }
    }
    assert!(border < 20);
}

fn first_hit(r: &Ray, set: &TriangleSet) -> Option<RayHit> {
    (0..set.triangles.len() as u32)
        .filter_map(|t| ray_triangle(r, set, t, 0.0))
        .min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Edges and vertices at which all triangles face `from` with a margin, and a point on each.
fn targets(set: &TriangleSet, from: &Vec3, random: &mut Random) -> Vec<Vec3> {
    let faces = |t: u32, p: &Vec3| set.normal(t).dot(&(from - p).normalize()) > 0.02;
    let count = set.triangles.len() as u32;
    let mut targets = Vec::new();
    for (v, p) in set.vertices.iter().enumerate() {
        let around: Vec<u32> =
            (0..count).filter(|&t| set.triangles[t as usize].vertices.contains(&(v as u32))).collect();
        let inner = around.iter().all(|&t| {
            let record = &set.triangles[t as usize];
            (0..3).all(|k| {
                let has = record.vertices[k] == v as u32 || record.vertices[(k + 1) % 3] == v as u32;
                !has || record.neighbors[k] != u32::MAX
            })
        });
        if inner && around.iter().all(|&t| faces(t, p)) {
            targets.push(*p);
        }
    }
    for t in 0..count {
        for k in 0..3 {
            let neighbor = set.triangles[t as usize].neighbors[k];
            if neighbor == u32::MAX || neighbor < t {
                continue;
            }
            let c = set.corners(t);
            let share = [0.5, random.unit(), 1e-9][(random.bits() % 3) as usize];
            let p = c[k] + (c[(k + 1) % 3] - c[k]) * share;
            if faces(t, &p) && faces(neighbor, &p) {
                targets.push(p);
            }
        }
    }
    targets
}

/// Rays aimed exactly at shared edges and vertices hit there or earlier; never later, and they never miss.
#[test]
fn no_ray_slips_through_a_seam() {
    let mut random = Random(304);
    let mut worst = Worst::new("rays at seams: distance");
    let mut aimed = 0;
    for round in 0..60 {
        let set = match round % 5 {
            0 => dented_ball(6, 9, 0.2, &mut random),
            1 => hilly_sheet(5, 0.3, &mut random),
            2 => fan_plate(&mut random),
            3 => skin(&stretched_hull(30, Vec3::new(1.0, 0.9, 0.7))),
            _ => oracle_support::regular_plate(6),
        };
        let set = moved_surface(&set, &random_motion(&mut random, 3.0));
        let set = if round % 2 == 0 { rounded_to_f32(&set) } else { set };
        for _ in 0..6 {
            let middle = set.vertices.iter().sum::<Vec3>() / set.vertices.len() as f64;
            let from = middle + random.direction() * random.between(1.5, 6.0);
            for target in targets(&set, &from, &mut random) {
                let gap = target - from;
                let r = ray(from, gap.normalize(), gap.norm() + 1.0, None);
                let hit = first_hit(&r, &set).unwrap_or_else(|| panic!("missed {target:?} from {from:?}"));
                worst.note((hit.distance - gap.norm()).max(0.0) / 6.0, 1e-13);
                aimed += 1;
            }
        }
    }
    println!("{aimed} rays at seams");
    assert!(aimed > 8000);
}

/// A ray straight along an axis onto the vertices and edges of a regular plate, exactly representable.
#[test]
fn exact_rays_onto_exact_seams_hit() {
    let set = oracle_support::regular_plate(4);
    for i in -3..=3 {
        for j in -3..=3 {
            let origin = Vec3::new(f64::from(i) / 4.0, f64::from(j) / 4.0, 1.0);
            let hit = first_hit(&ray(origin, -Vec3::z(), 2.0, None), &set).expect("hit");
            assert_eq!((hit.distance, hit.normal_b), (1.0, Vec3::z()));
            // From below: the back, no hit.
            let below = Vec3::new(origin.x, origin.y, -1.0);
            assert!(first_hit(&ray(below, Vec3::z(), 2.0, None), &set).is_none());
            // Along the plate: no hit.
            let within = Vec3::new(origin.x, origin.y, 0.0);
            assert!(first_hit(&ray(within, Vec3::x(), 2.0, None), &set).is_none());
        }
    }
    let tip_on_it = ray(Vec3::z(), -Vec3::z(), 1.0, None);
    assert!(first_hit(&tip_on_it, &set).is_none(), "a plunger that only touches is not shortened");
}

fn pieces(cut: f64, motion: &pong_geometry::Transform) -> Vec<Polyhedron> {
    let mut pieces: Vec<Polyhedron> = [(-1.0, cut), (cut, 1.0)]
        .iter()
        .map(|&(low, high)| {
            let corners = cuboid_corners(Vec3::new(low, -0.7, -0.4), Vec3::new(high, 0.7, 0.4));
            hull_with_walls(&corners, &|n, d| (n.x * d - cut).abs() < 1e-9 && n.x.abs() > 0.9)
        })
        .map(|piece| moved(&piece, motion))
        .collect();
    close_lower_walls(&mut pieces);
    join_pieces(&mut pieces);
    pieces
}

/// Rays aimed at the line where two pieces of one body abut hit one of them.
#[test]
fn no_ray_slips_between_pieces() {
    let mut random = Random(305);
    for round in 0..3000 {
        let still = pong_geometry::Transform::identity();
        let motion = if round % 2 == 0 { still } else { random_motion(&mut random, 2.0) };
        let cut = if round % 4 == 0 { 0.0 } else { 0.25 };
        let mut pieces = pieces(cut, &motion);
        if round % 3 == 0 {
            // The order must not matter: the closed internal face belongs to the lower index.
            pieces.reverse();
            close_lower_walls(&mut pieces);
        }
        // The loader makes opposite internal faces exact opposites.
        let wall = pieces[0].faces.iter().find(|f| !f.active).map(|f| (f.normal, f.offset)).expect("wall");
        pieces[1].change(|parts| {
            for face in parts.faces.iter_mut().filter(|f| !f.active) {
                (face.normal, face.offset) = (-wall.0, -wall.1);
            }
        });
        let target = Vec3::new(cut, random.between(-0.6, 0.6), 0.4);
        let slope = if round % 5 < 2 { 0.0 } else { random.between(-1.0, 1.0) };
        let from = target + Vec3::new(slope, random.between(-0.5, 0.5), 1.0);
        let (from, target) = (motion.point(&from), motion.point(&target));
        let r = ray(from, (target - from).normalize(), 3.0, None);
        let hits: Vec<RayHit> = pieces.iter().filter_map(|piece| ray_polyhedron(&r, piece)).collect();
        assert!(!hits.is_empty(), "round {round}: {r:?}");
        for hit in hits {
            assert!((hit.distance - (target - from).norm()).abs() < 1e-13);
        }
    }
}

#[test]
fn rays_from_inside_and_beyond() {
    let shape = common::cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let down = -Vec3::z();
    let at =
        |z: f64, reach: Option<f64>| ray_polyhedron(&ray(Vec3::new(0.1, 0.2, z), down, 3.0, reach), &shape);
    assert_eq!(at(2.0, None).map(|h| h.distance), Some(1.0));
    assert_eq!(at(1.0, None), None, "t must exceed −reach");
    assert_eq!(at(0.5, None), None);
    assert_eq!(at(0.5, Some(0.6)).map(|h| h.distance), Some(-0.5));
    assert_eq!(at(0.5, Some(0.5)), None);
    assert_eq!(at(-1.5, Some(9.0)), None, "the solid is behind");
    assert_eq!(at(-1.0, Some(9.0)), None);
    assert_eq!(at(4.0, None), None, "exactly at the length");
    // The winding number confirms the positions of these origins.
    let set = skin(&shape);
    assert!(winding_number(&set, &Vec3::new(0.1, 0.2, 0.5)) > 0.99);
    assert!(winding_number(&set, &Vec3::new(0.1, 0.2, -1.5)).abs() < 0.01);
}

/// Seams between pieces with different rounding: rotated wedges, rays in any direction onto their common
/// line.
#[test]
fn no_ray_slips_between_turned_pieces() {
    let mut random = Random(306);
    for _ in 0..400 {
        let mut pieces = oracle_support::wedges(&mut random);
        if random.bits().is_multiple_of(2) {
            pieces.reverse();
            close_lower_walls(&mut pieces);
        }
        for (a, b, normal) in oracle_support::seams(&pieces) {
            for _ in 0..20 {
                let target = a + (b - a) * random.between(0.05, 0.95);
                let from = target + (normal * 1.2 + random.direction()) * random.between(0.5, 2.0);
                let gap = target - from;
                let r = ray(from, gap.normalize(), 9.0, None);
                let hits: Vec<RayHit> = pieces.iter().filter_map(|piece| ray_polyhedron(&r, piece)).collect();
                assert!(!hits.is_empty(), "{r:?}");
                for hit in hits {
                    assert!(
                        (hit.distance - gap.norm()).abs() < 1e-13 && (hit.normal_b - normal).norm() < 1e-12
                    );
                }
            }
        }
    }
}

/// Exactly through the common line, slanted and exactly representable: the ray enters the active face, not
/// the internal one.
#[test]
fn exact_slanted_rays_between_pieces_hit() {
    for order in [false, true] {
        let mut pieces = pieces(0.0, &pong_geometry::Transform::identity());
        if order {
            pieces.reverse();
            close_lower_walls(&mut pieces);
        }
        for toward in [-1.0, 1.0] {
            for lift in [0.25, 0.5, 1.0, 2.0] {
                // z = 0.4 is not representable: the same number is the plane's offset.
                let from = Vec3::new(-toward * lift, 0.25, 0.4 + lift);
                let r = ray(from, Vec3::new(toward, 0.0, -1.0).normalize(), 5.0, None);
                let hits = pieces.iter().filter_map(|piece| ray_polyhedron(&r, piece)).count();
                assert!(hits > 0, "{r:?}");
            }
        }
    }
}

/// A ray that starts exactly on a face: with a reach a hit at distance zero counts, without one it does not.
#[test]
fn a_ray_that_starts_on_a_face_hits_it_within_its_reach() {
    let solid = common::hull(&cuboid_corners(Vec3::repeat(-1.0), Vec3::repeat(1.0)));
    for (reach, hits) in [(None, false), (Some(0.0), false), (Some(1e-9), true), (Some(0.5), true)] {
        let origin = Vec3::new(0.25, -0.5, 1.0);
        let direction = Vec3::new(0.6, 0.0, -0.8);
        let ray = Ray { origin, direction, length: 0.5, reach, response: RayResponse::Normal };
        let hit = ray_polyhedron(&ray, &solid);
        assert_eq!(
            hit.map(|hit| (hit.distance, hit.normal_b)),
            hits.then_some((0.0, Vec3::z())),
            "{reach:?}"
        );
    }
}

/// Rays exactly along an axis, in either direction, onto a perpendicular triangle: they hit inside its
/// outline only.
#[test]
fn rays_along_the_axes_hit_inside_the_outline_alone() {
    let mut random = Random(307);
    for axis in 0..3 {
        let place = |along: f64, u: f64, v: f64| {
            let mut place = Vec3::zeros();
            (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (along, u, v);
            place
        };
        // Counter-clockwise seen from where the axis points to; its mirror image from the other side.
        for side in [1.0, -1.0] {
            let mut corners = vec![place(0.0, 0.0, 0.0), place(0.0, 1.0, 0.0), place(0.0, 0.0, 1.0)];
            if side < 0.0 {
                corners.swap(1, 2);
            }
            let set = common::triangle_set(corners, &[[0, 1, 2]]);
            for _ in 0..500 {
                let (u, v) = (random.between(-0.5, 1.5), random.between(-0.5, 1.5));
                let (origin, direction) = (place(side, u, v), place(-side, 0.0, 0.0));
                let down = Ray { origin, direction, length: 2.0, reach: None, response: RayResponse::Normal };
                let inside = u > 0.0 && v > 0.0 && u + v < 1.0;
                let hit = ray_triangle(&down, &set, 0, 0.0).map(|hit| hit.distance);
                assert_eq!(hit, inside.then_some(1.0), "axis {axis}, side {side}: {u} {v}");
                let behind = Ray { origin: place(-side, u, v), direction: -direction, ..down };
                assert!(ray_triangle(&behind, &set, 0, 0.0).is_none());
            }
        }
    }
}
