//! Rejected pairs of a sphere and a triangle have no contact, and features marked as never pushing have none.
//! Pairs are classified eight at a time.

use crate::common::{Random, levels, random_motion};
use crate::oracle_support::rows::{Pairs, tell_in_rows};
use crate::oracle_support::{
    all_contacts, dented_ball, fan_plate, hilly_sheet, moved_surface, regular_plate, rounded_to_f32, surface,
    surfaces,
};
use pong_geometry::Vec3;
use pong_geometry::interference::ellipsoid_triangle::ellipsoid_triangle;
use pong_geometry::interference::pushing_features::mark_pushing;
use pong_geometry::interference::sphere_triangle::{sphere_over_face, sphere_triangle};
use pong_geometry::interference::sphere_triangle_pairs::{PairsTold, SphereTrianglePairs};
use pong_geometry::interference::triangle_features::TriangleContact;
use pong_geometry::primitive::{Ellipsoid, MayPush, Sphere, TriangleSet};
use pong_geometry::simd::{LANES, Level, Simd, set_level};

/// Random sphere near a surface: anywhere, over a face or at a degenerate point; and the triangle there.
fn sphere(set: &TriangleSet, random: &mut Random) -> (Sphere, u32) {
    let count = set.triangles.len() as u64;
    let triangle = (random.bits() % count) as u32;
    let [a, b, c] = set.corners(triangle);
    let normal = set.normal((random.bits() % count) as u32);
    let height = random.between(-0.1, 0.3);
    let center = match random.bits() % 7 {
        0 => a,
        1 => (a + b) * 0.5,
        2 => (a + b + c) / 3.0,
        3 => a + normal * height,
        4 => (a + b + c) / 3.0 + set.normal(triangle) * height,
        5 => (a + b) * 0.5 + normal * height,
        _ => Vec3::new(random.between(-1.3, 1.3), random.between(-1.3, 1.3), random.between(-0.5, 0.5)),
    };
    (Sphere { center, radius: random.between(0.01, 0.4) }, triangle)
}

fn contacts(sphere: &Sphere, set: &TriangleSet, triangle: u32, thickness: f64) -> Vec<TriangleContact> {
    let mut found = Vec::new();
    sphere_triangle(sphere, set, triangle, thickness, &mut |contact| found.push(contact));
    found
}

/// No rejected pair has a contact, at any instruction-set level and of any size. Most pairs without contacts
/// are rejected, though none whose centre is behind the triangle and near its plane. Where only the face may
/// push, no other feature does.
#[test]
fn pairs_that_are_left_out_find_nothing() {
    let mut random = Random(71);
    let (mut left_out, mut idle, mut touching, mut faces) = (0, 0, 0, 0);
    for round in 0..40 {
        for (name, mut set) in surfaces(&mut random) {
            if round % 2 == 0 {
                mark_pushing(&mut set);
            }
            // Scaled by a power of two, which is exact: a kilometre, a millimetre.
            let scale = f64::exp2(f64::from(round % 3 - 1) * 10.0);
            let mut scaled = set.clone();
            scaled.vertices.iter_mut().for_each(|vertex| *vertex *= scale);
            for _ in 0..20 {
                let used = 1 + random.bits() as usize % LANES;
                let drawn: Vec<(Sphere, u32, f64)> = (0..used)
                    .map(|_| {
                        let (sphere, there) = sphere(&set, &mut random);
                        let any = (random.bits() % set.triangles.len() as u64) as u32;
                        let triangle = if random.bits().is_multiple_of(4) { there } else { any };
                        let sphere = Sphere { center: sphere.center * scale, radius: sphere.radius * scale };
                        (sphere, triangle, sphere.radius * random.between(0.0, 2.0))
                    })
                    .collect();
                let _turn = levels::Turn::wait();
                for level in Level::available() {
                    set_level(level);
                    let mut pairs = SphereTrianglePairs::default();
                    for (place, (sphere, t, thickness)) in drawn.iter().enumerate() {
                        assert_eq!(pairs.add(sphere, *t, *thickness), place);
                    }
                    let PairsTold { near, over_face } = pairs.take(&scaled);
                    assert_eq!(pairs.count(), 0);
                    assert_eq!(over_face & !near, 0);
                    assert!(used == LANES || near >> used == 0);
                    for (lane, (sphere, t, thickness)) in drawn.iter().enumerate() {
                        let found = contacts(sphere, &scaled, *t, *thickness);
                        let is_near = near >> lane & 1 == 1;
                        assert!(is_near || found.is_empty(), "{name} {level:?} {sphere:?} {t} {found:?}");
                        if over_face >> lane & 1 == 1 {
                            let alone = sphere_over_face(sphere, &scaled, *t);
                            assert_eq!(alone.as_slice(), found, "{name} {level:?} {sphere:?} {t}");
                            faces += found.len();
                        }
                        left_out += u32::from(!is_near);
                        idle += u32::from(found.is_empty());
                        touching += u32::from(!found.is_empty());
                    }
                }
            }
        }
    }
    println!("{left_out} left out of {idle} without contact; {touching} with, {faces} by a face alone");
    assert!(faces > 500);
    assert!(touching > 2000 && f64::from(left_out) > 0.6 * f64::from(idle));
}

impl Pairs for SphereTrianglePairs {
    type Element = Sphere;
    type Told = PairsTold;
    fn begin_in<S: Simd>(&mut self, simd: S, element: &Sphere, thickness: f64) {
        Self::begin_in(self, simd, element, thickness);
    }
    fn push(&mut self, triangle: u32) -> usize {
        Self::push(self, triangle)
    }
    fn add(&mut self, element: &Sphere, triangle: u32, thickness: f64) -> usize {
        Self::add(self, element, triangle, thickness)
    }
    fn take(&mut self, set: &TriangleSet) -> PairsTold {
        Self::take(self, set)
    }
}

#[test]
fn triangles_in_a_row_are_told_as_one_by_one() {
    let mut random = Random(75);
    let mut near = 0;
    for (_, set) in surfaces(&mut random) {
        let told = tell_in_rows::<SphereTrianglePairs>(&set, &mut random, |random| {
            let (sphere, there) = sphere(&set, random);
            let thickness = sphere.radius * random.between(0.0, 2.0);
            (sphere, there, thickness)
        });
        near += told.iter().map(|told| told.near.count_ones()).sum::<u32>();
    }
    assert!(near > 500, "{near}");
}

#[test]
fn pairs_are_counted_and_forgotten() {
    let set = regular_plate(2);
    let mut pairs = SphereTrianglePairs::default();
    let touching = Sphere { center: set.corners(0)[0], radius: 0.1 };
    for count in 1..=3 {
        pairs.add(&touching, 0, 0.1);
        assert_eq!(pairs.count(), count);
    }
    pairs.clear();
    assert_eq!((pairs.count(), pairs.take(&set).near), (0, 0));
    pairs.add(&touching, 0, 0.1);
    assert_eq!(pairs.take(&set).near, 1);
}

/// A pair with NaN is not rejected.
#[test]
fn what_is_no_number_is_not_left_out() {
    let set = regular_plate(2);
    let mut pairs = SphereTrianglePairs::default();
    pairs.add(&Sphere { center: Vec3::repeat(f64::NAN), radius: 0.1 }, 0, 0.1);
    pairs.add(&Sphere { center: Vec3::zeros(), radius: f64::NAN }, 0, 0.1);
    assert_eq!(pairs.take(&set), PairsTold { near: 3, over_face: 0 });
}

/// Marking the features that may push changes no contact of any sphere or ellipsoid.
#[test]
fn marked_surfaces_push_as_unmarked_ones() {
    let mut random = Random(72);
    let mut compared = 0;
    for (name, set) in (0..10).flat_map(|_| surfaces(&mut random)).collect::<Vec<_>>() {
        assert!(set.triangles.iter().all(|triangle| triangle.may_push == MayPush::ALL));
        let mut marked = set.clone();
        mark_pushing(&mut marked);
        assert!(marked.triangles.iter().any(|triangle| triangle.may_push != MayPush::ALL), "{name}");
        for _ in 0..100 {
            let (sphere, _) = sphere(&set, &mut random);
            let expected = all_contacts(&sphere, &set, sphere.radius);
            assert_eq!(all_contacts(&sphere, &marked, sphere.radius), expected, "{name} {sphere:?}");
            let semi_axes = Vec3::new(1.0, 0.6, 0.4) * sphere.radius;
            let e = Ellipsoid { center: sphere.center, axes: random.rotation_matrix(), semi_axes };
            let of = |set: &TriangleSet| {
                let mut found = Vec::new();
                for t in 0..set.triangles.len() as u32 {
                    ellipsoid_triangle(&e, set, t, semi_axes.z, &mut |contact| found.push(contact));
                }
                found
            };
            assert_eq!(of(&marked), of(&set), "{name} {e:?}");
            compared += expected.len();
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// Pyramid without a base, with `sides` sides that descend with a slope.
fn pyramid(sides: u32, slope: f64, random: &mut Random) -> TriangleSet {
    let corner = |k: u32, turn: f64| {
        let angle = (f64::from(k) + turn) / f64::from(sides) * std::f64::consts::TAU;
        Vec3::new(angle.cos(), angle.sin(), -slope)
    };
    let mut vertices = vec![Vec3::zeros()];
    vertices.extend((0..sides).map(|k| corner(k, random.between(-0.3, 0.3)) * random.between(0.7, 1.4)));
    let side = |k: u32| [0, 1 + k, 1 + (k + 1) % sides];
    surface(vertices, &(0..sides).map(side).collect::<Vec<_>>())
}

/// Surface with little or much curvature, rotated, moved and scaled, half of them rounded to single
/// precision; marked.
fn curved_surface(round: usize, random: &mut Random) -> TriangleSet {
    let hill = [1e-6, 1e-3, 0.02, 0.1, 0.4][round % 5];
    let set = match round % 4 {
        0 => hilly_sheet(4, hill, random),
        1 => dented_ball(5, 7, hill, random),
        2 => pyramid(3 + round as u32 % 9, 2.0 * hill, random),
        _ => {
            let mut set = fan_plate(random);
            set.vertices.iter_mut().for_each(|vertex| vertex.z = -hill * vertex.norm_squared());
            set
        }
    };
    let moved = moved_surface(&set, &random_motion(random, 3.0));
    let mut set = if round.is_multiple_of(2) { rounded_to_f32(&moved) } else { moved };
    let scale = f64::exp2([0.0, 10.0, -10.0][round % 7 % 3]);
    set.vertices.iter_mut().for_each(|vertex| *vertex *= scale);
    mark_pushing(&mut set);
    set
}

/// Returns `true` if a single pair is classified as one that may touch.
fn is_told_near(sphere: &Sphere, set: &TriangleSet, triangle: u32) -> bool {
    let mut pairs = SphereTrianglePairs::default();
    pairs.add(sphere, triangle, sphere.radius);
    pairs.take(set).near == 1
}

/// A centre straight over an edge or a vertex, on a mixture of the normals there: up to one of them, and
/// beside it by rounding. A contact of the edge or the vertex is not rejected.
#[test]
fn what_pushes_aside_is_not_left_out() {
    const PARTS: [f64; 8] = [0.0, 1e-15, 1e-9, 1e-3, 0.3, 0.5, 1.0 - 1e-9, 1.0];
    let mut random = Random(73);
    let (mut edges, mut vertices) = (0, 0);
    for round in 0..240 {
        let set = curved_surface(round, &mut random);
        for (t, record) in set.triangles.iter().enumerate() {
            for k in 0..3 {
                let corners = set.corners(t as u32);
                let (start, end) = (corners[k], corners[(k + 1) % 3]);
                let size = (end - start).norm();
                let height = size * 10.0_f64.powf(random.between(-3.0, 0.0));
                let radius = height * random.between(1.001, 1.1);
                let neighbor = record.neighbors[k];
                let other = if neighbor == u32::MAX { t as u32 } else { neighbor };
                // One of the triangles around the vertex.
                let around = (0..set.triangles.len() as u32)
                    .filter(|&t| set.triangles[t as usize].vertices.contains(&record.vertices[k]))
                    .collect::<Vec<_>>();
                for part in PARTS {
                    let mean = set.normal(t as u32) * (1.0 - part) + set.normal(other) * part;
                    let place = start + (end - start) * random.between(0.1, 0.9);
                    let over_edge = Sphere { center: place + mean.normalize() * height, radius };
                    let any = around[random.bits() as usize % around.len()];
                    let mixed = mean * (1.0 - part) + set.normal(any) * part;
                    let over_vertex = Sphere { center: start + mixed.normalize() * height, radius };
                    for (sphere, found) in [(over_edge, &mut edges), (over_vertex, &mut vertices)] {
                        for triangle in [t as u32, other, any] {
                            let contacts = contacts(&sphere, &set, triangle, radius);
                            let is_aside = |c: &&TriangleContact| !c.interference.feature.is_face();
                            *found += contacts.iter().filter(is_aside).count();
                            assert!(
                                contacts.is_empty() || is_told_near(&sphere, &set, triangle),
                                "round {round}, triangle {triangle}, {sphere:?}: {contacts:?}"
                            );
                        }
                    }
                }
            }
        }
    }
    println!("{edges} contacts of edges, {vertices} of vertices");
    assert!(edges > 5000 && vertices > 500);
}

/// On a slightly curved surface, a sphere pressed into it is tested against few triangles without a contact.
#[test]
fn most_neighbours_of_the_face_below_are_left_out() {
    let mut random = Random(74);
    let (mut told, mut touching) = (0, 0);
    for _ in 0..20 {
        let mut set = hilly_sheet(10, 0.02, &mut random);
        mark_pushing(&mut set);
        for _ in 0..50 {
            let center = Vec3::new(random.between(-0.6, 0.6), random.between(-0.6, 0.6), 0.33);
            let sphere = Sphere { center, radius: 0.35 };
            for t in 0..set.triangles.len() as u32 {
                told += u32::from(is_told_near(&sphere, &set, t));
                touching += u32::from(!contacts(&sphere, &set, t, sphere.radius).is_empty());
            }
        }
    }
    println!("{told} told near, {touching} touch");
    assert!(touching > 1000 && f64::from(told) < 1.3 * f64::from(touching));
}
