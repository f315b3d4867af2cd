//! Load sharing: known answers, independent slow methods, recorded bits, and scratch memory that is too
//! small.

mod exact;
mod two_ends;

use super::shared_contact::{Coupling, all_couple};
use super::*;
use pong_geometry::Vec3;
use pong_testkit::Random;

/// Computes λ with enough scratch memory.
fn share(contacts: &mut [SharedContact]) {
    let mut scratch = Arena::with_capacity(scratch_bytes(contacts.len()));
    share_within(contacts, &mut scratch).unwrap();
}

fn solved(contacts: &[(Vec3, f64)]) -> (Vec<f64>, Vec3) {
    let mut shared_contacts: Vec<SharedContact> =
        contacts.iter().map(|(n, d)| SharedContact::new(n.normalize(), *d)).collect();
    share(&mut shared_contacts);
    let t = shared_contacts.iter().map(|s| s.normal_b * s.lambda).sum();
    (shared_contacts.iter().map(|s| s.lambda).collect(), t)
}

#[test]
fn both_walls_of_a_square_corner_push_fully() {
    let (lambda, _) = solved(&[(Vec3::x(), 2e-3), (Vec3::y(), 1e-3)]);
    assert_eq!(lambda, [2e-3, 1e-3]);
}

#[test]
fn many_pieces_of_one_plate_push_like_one_plane() {
    let n = Vec3::new(0.2, -0.3, 0.9);
    let (lambda, t) = solved(&[(n, 1e-3); 6]);
    assert!((t - n.normalize() * 1e-3).norm() < 1e-17);
    assert!(lambda.iter().all(|l| (l - 1e-3 / 6.0).abs() < 1e-17), "{lambda:?}");
}

#[test]
fn rounding_in_the_normals_of_a_plate_does_not_show() {
    let wobble = |a: f64, b: f64| Vec3::new(3e-8 * a, 3e-8 * b, 1.0);
    let plate = [
        (wobble(1.0, 0.0), 1e-3),
        (wobble(0.0, 1.0), 1e-3 * (1.0 + 1e-9)),
        (wobble(-1.0, 0.5), 1e-3),
        (wobble(0.3, -1.0), 1e-3 * (1.0 - 1e-9)),
    ];
    let (_, t) = solved(&plate);
    assert!((t - Vec3::z() * 1e-3).norm() < 1e-3 * 5e-8);
}

/// Known answer: the shortest vector that clears three walls leads to the corner point, where it touches all
/// three.
#[test]
fn three_walls_meet_in_their_corner() {
    let walls =
        [(Vec3::new(1.0, 0.1, 0.0), 1.0), (Vec3::new(0.0, 1.0, 0.2), 0.8), (Vec3::new(0.1, 0.0, 1.0), 0.9)];
    let (lambda, t) = solved(&walls);
    for (n, d) in walls {
        assert!((n.normalize().dot(&t) - d).abs() < 1e-14);
    }
    assert!(lambda.iter().all(|l| *l > 0.0));
}

/// Independent method: projected gradient on the dual, run to convergence.
#[test]
fn random_sets_agree_with_slow_descent() {
    let mut random = Random(7);
    for _ in 0..300 {
        let count = 3 + (random.unit() * 6.0) as usize;
        let contacts: Vec<(Vec3, f64)> = (0..count)
            .map(|_| {
                let n = Vec3::from_fn(|_, _| random.unit()).normalize();
                (n, 0.5 + 0.5 * random.unit())
            })
            .collect();
        let mut lambda = vec![0.0_f64; count];
        for _ in 0..60_000 {
            for i in 0..count {
                let covered: f64 = (0..count)
                    .filter(|&j| j != i)
                    .map(|j| contacts[i].0.dot(&contacts[j].0) * lambda[j])
                    .sum();
                lambda[i] = (contacts[i].1 - covered).max(0.0);
            }
        }
        let slow: Vec3 = contacts.iter().zip(&lambda).map(|((n, _), l)| n * *l).sum();
        let (_, t) = solved(&contacts);
        let worst = contacts.iter().map(|(n, d)| d - n.dot(&t)).fold(f64::MIN, f64::max);
        assert!(worst < 1e-13, "violated by {worst}");
        assert!(t.norm() <= slow.norm() * (1.0 + 1e-9), "{} > {}", t.norm(), slow.norm());
        assert!((t - slow).norm() < 1e-4);
    }
}

/// Nearly parallel normals at a given fold angle in a random orientation, with depths that differ little
/// enough to share; optionally with walls across them.
fn folded_set(random: &mut Random, count: usize, fold: f64, walls: usize) -> Vec<SharedContact> {
    let direction = |random: &mut Random| Vec3::from_fn(|_, _| random.unit() - 0.5).normalize();
    let base = direction(random);
    let depth = libm::exp10(-4.0 * random.unit());
    let mut set = Vec::new();
    for k in 0..count {
        let across = |v: Vec3| v - base * base.dot(&v);
        let (normal, depth) = if k < walls {
            let part = 0.05 + random.unit();
            (across(direction(random)).normalize() + base * (0.2 * random.unit()), depth * part)
        } else {
            let lean = across(direction(random)) * fold;
            (base + lean, depth * (1.0 + fold * fold * (random.unit() - 0.5)))
        };
        set.push(SharedContact::new(normal.normalize().map(exact::rounded), exact::rounded(depth)));
    }
    set
}

/// Independent method: exact arithmetic over all sets of at most three contacts.
///
/// Depths and normals have 16 digits. Between normals at an angle θ they determine the force direction to
/// 1e-16/θ (worse for three nearly coplanar normals), and never worse than θ. They always determine the
/// magnitude of the force and the sum of the weights.
#[test]
fn folds_of_any_angle_agree_with_exact_arithmetic() {
    let mut random = Random(31);
    for exponent in 0..=14 {
        let fold = libm::exp10(-10.0 + 0.5 * f64::from(exponent));
        let (mut length, mut direction, mut weights, mut shared) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
        for round in 0..300 {
            let mut set = folded_set(&mut random, 2 + round % 5, fold, 0);
            let (expected, decide, sum) = exact::shortest(&set);
            share(&mut set);
            let t: Vec3 = set.iter().map(|s| s.normal_b * s.lambda).sum();
            let size = expected.norm();
            length = length.max((t.norm() / size - 1.0).abs());
            direction = direction.max((t - expected).norm() / size);
            let got: f64 = set.iter().map(|s| s.lambda / s.depth).sum();
            weights = weights.max((got - sum).abs());
            shared += usize::from(decide > 1);
        }
        println!(
            "fold {fold:.0e}: {shared} of 300 shared; length off by {length:.0e}, direction {direction:.0e}, weights {weights:.0e}"
        );
        // Folds below 1e-7 change depths by less than their rounding.
        assert!(shared > 100 || fold < 1e-7, "{shared}");
        assert!(length < 1e-14 && weights < 1e-12);
        assert!(direction < (3e-14 / fold).clamp(1e-14, 2.0 * fold), "{direction:e}");
    }
}

/// Independent method: exact arithmetic, with one or two walls across the folded plate.
#[test]
fn folds_beside_walls_agree_with_exact_arithmetic() {
    let mut random = Random(77);
    for exponent in 0..=14 {
        let fold = libm::exp10(-10.0 + 0.5 * f64::from(exponent));
        let (mut worst, mut coupled) = (0.0_f64, 0);
        for round in 0..300 {
            let walls = 1 + round % 2;
            let mut set = folded_set(&mut random, walls + 2 + round % 3, fold, walls);
            if !all_couple(&set) {
                continue;
            }
            let (expected, ..) = exact::shortest(&set);
            share(&mut set);
            let t: Vec3 = set.iter().map(|s| s.normal_b * s.lambda).sum();
            worst = worst.max((t - expected).norm() / expected.norm());
            coupled += 1;
        }
        println!("fold {fold:.0e} beside walls: off by {worst:.0e} in {coupled}");
        assert!(coupled > 100 && worst < (3e-14 / fold).clamp(1e-13, 2.0 * fold), "{worst:e}");
    }
}

/// Cutting plates into pieces does not change the total load of a plate. The normals of two plates are more
/// than 90° apart; the normal of a third is within 90° of both.
#[test]
fn plates_in_pieces_share_alike_where_some_normals_do_not_couple() {
    let mut random = Random(13);
    for round in 0..2000 {
        let fold = if round % 4 == 0 { 0.0 } else { libm::exp10(-16.0 + 13.0 * random.unit()) };
        let turn = pong_geometry::Quat::from_scaled_axis(Vec3::from_fn(|_, _| 6.0 * (random.unit() - 0.5)));
        let plates = [(Vec3::new(1.0, 0.0, 0.5), 1e-3), (Vec3::new(-1.0, 0.0, 0.5), 7e-4), (Vec3::z(), 5e-4)];
        let whole: Vec<SharedContact> =
            plates.iter().map(|(n, d)| SharedContact::new(turn * n.normalize(), *d)).collect();
        let mut in_pieces = Vec::new();
        for shared_contact in &whole {
            for _ in 0..1 + (random.unit() * 3.0) as usize {
                let lean = Vec3::from_fn(|_, _| random.unit() - 0.5) * fold;
                let depth =
                    shared_contact.depth * (1.0 + 0.1 * fold * fold * random.unit() + 2e-16 * random.unit());
                in_pieces.push(SharedContact::new((shared_contact.normal_b + lean).normalize(), depth));
            }
        }
        let mut alone = whole.clone();
        share(&mut alone);
        share(&mut in_pieces);
        for shared_contact in &alone {
            let near = in_pieces.iter().filter(|piece| piece.normal_b.dot(&shared_contact.normal_b) > 0.99);
            let together: f64 = near.map(|piece| piece.lambda).sum();
            let error = (together - shared_contact.lambda).abs() / 1e-3;
            assert!(error < 1e-14 + 2.0 * fold, "{round} fold {fold:e}: {error:e} {in_pieces:?}");
        }
    }
}

/// Two equally deep pieces of a plate, tilted by so little that the squared angle is far below the rounding
/// of the normals. By symmetry each has half of the weight, also beside contacts that do not couple.
#[test]
fn pieces_that_lean_a_little_carry_half_each_beside_what_does_not_couple() {
    let turn = pong_geometry::Quat::from_scaled_axis(Vec3::new(0.3, -1.1, 0.7));
    for lean in [3e-5, 1e-6, 3e-8] {
        let place = |n: Vec3, depth: f64| (turn * n, depth);
        let (lambda, _) = solved(&[
            place(Vec3::new(lean, 0.0, 1.0), 1e-3),
            place(Vec3::new(-lean, 0.0, 1.0), 1e-3),
            place(Vec3::new(0.0, 1.0, -0.5), 4e-4),
        ]);
        let [one, other, apart] = [0, 1, 2].map(|at| lambda[at] / 1e-3);
        assert!((one - 0.5).abs() < 1e-6 && (other - 0.5).abs() < 1e-6, "lean {lean:e}: {one} and {other}");
        assert!((apart - 0.4).abs() < 1e-12, "lean {lean:e}: {apart}");
    }
}

/// Normals more than 90° apart do not couple: λ satisfies the fixed-point definition itself.
#[test]
fn opposed_normals_satisfy_the_definition() {
    let mut random = Random(21);
    for _ in 0..200 {
        let mut shared_contacts: Vec<SharedContact> = (0..5)
            .map(|_| {
                let n = Vec3::from_fn(|_, _| random.unit() - 0.5).normalize();
                SharedContact::new(n, 0.5 + 0.5 * random.unit())
            })
            .collect();
        share(&mut shared_contacts);
        for i in 0..shared_contacts.len() {
            let others: f64 = (0..shared_contacts.len())
                .filter(|&j| j != i)
                .map(|j| {
                    Coupling::new(&shared_contacts[i], &shared_contacts[j]).cosine * shared_contacts[j].lambda
                })
                .sum();
            let expected = (shared_contacts[i].depth - others).max(0.0);
            assert!((shared_contacts[i].lambda - expected).abs() < 1e-12, "{shared_contacts:?}");
        }
    }
}

/// Difficult sets: normals in all directions, some opposed or equal, and some equal depths.
fn awkward_set(random: &mut Random, count: usize) -> Vec<SharedContact> {
    let mut set: Vec<SharedContact> = Vec::new();
    for i in 0..count {
        let fresh = Vec3::from_fn(|_, _| random.unit() - 0.5).normalize();
        let earlier = set.get(i / 2).map_or(fresh, |earlier| earlier.normal_b);
        let normal = match (random.unit() * 8.0) as u32 {
            0 => earlier,
            1 => -earlier,
            _ => fresh,
        };
        let depth = if random.unit() < 0.2 { 0.75 } else { 0.5 + 0.5 * random.unit() };
        set.push(SharedContact::new(normal, depth));
    }
    set
}

/// Sets with many equal depths and normals: few directions, few different depths.
fn set_full_of_ties(random: &mut Random, count: usize) -> Vec<SharedContact> {
    let directions = [Vec3::x(), Vec3::y(), -Vec3::x(), Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.6, 0.8, 0.0)];
    let shared_contact = |_| {
        let normal = directions[(random.unit() * 5.0) as usize];
        SharedContact::new(normal, [0.5, 0.75, 1.0][(random.unit() * 3.0) as usize])
    };
    (0..count).map(shared_contact).collect()
}

fn lambda_bits(shared_contacts: &[SharedContact]) -> impl Iterator<Item = u64> {
    shared_contacts.iter().map(|shared_contact| shared_contact.lambda.to_bits())
}

/// Bits recorded from the double-double implementation.
#[test]
fn the_pivots_are_the_recorded_ones_to_the_last_bit() {
    let recorded = |set: fn(&mut Random, usize) -> Vec<SharedContact>| {
        let mut scratch = Arena::with_capacity(scratch_bytes(40));
        let mut random = Random(99);
        let mut hash = 0_u64;
        for round in 0..3000 {
            let mut set = set(&mut random, 3 + round % 38);
            share_within(&mut set, &mut scratch).unwrap();
            for bits in lambda_bits(&set) {
                hash = (hash ^ bits).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(17);
            }
        }
        hash
    };
    assert_eq!(recorded(awkward_set), 0x0187_aaa8_76cf_08da);
    assert_eq!(recorded(set_full_of_ties), 0x67fa_c6b7_0ac9_5003);
}

/// Indices of the `count` deepest contacts, ties by index.
fn deepest_first(set: &[SharedContact], count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..set.len()).collect();
    order.sort_by(|&i, &j| set[j].depth.total_cmp(&set[i].depth));
    order.truncate(count);
    order.sort();
    order
}

#[test]
fn with_too_little_memory_the_deepest_are_shared_exactly_and_the_rest_get_nothing() {
    let mut random = Random(5);
    let mut left_out = 0;
    for round in 0..500 {
        let kind = [awkward_set, set_full_of_ties][round % 2];
        let set = kind(&mut random, 4 + round % 30);
        let mut scratch = Arena::with_capacity((random.unit() * scratch_bytes(20) as f64) as usize);
        let mut shared = set.clone();
        shared.iter_mut().for_each(|shared_contact| shared_contact.lambda = f64::NAN);
        if share_within(&mut shared, &mut scratch).is_ok() {
            continue;
        }
        // For some count, sharing only the deepest contacts must give every λ.
        let explained = (1..set.len()).find(|&count| {
            let chosen = deepest_first(&set, count);
            let mut alone: Vec<SharedContact> = chosen.iter().map(|&i| set[i]).collect();
            share(&mut alone);
            let mut expected = vec![0.0; set.len()];
            chosen.iter().zip(&alone).for_each(|(&i, shared_contact)| expected[i] = shared_contact.lambda);
            shared.iter().zip(&expected).all(|(shared_contact, lambda)| shared_contact.lambda == *lambda)
        });
        assert!(explained.is_some(), "{shared:?}");
        left_out += 1;
    }
    assert!(left_out > 100);
}

#[test]
fn the_fallback_fills_the_memory_that_there_is() {
    let mut random = Random(11);
    let set = awkward_set(&mut random, 30);
    let sharing_at = |bytes: usize| {
        let mut shared = set.clone();
        let mut scratch = Arena::with_capacity(bytes);
        assert!(share_within(&mut shared, &mut scratch).is_err());
        (
            shared.iter().filter(|shared_contact| shared_contact.lambda > 0.0).count(),
            scratch.used() as f64 / bytes as f64,
        )
    };
    let (few, _) = sharing_at(1000);
    let (many, filled) = sharing_at(scratch_bytes(30) - 16);
    assert!(few < many, "{few} {many}");
    assert!(filled > 0.9, "{filled}");
    // No memory at all: only the deepest contact.
    assert_eq!(sharing_at(0).0, 1);
}

#[test]
fn the_peak_of_the_scratch_memory_is_the_size_to_give() {
    let mut random = Random(3);
    let mut set = awkward_set(&mut random, 25);
    let mut exact = set.clone();
    share(&mut exact);
    for too_small in [0, 64, scratch_bytes(25) - 16] {
        let mut scratch = Arena::with_capacity(too_small);
        let full = share_within(&mut set, &mut scratch).unwrap_err();
        assert!(full.asked > full.free);
        assert_eq!(scratch.peak(), scratch_bytes(25));
        // A call that ran out of memory must not affect the next one.
        let mut two = [SharedContact::new(Vec3::x(), 1.0), SharedContact::new(-Vec3::x(), 2.0)];
        assert!(share_within(&mut two, &mut scratch).is_ok());
        let mut enough = Arena::with_capacity(scratch.peak());
        assert!(share_within(&mut set, &mut enough).is_ok());
        assert!(lambda_bits(&set).eq(lambda_bits(&exact)));
    }
}
