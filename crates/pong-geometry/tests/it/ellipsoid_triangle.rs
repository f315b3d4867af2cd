//! Ellipsoid against triangles.
//!
//! Degenerate cases: feet on edges and vertices of a flat tessellation, on convex edges and vertices, on free edges;
//! centre in the plane, behind by less and by more than the thickness; spheres; concave corners; upright feet on a
//! ridge; grazing.

use crate::common::{
    Random, cuboid, patch, random_motion, scaled_ellipsoid, stretched_hull, surface_of, triangle_set,
};
use pong_geometry::interference::Feature;
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_polyhedron;
use pong_geometry::interference::ellipsoid_triangle::ellipsoid_triangle;
use pong_geometry::interference::sphere_triangle::sphere_triangle;
use pong_geometry::interference::triangle_features::{Standing, TriangleContact};
use pong_geometry::primitive::{Ellipsoid, Sphere, TriangleSet};
use pong_geometry::{Mat3, Vec3};

/// Some units in the last place of depths of tenths of a metre, m.
const ROUNDING: f64 = 1e-15;

fn contacts(e: &Ellipsoid, set: &TriangleSet, thickness: f64) -> Vec<TriangleContact> {
    let mut found = Vec::new();
    for t in 0..set.triangles.len() as u32 {
        ellipsoid_triangle(e, set, t, thickness, &mut |contact| found.push(contact));
    }
    found
}

/// Contacts that push; fallbacks only if nothing else is as deep.
fn pushing(e: &Ellipsoid, set: &TriangleSet, thickness: f64) -> Vec<TriangleContact> {
    let is_firm = |c: &TriangleContact| matches!(c.standing, Standing::Front | Standing::Behind);
    let (mut firm, spare): (Vec<_>, Vec<_>) = contacts(e, set, thickness).into_iter().partition(is_firm);
    let deepest = firm.iter().map(|c| c.interference.depth).fold(0.0, f64::max);
    firm.extend(spare.into_iter().filter(|c| c.interference.depth * (1.0 - 1e-9) > deepest));
    let all = firm.clone();
    firm.retain(|contact| !all.iter().any(|other| yields(contact, other)));
    firm
}

/// Returns `true` if a face, or a contact with the centre behind it, yields to a less deep contact that meets
/// it convexly: the tester finds both, and load sharing, which knows which of them push, keeps the less deep
/// (docs/theory.md, 2.2).
fn yields(contact: &TriangleContact, other: &TriangleContact) -> bool {
    let (here, there) = (touched(contact), touched(other));
    let [depth, less] = [contact, other].map(|c| c.interference.depth);
    let is_before = contact.interference.feature > other.interference.feature;
    let is_less_deep = less < depth * (1.0 - 1e-12) || (less < depth * (1.0 + 1e-12) && is_before);
    let apart = there - here;
    let slack = 1e-9 * apart.norm();
    let is_one_place = apart.norm() < 1e-9;
    let meet_convexly = if is_one_place {
        !contact.interference.feature.is_face() || !other.interference.feature.is_face()
    } else {
        contact.interference.normal_b.dot(&apart) <= slack
            && other.interference.normal_b.dot(&apart) >= -slack
    };
    let may_yield = contact.interference.feature.is_face() || contact.standing == Standing::Behind;
    may_yield && is_less_deep && meet_convexly
}

fn smallest_radius(semi_axes: &Vec3) -> f64 {
    semi_axes.min() * semi_axes.min() / semi_axes.max()
}

#[test]
fn flat_tessellation_is_one_plane() {
    let mut random = Random(101);
    let set = patch(6, &mut random, &|_, _| 0.0);
    for case in 0..20_000 {
        let semi_axes = Vec3::from_fn(|_, _| random.between(0.02, 0.1));
        let mut e = Ellipsoid { center: Vec3::zeros(), axes: random.rotation_matrix(), semi_axes };
        let depth = random.between(1e-6, 1.0) * 0.02;
        e.center.z = e.half_width(&Vec3::z()) - depth;
        // Foot point: anywhere, or exactly over a vertex or the middle of an edge.
        let foot = match case % 3 {
            0 => Vec3::new(random.between(-0.25, 0.25), random.between(-0.25, 0.25), 0.0),
            1 => set.vertices[16 + (random.bits() % 3) as usize + 7 * (random.bits() % 3) as usize],
            _ => {
                let [a, b, _] = set.corners([28, 29, 30, 31, 40, 41, 42, 43][(random.bits() % 8) as usize]);
                (a + b) * 0.5
            }
        };
        let drift = e.support(&-Vec3::z()) - e.center;
        e.center.x = foot.x - drift.x;
        e.center.y = foot.y - drift.y;
        let found = pushing(&e, &set, semi_axes.min());
        assert!(!found.is_empty(), "case {case}");
        for contact in &found {
            assert!((contact.interference.normal_b - Vec3::z()).norm() < 1e-12, "case {case}: {contact:?}");
            assert!((contact.interference.depth - depth).abs() < 1e-14, "case {case}: {contact:?}");
        }
    }
}

#[test]
fn convex_surfaces_push_as_the_polyhedron() {
    let mut random = Random(102);
    for p in
        [cuboid(Vec3::new(-0.5, -0.4, -0.3), Vec3::new(0.5, 0.4, 0.3)), stretched_hull(18, Vec3::repeat(0.5))]
    {
        let set = surface_of(&p);
        let (mut checked, mut not_faces) = (0, 0);
        while checked < 3000 {
            let semi_axes = Vec3::from_fn(|_, _| random.between(0.05, 0.15));
            let e = Ellipsoid {
                center: random.direction() * random.between(0.3, 0.8),
                axes: random.rotation_matrix(),
                semi_axes,
            };
            let Some(expected) = ellipsoid_polyhedron(&e, &p) else {
                assert!(pushing(&e, &set, semi_axes.min()).is_empty());
                continue;
            };
            if expected.depth > 0.9 * smallest_radius(&semi_axes) {
                continue;
            }
            checked += 1;
            not_faces += usize::from(!expected.feature.is_face());
            let found = pushing(&e, &set, semi_axes.min());
            assert!(!found.is_empty(), "lost {expected:?} of {e:?}");
            for contact in &found {
                let i = &contact.interference;
                assert!((i.depth - expected.depth).abs() < 1e-13, "{contact:?} {expected:?} {e:?}");
                assert!((i.normal_b - expected.normal_b).norm() < 1e-7, "{contact:?} {expected:?}");
                assert!((i.deepest_b - expected.deepest_b).norm() < 1e-7);
                assert_eq!(contact.standing, Standing::Front);
            }
        }
        assert!(not_faces > 300);
    }
}

#[test]
fn deep_on_a_convex_surface_the_least_is_among_them_and_nothing_is_lost() {
    let mut random = Random(103);
    let p = stretched_hull(18, Vec3::repeat(0.5));
    let set = surface_of(&p);
    let (mut checked, mut several) = (0, 0);
    while checked < 3000 {
        let semi_axes = Vec3::from_fn(|_, _| random.between(0.03, 0.3));
        let e = Ellipsoid {
            center: random.direction() * random.between(0.4, 0.8),
            axes: random.rotation_matrix(),
            semi_axes,
        };
        let Some(expected) = ellipsoid_polyhedron(&e, &p) else { continue };
        checked += 1;
        let found = pushing(&e, &set, f64::INFINITY);
        several += usize::from(found.len() > 1);
        for contact in &found {
            check_against_convex_neighbors(contact, &found, &set);
            let height = contact.interference.normal_b.dot(&(e.center - touched(contact)));
            assert_eq!(contact.standing == Standing::Behind, height < -1e-14, "{contact:?}");
            // Not deeper than any face at the pushing feature.
            for t in faces_at(contact, &set) {
                let corner = set.corners(t)[0];
                let plane = e.half_width(&set.normal(t)) - set.normal(t).dot(&(e.center - corner));
                assert!(contact.interference.depth <= plane * (1.0 + 1e-8), "{contact:?} {plane}");
            }
        }
        assert!(
            found.iter().any(|c| (c.interference.depth - expected.depth).abs() < 1e-13),
            "{found:?} {expected:?} {e:?}"
        );
    }
    println!("{checked} contacts, {several} with more than one minimum");
}

/// A rod stands deep in a plateau, beside a step down of 1 cm. It is less deep below the step's slope, but
/// its foot is far outside it: the slope does not push, so the plateau must.
#[test]
fn a_face_beside_a_small_step_pushes_a_rod_that_reaches_below_the_step() {
    let profile = [(-1.0, 0.0), (0.0, 0.0), (0.01, -0.01), (1.0, -0.01)];
    let corners = [-1.0, 1.0].map(|y| profile.map(|(x, z)| Vec3::new(x, y, z)));
    let strips = [[0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6]];
    let set = triangle_set(corners.concat(), &strips);
    // Centre in front, in the plane, and behind by less than the thickness.
    for (y, z) in [-0.5, 0.25].into_iter().flat_map(|y| [0.1, 0.0, -1e-9, -0.125].map(|z| (y, z))) {
        let rod = Ellipsoid {
            center: Vec3::new(-0.05, y, z),
            axes: Mat3::identity(),
            semi_axes: Vec3::new(0.1, 0.1, 0.4),
        };
        let slant = set.normal(2);
        let below_slant = rod.half_width(&slant) - slant.dot(&(rod.center - set.corners(2)[0]));
        assert!(below_slant < 0.4 - z);
        let found: Vec<_> = pushing(&rod, &set, 0.25)
            .iter()
            .map(|c| (c.interference.normal_b, c.interference.depth))
            .collect();
        assert!(
            matches!(found[..], [(normal, depth)] if normal == Vec3::z() && (depth - 0.4 + z).abs() < ROUNDING),
            "{z}: {found:?}"
        );
    }
}

fn upright(center: Vec3, semi_axes: Vec3) -> Ellipsoid {
    Ellipsoid { center, axes: Mat3::identity(), semi_axes }
}

/// Roof with its ridge on the y axis, sloping down at 45° on both sides, one triangle each.
fn roof() -> TriangleSet {
    let corners = [(0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, -1.0), (-1.0, 0.0, -1.0)]
        .map(|(x, y, z)| Vec3::new(x, y, z));
    triangle_set(corners.to_vec(), &[[0, 2, 1], [0, 1, 3]])
}

#[test]
fn a_rod_exactly_above_a_ridge_is_pushed_by_one_of_two_equal_faces() {
    let found = pushing(&upright(Vec3::new(0.0, 0.0, 0.1), Vec3::new(0.1, 0.1, 0.4)), &roof(), 0.0);
    let features: Vec<_> = found.iter().map(|contact| contact.interference.feature).collect();
    assert_eq!(features, [Feature::face(0)], "{found:?}");
}

/// Deep beside a free edge the minimum translation is sideways, if the centre is not too far behind for it;
/// else upwards. Never both.
#[test]
fn beside_a_free_edge_either_the_edge_or_the_face_pushes_a_rod() {
    let plate = triangle_set(
        [(-1.0, -1.0), (0.0, -1.0), (0.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(),
        &[[0, 1, 2], [0, 2, 3]],
    );
    let rod = upright(Vec3::new(-0.05, 0.25, 0.1), Vec3::new(0.1, 0.1, 0.4));
    let alone = |thickness: f64| {
        let found = pushing(&rod, &plate, thickness);
        assert_eq!(found.len(), 1, "{thickness}: {found:?}");
        found[0].interference
    };
    let sideways = alone(0.1);
    assert!(sideways.normal_b.x > 0.9 && (0.14..0.15).contains(&sideways.depth), "{sideways:?}");
    let upwards = alone(0.0);
    assert!(upwards.normal_b == Vec3::z() && (upwards.depth - 0.3).abs() < ROUNDING, "{upwards:?}");
}

#[test]
fn a_centre_on_an_edge_or_a_vertex_is_in_front() {
    let (roof, cube) = (roof(), surface_of(&cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0))));
    for (set, center) in
        [(&roof, Vec3::zeros()), (&cube, Vec3::new(1.0, 0.25, 1.0)), (&cube, Vec3::repeat(1.0))]
    {
        for semi_axes in [Vec3::new(0.25, 0.375, 0.5), Vec3::new(0.5, 0.375, 0.125)] {
            let found = pushing(&upright(center, semi_axes), set, 0.0);
            assert!(!found.is_empty(), "{center:?} {semi_axes:?}");
            assert!(found.iter().all(|contact| contact.standing != Standing::Behind), "{found:?}");
        }
    }
}

/// If the foot point is on a convex edge, within rounding, the face or the edge has the contact.
#[test]
fn a_foot_on_a_convex_edge_is_not_lost() {
    /// Depth, m; and the error, m, of centre and foot computed from random axes.
    const DEPTH: f64 = 1e-3;
    const OF_PLACES: f64 = 1e-12;
    let mut random = Random(107);
    let cube = surface_of(&cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0)));
    let mut spare = 0;
    for _ in 0..5000 {
        let e = Ellipsoid {
            center: Vec3::zeros(),
            axes: random.rotation_matrix(),
            semi_axes: Vec3::from_fn(|_, _| random.between(0.1, 0.3)),
        };
        let deepest = e.axes
            * (e.axes.tr_mul(&Vec3::z()).component_mul(&e.semi_axes.component_mul(&e.semi_axes)))
            / -e.half_width(&Vec3::z());
        let lowered = Vec3::new(1.0, random.between(-0.5, 0.5), 1.0 - DEPTH);
        let found = contacts(&Ellipsoid { center: lowered - deepest, ..e }, &cube, 0.0);
        assert!(found.iter().any(|c| (c.interference.depth - DEPTH).abs() < OF_PLACES), "{e:?}: {found:?}");
        spare += usize::from(found.iter().all(|c| c.standing == Standing::Spare));
    }
    println!("{spare} held by a spare contact alone");
}

fn touched(contact: &TriangleContact) -> Vec3 {
    contact.interference.deepest_b + contact.interference.normal_b * contact.interference.depth
}

/// Faces that meet at the pushing feature.
fn faces_at(contact: &TriangleContact, set: &TriangleSet) -> Vec<u32> {
    let index = contact.interference.feature.index();
    match contact.interference.feature.0 >> 30 {
        0 => vec![index as u32],
        1 => vec![index as u32 / 3, set.triangles[index / 3].neighbors[index % 3]],
        _ => {
            let has = |t: &u32| set.triangles[*t as usize].vertices.contains(&(index as u32));
            (0..set.triangles.len() as u32).filter(has).collect()
        }
    }
}

/// On a convex surface no two adjacent faces push, nor a face and a less deep edge of it.
fn check_against_convex_neighbors(contact: &TriangleContact, found: &[TriangleContact], set: &TriangleSet) {
    if !contact.interference.feature.is_face() {
        return;
    }
    let index = contact.interference.feature.index() as u32;
    for other in found {
        let feature = other.interference.feature;
        let beside = match feature.0 >> 30 {
            0 => set.triangles[index as usize].neighbors.contains(&(feature.index() as u32)),
            1 => faces_at(other, set).contains(&index),
            _ => false,
        };
        assert!(!beside, "{contact:?} {other:?}");
    }
}

#[test]
fn a_ridge_pushes_a_disc_back_while_the_centre_is_less_than_the_thickness_below() {
    let set = triangle_set(
        vec![
            Vec3::new(0.0, -1.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(1.0, 0.0, -1.0),
            Vec3::new(-1.0, 0.0, -1.0),
        ],
        &[[0, 2, 1], [1, 3, 0]],
    );
    let at = |z: f64| Ellipsoid {
        center: Vec3::new(0.0, 0.01, z),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(0.4, 0.4, 0.1),
    };
    for (z, standing) in
        [(0.05, Some(Standing::Front)), (-0.02, Some(Standing::Behind)), (-0.04, None), (0.101, None)]
    {
        let found = contacts(&at(z), &set, 0.03);
        let up: Vec<_> = found.iter().filter(|c| c.interference.normal_b.z > 0.9).collect();
        assert_eq!(up.first().map(|c| c.standing), standing, "{z}: {found:?}");
        for contact in up {
            assert!((contact.interference.depth - (0.1 - z)).abs() < 1e-15);
        }
    }
}

#[test]
fn a_foot_within_rounding_beyond_a_seam_is_spare() {
    let set = triangle_set(
        vec![Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        &[[0, 1, 2], [0, 2, 3]],
    );
    let e = Ellipsoid {
        center: Vec3::new(0.5 - 1e-13, 0.5, 0.09),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(0.1, 0.2, 0.1),
    };
    let standings: Vec<_> = contacts(&e, &set, 0.1).iter().map(|c| c.standing).collect();
    assert_eq!(standings, [Standing::Spare, Standing::Front]);
}

#[test]
fn a_sphere_as_the_sphere_tester() {
    let mut random = Random(104);
    let bumpy = patch(5, &mut Random(7), &|x, y| 0.1 * (9.0 * x).sin() * (7.0 * y).cos());
    let mut compared = 0;
    for _ in 0..20_000 {
        let sphere = Sphere {
            center: Vec3::new(
                random.between(-0.6, 0.6),
                random.between(-0.6, 0.6),
                random.between(-0.1, 0.2),
            ),
            radius: 0.12,
        };
        let e = Ellipsoid {
            center: sphere.center,
            axes: random.rotation_matrix(),
            semi_axes: Vec3::repeat(sphere.radius),
        };
        let mut expected = Vec::new();
        for t in 0..bumpy.triangles.len() as u32 {
            sphere_triangle(&sphere, &bumpy, t, 0.03, &mut |contact| expected.push(contact));
        }
        // A face behind yields here to any less deep plane next to it; for spheres load sharing does that.
        let front = |list: &[TriangleContact]| {
            let mut list: Vec<_> =
                list.iter().filter(|c| c.standing == Standing::Front).map(|c| c.interference).collect();
            list.sort_by_key(|i| i.feature);
            list
        };
        let (expected, found) = (front(&expected), front(&contacts(&e, &bumpy, 0.03)));
        assert_eq!(expected.len(), found.len(), "{expected:?} {found:?}");
        for (a, b) in expected.iter().zip(&found) {
            assert_eq!(a.feature, b.feature);
            assert!((a.depth - b.depth).abs() < 1e-14 && (a.normal_b - b.normal_b).norm() < 1e-10);
            compared += 1;
        }
    }
    println!("{compared} contacts compared");
    assert!(compared > 5000);
}

fn one_triangle() -> TriangleSet {
    triangle_set(vec![Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)], &[[0, 1, 2]])
}

#[test]
fn free_edge_and_corner_push_towards_the_centre_in_front() {
    let set = one_triangle();
    let semi_axes = Vec3::new(0.2, 0.3, 0.1);
    let at = |center| Ellipsoid { center, axes: Mat3::identity(), semi_axes };
    let reach =
        |n: &Vec3| n.component_mul(&semi_axes).component_mul(&semi_axes) / n.component_mul(&semi_axes).norm();
    let depth = 1e-3;
    // Over the edge y = 0.
    let n = Vec3::new(0.0, -0.6, 0.8);
    let found = pushing(&at(Vec3::new(0.4, 0.0, 0.0) + reach(&n) - n * depth), &set, 0.1);
    assert_eq!(found.len(), 1);
    assert!((found[0].interference.depth - depth).abs() < 1e-15);
    assert!((found[0].interference.normal_b - n).norm() < 1e-13);
    // Over the corner at the origin.
    let n = Vec3::new(-0.48, -0.36, 0.8);
    let found = pushing(&at(reach(&n) - n * depth), &set, 0.1);
    assert_eq!(found.len(), 1);
    assert!(
        (found[0].interference.normal_b - n).norm() < 1e-13
            && (found[0].interference.depth - depth).abs() < 1e-15
    );
    // From behind neither pushes.
    for n in [Vec3::new(0.0, -0.6, -0.8), Vec3::new(-0.48, -0.36, -0.8)] {
        let e = at(Vec3::new(0.0, 0.0, 0.0) + reach(&n) - n * depth);
        assert!(contacts(&e, &set, 0.1).is_empty(), "{:?}", contacts(&e, &set, 0.1));
    }
}

#[test]
fn behind_counts_less_than_the_thickness() {
    let set = one_triangle();
    let at = |z| Ellipsoid {
        center: Vec3::new(0.25, 0.25, z),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(0.05, 0.04, 0.1),
    };
    for (z, standing) in [
        (0.05, Some(Standing::Front)),
        (0.0, Some(Standing::Front)),
        (-0.029, Some(Standing::Behind)),
        (-0.031, None),
    ] {
        let found = contacts(&at(z), &set, 0.03);
        assert_eq!(found.first().map(|c| c.standing), standing, "{z}");
        if let Some(contact) = found.first() {
            assert!((contact.interference.depth - (0.1 - z)).abs() < 1e-15);
        }
    }
}

#[test]
fn both_walls_of_a_concave_corner_push() {
    let set = triangle_set(
        vec![
            Vec3::new(0.0, -1.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(1.0, 0.0, 0.0),
            Vec3::new(0.0, 0.0, 1.0),
        ],
        &[[0, 2, 1], [1, 3, 0]],
    );
    let e = Ellipsoid {
        center: Vec3::new(0.19, 0.0, 0.09),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(0.2, 0.15, 0.1),
    };
    let found = pushing(&e, &set, 0.1);
    assert_eq!(found.len(), 2, "{found:?}");
    for (contact, n) in found.iter().zip([Vec3::z(), Vec3::x()]) {
        assert!(
            (contact.interference.normal_b - n).norm() < 1e-15
                && (contact.interference.depth - 0.01).abs() < 1e-15
        );
    }
}

#[test]
fn least_depth_is_continuous_over_a_ridge() {
    let lift = |x: f64, _: f64| -0.8 * x.abs();
    let set = patch(2, &mut Random(u64::MAX), &|x, y| if x.abs() < 0.3 { 0.0 } else { lift(x, y) });
    let axes = Random(5).rotation_matrix();
    let mut before = None;
    const STEPS: usize = 20_000;
    for k in 0..=STEPS {
        let s = 0.5 * k as f64 / STEPS as f64 - 0.25;
        let e = Ellipsoid {
            center: Vec3::new(s, 0.02, 0.05 - 0.3 * s.abs()),
            axes,
            semi_axes: Vec3::new(0.12, 0.1, 0.09),
        };
        let depth =
            pushing(&e, &set, 0.09).iter().map(|c| c.interference.depth).fold(f64::INFINITY, f64::min);
        let depth = if depth.is_finite() { depth } else { 0.0 };
        if let Some(before) = before {
            let step: f64 = depth - before;
            assert!(step.abs() < 1.1 * 0.5 / STEPS as f64, "at {s}: {before} {depth}");
        }
        before = Some(depth);
    }
}

#[test]
fn rigid_motion_and_scale_change_nothing() {
    let mut random = Random(105);
    let set = surface_of(&stretched_hull(18, Vec3::repeat(0.5)));
    let changed = |f: &dyn Fn(&Vec3) -> Vec3| TriangleSet {
        vertices: set.vertices.iter().map(f).collect(),
        triangles: set.triangles.clone(),
    };
    for _ in 0..1000 {
        let e = Ellipsoid {
            center: random.direction() * random.between(0.5, 0.6),
            axes: random.rotation_matrix(),
            semi_axes: Vec3::new(0.15, 0.1, 0.12),
        };
        let expected = pushing(&e, &set, 0.1);
        for factor in [1e-4, 1e4] {
            let found = pushing(&scaled_ellipsoid(&e, factor), &changed(&|v| v * factor), 0.1 * factor);
            assert_eq!(found.len(), expected.len());
            for (a, b) in expected.iter().zip(&found) {
                assert!((a.interference.depth * factor - b.interference.depth).abs() < 1e-12 * factor);
            }
        }
        let x = random_motion(&mut random, 1.0);
        let found = pushing(&e.carried(&x), &changed(&|v| x.point(v)), 0.1);
        assert_eq!(found.len(), expected.len());
        for (a, b) in expected.iter().zip(&found) {
            assert!((a.interference.depth - b.interference.depth).abs() < 1e-12);
            assert!((x.vector(&a.interference.normal_b) - b.interference.normal_b).norm() < 1e-8);
        }
    }
}
