//! Spheres against triangle surfaces, compared with all local minima of the distance to every triangle.
//!
//! Degenerate cases: centres in a triangle's plane, on its edges and vertices, straight above them; flat plates
//! rounded to `f32`; centres behind the surface within and beyond the thickness.

use crate::common;
use crate::common::{Random, random_motion, stretched_hull};
use crate::oracle_support;
use crate::oracle_support::{
    Nearest, Worst, all_contacts, counting_contacts, dented_ball, fan_plate, hilly_sheet, local_minima,
    moved_surface, regular_plate, rounded_to_f32, shared_push, shuffled, skin, surface, winding_number,
};
use pong_geometry::Vec3;
use pong_geometry::interference::triangle_features::Standing;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::{Sphere, TriangleSet};

/// Compares the contacts of one sphere with the local minima that may push; returns the largest error if they
/// agree.
fn agrees(contacts: &[Interference], minima: &[&Nearest], sphere: &Sphere, tolerance: f64) -> Option<f64> {
    let mut worst = 0.0_f64;
    if contacts.len() != minima.len() {
        return None;
    }
    for nearest in minima {
        let expected = sphere.center - nearest.foot;
        let error = |c: &Interference| {
            let arm = c.normal_b * (sphere.radius - c.depth);
            (arm - expected).norm()
                + (c.deepest_b - (sphere.center - c.normal_b * sphere.radius)).norm()
                + (c.normal_b.norm() - 1.0).abs()
        };
        worst = worst.max(contacts.iter().map(error).fold(f64::INFINITY, f64::min));
    }
    (worst <= tolerance).then_some(worst)
}

/// Minima that may push with zero thickness: the centre is in front of the foot's triangles. `closed`:
/// decided by being outside the solid; else by the faces there (all of a fold, any of a free fan).
fn pushing(set: &TriangleSet, p: &Vec3, radius: f64, closed: bool) -> Vec<Nearest> {
    let outside = !closed || winding_number(set, p) < 0.5;
    let mut minima = local_minima(set, p, radius, 1.0);
    minima
        .retain(|m| outside && m.distance < radius && m.height_max >= 0.0 && (closed || in_front(set, p, m)));
    minima
}

/// For open surfaces: decided by the sum of the normals at the foot, or by the face at a free edge.
fn in_front(set: &TriangleSet, p: &Vec3, m: &Nearest) -> bool {
    let free = m.triangles.iter().any(|&t| {
        let c = set.corners(t);
        (0..3).any(|k| {
            set.triangles[t as usize].neighbors[k] == u32::MAX
                && (oracle_support::nearest_on_segment(&m.foot, &c[k], &c[(k + 1) % 3]) - m.foot).norm()
                    < 1e-9
        })
    });
    let mean: Vec3 = m.triangles.iter().map(|&t| set.normal(t)).sum();
    if free { m.height_max >= 0.0 } else { mean.dot(&(p - m.foot)) >= 0.0 }
}

fn compare(set: &TriangleSet, rounds: usize, closed: bool, seed: u64, name: &'static str) {
    let mut random = Random(seed);
    let mut worst = Worst::new(name);
    let (mut touching, mut several, mut ambiguous) = (0, 0, 0);
    while touching < rounds {
        let center = Vec3::from_fn(|_, _| random.between(-1.4, 1.4));
        let sphere = Sphere { center, radius: random.between(0.05, 0.9) };
        let contacts = counting_contacts(&sphere, set, 0.0);
        let minima = pushing(set, &center, sphere.radius, closed);
        if minima.is_empty() && contacts.is_empty() {
            continue;
        }
        touching += 1;
        several += usize::from(minima.len() > 1);
        let references: Vec<&Nearest> = minima.iter().collect();
        if let Some(error) = agrees(&contacts, &references, &sphere, 1e-9) {
            worst.note(error, 1e-12);
            // For any order of the triangles: the same set.
            if touching % 16 == 0 {
                let other = counting_contacts(&sphere, &shuffled(set, &mut random), 0.0);
                assert!(agrees(&other, &references, &sphere, 1e-12).is_some());
            }
            continue;
        }
        // On the border between two answers the search itself must change nearby.
        let wavers = (0..24).any(|_| {
            let p = center + random.direction() * 1e-6;
            pushing(set, &p, sphere.radius, closed).len() != minima.len()
        });
        assert!(wavers, "{center:?} r {}: {contacts:?} but {minima:?}", sphere.radius);
        ambiguous += 1;
    }
    println!("{name}: {touching} touching, {several} at several places, {ambiguous} on a border");
    assert!(ambiguous * 500 < touching);
}

#[test]
fn closed_convex_surfaces_push_from_every_local_minimum() {
    let ball = skin(&stretched_hull(40, Vec3::new(1.0, 0.8, 0.6)));
    compare(&moved_surface(&ball, &random_motion(&mut Random(7), 0.2)), 3500, true, 201, "convex mesh");
    let brick = skin(&common::cuboid(Vec3::new(-0.6, -0.5, -0.4), Vec3::new(0.5, 0.6, 0.3)));
    compare(&moved_surface(&brick, &random_motion(&mut Random(8), 0.2)), 3500, true, 202, "box mesh");
}

#[test]
fn closed_concave_surfaces_push_from_every_local_minimum() {
    let mut random = Random(203);
    for seed in 0..4 {
        let ball = dented_ball(6, 9, 0.25, &mut random);
        compare(
            &moved_surface(&ball, &random_motion(&mut random, 0.1)),
            2500,
            true,
            204 + seed,
            "dented mesh",
        );
    }
}

#[test]
fn open_sheets_push_from_every_local_minimum_in_front() {
    let mut random = Random(210);
    for seed in 0..4 {
        let sheet = hilly_sheet(4, 0.35, &mut random);
        compare(
            &moved_surface(&sheet, &random_motion(&mut random, 0.1)),
            2500,
            false,
            211 + seed,
            "hilly sheet",
        );
    }
}

/// A square L-shaped trough: concave edges and vertices never push, for any centre.
#[test]
fn concave_features_are_silent() {
    let vertices = [(0., 1.), (0., 0.), (1., 0.)]
        .iter()
        .flat_map(|&(x, z)| [-1.0, 0.0, 1.0].map(|y| Vec3::new(x, y, z)))
        .collect();
    let mut triangles = Vec::new();
    for strip in 0..2_u32 {
        for y in 0..2_u32 {
            let a = 3 * strip + y;
            triangles.extend([[a, a + 3, a + 1], [a + 1, a + 3, a + 4]]);
        }
    }
    let set = surface(vertices, &triangles);
    assert!(set.normal(0).x > 0.9 && set.normal(4).z > 0.9, "both fronts face the trough");
    let mut random = Random(220);
    for _ in 0..10_000 {
        let center =
            Vec3::new(random.between(-0.1, 0.6), random.between(-0.9, 0.9), random.between(-0.1, 0.6));
        let sphere = Sphere { center, radius: random.between(0.1, 0.8) };
        for contact in all_contacts(&sphere, &set, 0.3) {
            let i = contact.interference;
            if !i.feature.is_face() && contact.standing != Standing::Spare {
                // Only the free rim may: its feet lie at x = 1, z = 1 or |y| = 1.
                let foot = i.deepest_b + i.normal_b * i.depth;
                let on_rim = foot.x > 1.0 - 1e-9 || foot.z > 1.0 - 1e-9 || foot.y.abs() > 1.0 - 1e-9;
                assert!(on_rim, "{i:?}");
            }
        }
    }
}

/// Behind: inside the prism and by less than the thickness; never elsewhere.
#[test]
fn thickness_is_measured_at_the_centre_inside_the_prism() {
    let set = surface(vec![Vec3::zeros(), Vec3::x(), Vec3::y()], &[[0, 1, 2]]);
    let mut random = Random(230);
    let mut pushed = 0;
    for _ in 0..10_000 {
        let center =
            Vec3::new(random.between(-0.4, 1.2), random.between(-0.4, 1.2), random.between(-0.5, -1e-9));
        let (radius, thickness) = (random.between(0.05, 0.6), random.between(0.0, 0.6));
        let contacts = all_contacts(&Sphere { center, radius }, &set, thickness);
        let in_prism = center.x >= 0.0 && center.y >= 0.0 && center.x + center.y <= 1.0;
        let expected = in_prism && -center.z < thickness;
        assert_eq!(contacts.len(), usize::from(expected), "{center:?} r {radius} t {thickness}");
        if let [contact] = contacts[..] {
            pushed += 1;
            assert_eq!(contact.standing, Standing::Behind);
            assert_eq!(contact.interference.normal_b, Vec3::z());
            assert!((contact.interference.depth - (radius - center.z)).abs() < 1e-15);
        }
    }
    assert!(pushed > 500);
}

fn lean(random: &mut Random) -> f64 {
    random.between(-1.0, 1.0)
}

/// The shared force of a flat plate, however it is cut and rounded, is that of one plane.
#[test]
fn rounded_plates_push_like_one_plane() {
    let mut random = Random(240);
    let mut worst = Worst::new("f32 plate: shared push, relative to depth, over the slope of its facets");
    for round in 0..60 {
        let plate = if round % 2 == 0 { regular_plate(7) } else { fan_plate(&mut random) };
        let motion = random_motion(&mut random, 2.0);
        let tilted = rounded_to_f32(&moved_surface(&plate, &motion));
        let normal = motion.rotation.column(2).into_owned();
        // Angle and distance by which the rounded facets deviate from the plane.
        let slope = (0..tilted.triangles.len() as u32)
            .map(|t| (tilted.normal(t) - normal).norm())
            .fold(1e-15, f64::max);
        let off =
            tilted.vertices.iter().map(|v| normal.dot(&(v - motion.translation)).abs()).fold(1e-16, f64::max);
        for _ in 0..170 {
            let height = random.between(0.02, 0.29);
            let foot = Vec3::new(lean(&mut random) * 0.65, lean(&mut random) * 0.65, 0.0);
            let center = motion.point(&(foot + Vec3::z() * height));
            let contacts = counting_contacts(&Sphere { center, radius: 0.3 }, &tilted, 0.3);
            assert!(!contacts.is_empty());
            let push = shared_push(&contacts);
            let depth = 0.3 - height;
            worst.note((push - normal * depth).norm() / (slope * 0.3 + off), 4.0);
        }
    }
}

/// The tip of an oblique cone of few or many faces, pointed or as flat as the corner of a sheet, pushes a
/// centre above all its edges if its fronts are outside; as the bottom of a pit, seen through the solid, it
/// does not.
#[test]
fn slanting_tips_push_from_their_front_alone() {
    let mut random = Random(250);
    let (mut tried, mut aslant) = (0, 0);
    while tried < 2000 {
        let axis = -(random.direction() + Vec3::z() * 0.5).normalize();
        let side = axis.cross(&random.direction()).normalize();
        let (count, width) = (3 + random.bits() % 6, random.between(0.1, 1.0));
        let flat = if random.bits().is_multiple_of(2) { 1.0 } else { random.between(1e-3, 0.1) };
        let ring: Vec<Vec3> = (0..count)
            .map(|k| {
                let angle = std::f64::consts::TAU * (k as f64 + random.between(0.1, 0.9)) / count as f64;
                let out = side * angle.cos() + axis.cross(&side) * (flat * angle.sin());
                (axis + out * width).normalize() * random.between(1.0, 4.0)
            })
            .collect();
        if ring.iter().any(|edge| edge.z > -0.05) {
            continue;
        }
        tried += 1;
        // True if the foot of the z axis lies beside the cone.
        aslant += usize::from(axis.z > -1.0 / (1.0 + width * width).sqrt());
        let count = count as u32;
        let fan = |out: bool| -> Vec<[u32; 3]> {
            let turned = |k: u32| [0, 1 + (k + 1) % count, 1 + k];
            let straight = |k: u32| [0, 1 + k, 1 + (k + 1) % count];
            (0..count).map(|k| if out { turned(k) } else { straight(k) }).collect()
        };
        let sphere = Sphere { center: Vec3::z() * 0.125, radius: 0.25 };
        let pushes = |triangles: &[[u32; 3]]| {
            let set =
                surface(std::iter::once(Vec3::zeros()).chain(ring.iter().copied()).collect(), triangles);
            let found = all_contacts(&sphere, &set, 0.0);
            let mut of_tip = found.iter().filter(|c| c.interference.feature == Feature::vertex(0));
            of_tip.next().map(|contact| (contact.standing, contact.interference.normal_b))
        };
        assert_eq!(pushes(&fan(true)), Some((Standing::Front, Vec3::z())), "{ring:?}");
        assert_eq!(pushes(&fan(false)), None, "{ring:?}");
    }
    assert!(aslant > 300, "{aslant}");
}

#[test]
fn centres_on_the_surface_are_finite_and_pushed_out() {
    let set = skin(&common::cuboid(Vec3::repeat(-0.5), Vec3::repeat(0.5)));
    for x in [-0.5, 0.0, 0.5] {
        for y in [-0.5, 0.25, 0.5] {
            for z in [-0.5, 0.1, 0.5] {
                let center = Vec3::new(x, y, z);
                if center.amax() < 0.5 {
                    continue;
                }
                let sphere = Sphere { center, radius: 0.2 };
                let contacts = counting_contacts(&sphere, &set, 0.2);
                assert_eq!(contacts, counting_contacts(&sphere, &set, 0.2));
                let push = shared_push(&contacts);
                assert!(push.norm().is_finite() && push.norm() >= 0.2 - 1e-15, "{center:?}");
                let out = center.map(|c| if c.abs() == 0.5 { c.signum() } else { 0.0 });
                assert!(push.dot(&out) > 0.0 && contacts.iter().all(|c| c.normal_b.dot(&out) >= 0.0));
            }
        }
    }
}
