//! Spheres and two-ended bodies against capsules, cylinders and cones: depths by a search over all
//! directions, wrenches as derivatives of the stored energy, and invariances.

use crate::common::{fibonacci_sphere, random_motion};
use crate::round_support::Solid;
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ball_round::{ball_capsule, ball_frustum};
use pong_geometry::interference::two_capsules::{OverlapContacts, capsule_capsule, segment_capsule};
use pong_geometry::interference::two_ended_round::{EndContact, capsule_frustum, segment_frustum};
use pong_geometry::primitive::{Capsule, Frustum, LineSegment, Round, Sphere};
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

    fn touch_rod(&self, rod: &Capsule) -> OverlapContacts {
        let segment = LineSegment { ends: rod.ends };
        match (self, rod.radius > 0.0) {
            (Self::Capsule(capsule), true) => capsule_capsule(rod, capsule),
            (Self::Frustum(frustum), true) => capsule_frustum(rod, frustum),
            (Self::Capsule(capsule), false) => segment_capsule(&segment, capsule),
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

fn deepest(contacts: &OverlapContacts) -> f64 {
    contacts.iter().flatten().map(|contact| contact.interference.depth).fold(0.0, f64::max)
}

/// Energy with a stiffness of 1 N/m.
fn energy(contacts: &OverlapContacts) -> f64 {
    let stored = |contact: &EndContact| 0.25 * contact.share * contact.interference.depth.powi(2);
    contacts.iter().flatten().map(stored).sum()
}

/// Force and moment about a point, with a stiffness of 1 N/m.
fn wrench(contacts: &OverlapContacts, about: &Vec3) -> (Vec3, Vec3) {
    contacts.iter().flatten().fold((Vec3::zeros(), Vec3::zeros()), |(force, moment), contact| {
        let Interference { depth, normal_b, deepest_b, .. } = contact.interference;
        let one = normal_b * (0.5 * contact.share * depth);
        (force + one, moment + (deepest_b - about).cross(&one))
    })
}

/// The gap between an axis and a cylinder or a cone through which it passes, or on whose axis it lies, is minus the least
/// translation that separates them.
#[test]
fn gaps_of_axes_in_cylinders_and_cones_are_the_least_translation() {
    let mut random = Random::new(15, 0, 0);
    let mut compared = 0;
    for case in 0..long_samples(300, 1000) {
        let solid = random_solid(&mut random);
        let Solid::Frustum(frustum) = solid else { continue };
        let ends = match case % 4 {
            0 => [(); 2]
                .map(|()| frustum.ends[0] + frustum.axis * (frustum.length * random.between(-0.4, 1.4))),
            _ => [solid.near(&mut random), solid.near(&mut random)],
        };
        let found = -frustum.gap(&ends).distance;
        if found <= 0.0 {
            continue;
        }
        let rod = Capsule { ends, radius: 0.0 };
        let searched = depth_by_descent(&rod, &solid, 400, 5);
        assert!(found < searched + 1e-9, "{found} {searched} {frustum:?} {ends:?}");
        let n = frustum.gap(&ends).normal_b;
        let out = solid.support(&n) + Bounded::support(&rod, &-n);
        assert!((out - found).abs() < 1e-12, "{found} {out} {frustum:?} {ends:?}");
        compared += 1;
    }
    assert!(compared > long_samples(90, 300), "{compared}");
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
