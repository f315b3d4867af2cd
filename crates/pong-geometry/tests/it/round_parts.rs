//! Spheres and two-ended bodies against capsules, cylinders and cones: depths by a search over all
//! directions, wrenches as derivatives of the stored energy, and invariances.

use crate::common::{fibonacci_sphere, random_motion};
use crate::round_support::Solid;
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ball_round::{ball_capsule, ball_frustum};
use pong_geometry::interference::two_capsules::{OverlapContacts, capsule_capsule, segment_capsule};
use pong_geometry::interference::two_ended_round::{
    EndContact, EndContacts, capsule_frustum, segment_frustum,
};
use pong_geometry::primitive::{Capsule, Frustum, LineSegment, Sphere};
use pong_geometry::{Transform, Vec3};
use pong_testkit::{Random, long_samples, samples};

/// Random solid, about 1 m in size, of any slenderness, near the origin.
fn random_solid(random: &mut Random) -> Solid {
    let one = random.direction() * random.between(0.0, 1.0);
    let other = one + random.direction() * random.between(0.05, 2.0);
    let radius = random.between(0.05, 1.0);
    match random.below(3) {
        0 => Solid::Capsule(Capsule { ends: [one, other], radius }),
        1 => Solid::Frustum(Frustum::new([one, other], [radius; 2])),
        _ => {
            let tip = if random.below(3) == 0 { 0.0 } else { random.between(0.05, 1.0) };
            Solid::Frustum(Frustum::new([one, other], [radius, tip]))
        }
    }
}

impl Solid {
    /// Random point on the axis or near it, in units of its size.
    fn near(&self, random: &mut Random) -> Vec3 {
        let (Self::Capsule(Capsule { ends, .. }) | Self::Frustum(Frustum { ends, .. })) = self;
        ends[0]
            + (ends[1] - ends[0]) * random.between(-0.3, 1.3)
            + random.direction() * random.between(0.0, 1.3)
    }

    fn axis(&self) -> Vec3 {
        let (Self::Capsule(Capsule { ends, .. }) | Self::Frustum(Frustum { ends, .. })) = self;
        ends[1] - ends[0]
    }

    fn middle(&self) -> Vec3 {
        let (Self::Capsule(Capsule { ends, .. }) | Self::Frustum(Frustum { ends, .. })) = self;
        0.5 * (ends[0] + ends[1])
    }

    fn touch_rod(&self, rod: &Capsule) -> EndContacts {
        let segment = LineSegment { ends: rod.ends };
        match (self, rod.radius > 0.0) {
            (Self::Capsule(capsule), true) => with_none(capsule_capsule(rod, capsule)),
            (Self::Frustum(frustum), true) => capsule_frustum(rod, frustum),
            (Self::Capsule(capsule), false) => with_none(segment_capsule(&segment, capsule)),
            (Self::Frustum(frustum), false) => segment_frustum(&segment, frustum),
        }
    }

    fn touch_ball(&self, ball: &Sphere) -> Option<Interference> {
        match self {
            Self::Capsule(capsule) => ball_capsule(ball, capsule),
            Self::Frustum(frustum) => ball_frustum(ball, frustum),
        }
    }
}

fn with_none([first, second]: OverlapContacts) -> EndContacts {
    [first, second, None]
}

fn random_rod(random: &mut Random, solid: &Solid) -> Capsule {
    let radius = if random.below(2) == 0 { 0.0 } else { random.between(0.01, 0.5) };
    Capsule { ends: [solid.near(random), solid.near(random)], radius }
}

/// Least overlap over all unit vectors, m, by descent from many of them: the definition of depth, with
/// support functions only.
fn depth_by_search(rod: &Capsule, solid: &Solid) -> f64 {
    depth_by_descent(rod, solid, 1000, 20)
}

/// Least overlap by descent from the best `few` of `directions` directions, m.
fn depth_by_descent(rod: &Capsule, solid: &Solid, directions: usize, few: usize) -> f64 {
    let overlap = |n: &Vec3| solid.support(n) + Bounded::support(rod, &-n);
    let mut starts: Vec<(f64, Vec3)> =
        fibonacci_sphere(directions).into_iter().map(|n| (overlap(&n), n)).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut least = f64::INFINITY;
    for (_, start) in starts.into_iter().take(few) {
        let (mut n, mut best, mut step) = (start, overlap(&start), 0.05);
        while step > 1e-8 {
            let (u, v) = frame(&n);
            let tried = (0..8).map(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / 8.0;
                (n + (u * angle.cos() + v * angle.sin()) * step).normalize()
            });
            match tried.map(|n| (overlap(&n), n)).min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((value, better)) if value < best => (n, best) = (better, value),
                _ => step *= 0.5,
            }
        }
        least = least.min(best);
    }
    least
}

fn frame(n: &Vec3) -> (Vec3, Vec3) {
    let u = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
    (u, n.cross(&u))
}

fn deepest(contacts: &EndContacts) -> f64 {
    contacts.iter().flatten().map(|contact| contact.interference.depth).fold(0.0, f64::max)
}

/// Energy with a stiffness of 1 N/m.
fn energy(contacts: &EndContacts) -> f64 {
    let stored = |contact: &EndContact| 0.25 * contact.share * contact.interference.depth.powi(2);
    contacts.iter().flatten().map(stored).sum()
}

/// Force and moment about a point, with a stiffness of 1 N/m.
fn wrench(contacts: &EndContacts, about: &Vec3) -> (Vec3, Vec3) {
    contacts.iter().flatten().fold((Vec3::zeros(), Vec3::zeros()), |(force, moment), contact| {
        let Interference { depth, normal_b, deepest_b, .. } = contact.interference;
        let one = normal_b * (0.5 * contact.share * depth);
        (force + one, moment + (deepest_b - about).cross(&one))
    })
}

/// For a rod exactly on the axis of a solid the direction of the nearest wall is undefined; its depth is
/// still the minimum translation, and the same as beside the axis.
#[test]
fn a_rod_on_the_axis_of_a_solid_leaves_it_by_the_shortest_way() {
    let mut random = Random::new(1, 7, 0);
    let mut through_wall = 0;
    for case in 0..120 {
        let axis = Vec3::ith(case % 3, 1.0);
        let (length, place) = (random.between(0.2, 1.5), random.between(-1.0, 1.0));
        let ends = [axis * place, axis * (place + length)];
        let radii = [random.between(0.05, 1.0), random.between(0.0, 1.0)];
        let solid = Solid::Frustum(Frustum::new(ends, radii));
        let [one, other] = [(); 2].map(|()| axis * (place + length * random.between(-0.4, 1.4)));
        let rod = Capsule {
            ends: [one, other],
            radius: if case % 2 == 0 { 0.0 } else { random.between(0.01, 0.3) },
        };
        let depth = deepest(&solid.touch_rod(&rod));
        // By symmetry, the translations in one plane through the axis are sufficient.
        let (aside, _) = frame(&axis);
        let overlap = |angle: f64| {
            let n = axis * angle.cos() + aside * angle.sin();
            solid.support(&n) + Bounded::support(&rod, &-n)
        };
        let mut least = (0..=2000)
            .map(|i| std::f64::consts::PI * f64::from(i) / 2000.0)
            .min_by(|a, b| overlap(*a).total_cmp(&overlap(*b)))
            .unwrap();
        let mut step = 1e-3;
        while step > 1e-10 {
            let better =
                [least - step, least + step].into_iter().find(|angle| overlap(*angle) < overlap(least));
            if let Some(better) = better { least = better } else { step *= 0.5 }
        }
        let searched = overlap(least).max(0.0);
        assert!((depth - searched).abs() < 1e-7, "case {case}: {depth} {searched} {rod:?} {solid:?}");
        let beside = Capsule { ends: rod.ends.map(|end| end + aside * 1e-9), ..rod };
        let (here, there) = (energy(&solid.touch_rod(&rod)), energy(&solid.touch_rod(&beside)));
        assert!((here - there).abs() < 1e-8, "case {case}: {here} {there} {rod:?} {solid:?}");
        let along_axis = |contact: &Interference| contact.normal_b.dot(&axis).abs() > 1.0 - 1e-9;
        let leaves_by_wall = |contacts: &EndContacts| {
            contacts.iter().flatten().any(|contact| !along_axis(&contact.interference))
        };
        through_wall += usize::from(leaves_by_wall(&solid.touch_rod(&rod)));
    }
    assert!(through_wall > 20, "{through_wall}");
}

/// The depth in a cylinder or a cone is the minimum translation, for any depth and any feature.
#[test]
fn depths_are_the_least_translation_that_separates() {
    let mut random = Random::new(1, 0, 0);
    let mut touching = 0;
    for case in 0..long_samples(30, 150) {
        let solid = random_solid(&mut random);
        if matches!(solid, Solid::Capsule(_)) {
            continue;
        }
        let rod = random_rod(&mut random, &solid);
        let searched = depth_by_search(&rod, &solid);
        let contacts = solid.touch_rod(&rod);
        let found = deepest(&contacts);
        let told = format!("case {case}: {found} {searched} {solid:?} {rod:?}");
        // The search may stop above the minimum.
        assert!(found < searched.max(0.0) + 1e-9, "{told}");
        assert!(found > 0.0 || searched < 1e-6, "{told}");
        touching += usize::from(found > 0.0);
        for contact in contacts.iter().flatten().filter(|contact| contact.interference.depth == found) {
            let n = contact.interference.normal_b;
            let out = solid.support(&n) + Bounded::support(&rod, &-n);
            assert!((out - found).abs() < 1e-11, "{told}: the normal separates by {out}");
        }
    }
    assert!(touching > long_samples(6, 30));
}

/// Rods whose axes pass through a cylinder or a cone, many poses for each pair: no searched direction gives a
/// shorter translation.
#[test]
fn no_way_out_of_cylinders_and_cones_is_shorter_than_the_depth() {
    let poses = long_samples(200, 1000);
    let mut random = Random::new(15, 0, 0);
    let mut counts = [[0; 2]; 2];
    while counts.iter().flatten().any(|&count| count < poses) {
        let solid = random_solid(&mut random);
        let Solid::Frustum(frustum) = solid else { continue };
        let rod = random_rod(&mut random, &solid);
        let count =
            &mut counts[usize::from(rod.radius > 0.0)][usize::from(frustum.radii[0] != frustum.radii[1])];
        let contacts = solid.touch_rod(&rod);
        let found = deepest(&contacts);
        if *count == poses || found <= rod.radius {
            continue;
        }
        *count += 1;
        let searched = depth_by_descent(&rod, &solid, 400, 5);
        assert!(found < searched + 1e-9, "{found} {searched} {frustum:?} {rod:?}");
        let deep = contacts
            .iter()
            .flatten()
            .map(|contact| &contact.interference)
            .find(|contact| contact.depth == found);
        let n = deep.unwrap().normal_b;
        let out = solid.support(&n) + Bounded::support(&rod, &-n);
        assert!((out - found).abs() < 1e-12, "{found} {out} {frustum:?} {rod:?}");
    }
}

#[test]
fn depths_of_balls_are_the_least_translation_that_separates() {
    let mut random = Random::new(2, 0, 0);
    for case in 0..samples(100) {
        let solid = random_solid(&mut random);
        let center = solid.near(&mut random);
        let ball = Sphere { center, radius: random.between(0.0, 0.5) };
        let nearly = Capsule { ends: [center, center + Vec3::repeat(1e-13)], radius: ball.radius };
        let searched = depth_by_search(&nearly, &solid).max(0.0);
        let contact = solid.touch_ball(&ball);
        let found = contact.map_or(0.0, |contact| contact.depth);
        assert!(found < searched + 1e-9, "case {case}: {found} {searched} {solid:?} {ball:?}");
        assert!(found > 0.0 || searched < 1e-6, "case {case}: {searched} {solid:?} {ball:?}");
        if let Some(contact) = contact {
            let out = solid.support(&contact.normal_b) - contact.normal_b.dot(&contact.deepest_b);
            assert!((out - contact.depth).abs() < 1e-12, "the normal separates by the depth");
        }
    }
}

/// The wrench is minus the derivative of the stored energy along any motion: frictionless closed paths do no work.
#[test]
fn wrenches_derive_from_the_stored_energy() {
    const STEP: f64 = 1e-6;
    let mut random = Random::new(3, 0, 0);
    let (mut compared, mut kinks) = (0, 0);
    for _ in 0..20_000 {
        let solid = random_solid(&mut random);
        let rod = random_rod(&mut random, &solid);
        let contacts = solid.touch_rod(&rod);
        if deepest(&contacts) < 1e-3 {
            continue;
        }
        let (velocity, spin, about) = (random.direction(), random.direction(), rod.ends[0]);
        let moved = |time: f64| {
            let turn = pong_geometry::Quat::from_scaled_axis(spin * time);
            let place = |p: Vec3| about + turn * (p - about) + velocity * time;
            energy(&solid.touch_rod(&Capsule { ends: rod.ends.map(place), radius: rod.radius }))
        };
        let (force, moment) = wrench(&contacts, &about);
        let power = force.dot(&velocity) + moment.dot(&spin);
        let slope = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
        compared += 1;
        // If another side becomes the exit within the step, the energy has a kink and no derivative.
        let halves = [moved(STEP) - moved(0.0), moved(0.0) - moved(-STEP)].map(|change| change / STEP);
        if (halves[0] - halves[1]).abs() > 1e-4 {
            kinks += 1;
            continue;
        }
        assert!((power + slope).abs() < 1e-5, "{power} {slope} {solid:?} {rod:?} {contacts:?}");
    }
    assert!(compared > 5000 && kinks * 200 < compared, "{kinks} kinks of {compared}");
}

/// Moved together, rotated about its own axis, with its ends exchanged: nothing changes.
#[test]
fn no_pose_and_no_naming_of_ends_changes_anything() {
    let mut random = Random::new(4, 0, 0);
    // If two are nearly parallel, the contact point depends on the last digits.
    let (mut compared, mut loose) = (0, 0);
    for _ in 0..3000 {
        let solid = random_solid(&mut random);
        let rod = random_rod(&mut random, &solid);
        let contacts = solid.touch_rod(&rod);
        let about = solid.middle();
        let (force, moment) = wrench(&contacts, &about);
        let mut close = |(f, m): (Vec3, Vec3), what: &str| {
            let off = (f - force).norm() + (m - moment).norm();
            assert!(off < 1e-9, "{what}: {off:e} {solid:?} {rod:?}");
            compared += 1;
            loose += usize::from(off > 1e-12);
        };
        let x = random_motion(&mut random, 2.0);
        let (f, m) = wrench(&solid.carried(&x).touch_rod(&rod.carried(&x)), &x.point(&about));
        let back = x.rotation.transpose();
        close((back * f, back * m), "moved");
        let own = pong_geometry::Quat::from_scaled_axis(solid.axis().normalize() * random.between(0.0, 6.0));
        let own = own.to_rotation_matrix().into_inner();
        let turn = Transform { rotation: own, translation: about - own * about };
        close(wrench(&solid.carried(&turn).touch_rod(&rod), &about), "turned about its own axis");
        close(wrench(&solid.swapped().touch_rod(&rod), &about), "ends of B exchanged");
        let exchanged = Capsule { ends: [rod.ends[1], rod.ends[0]], radius: rod.radius };
        close(wrench(&solid.touch_rod(&exchanged), &about), "ends of A exchanged");
    }
    assert!(loose * 100 < compared, "{loose} of {compared} are off by more than 1e-12");
}

#[test]
fn scale_changes_nothing_but_lengths() {
    let mut random = Random::new(5, 0, 0);
    for _ in 0..2000 {
        let solid = random_solid(&mut random);
        let rod = random_rod(&mut random, &solid);
        let depth = deepest(&solid.touch_rod(&rod));
        for factor in [1e-6, 1e6] {
            let scaled = Capsule { ends: rod.ends.map(|end| end * factor), radius: rod.radius * factor };
            let found = deepest(&solid.scaled(factor).touch_rod(&scaled));
            assert!((found / factor - depth).abs() < 1e-11, "{factor:e}: {found:e} {depth:e}");
        }
    }
}

/// A rod that lies flat on a cylinder carries kδ, whatever overhangs; on one end or across, half of it along the minimum
/// translation.
#[test]
fn a_rod_that_lies_flat_carries_its_spring_and_a_tip_half_of_it() {
    let mut random = Random::new(6, 0, 0);
    let cylinder = Frustum::new([Vec3::zeros(), Vec3::x()], [0.3; 2]);
    let depth = 1e-3;
    for _ in 0..500 {
        let x = random_motion(&mut random, 3.0);
        let height = 0.3 + 0.1 - depth;
        for (from, to) in [(0.2, 0.7), (-0.5, 1.6), (-0.4, 0.5), (0.3, 1.9), (0.0, 1.0)] {
            let (from, to) = (from + random.between(-0.05, 0.05), to + random.between(-0.05, 0.05));
            let rod =
                Capsule { ends: [Vec3::new(from, 0.0, height), Vec3::new(to, 0.0, height)], radius: 0.1 };
            let contacts = Solid::Frustum(cylinder).carried(&x).touch_rod(&rod.carried(&x));
            let (force, moment) = wrench(&contacts, &x.point(&Vec3::zeros()));
            assert!((force.norm() - depth).abs() < 1e-12, "{from} {to} {}", force.norm());
            let middle = 0.5 * (f64::max(from, 0.0) + f64::min(to, 1.0));
            let lever = x.rotation.tr_mul(&moment).dot(&-Vec3::y()) / force.norm();
            assert!((lever - middle).abs() < 1e-9, "{lever} {middle}");
        }
        let tip = Vec3::new(random.between(0.3, 0.7), 0.0, height);
        for rod in [
            Capsule { ends: [tip, tip + Vec3::new(0.3, 0.1, 0.8)], radius: 0.1 },
            Capsule { ends: [tip - Vec3::new(0.2, 1.0, 0.0), tip + Vec3::new(0.2, 1.0, 0.0)], radius: 0.1 },
        ] {
            let (force, _) = wrench(&Solid::Frustum(cylinder).carried(&x).touch_rod(&rod.carried(&x)), &tip);
            assert!((force.norm() - 0.5 * depth).abs() < 1e-12, "{}", force.norm());
        }
    }
}

/// While a rod tilts through lying flat, force and moment are continuous.
#[test]
fn a_rod_tilts_through_lying_flat_without_a_jump() {
    let cylinder = Solid::Frustum(Frustum::new([Vec3::zeros(), Vec3::x()], [0.3; 2]));
    let depth = 1e-3;
    for (from, to) in [(0.21, 0.74), (-0.52, 1.63), (-0.41, 0.53), (0.33, 1.92)] {
        let mut last: Option<(Vec3, Vec3)> = None;
        let middle = Vec3::new(0.5 * (f64::max(from, 0.0) + f64::min(to, 1.0)), 0.0, 0.4 - depth);
        for step in -4000..=4000 {
            let tilt = 3e-6 * f64::from(step);
            let turn = pong_geometry::Quat::from_scaled_axis(Vec3::y() * tilt + Vec3::z() * 1e-4);
            let end = |x: f64| middle + turn * (Vec3::new(x, 0.0, 0.4 - depth) - middle);
            let rod = Capsule { ends: [end(from), end(to)], radius: 0.1 };
            let now = wrench(&cylinder.touch_rod(&rod), &middle);
            if let Some((force, moment)) = last {
                let jump = (now.0 - force).norm() + (now.1 - moment).norm();
                assert!(jump < 2e-2 * depth, "{from} {to} {tilt}: {jump:e}");
            }
            last = Some(now);
        }
    }
}

/// A rod along a cylinder, sunk in until its axis is inside, past one end or both: it is held at the ends of
/// the overlap, in any pose and in spite of rounding.
#[test]
fn a_rod_sunk_in_along_a_cylinder_is_held_where_it_overlaps() {
    let mut random = Random::new(7, 0, 0);
    let cylinder = Frustum::new([Vec3::zeros(), Vec3::x()], [0.1; 2]);
    for case in 0..20_000 {
        let x = random_motion(&mut random, 3.0);
        let solid = Solid::Frustum(cylinder.carried(&x));
        let aside = random.between(0.06, 0.095);
        let (from, to) = [(-0.6, 0.5), (0.5, 1.9), (-0.7, 1.8)][case % 3];
        let place = |along: f64| Vec3::new(along, 0.0, aside);
        let mut ends = [place(from), place(to)];
        if random.below(2) == 0 {
            ends.reverse();
        }
        let rod = Capsule { ends, radius: 0.02 }.carried(&x);
        let (force, moment) = wrench(&solid.touch_rod(&rod), &x.point(&Vec3::zeros()));
        let depth = 0.1 + 0.02 - aside;
        assert!((force.norm() - depth).abs() < 1e-12, "{from} {to}: {} for {depth}", force.norm());
        let middle = 0.5 * (f64::max(from, 0.0) + f64::min(to, 1.0));
        let lever = x.rotation.tr_mul(&moment).dot(&-Vec3::y()) / force.norm();
        assert!((lever - middle).abs() < 1e-9, "case {case}, {from} {to}: at {lever}, not {middle}");
    }
}

/// A rod inside a cone, along its axis, leaves perpendicular to the axis, by the wide end: it is held there.
#[test]
fn a_rod_sunk_in_along_the_axis_of_a_cone_is_held_at_the_wide_end() {
    let mut random = Random::new(8, 0, 0);
    let cone = Frustum::new([Vec3::zeros(), Vec3::x()], [0.3, 0.1]);
    for _ in 0..500 {
        let x = random_motion(&mut random, 3.0);
        let ends = [Vec3::new(-0.8, 0.0, 0.25), Vec3::new(0.9, 0.0, 0.25)];
        let rod = Capsule { ends, radius: 0.0 }.carried(&x);
        let contacts = Solid::Frustum(cone).carried(&x).touch_rod(&rod);
        for contact in contacts.iter().flatten() {
            let at = x.rotation.tr_mul(&(contact.interference.deepest_b - x.translation));
            assert!(at.x.abs() < 1e-9 && (contact.interference.depth - 0.05).abs() < 1e-12, "{contacts:?}");
        }
        assert!(contacts.iter().flatten().count() > 0);
    }
}

/// A rod that lies across a coin, past its rim on both sides: the two faces of the coin are the ends of the
/// overlap, each as deep as the radius extends past it, though the axis is outside both.
#[test]
fn a_rod_across_a_coin_is_held_by_both_faces() {
    let mut random = Random::new(10, 0, 0);
    let (radius, thickness) = (0.1, 0.01);
    for _ in 0..500 {
        let mut faces = [Vec3::zeros(), Vec3::new(0.0, 0.0, -thickness)];
        if random.chance(0.5) {
            faces.reverse();
        }
        let coin = Frustum::new(faces, [0.05; 2]);
        let depth = random.between(1.1 * thickness, 0.05);
        let (across, height) = (random.across(&Vec3::z()), Vec3::new(0.0, 0.0, radius - depth));
        let ends = [height - across * random.between(0.2, 0.9), height + across * random.between(0.2, 0.9)];
        let x = random_motion(&mut random, 3.0);
        let rod = Capsule { ends, radius }.carried(&x);
        let (force, _) = wrench(&Solid::Frustum(coin.carried(&x)).touch_rod(&rod), &x.translation);
        // U = ¼(δ² + δ₀²δ₁²/δ²), with δ₁ = δ at the near face and δ₀ at the far one.
        let expected = x.vector(&Vec3::z()) * (0.5 * (depth + depth - thickness));
        assert!((force - expected).norm() < 1e-12, "{depth}: {force} for {expected}");
    }
}

/// A rod along an end face of a cylinder or a cone, past its rim on both sides and its axis inside, leaves
/// over that face: it is held over the middle of the overlap, in any pose.
#[test]
fn a_rod_sunk_in_along_an_end_face_is_held_over_its_middle() {
    let mut random = Random::new(11, 0, 0);
    for case in 0..5000 {
        let mut ends = [Vec3::new(0.0, 0.0, -1.0), Vec3::zeros()];
        let mut radii = [[0.3, 0.3], [0.4, 0.2]][case % 2];
        if random.chance(0.5) {
            ends.reverse();
            radii.reverse();
        }
        let (sunk, beside) = (random.between(0.01, 0.04), random.between(-0.1, 0.1));
        let along = random.across(&Vec3::z());
        let middle = along.cross(&Vec3::z()) * beside - Vec3::z() * sunk;
        let rod_ends = [-random.between(0.35, 0.9), random.between(0.35, 0.9)].map(|at| middle + along * at);
        let x = random_motion(&mut random, 3.0);
        let rod = Capsule { ends: rod_ends, radius: 0.02 }.carried(&x);
        let contacts = Solid::Frustum(Frustum::new(ends, radii).carried(&x)).touch_rod(&rod);
        let Interference { depth, normal_b, deepest_b, .. } = contacts[2].expect("past the rim").interference;
        assert!((depth - sunk - rod.radius).abs() < 1e-12, "case {case}: {depth} for {sunk}");
        let held = deepest_b + normal_b * rod.radius;
        assert!((held - x.point(&middle)).norm() < 1e-9, "case {case}: {held}, not {}", x.point(&middle));
    }
}
