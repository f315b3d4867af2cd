//! Segments and capsules on cylinders and cones: the energy against its definition by planes, the wrench against the
//! energy, and closed forms.

use crate::common::bars::{bar, component, gained_along, least_from, moved_by, pushed, slope, stored};
use crate::common::{fibonacci_sphere, random_motion};
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::two_capsules::OverlapContacts;
use pong_geometry::interference::two_ended_round::{capsule_frustum, segment_frustum};
use pong_geometry::primitive::{Capsule, Frustum, LineSegment};
use pong_geometry::{Quat, Vec3, Wrench};
use pong_testkit::{Random, assert_near, long_samples};
use std::f64::consts::TAU;

/// Contacts of A with B; A is a segment if it has no radius.
fn contacts(a: &Capsule, b: &Frustum) -> OverlapContacts {
    if a.radius > 0.0 { capsule_frustum(a, b) } else { segment_frustum(&LineSegment { ends: a.ends }, b) }
}

/// Energy with a stiffness of 1 N/m.
fn energy(a: &Capsule, b: &Frustum) -> f64 {
    stored(&contacts(a, b))
}

/// Force on A and its moment about the origin, with a stiffness of 1 N/m.
fn wrench(a: &Capsule, b: &Frustum) -> Wrench {
    pushed(&contacts(a, b))
}

fn force(a: &Capsule, b: &Frustum) -> f64 {
    wrench(a, b).force.norm()
}

/// Random cylinder or cone of any slenderness, about 1 m in size.
fn random_frustum(random: &mut Random) -> Frustum {
    let one = random.direction() * random.between(0.0, 1.0);
    let ends = [one, one + random.direction() * random.between(0.05, 2.0)];
    let radius = random.between(0.05, 1.0);
    let other = match random.below(6) {
        0 => 0.0,
        1 | 2 => random.between(0.05, 1.0),
        _ => radius,
    };
    Frustum::new(ends, [radius, other])
}

/// Random bar: anywhere, through a place near a rim, or along a direction of B. Half of the bars are segments.
fn random_bar(random: &mut Random, b: &Frustum) -> Capsule {
    let radius = if random.chance(0.5) { 0.0 } else { random.log_between(0.01, 0.5) };
    let side = b.axis.cross(&random.direction()).normalize();
    let middle = b.ends[0] + (b.ends[1] - b.ends[0]) * random.between(-0.3, 1.3);
    let anywhere = middle + random.direction() * random.between(0.0, 1.3);
    if random.chance(0.5) {
        let other = b.ends[0] + (b.ends[1] - b.ends[0]) * random.between(-0.3, 1.3);
        return Capsule { ends: [anywhere, other + random.direction() * random.between(0.0, 1.3)], radius };
    }
    let end = random.below(2);
    let at_rim = b.ends[end] + side * b.radii[end];
    let beside = random.log_between(1e-3, 0.3) * b.radii[end].min(b.length);
    let near = at_rim + random.vector(beside);
    let place = match random.below(4) {
        0 => anywhere,
        1 => middle,
        _ => near,
    };
    let along = match random.below(6) {
        0 => b.axis,
        1 => side,
        2 => b.axis.cross(&side),
        3 => (b.ends[1] - b.ends[0] + side * (b.radii[1] - b.radii[0])).normalize(),
        _ => random.direction(),
    };
    let [from, to] = [(); 2].map(|()| along * random.log_between(0.02, 2.0));
    Capsule { ends: [place - from, place + to], radius }
}

/// Energy of A on the plane behind B with the normal `n`: U = ¼·Σ (depth of an end)².
fn on_plane(a: &Capsule, b: &Frustum, n: &Vec3) -> f64 {
    let depth = |end: &Vec3| a.radius + Bounded::support(b, n) - n.dot(end);
    0.25 * a.ends.iter().map(|end| depth(end).max(0.0).powi(2)).sum::<f64>()
}

/// Least energy on a plane behind B: on those of its ends, on those of its wall by angles, and by descent from the best
/// `few` of many directions.
fn least_on_planes(a: &Capsule, b: &Frustum, few: usize) -> f64 {
    let u = b.axis.cross(&Vec3::ith(b.axis.iamin(), 1.0)).normalize();
    let v = b.axis.cross(&u);
    let at_wall = |angle: f64| on_plane(a, b, &b.wall_toward(&(u * angle.cos() + v * angle.sin())));
    let least = on_plane(a, b, &b.axis).min(on_plane(a, b, &-b.axis));
    let first = (0..360).map(|k| TAU * f64::from(k) / 360.0);
    let mut angle = first.min_by(|x, y| at_wall(*x).total_cmp(&at_wall(*y))).unwrap();
    let mut step = TAU / 360.0;
    while step > 1e-9 {
        let better = [angle - step, angle + step].into_iter().find(|x| at_wall(*x) < at_wall(angle));
        if let Some(better) = better { angle = better } else { step *= 0.5 }
    }
    let least = least.min(at_wall(angle));
    least.min(least_from(fibonacci_sphere(400).into_iter(), few, (12, 1e-8), |n| on_plane(a, b, n)))
}

/// The energy is the least that A stores on any plane behind B, with half a spring at each end: outside and sunk in,
/// however deep, at any feature, and where the axis lies along one.
#[test]
fn the_energy_is_the_least_on_a_plane_behind_the_solid() {
    let mut random = Random::new(31, 0, 0);
    let mut touching = [0; 2];
    for case in 0..long_samples(300, 6000) {
        let b = random_frustum(&mut random);
        let a = random_bar(&mut random, &b);
        let (stored, searched) = (energy(&a, &b), least_on_planes(&a, &b, 6));
        assert!(stored <= searched * (1.0 + 1e-9) + 1e-13, "case {case}: {stored} {searched} {a:?} {b:?}");
        // A descent with both bodies' kinks may stop above the minimum.
        assert!(stored >= searched * 0.9 - 1e-12, "case {case}: {stored} {searched} {a:?} {b:?}");
        touching[usize::from(a.radius > 0.0)] += usize::from(stored > 0.0);
    }
    assert!(touching.iter().all(|&count| count > long_samples(50, 1000)), "{touching:?}");
}

#[test]
fn the_wrench_is_minus_the_derivative_of_the_energy() {
    const STEP: f64 = 1e-5;
    let mut random = Random::new(32, 0, 0);
    let (mut compared, mut worst, mut steps) = (0, 0.0_f64, 0);
    for case in 0..long_samples(1500, 40_000) {
        let b = random_frustum(&mut random);
        let a = random_bar(&mut random, &b);
        let found = wrench(&a, &b);
        let force = found.force.norm();
        if force < 1e-3 {
            continue;
        }
        for k in 0..6 {
            let moved = |by: f64| moved_by(&a, k, by);
            let turns = |by: f64| (wrench(&moved(by), &b).force - found.force).norm();
            // At a first touch, near an edge, and where two ways out cost the same, the second derivatives are large.
            if turns(2.0 * STEP).max(turns(-2.0 * STEP)) > 2e-3 * force {
                steps += 1;
                continue;
            }
            let slope = slope(|by| energy(&moved(by), &b), STEP);
            let part = component(&found, k);
            let off = (part + slope).abs() / force;
            assert!(off < 1e-6, "case {case}, {k}: {part} {slope} {a:?} {b:?}");
            worst = worst.max(off);
            compared += 1;
        }
    }
    println!("W + ∂U/∂x over the force: {worst:.1e} at most, {compared} compared, {steps} left out");
    assert!(compared > long_samples(2200, 60_000) && steps * 10 < compared, "{compared} {steps}");
}

/// Along random paths, into the solid and out of it, past its rims and through square axes, the work of the wrench is
/// the energy that is stored less: none appears or vanishes.
#[test]
fn paths_gain_and_lose_nothing() {
    let mut random = Random::new(33, 0, 0);
    let (mut touching, mut worst) = (0, 0.0_f64);
    for case in 0..long_samples(60, 10_000) {
        let b = random_frustum(&mut random);
        let a = random_bar(&mut random, &b);
        let (shift, turn) = (random.vector(0.3), random.vector(0.6));
        let Some(gained) = gained_along(&a, &shift, &turn, |a| contacts(a, &b)) else { continue };
        assert!(
            gained < 1e-9,
            "case {case}: {gained:e} of the largest stored {a:?} {b:?} {shift:?} {turn:?}"
        );
        worst = worst.max(gained);
        touching += 1;
    }
    println!("{touching} paths, largest gain or loss {worst:.1e} of the largest stored");
    assert!(touching > long_samples(30, 3_000), "{touching}");
}

/// On a drum's end over both sides of it, level along its side, crossing, on a tip.
#[test]
fn known_cases_carry_what_the_rule_says() {
    let (depth, height) = (1e-3, 0.4);
    for radius in [0.0, 0.1] {
        let drum = Frustum::new([Vec3::zeros(), Vec3::z() * height], [0.3; 2]);
        let top = height + radius - depth;
        // Flat over both sides of the end, or over one: through the middle, as long as the end is below it.
        for (from, to) in [(-1.0, 1.0), (-0.7, 0.9), (-0.1, 0.2), (-0.2, 0.6)] {
            let found = wrench(&bar([[from, 0.1, top], [to, 0.1, top]], radius), &drum);
            assert_near(found.force.z, depth, 1e-12);
            assert!(
                (found.moment.y + 0.5 * (from + to) * depth).abs() < 1e-12,
                "{from} {to}: {}",
                found.moment.y
            );
        }
        // Beside the middle by x of the length: k/(1 + 4x²) at the rim.
        let found = wrench(&bar([[0.0, 0.0, top], [2.0, 0.0, top]], radius), &drum);
        assert!((found.force.norm() / depth * (1.0 + 0.49) - 1.0).abs() < 0.01, "{}", found.force.norm());

        let log = Frustum::new([Vec3::zeros(), Vec3::x()], [0.3; 2]);
        let level = 0.3 + radius - depth;
        let lying = |from: f64, to: f64| bar([[from, 0.0, level], [to, 0.0, level]], radius);
        for (from, to) in [(0.0, 1.0), (-0.5, 1.2), (0.2, 0.7), (-0.3, 0.5)] {
            let found = wrench(&lying(from, to), &log);
            assert_near(found.force.z, depth, 1e-12);
            assert!((found.moment.y + 0.5 * (from + to) * depth).abs() < 1e-12, "{from} {to}");
        }
        // Crossing in the middle: k. At an end: half of it. Between: k/(1 + 4x²).
        let across = |y: f64| bar([[0.5, y - 0.5, level], [0.5, y + 0.5, level]], radius);
        assert_near(force(&across(0.0), &log), depth, 1e-12);
        assert!((force(&across(0.25), &log) / depth * 1.25 - 1.0).abs() < 0.01);
        assert!((force(&across(0.49), &log) / depth - 0.51).abs() < 0.01);
        let standing = bar([[0.5, 0.0, level], [0.6, 0.2, level + 1.0]], radius);
        assert_near(force(&standing, &log), 0.5 * depth, 1e-12);
    }
    // Across a coin that is thinner than the bar is deep, the axis outside: as on a drum.
    let coin = Frustum::new([Vec3::z() * -0.01, Vec3::zeros()], [0.05; 2]);
    let over = bar([[-0.4, 0.0, 0.07], [0.4, 0.0, 0.07]], 0.1);
    assert_near(wrench(&over, &coin).force.z, 0.03, 1e-12);
}

/// While a bar that overhangs a drum's end on both sides tilts through lying flat, or turns through square to the axis
/// beside the end of a log, force and moment do not step.
#[test]
fn the_wrench_is_continuous_through_level_and_square_axes() {
    let drum = Frustum::new([-Vec3::z(), Vec3::zeros()], [0.3; 2]);
    let cone = Frustum::new([Vec3::zeros(), -Vec3::z()], [0.3, 0.5]);
    let log = Frustum::new([Vec3::zeros(), Vec3::x()], [0.3; 2]);
    let sunk = Vec3::new(0.02, 0.03, -1e-3);
    for (solid, radius, place, along, turn) in [
        (drum, 0.1, Vec3::new(0.02, 0.03, 0.099), Vec3::x(), Vec3::y()),
        (cone, 0.1, Vec3::new(0.02, 0.03, 0.099), Vec3::x(), Vec3::y()),
        (drum, 0.0, sunk, Vec3::x(), Vec3::y()),
        (cone, 0.0, sunk, Vec3::y(), Vec3::x()),
        (log, 0.1, Vec3::new(1.02, 0.02, 0.37), Vec3::y(), Vec3::z()),
        (log, 0.1, Vec3::new(0.9, 0.02, 0.37), Vec3::y(), Vec3::z()),
        (log, 0.1, Vec3::new(0.8, 0.0, 0.399), Vec3::x(), Vec3::y()),
        (log, 0.0, Vec3::new(0.5, 0.0, 0.299), Vec3::x(), Vec3::y()),
    ] {
        let at = |angle: f64| {
            let along = Quat::from_scaled_axis(turn * angle) * along;
            let a = Capsule { ends: [place - along * 0.8, place + along], radius };
            let Wrench { force, moment } = wrench(&a, &solid);
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
        assert!(steps[0] > 0.0 && steps[1] < 0.2 * steps[0], "{place} {along} {radius}: {steps:?}");
    }
}

/// The load acts at one place of the axis, which the contacts carry at the ends of the part that is less than the radius
/// away from B.
#[test]
fn contacts_lie_at_the_ends_of_the_overlap() {
    let mut random = Random::new(34, 0, 0);
    let mut compared = 0;
    for case in 0..long_samples(600, 6000) {
        let b = random_frustum(&mut random);
        let a = random_bar(&mut random, &b);
        let along = a.ends[1] - a.ends[0];
        let is_near = |at: f64| b_distance(&b, &(a.ends[0] + along * at)) < a.radius;
        let inside: Vec<f64> = (0..=2000).map(|k| f64::from(k) / 2000.0).filter(|at| is_near(*at)).collect();
        let [Some(one), Some(other)] = contacts(&a, &b) else { continue };
        let (Some(first), Some(last)) = (inside.first(), inside.last()) else { continue };
        let shares = [one.share, other.share];
        let places = [one, other].map(|contact| {
            let found = contact.interference;
            along.dot(&(found.deepest_b + found.normal_b * a.radius - a.ends[0])) / along.norm_squared()
        });
        let load = (places[0] * shares[0] + places[1] * shares[1]) / (shares[0] + shares[1]);
        let expected = [first.min(load), last.max(load)];
        for (place, expected) in places.iter().zip(expected) {
            assert!((place - expected).abs() < 1e-3, "case {case}: {places:?} {expected:?} {a:?} {b:?}");
        }
        compared += 1;
    }
    assert!(compared > long_samples(60, 600), "{compared}");
}

/// Distance of a place from a cylinder or a cone, by its definition as a hull: the greatest height above a plane behind it
/// in the half plane of the place.
fn b_distance(b: &Frustum, place: &Vec3) -> f64 {
    let arm = place - b.ends[0];
    let along = b.axis.dot(&arm);
    let around = b.axis.cross(&Vec3::ith(b.axis.iamin(), 1.0)).normalize();
    let side = (arm - b.axis * along).try_normalize(1e-9).unwrap_or(around);
    let height = |angle: f64| {
        let n = b.axis * angle.sin() + side * angle.cos();
        n.dot(place) - Bounded::support(b, &n)
    };
    let angles = (-50..=50).map(|k| TAU * f64::from(k) / 200.0);
    let mut best = angles.max_by(|x, y| height(*x).total_cmp(&height(*y))).unwrap();
    let mut step = TAU / 200.0;
    while step > 1e-7 {
        let better = [best - step, best + step].into_iter().find(|x| height(*x) > height(best));
        if let Some(better) = better { best = better } else { step *= 0.5 }
    }
    height(best)
}

/// In any frame a bar along the axis, the wall or an end face has the same energy.
#[test]
fn no_frame_changes_the_energy_of_special_poses() {
    let mut random = Random::new(35, 0, 0);
    for case in 0..long_samples(600, 6000) {
        let b = random_frustum(&mut random);
        let a = random_bar(&mut random, &b);
        let x = random_motion(&mut random, 2.0);
        let (here, there) = (energy(&a, &b), energy(&a.carried(&x), &b.carried(&x)));
        assert!((here - there).abs() <= 1e-12 * (1.0 + here), "case {case}: {here} {there} {a:?} {b:?}");
    }
}
