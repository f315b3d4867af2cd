//! Rejected pairs of an ellipsoid and a triangle have no contact. Pairs are classified eight at a time.

use crate::common::{Random, levels, scaled_ellipsoid};
use crate::oracle_support::rows::{Pairs, tell_in_rows};
use crate::oracle_support::{regular_plate, surface, surfaces};
use pong_geometry::Vec3;
use pong_geometry::interference::ellipsoid_triangle::ellipsoid_triangle;
use pong_geometry::interference::ellipsoid_triangle_pairs::EllipsoidTrianglePairs;
use pong_geometry::interference::pushing_features::mark_pushing;
use pong_geometry::interference::triangle_features::TriangleContact;
use pong_geometry::primitive::{Ellipsoid, TriangleSet};
use pong_geometry::simd::{LANES, LaneBits, Level, Simd, set_level};

/// Surfaces of every kind, and two on which only a vertex pushes: a sharp spike, and a box cut at a corner so
/// that the lowest triangle there has none of the box's edges.
fn all_surfaces(random: &mut Random) -> Vec<(&'static str, TriangleSet)> {
    let corner = |angle: f64| Vec3::new(0.12 * angle.cos(), 0.12 * angle.sin(), 0.0);
    let base = [0.3, 2.4, 4.5].map(corner);
    let spike = vec![base[0], base[1], base[2], Vec3::new(0.02, 0.01, 1.0)];
    let spike = surface(spike, &[[0, 1, 3], [1, 2, 3], [2, 0, 3], [2, 1, 0]]);
    let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    // The top is cut from its corner 0 into three triangles, of which the middle one comes first, after two
    // at its other corners.
    let vertices = vec![
        at(0.5, 0.5, 0.4),
        at(-0.5, 0.5, 0.4),
        at(-0.5, 0.0, 0.4),
        at(-0.5, -0.5, 0.4),
        at(0.5, -0.5, 0.4),
        at(0.5, 0.5, -0.4),
        at(-0.5, 0.5, -0.4),
        at(0.5, -0.5, -0.4),
    ];
    let triangles =
        [[2, 1, 6], [3, 2, 6], [0, 2, 3], [0, 1, 2], [0, 3, 4], [0, 5, 1], [5, 6, 1], [0, 4, 5], [4, 7, 5]];
    let mut all = surfaces(random);
    all.extend([("spike", spike), ("cut box", surface(vertices, &triangles))]);
    all
}

/// Ellipsoid of any shape, from a needle to a disc, near a triangle: anywhere, over its face, or at an edge
/// or a vertex, shallow or deep.
fn ellipsoid(set: &TriangleSet, triangle: u32, random: &mut Random) -> Ellipsoid {
    let [a, b, c] = set.corners(triangle);
    let normal = set.normal(triangle);
    let radius = random.between(0.02, 0.4);
    let shape = match random.bits() % 4 {
        0 => Vec3::repeat(1.0),
        1 => Vec3::new(1.0, 0.9, 0.2),
        2 => Vec3::new(1.0, 0.3, 0.25),
        _ => Vec3::new(random.between(0.1, 1.0), random.between(0.1, 1.0), 1.0),
    };
    // Upright ones too, whose deepest point lies below the centre.
    let axes = if random.bits().is_multiple_of(3) {
        nalgebra::Matrix3::identity()
    } else {
        random.rotation_matrix()
    };
    let height = normal * (radius * random.between(-1.0, 1.1));
    let aside = Vec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    let center = match random.bits() % 8 {
        0 => a + height,
        1 => (a + b) * 0.5 + height,
        2 => (a + b + c) / 3.0 + height,
        3 => a,
        4 => (a + b) * 0.5,
        5 => a + aside * radius,
        6 => c - Vec3::z() * (radius * random.between(0.0, 2.0)),
        _ => (a + b + c) / 3.0 + height + aside * radius,
    };
    Ellipsoid { center, axes, semi_axes: shape * radius }
}

impl Pairs for EllipsoidTrianglePairs {
    type Element = Ellipsoid;
    type Told = LaneBits;
    fn begin_in<S: Simd>(&mut self, simd: S, element: &Ellipsoid, thickness: f64) {
        Self::begin_in(self, simd, element, thickness);
    }
    fn push(&mut self, triangle: u32) -> usize {
        Self::push(self, triangle)
    }
    fn add(&mut self, element: &Ellipsoid, triangle: u32, thickness: f64) -> usize {
        Self::add(self, element, triangle, thickness)
    }
    fn take(&mut self, set: &TriangleSet) -> LaneBits {
        Self::take(self, set)
    }
}

#[test]
fn triangles_in_a_row_are_told_as_one_by_one() {
    let mut random = Random(76);
    let mut near = 0;
    for (_, set) in all_surfaces(&mut random) {
        let told = tell_in_rows::<EllipsoidTrianglePairs>(&set, &mut random, |random| {
            let there = (random.bits() % set.triangles.len() as u64) as u32;
            let ellipsoid = ellipsoid(&set, there, random);
            let thickness = ellipsoid.smallest_semi_axis() * random.between(0.0, 2.0);
            (ellipsoid, there, thickness)
        });
        near += told.iter().map(|told| told.count_ones()).sum::<u32>();
    }
    assert!(near > 500, "{near}");
}

fn contacts(e: &Ellipsoid, set: &TriangleSet, triangle: u32, thickness: f64) -> Vec<TriangleContact> {
    let mut found = Vec::new();
    ellipsoid_triangle(e, set, triangle, thickness, &mut |contact| found.push(contact));
    found
}

/// No rejected pair has a contact, at any instruction-set level and of any size, marked or not; most pairs
/// without contacts are rejected.
#[test]
fn pairs_that_are_left_out_find_nothing() {
    let mut random = Random(73);
    let (mut left_out, mut idle, mut touching, mut told) = (0, 0, 0, 0);
    for round in 0..300 {
        for (name, mut set) in all_surfaces(&mut random) {
            if round % 3 != 0 {
                mark_pushing(&mut set);
            }
            // Scaled by a power of two, which is exact: a kilometre, a millimetre.
            let scale = f64::exp2(f64::from(round % 3 - 1) * 10.0);
            let mut scaled = set.clone();
            scaled.vertices.iter_mut().for_each(|vertex| *vertex *= scale);
            for _ in 0..30 {
                let used = 1 + random.bits() as usize % LANES;
                let drawn: Vec<(Ellipsoid, u32, f64)> = (0..used)
                    .map(|_| {
                        let any = |random: &mut Random| (random.bits() % set.triangles.len() as u64) as u32;
                        let (there, elsewhere) = (any(&mut random), any(&mut random));
                        let e = scaled_ellipsoid(&ellipsoid(&set, there, &mut random), scale);
                        let triangle = match random.bits() % 3 {
                            0 => elsewhere,
                            1 => there,
                            _ => {
                                set.triangles[there as usize].neighbors[0].min(set.triangles.len() as u32 - 1)
                            }
                        };
                        let thickness = e.semi_axes.min() * random.between(0.0, 3.0);
                        (e, triangle, thickness)
                    })
                    .collect();
                let expected: Vec<_> =
                    drawn.iter().map(|(e, t, thickness)| contacts(e, &scaled, *t, *thickness)).collect();
                let _turn = levels::Turn::wait();
                for level in Level::available() {
                    set_level(level);
                    let mut pairs = EllipsoidTrianglePairs::default();
                    for (place, (e, t, thickness)) in drawn.iter().enumerate() {
                        assert_eq!(pairs.add(e, *t, *thickness), place);
                    }
                    let near = pairs.take(&scaled);
                    assert_eq!(pairs.count(), 0);
                    assert!(used == LANES || near >> used == 0);
                    for (lane, found) in expected.iter().enumerate() {
                        let is_near = near >> lane & 1 == 1;
                        assert!(is_near || found.is_empty(), "{name} {level:?} {:?} {found:?}", drawn[lane]);
                        told += 1;
                        left_out += u32::from(!is_near);
                        idle += u32::from(found.is_empty());
                        touching += u32::from(!found.is_empty());
                    }
                }
            }
        }
    }
    println!("{left_out} left out of {idle} without contact; {touching} of {told} with");
    assert!(touching > 10_000 && f64::from(left_out) > 0.6 * f64::from(idle));
}

/// A pair with NaN is not rejected.
#[test]
fn what_is_no_number_is_not_left_out() {
    let set = regular_plate(2);
    let mut pairs = EllipsoidTrianglePairs::default();
    let ball = Ellipsoid {
        center: Vec3::zeros(),
        axes: nalgebra::Matrix3::identity(),
        semi_axes: Vec3::repeat(0.1),
    };
    pairs.add(&Ellipsoid { center: Vec3::repeat(f64::NAN), ..ball }, 0, 0.1);
    pairs.add(&Ellipsoid { axes: ball.axes * f64::NAN, ..ball }, 0, 0.1);
    assert_eq!(pairs.count(), 2);
    assert_eq!(pairs.take(&set), 3);
    pairs.add(&ball, 0, 0.1);
    pairs.clear();
    assert_eq!((pairs.count(), pairs.take(&set)), (0, 0));
}
