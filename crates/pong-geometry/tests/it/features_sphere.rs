//! Seams have no effect on spheres over plates, closed meshes and polyhedra (docs/theory.md, 2.2).
//!
//! Degenerate cases: centres exactly above vertices and edges and up to three ulps beside them, over regular,
//! irregular, `f32`-rounded and turned surfaces; on the planes between the regions of neighbouring features.

use crate::common;
use crate::common::{Random, cuboid, moved, random_motion, stretched_hull};
use crate::oracle_support;
use crate::oracle_support::{
    Worst, all_contacts, counting_contacts, fan_plate, moved_surface, nearest_on_polyhedron, nudge,
    regular_plate, rounded_to_f32, shared_push, skin, surface, wedges,
};
use pong_geometry::Vec3;
use pong_geometry::interference::Interference;
use pong_geometry::interference::sphere_polyhedron::sphere_outside_polyhedron;
use pong_geometry::primitive::{Polyhedron, Sphere, TriangleSet};

/// Random point of a surface: a vertex, a point on an edge, or a point inside a triangle.
fn feature_place(set: &TriangleSet, random: &mut Random) -> Vec3 {
    let c = set.corners((random.bits() % set.triangles.len() as u64) as u32);
    match random.bits() % 4 {
        0 => c[0],
        1 => c[0] + (c[1] - c[0]) * 0.5,
        2 => c[1] + (c[2] - c[1]) * random.unit(),
        _ => {
            let (s, t) = (random.unit(), random.unit());
            let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
            c[0] + (c[1] - c[0]) * s + (c[2] - c[0]) * t
        }
    }
}

fn jittered(p: Vec3, random: &mut Random) -> Vec3 {
    p.map(|x| nudge(x, (random.bits() % 7) as i64 - 3))
}

/// Each feature occurs at most once.
fn assert_once(contacts: &[Interference]) {
    for (i, a) in contacts.iter().enumerate() {
        assert!(contacts[i + 1..].iter().all(|b| a.feature != b.feature), "{contacts:?}");
    }
}

#[test]
fn plates_have_no_gaps() {
    let mut random = Random(701);
    let mut exact = Worst::new("plate: depth and normal of what pushes, over the plate's own roughness");
    for round in 0..50 {
        let plate = if round % 2 == 0 { regular_plate(6) } else { fan_plate(&mut random) };
        let motion = if round % 5 == 0 {
            pong_geometry::Transform::identity()
        } else {
            random_motion(&mut random, 2.0)
        };
        let mut plate = moved_surface(&plate, &motion);
        if round % 3 == 0 {
            plate = rounded_to_f32(&plate);
        }
        let normal = motion.vector(&Vec3::z());
        let slope = (0..plate.triangles.len() as u32)
            .map(|t| (plate.normal(t) - normal).norm())
            .fold(1e-15, f64::max);
        for _ in 0..2000 {
            let place = feature_place(&plate, &mut random);
            let local = motion.inverse().point(&place);
            if local.xy().norm() > 0.95 || local.xy().amax() > 0.95 {
                continue;
            }
            let height = random.between(1e-6, 0.049);
            let center = jittered(place + normal * height, &mut random);
            let contacts = counting_contacts(&Sphere { center, radius: 0.05 }, &plate, 0.05);
            assert!(!contacts.is_empty(), "nothing under {center:?}");
            assert_once(&contacts);
            let push = shared_push(&contacts);
            let depth = 0.05 - normal.dot(&(center - motion.translation));
            exact.note((push - normal * depth).norm() / (4.0 * slope), 1.0);
        }
    }
}

/// Direction away from a point of a convex surface: a mixture of the normals there.
fn outward_mix(set: &TriangleSet, place: &Vec3, random: &mut Random) -> Vec3 {
    let mut sum = Vec3::zeros();
    let sharp = random.bits().is_multiple_of(3);
    for t in 0..set.triangles.len() as u32 {
        let foot = oracle_support::nearest_on_triangle(place, &set.corners(t));
        if (foot - place).norm() < 1e-12 {
            // Sometimes a single normal: exactly on the border of the cone.
            let share =
                if sharp { f64::from(u8::from(random.bits().is_multiple_of(2))) } else { random.unit() };
            sum += set.normal(t) * share;
        }
    }
    if sum.norm() < 1e-3 { random.direction() } else { sum.normalize() }
}

#[test]
fn closed_convex_surfaces_have_no_gaps() {
    let mut random = Random(702);
    let mut worst = Worst::new("convex: nearest point, mesh and solid");
    let solids = [
        cuboid(Vec3::new(-0.5, -0.4, -0.3), Vec3::new(0.5, 0.6, 0.3)),
        stretched_hull(20, Vec3::new(1.0, 0.8, 0.5)),
        stretched_hull(60, Vec3::new(1.0, 1.0, 0.9)),
    ];
    for round in 0..9 {
        let solid = &solids[round % 3];
        let solid = if round < 3 { solid.clone() } else { moved(solid, &random_motion(&mut random, 1.5)) };
        let mesh = skin(&solid);
        for _ in 0..2500 {
            let place = feature_place(&mesh, &mut random);
            let direction = outward_mix(&mesh, &place, &mut random);
            let center = jittered(place + direction * random.between(1e-6, 0.3), &mut random);
            if solid.contains(&center) {
                continue;
            }
            let sphere = Sphere { center, radius: 0.4 };
            let (foot, _) = nearest_on_polyhedron(&solid, &center);
            let expected = center - foot;
            if expected.norm() > 0.4 - 1e-9 {
                continue;
            }
            let contacts = counting_contacts(&sphere, &mesh, 0.0);
            assert_once(&contacts);
            let on_solid = sphere_outside_polyhedron(&sphere, &solid);
            for contact in contacts.iter().chain(&on_solid) {
                let arm = contact.normal_b * (0.4 - contact.depth);
                worst.note((arm - expected).norm(), 2e-12);
            }
            assert!(!contacts.is_empty() && on_solid.is_some(), "nothing at {center:?}");
        }
    }
}

/// Along straight lines over a surface, the force changes no faster than the centre allows.
fn continuous(push: &dyn Fn(&Vec3) -> Option<Vec3>, lines: usize, seed: u64, name: &'static str) {
    let mut random = Random(seed);
    let mut worst = Worst::new(name);
    let mut steps = 0;
    for _ in 0..lines {
        let (from, to) = (random.direction() * 1.3, random.direction() * 1.3);
        let at = |s: f64| from + (to - from) * s;
        for i in 0..200 {
            let (mut low, mut high) = (f64::from(i) / 200.0, f64::from(i + 1) / 200.0);
            // Bisect towards the larger change: a step remains, a slope vanishes.
            let (Some(mut below), Some(mut above)) = (push(&at(low)), push(&at(high))) else { continue };
            let allowed = |low: f64, high: f64| 60.0 * (high - low) * (to - from).norm();
            while (above - below).norm() > allowed(low, high) && high - low > 1e-13 {
                let middle = 0.5 * (low + high);
                let Some(here) = push(&at(middle)) else { break };
                if (here - below).norm() > (above - here).norm() {
                    (high, above) = (middle, here);
                } else {
                    (low, below) = (middle, here);
                }
            }
            steps += 1;
            worst.note((above - below).norm() - allowed(low, high), 1e-11);
        }
    }
    assert!(steps > 1000, "{steps}");
}

#[test]
fn the_push_is_continuous_across_features() {
    let solid = moved(&stretched_hull(20, Vec3::new(0.9, 0.7, 0.5)), &random_motion(&mut Random(7), 0.1));
    let outside = |solid: &Polyhedron, p: &Vec3| {
        let (foot, _) = nearest_on_polyhedron(solid, p);
        !solid.contains(p) && (foot - p).norm() > 0.02
    };
    let on_solid = |p: &Vec3| {
        let sphere = Sphere { center: *p, radius: 0.5 };
        outside(&solid, p).then(|| {
            sphere_outside_polyhedron(&sphere, &solid).map_or(Vec3::zeros(), |c| c.normal_b * c.depth)
        })
    };
    continuous(&on_solid, 150, 703, "continuity: solid");
    let mesh = skin(&solid);
    let on_mesh = |p: &Vec3| {
        let sphere = Sphere { center: *p, radius: 0.5 };
        outside(&solid, p).then(|| shared_push(&counting_contacts(&sphere, &mesh, 0.0)))
    };
    continuous(&on_mesh, 40, 704, "continuity: mesh");
}

/// A valley of two walls at several angles: both walls push, no edge does, and the force has no step.
#[test]
fn valleys_are_continuous_and_their_edges_silent() {
    for degrees in [90.0_f64, 120.0, 150.0, 179.0, 179.999_999] {
        let half = (degrees / 2.0).to_radians();
        let wall = |side: f64, y: f64| Vec3::new(side * half.sin() * 2.0, y, half.cos() * 2.0);
        let vertices = vec![
            Vec3::new(0.0, -2.0, 0.0),
            Vec3::new(0.0, 2.0, 0.0),
            wall(1.0, -2.0),
            wall(1.0, 2.0),
            wall(-1.0, -2.0),
            wall(-1.0, 2.0),
        ];
        let set = surface(vertices, &[[0, 2, 1], [1, 2, 3], [0, 1, 4], [1, 5, 4]]);
        assert!((0..4).all(|t| set.normal(t).z > 0.0));
        let push = |p: &Vec3| {
            let q = Vec3::new(p.x, p.y, p.z.abs() + 1e-3);
            let in_front = (0..4).all(|t| set.normal(t).dot(&q) > 0.0);
            in_front.then(|| {
                let contacts = all_contacts(&Sphere { center: q, radius: 0.7 }, &set, 0.0);
                let plain: Vec<_> = contacts.iter().map(|c| c.interference).collect();
                assert!(plain.iter().all(|c| c.feature.is_face()), "{plain:?}");
                shared_push(&plain)
            })
        };
        continuous(&push, 60, 705, "continuity: valley");
    }
}

/// A convex edge or vertex pushes only strictly inside its cone; a free edge only while the centre is in
/// front.
#[test]
fn cones_and_free_edges() {
    let mut random = Random(706);
    let solid = cuboid(Vec3::repeat(-0.5), Vec3::repeat(0.5));
    let mesh = skin(&solid);
    for _ in 0..10_000 {
        let center = Vec3::from_fn(|_, _| random.between(-0.9, 0.9));
        let sphere = Sphere { center, radius: 0.5 };
        for contact in all_contacts(&sphere, &mesh, 0.0) {
            let i = contact.interference;
            let beyond = center.iter().filter(|c| c.abs() > 0.5).count();
            let kind = i.feature.0 >> 30;
            assert_eq!(beyond, kind as usize + 1, "{center:?}: {i:?}");
        }
    }
    let sheet = surface(vec![Vec3::zeros(), Vec3::x(), Vec3::y()], &[[0, 1, 2]]);
    let (mut front, mut rim) = (0, 0);
    for _ in 0..10_000 {
        let center = Vec3::from_fn(|_, _| random.between(-0.5, 1.3));
        let contacts = all_contacts(&Sphere { center, radius: 0.4 }, &sheet, 0.0);
        assert!(contacts.len() <= 1);
        if center.z < 0.0 {
            assert!(contacts.is_empty(), "{center:?}");
        }
        for contact in contacts {
            front += 1;
            let foot = oracle_support::nearest_on_triangle(&center, &sheet.corners(0));
            let i = contact.interference;
            assert!((i.normal_b * (0.4 - i.depth) - (center - foot)).norm() < 1e-14);
            rim += usize::from(!i.feature.is_face());
        }
    }
    assert!(rim > 200 && front > rim + 200);
}

/// Over the line where two pieces abut there is always a contact, along the common normal.
#[test]
fn abutting_pieces_have_no_gaps() {
    let mut random = Random(708);
    let mut worst = Worst::new("over the seam of two pieces: depth, normal");
    for _ in 0..300 {
        let pieces = wedges(&mut random);
        let seams = oracle_support::seams(&pieces);
        assert_eq!(seams.len(), 4);
        for _ in 0..100 {
            let (a, b, normal) = seams[(random.bits() % 4) as usize];
            let share = random.between(0.05, 0.95);
            let height = random.between(1e-3, 0.29);
            let center = jittered(a + (b - a) * share + normal * height, &mut random);
            let sphere = Sphere { center, radius: 0.3 };
            let contacts: Vec<_> =
                pieces.iter().filter_map(|piece| sphere_outside_polyhedron(&sphere, piece)).collect();
            assert!(!contacts.is_empty(), "nothing over the seam at {center:?}");
            let push = shared_push(&contacts);
            worst.note((push - normal * (0.3 - height)).norm(), 1e-14);
        }
    }
}

/// Two pieces of a plate that abut at x = 0; in both, the internal face comes before the top.
fn abutting_pieces(size: f64) -> [pong_geometry::primitive::Polyhedron; 2] {
    let wall = |n: &Vec3, d: f64| n.x.abs() > 0.9 && d == 0.0;
    let corners = |low: f64, high: f64| {
        common::cuboid_corners(Vec3::new(low, -1.0, -1.0) * size, Vec3::new(high, 1.0, 0.5) * size)
    };
    let mut left = corners(-1.0, 0.0);
    left.reverse();
    let mut pieces = [left, corners(0.0, 1.0)].map(|corners| common::hull_with_walls(&corners, &wall));
    for piece in &pieces {
        let first =
            |is: &dyn Fn(&pong_geometry::primitive::PolyhedronFace) -> bool| piece.faces.iter().position(is);
        assert!(first(&|face| !face.active) < first(&|face| face.normal.z > 0.9));
    }
    oracle_support::close_lower_walls(&mut pieces);
    oracle_support::join_pieces(&mut pieces);
    pieces
}

/// A centre exactly on the line where two pieces abut.
#[test]
fn a_centre_on_a_seam_is_pushed() {
    let pieces = abutting_pieces(1.0);
    for x in [nudge(0.0, -1), 0.0, nudge(0.0, 1)] {
        let sphere = Sphere { center: Vec3::new(x, 0.25, 0.5), radius: 0.1 };
        let contacts: Vec<_> =
            pieces.iter().filter_map(|piece| sphere_outside_polyhedron(&sphere, piece)).collect();
        assert!((shared_push(&contacts) - Vec3::z() * 0.1).norm() < 1e-16, "{x}: {contacts:?}");
    }
}

/// A centre beside the seam by a billionth of the size is pushed only by the piece below it, at any size.
#[test]
fn beside_a_seam_one_piece_pushes() {
    for size in [1e-4, 1.0, 1e4] {
        let pieces = abutting_pieces(size);
        for side in [-1.0, 1.0] {
            let center = Vec3::new(1e-9 * side, 0.25, 0.55) * size;
            let sphere = Sphere { center, radius: 0.1 * size };
            let pushed = pieces.each_ref().map(|piece| sphere_outside_polyhedron(&sphere, piece).is_some());
            assert_eq!(pushed, [side < 0.0, side > 0.0], "size {size}");
        }
    }
}

/// A centre on a convex edge or vertex lies in the planes of all faces there. One contact pushes it, along
/// the mean of their normals, however the surface is rotated and cut.
#[test]
fn a_centre_on_a_convex_rim_is_pushed_once() {
    let mut random = Random(703);
    let cube = cuboid(Vec3::repeat(-0.5), Vec3::repeat(0.5));
    for round in 0..2000 {
        let motion = random_motion(&mut random, 1.0);
        let mesh = skin(&moved(&cube, &motion));
        let along = if round % 4 == 0 { 0.5 } else { random.between(-0.49, 0.49) };
        let place = Vec3::new(0.5, 0.5, along);
        let normals = if along == 0.5 { Vec3::repeat(1.0) } else { Vec3::new(1.0, 1.0, 0.0) };
        let sphere = Sphere { center: motion.point(&place), radius: 0.4 };
        let contacts = counting_contacts(&sphere, &mesh, 1e-3);
        let [contact] = contacts[..] else { panic!("{} contacts at {place:?}", contacts.len()) };
        let expected = motion.rotation * normals.normalize();
        assert!((contact.depth - 0.4).abs() < 1e-12, "{}", contact.depth);
        // A corner of the cube has one or two triangles of each face.
        let slack = if along == 0.5 { 0.5 } else { 1e-12 };
        assert!((contact.normal_b - expected).norm() < slack, "{:?} at {place:?}", contact.normal_b);
    }
}
