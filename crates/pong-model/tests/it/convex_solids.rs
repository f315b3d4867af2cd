//! Every solid whose vertices are in convex position, up to the rounding of single precision, loads; the
//! loaded solid is the written one, within the tolerance of the model format.

use crate::common::held::{TOLERANCE, brief, holds, load, thickness};
use crate::common::solids::{Solid, cut_box, geodesic, prism, uv_sphere};
use pong_geometry::Vec3;
use pong_testkit::Random;

/// Cloud of points, in convex position or not: the hull decides.
fn cloud(random: &mut Random, kind: usize, count: usize) -> Vec<Vec3> {
    let squash = Vec3::new(1.0, random.between(0.05, 1.0), random.between(0.01, 1.0));
    let point = |random: &mut Random| match kind {
        0 => random.direction(),
        1 => random.direction() * random.unit(),
        2 => random.direction().component_mul(&squash),
        3 => Vec3::new(random.unit(), random.unit(), random.unit()),
        // Many points in few planes, moved by less than the tolerance.
        4 => {
            let side = random.direction();
            let face = side.iamax();
            let mut place =
                Vec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            place[face] = side[face].signum() + random.between(-1e-6, 1e-6);
            place
        }
        // Chamfers of about the tolerance along every edge of a box.
        _ => {
            let mut place = Vec3::new(1.0, 1.0, 1.0) - random.direction().abs() * random.between(0.0, 1e-5);
            (0..3).for_each(|k| place[k] *= if random.unit() < 0.5 { -1.0 } else { 1.0 });
            place
        }
    };
    (0..count).map(|_| point(random)).collect()
}

#[test]
fn hulls_by_the_thousand_load() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut tried = 0;
    for round in 0..4000 {
        let (kind, count) = (round % 6, 4 + (random.unit() * random.unit() * 90.0) as usize);
        let points = cloud(&mut random, kind, count);
        let Some(hull) = Solid::hull_of(&points, 2.0_f64.powi(-22)).filter(has_no_sliver) else { continue };
        tried += 1;
        // As exact as single precision can be, and as an exporter rounds it.
        if thickness(&hull) > 4.0 * TOLERANCE * hull.diameter() {
            holds(&hull, &format!("round {round}"));
        }
        let size = 10.0_f64.powf(random.between(-4.0, 4.0));
        let to = random.direction() * (size * random.between(0.0, 2.0));
        let posed = hull.posed(random.rotation_matrix(), to, size);
        if has_no_sliver(&posed) && thickness(&posed) > 4.0 * TOLERANCE * posed.diameter() {
            holds(&posed, &format!("round {round}, turned"));
        }
    }
    assert!(tried > 3500, "{tried}");
}

/// Returns `true` unless a face is narrower than 1e-9 of its longest edge, which is refused by a rule of its
/// own.
fn has_no_sliver(solid: &Solid) -> bool {
    let width = |face: &Vec<u32>| {
        let [a, b, c] = [0, 1, 2].map(|k| solid.vertices[face[k] as usize]);
        let longest = [b - a, c - b, a - c].map(|e| e.norm()).into_iter().fold(0.0, f64::max);
        (b - a).cross(&(c - a)).norm() / (longest * longest)
    };
    solid.faces.iter().all(|face| width(face) > 1.1e-9)
}

/// Points on a shallow cap: the angles between its faces are comparable to the tolerance.
#[test]
fn shallow_caps_load() {
    let mut random = Random(77);
    for round in 0..300 {
        let height = 10.0_f64.powf(random.between(-5.3, -2.0));
        let points: Vec<Vec3> = (0..60)
            .map(|_| {
                let (radius, turn) = (0.7 * random.unit().sqrt(), random.between(0.0, std::f64::consts::TAU));
                let z = height * (1.0 - (radius / 0.7).powi(2));
                Vec3::new(radius * libm::cos(turn), radius * libm::sin(turn), z)
            })
            .collect();
        let Some(cap) = Solid::hull_of(&points, 2.0_f64.powi(-24)) else { continue };
        holds(&cap, &format!("cap {height:e} high, round {round}"));
        let turned = cap.posed(random.rotation_matrix(), Vec3::zeros(), 1.0);
        holds(&turned, &format!("cap {height:e} high, round {round}, turned"));
    }
}

#[test]
fn solids_of_many_faces_load() {
    let mut random = Random(5);
    for sides in [3, 4, 7, 100, 3000] {
        for height in [1e-3, 1.0, 300.0] {
            let prism = prism(sides, height);
            for solid in [prism.triangulated(), prism] {
                let posed = solid.posed(random.rotation_matrix(), random.direction() * 0.5, 0.7);
                holds(&posed, &format!("prism of {sides} sides, {height} high"));
            }
        }
    }
    for (circles, meridians) in [(8, 16), (32, 64), (100, 200)] {
        let ball = uv_sphere(circles, meridians);
        for solid in [ball.triangulated(), ball] {
            let posed = solid.posed(random.rotation_matrix(), Vec3::zeros(), 0.25);
            holds(&posed, &format!("ball of {circles} circles and {meridians} meridians"));
        }
    }
    for cuts in [1, 4, 16] {
        let posed = geodesic(cuts).posed(random.rotation_matrix(), Vec3::zeros(), 1.0);
        holds(&posed, &format!("geodesic ball, {cuts}"));
    }
}

/// A box whose faces and edges are finely cut stays a box, in every orientation.
#[test]
fn cut_boxes_are_boxes() {
    let mut random = Random(11);
    for cuts in [1, 2, 5, 20] {
        for round in 0..5 {
            let size = Vec3::new(1.0, random.between(0.05, 1.0), random.between(0.05, 1.0));
            let solid = cut_box(size, cuts).triangulated();
            let posed = solid.posed(random.rotation_matrix(), random.direction() * 0.3, 1.0);
            let loaded = holds(&posed, &format!("box cut {cuts} times, round {round}"));
            assert_eq!(loaded.faces.len(), 6, "box cut {cuts} times, round {round}");
        }
    }
}

/// Two points slightly more than the tolerance above a face keep their positions.
#[test]
fn low_bumps_on_a_box_stay() {
    let mut points: Vec<Vec3> = Vec::new();
    for corner in 0..8 {
        points.push(Vec3::from([0, 1, 2].map(|k| if corner >> k & 1 == 1 { 1.0 } else { -1.0 })));
    }
    points.extend([Vec3::new(0.3, 0.2, 1.0 + 5e-6), Vec3::new(-0.4, 0.1, 1.0 + 4.5e-6)]);
    let hull = Solid::hull_of(&points, 2.0_f64.powi(-23)).unwrap();
    let loaded = holds(&hull, "bumps");
    let diameter = hull.diameter();
    for bump in &points[8..] {
        let height = loaded.faces.iter().map(|f| f.normal.dot(bump) - f.offset).fold(f64::MIN, f64::max);
        assert!(height.abs() <= TOLERANCE * diameter, "{:e}", height / diameter);
    }
    assert!(loaded.faces.len() < hull.faces.len(), "the five other faces are merged");
}

/// The depth of a point is the same as before the merging, within the tolerance. The hulls are exact, so the
/// planes before merging are reliable.
#[test]
fn depths_are_those_of_the_unmerged_solid() {
    let mut random = Random(21);
    for round in 0..600 {
        let points = cloud(&mut random, round % 6, 12 + round % 50);
        let Some(hull) = Solid::hull_of(&points, 2.0_f64.powi(-22)).filter(has_no_sliver) else { continue };
        let loaded = holds(&hull, &format!("round {round}"));
        let diameter = hull.diameter();
        let planes: Vec<(Vec3, Vec3)> = hull
            .faces
            .iter()
            .map(|face| {
                let [a, b, c] = [0, 1, 2].map(|k| hull.vertices[face[k] as usize]);
                ((b - a).cross(&(c - a)).normalize(), a)
            })
            .collect();
        for _ in 0..40 {
            // Point inside: a mean of vertices.
            let shares: Vec<f64> = hull.vertices.iter().map(|_| random.unit().powi(4)).collect();
            let sum: f64 = shares.iter().sum();
            let place = hull.vertices.iter().zip(&shares).map(|(v, share)| v * (share / sum)).sum::<Vec3>();
            let before = planes.iter().map(|(n, on)| n.dot(&(on - place))).fold(f64::INFINITY, f64::min);
            let after =
                loaded.faces.iter().map(|f| f.offset - f.normal.dot(&place)).fold(f64::INFINITY, f64::min);
            let off = (after - before).abs() / diameter;
            assert!(
                off <= 2.0 * TOLERANCE,
                "round {round}: {before:e} became {after:e}, {off:e}\n{}",
                brief(&hull)
            );
        }
    }
}

/// A refusal names the vertex and its distance.
#[test]
fn what_is_not_convex_is_told_with_its_vertex() {
    let mut dented = cut_box(Vec3::new(1.0, 1.0, 1.0), 4);
    let center = dented.vertices.iter().position(|v| *v == Vec3::new(0.5, 0.5, 1.0)).unwrap();
    dented.vertices[center].z -= 0.01;
    let told = load(&dented.triangulated()).unwrap_err();
    assert!(
        told.contains("[not-convex]") && told.contains("of the diameter in front of this face"),
        "{told}"
    );
    let mut raised = cut_box(Vec3::new(1.0, 1.0, 1.0), 1);
    raised.vertices[6].z += 0.01;
    let told = load(&raised).unwrap_err();
    assert!(told.contains("[face-not-planar]") && told.contains("the vertex ("), "{told}");
    // A star-shaped outline is no face of a convex solid.
    let mut star = prism(10, 1.0);
    star.vertices.iter_mut().step_by(2).for_each(|v| (v.x, v.y) = (0.4 * v.x, 0.4 * v.y));
    let told = load(&star).unwrap_err();
    assert!(told.contains("the vertex ("), "{told}");
}
