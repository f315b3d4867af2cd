//! Two capsules, and a segment and a capsule: the energy against its definition by planes, the wrench against
//! the energy, closed forms, and invariances.

use crate::common::bars::{
    bar as capsule, component, gained_along, least_from, moved, moved_by, pushed, slope, stored,
};
use crate::common::{fibonacci_sphere, random_motion};
use pong_geometry::interference::two_capsules::{OverlapContacts, capsule_capsule, segment_capsule};
use pong_geometry::primitive::{Capsule, LineSegment};
use pong_geometry::{Quat, Transform, Vec3, Wrench};
use pong_testkit::{Random, assert_near, long_samples};

/// Contacts of A with B; A is a segment if it has no radius.
fn contacts(a: &Capsule, b: &Capsule) -> OverlapContacts {
    if a.radius > 0.0 { capsule_capsule(a, b) } else { segment_capsule(&LineSegment { ends: a.ends }, b) }
}

/// Energy with a stiffness of 1 N/m.
fn energy(a: &Capsule, b: &Capsule) -> f64 {
    stored(&contacts(a, b))
}

/// Force on A and its moment about the origin, with a stiffness of 1 N/m.
fn wrench(a: &Capsule, b: &Capsule) -> Wrench {
    pushed(&contacts(a, b))
}

fn force(a: &Capsule, b: &Capsule) -> f64 {
    wrench(a, b).force.norm()
}

/// Two random capsules that are near each other, any lengths and radii from `thin` to 0.5 m; one in four times A is
/// a segment, and one in four times both are in a common direction, across each other, or in one plane.
fn random_pair(random: &mut Random, thin: f64) -> (Capsule, Capsule) {
    let radius = |random: &mut Random| random.log_between(thin, 0.5);
    let (middle, along) = (random.vector(0.3), random.direction());
    let other = match random.below(8) {
        0 => along,
        1 => random.across(&along),
        _ => random.direction(),
    };
    let halves = [(); 2].map(|()| random.log_between(0.02, 1.0));
    let b = Capsule { ends: [-along * halves[0], along * halves[0]], radius: radius(random) };
    let radius_a = if random.below(4) == 0 { 0.0 } else { radius(random) };
    let place = along * (halves[0] * random.between(-1.2, 1.2))
        + other * (halves[1] * random.between(-1.2, 1.2))
        + middle * (b.radius + radius_a) * 2.0;
    let a = Capsule { ends: [place - other * halves[1], place + other * halves[1]], radius: radius_a };
    (a, b)
}

/// Energy of the two on a plane with the normal `n` where it is least: U = ½·Σ (what each of the four balls is beyond
/// the plane)².
fn on_plane(a: &Capsule, b: &Capsule, n: &Vec3) -> f64 {
    let above = a.ends.map(|end| n.dot(&end) - a.radius);
    let below = b.ends.map(|end| n.dot(&end) + b.radius);
    let beyond = |height: f64| {
        let of_a = above.map(|lowest| (height - lowest).max(0.0));
        let of_b = below.map(|highest| (highest - height).max(0.0));
        (of_a, of_b)
    };
    let (mut low, mut high) = (-10.0, 10.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        let (of_a, of_b) = beyond(middle);
        if of_a.iter().sum::<f64>() < of_b.iter().sum() { low = middle } else { high = middle }
    }
    let (of_a, of_b) = beyond(low);
    0.5 * of_a.iter().chain(&of_b).map(|x| x * x).sum::<f64>()
}

/// Least energy on a plane between the two, by descent from the best of many directions.
fn least_on_planes(a: &Capsule, b: &Capsule) -> f64 {
    least_from(fibonacci_sphere(300).into_iter(), 6, (8, 1e-9), |n| on_plane(a, b, n))
}

/// The energy is the least that the two store on any plane between them, each with half of twice the stiffness at
/// each end.
#[test]
fn the_energy_is_the_least_on_a_plane_between_the_two() {
    let mut random = Random::new(21, 0, 0);
    let mut touching = 0;
    for case in 0..long_samples(120, 1000) {
        let (a, b) = random_pair(&mut random, 0.03);
        let (stored, searched) = (energy(&a, &b), least_on_planes(&a, &b));
        // The search may stop above the minimum.
        assert!(stored <= searched + 1e-12, "case {case}: {stored} {searched} {a:?} {b:?}");
        assert!(searched - stored <= 1e-6 * searched + 1e-12, "case {case}: {stored} {searched} {a:?} {b:?}");
        touching += usize::from(stored > 0.0);
    }
    assert!(touching > long_samples(40, 300), "{touching}");
}

#[test]
fn the_wrench_is_minus_the_derivative_of_the_energy() {
    const STEP: f64 = 1e-5;
    let mut random = Random::new(22, 0, 0);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for case in 0..long_samples(4000, 40_000) {
        let (a, b) = random_pair(&mut random, 0.03);
        let [found, near] = [wrench(&a, &b), wrench(&moved(&a, &Vec3::zeros(), &Vec3::repeat(1e-9)), &b)];
        let force = found.force.norm();
        // At a first touch, and where the axes cross, the second derivatives are large.
        let is_sharp = (near.force - found.force).norm() > 1e-7 * force;
        if force < 1e-3 || is_sharp {
            continue;
        }
        compared += 1;
        for k in 0..6 {
            let slope = slope(|by| energy(&moved_by(&a, k, by), &b), STEP);
            let part = component(&found, k);
            let off = (part + slope).abs() / force;
            assert!(off < 1e-5, "case {case}, {k}: {part} {slope} {a:?} {b:?}");
            worst = worst.max(off);
        }
    }
    println!("W + ∂U/∂x over the force: {worst:.1e} at most, {compared} poses");
    assert!(compared > long_samples(1000, 10_000), "{compared}");
}

/// Along random paths, deep ones and through square axes included, the work of the wrench is the energy that is
/// stored less: none appears or vanishes.
#[test]
fn paths_gain_and_lose_nothing() {
    let mut random = Random::new(23, 0, 0);
    let (mut touching, mut worst) = (0, 0.0_f64);
    for case in 0..long_samples(600, 100_000) {
        let (a, b) = random_pair(&mut random, 0.1);
        let (shift, turn) = (random.vector(0.3), random.vector(0.6));
        let Some(gained) = gained_along(&a, &shift, &turn, |a| contacts(a, &b)) else { continue };
        assert!(gained < 1e-9, "case {case}: {gained:e} of the largest stored {a:?} {b:?}");
        worst = worst.max(gained);
        touching += 1;
    }
    println!("{touching} paths, largest gain or loss {worst:.1e} of the largest stored");
    assert!(touching > long_samples(200, 30_000), "{touching}");
}

/// Flat, overhanging, on a tip, crossing in the middle and at an end.
#[test]
fn known_cases_carry_what_the_rule_says() {
    let (b, depth) = (capsule([[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]], 0.3), 1e-3);
    let height = 0.4 - depth;
    let lying = |from: f64, to: f64| capsule([[from, 0.0, height], [to, 0.0, height]], 0.1);
    // Overhanging by less than half of each: through the middle, kδ.
    for (from, to) in [(-0.5, 0.5), (-0.9, 0.9), (-0.2, 0.2)] {
        assert_near(force(&lying(from, to), &b), depth, 1e-12);
    }
    // Equal lengths, shifted by d: the middle of the overlap is d/2 from both middles.
    for shift in [0.1, 0.4, 0.8] {
        let found = wrench(&lying(shift - 0.5, shift + 0.5), &b);
        // Where it is best the two places are opposite each other but for about δ.
        assert_near(found.force.z, depth / (1.0 + shift * shift), depth);
        assert_near(-found.moment.y, found.force.z * 0.5 * shift, 4.0 * depth);
    }
    // A tip on the middle: k/(1 + ½); on a tip: half.
    let standing = |x: f64| capsule([[x, 0.0, height], [x, 0.0, height + 1.0]], 0.1);
    assert_near(force(&standing(0.0), &b), depth / 1.5, 1e-12);
    assert_near(force(&standing(0.5), &b), 0.5 * depth, depth);
    // Crossing in the middle of both: k; at a fifth of one, k/(½ + 0.68).
    let across = |x: f64, y: f64| capsule([[x, y - 0.5, height], [x, y + 0.5, height]], 0.1);
    assert_near(force(&across(0.0, 0.0), &b), depth, 1e-12);
    assert!((force(&across(0.0, 0.3), &b) / depth - 1.0 / 1.18).abs() < 2.0 * depth);
    // A segment without a radius answers as a capsule of the same reach.
    let bar = capsule([[-0.3, 0.0, 0.3 - depth], [0.6, 0.1, 0.3 - depth]], 0.0);
    let rod = capsule([[-0.3, 0.0, 0.3 - depth], [0.6, 0.1, 0.3 - depth]], 0.1);
    let thinner = Capsule { radius: 0.2, ..b };
    assert_near(force(&bar, &b), force(&rod, &thinner), 1e-12);
}

/// Lying on one of the length L, a bar of the length l resists tilting with ½k·l²L²/(l² + L²), however it overhangs.
#[test]
fn a_bar_that_lies_resists_tilting() {
    let depth = 1e-3;
    for (length, shift) in [(1.0, 0.0), (1.0, 0.7), (20.0, 0.0), (20.0, 3.0), (0.2, 0.1)] {
        let b = capsule([[-0.5 * length, 0.0, 0.0], [0.5 * length, 0.0, 0.0]], 0.3);
        let a = capsule([[shift - 0.5, 0.0, 0.4 - depth], [shift + 0.5, 0.0, 0.4 - depth]], 0.1);
        let tilted = |angle: f64| wrench(&moved(&a, &Vec3::zeros(), &(Vec3::y() * angle)), &b);
        // About the place of the load, so that the depth there does not change.
        let (here, step) = (tilted(0.0), 1e-7);
        let at = -here.moment.y / here.force.z;
        let about = |w: Wrench| w.moment.y + at * w.force.z;
        let lift = |angle: f64| moved(&a, &(Vec3::z() * (at * angle)), &(Vec3::y() * angle));
        let [up, down] = [step, -step].map(|angle| about(wrench(&lift(angle), &b)));
        let square = length * length;
        let expected = 0.5 * square / (1.0 + square);
        let found = (down - up) / (2.0 * step);
        assert!((found / expected - 1.0).abs() < 0.02, "{length} {shift}: {found} instead of {expected}");
    }
}

/// While axes pass 90°, or a bar lies flat, beside their ends, force and moment do not step.
#[test]
fn the_wrench_is_continuous_through_square_and_level_axes() {
    let b = capsule([[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]], 0.3);
    for (place, along, turn) in [
        (Vec3::new(0.52, 0.02, 0.37), Vec3::y(), Vec3::z()),
        (Vec3::new(0.45, 0.02, 0.37), Vec3::y(), Vec3::z()),
        (Vec3::new(0.4, 0.0, 0.399), Vec3::x(), Vec3::y()),
        (Vec3::new(0.0, 0.0, 0.399), Vec3::x(), Vec3::y()),
        (Vec3::new(0.45, 0.0, 0.38), Vec3::z(), Vec3::y()),
    ] {
        let at = |angle: f64| {
            let along = Quat::from_scaled_axis(turn * angle) * along * 0.4;
            let a = Capsule { ends: [place - along * 0.1, place + along], radius: 0.1 };
            let Wrench { force, moment } = wrench(&a, &b);
            (force, moment)
        };
        let (mut steps, mut last) = ([0.0_f64; 2], at(-1e-3));
        for (index, fine) in [2e-6, 2e-7].into_iter().enumerate() {
            for step in -500..=500 {
                let now = at(f64::from(step) * fine);
                if step > -500 {
                    steps[index] = steps[index].max((now.0 - last.0).norm() + (now.1 - last.1).norm());
                }
                last = now;
            }
        }
        // Ten times finer steps change ten times less.
        assert!(steps[0] > 0.0 && steps[1] < 0.2 * steps[0], "{place} {along}: {steps:?}");
    }
}

/// Moved together, turned about an own axis, with ends or bodies exchanged, scaled: nothing changes.
#[test]
fn no_pose_and_no_naming_changes_anything() {
    let mut random = Random::new(24, 0, 0);
    let swapped = |c: &Capsule| Capsule { ends: [c.ends[1], c.ends[0]], radius: c.radius };
    for case in 0..long_samples(2000, 20_000) {
        let (a, b) = random_pair(&mut random, 0.03);
        let found = wrench(&a, &b);
        let size = found.force.norm().max(1e-3);
        let close = |other: Wrench, what: &str| {
            let off = (other.force - found.force).norm() + (other.moment - found.moment).norm();
            assert!(off < 1e-9 * size, "case {case}, {what}: {off:e} of {size} {a:?} {b:?}");
        };
        let x = random_motion(&mut random, 2.0);
        let Wrench { force, moment } = wrench(&a.carried(&x), &b.carried(&x));
        let back = x.rotation.transpose();
        close(Wrench { force: back * force, moment: back * (moment - x.translation.cross(&force)) }, "moved");
        close(wrench(&swapped(&a), &b), "ends of A exchanged");
        close(wrench(&a, &swapped(&b)), "ends of B exchanged");
        let own = Quat::from_scaled_axis((b.ends[1] - b.ends[0]).normalize() * random.between(0.0, 6.0));
        let turn = Transform { rotation: own.to_rotation_matrix().into_inner(), translation: Vec3::zeros() };
        close(wrench(&a, &b.carried(&turn)), "B turned about its axis");
        if a.radius > 0.0 {
            let Wrench { force, moment } = wrench(&b, &a);
            // B's place is δ·n farther than A's; the moments of both are about the same line.
            close(Wrench { force: -force, moment: -moment }, "A and B exchanged");
        }
        for factor in [1e-6, 1e6] {
            let scaled =
                |c: &Capsule| Capsule { ends: c.ends.map(|end| end * factor), radius: c.radius * factor };
            let Wrench { force, moment } = wrench(&scaled(&a), &scaled(&b));
            close(Wrench { force: force / factor, moment: moment / (factor * factor) }, "scaled");
        }
    }
}

/// The two contacts are at the ends of the part of A that B reaches, and their loads have the place of the load.
#[test]
fn the_contacts_are_at_the_ends_of_the_overlap() {
    let mut random = Random::new(25, 0, 0);
    let mut inside = 0;
    for case in 0..2000 {
        let (a, b) = random_pair(&mut random, 0.03);
        let found: Vec<_> = contacts(&a, &b).into_iter().flatten().collect();
        for contact in &found {
            let place = contact.interference.deepest_b + contact.interference.normal_b * a.radius;
            let along = b.ends[1] - b.ends[0];
            let foot = (along.dot(&(place - b.ends[0])) / along.norm_squared()).clamp(0.0, 1.0);
            let gap = a.radius + b.radius - (place - b.ends[0] - along * foot).norm();
            let from_end = a.ends.map(|end| (place - end).norm()).into_iter().fold(f64::INFINITY, f64::min);
            let is_at_edge = gap.abs() < 1e-9;
            assert!(
                is_at_edge || (gap > 0.0 && from_end < 1e-12),
                "case {case}: {gap} {from_end} {a:?} {b:?}"
            );
            assert!((0.0..=2.0).contains(&contact.share), "case {case}: {contact:?}");
            inside += usize::from(is_at_edge);
        }
        if let [one, other] = &found[..] {
            assert_eq!(one.interference.depth, other.interference.depth);
            assert_eq!(one.interference.normal_b, other.interference.normal_b);
        }
    }
    assert!(inside > 500, "{inside}");
}

/// Where two axes cross exactly, or lie on one line, the normal turns with the two, and the energy is that beside the
/// crossing. Rounding picks one of two ways out, which are mirror images.
#[test]
fn crossing_axes_have_a_normal() {
    let mut random = Random::new(26, 0, 0);
    for case in 0..1000 {
        let at = [random.between(0.0, 1.0), random.between(0.0, 1.0)];
        let u = random.direction() * random.between(0.3, 2.0);
        let in_line = case % 10 == 0;
        let other = if in_line { u.normalize() } else { random.direction() };
        let v = other * random.between(0.3, 2.0);
        let across = if in_line { random.across(&u.normalize()) } else { u.cross(&v).normalize() };
        let a = Capsule { ends: [-u * at[0], u * (1.0 - at[0])], radius: 0.1 };
        let b = Capsule { ends: [-v * at[1], v * (1.0 - at[1])], radius: 0.2 };
        let beside = moved(&a, &(across * 1e-8), &Vec3::zeros());
        let [here, there] = [&a, &beside].map(|a| (wrench(a, &b).force, energy(a, &b)));
        assert!((here.1 - there.1).abs() < 1e-8, "case {case}: {} {}", here.1, there.1);
        if in_line {
            continue;
        }
        let off = |force: Vec3| {
            let mirrored = here.0 - across * (2.0 * across.dot(&here.0));
            (here.0 - force).norm().min((mirrored - force).norm())
        };
        assert!(off(there.0) < 1e-5, "case {case}: {} {}", here.0, there.0);
        let x = random_motion(&mut random, 2.0);
        let turned = x.rotation.tr_mul(&wrench(&a.carried(&x), &b.carried(&x)).force);
        assert!(off(turned) < 1e-9, "case {case}: {} {turned}", here.0);
    }
}
