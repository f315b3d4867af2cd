//! Contacts with the wall of a round or tapered hole: depths by an independent search, wrenches as
//! derivatives of the stored energy, seams, and invariances.

use crate::bore_support::{across, carried, on_wall, random_bore, rounded, scaled, shared_square, swapped};
use crate::common::random_motion;
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::ball_bore::{BallContacts, ball_bore, is_behind_wall};
use pong_geometry::interference::ray_bore::ray_bore;
use pong_geometry::primitive::{Bore, Frustum, Ray, RayResponse, Sphere};
use pong_geometry::{Transform, Vec3};
use pong_testkit::Random;
use std::f64::consts::TAU;

/// Random point in the hole, behind its wall or beyond a mouth.
fn near(random: &mut Random, bore: &Bore) -> Vec3 {
    let place = on_wall(bore, random.between(-0.2, 1.2), random.between(0.0, TAU));
    let on_axis = bore.hole.ends[0] + bore.hole.axis * bore.hole.axis.dot(&(place - bore.hole.ends[0]));
    on_axis + (place - on_axis) * random.between(0.0, 1.4)
}

/// Distance to the nearest point of the wall, with that point's fraction of the length, by descent from a
/// grid.
fn nearest_by_search(bore: &Bore, place: &Vec3) -> (f64, f64) {
    let at = |share: f64, angle: f64| (on_wall(bore, share, angle) - place).norm();
    let grid = (0..=20).flat_map(|i| (0..48).map(move |j| (f64::from(i) / 20.0, TAU * f64::from(j) / 48.0)));
    let start = grid.min_by(|a, b| at(a.0, a.1).total_cmp(&at(b.0, b.1))).unwrap();
    let (mut share, mut angle, mut step) = (start.0, start.1, 0.1);
    while step > 1e-9 {
        let tried = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step), (step, step), (-step, -step)];
        let moved = tried.map(|(s, a)| ((share + s).clamp(0.0, 1.0), angle + a));
        let best = moved.into_iter().min_by(|a, b| at(a.0, a.1).total_cmp(&at(b.0, b.1))).unwrap();
        if at(best.0, best.1) < at(share, angle) {
            (share, angle) = best;
        } else {
            step *= 0.5;
        }
    }
    (at(share, angle), share)
}

/// Energy with a stiffness of 1 N/m, shared as in docs/theory.md, 2.2: half the square of the shortest vector
/// that clears both.
fn energy(contacts: &BallContacts) -> f64 {
    let [one, two] = contacts.map(|contact| contact.map_or((0.0, Vec3::zeros()), |c| (c.depth, c.normal_b)));
    0.5 * shared_square(one.0, two.0, one.1.dot(&two.1))
}

/// Force with a stiffness of 1 N/m.
fn force(contacts: &BallContacts) -> Vec3 {
    let [one, two] = contacts.map(|contact| contact.map_or((0.0, Vec3::zeros()), |c| (c.depth, c.normal_b)));
    let g = one.1.dot(&two.1).max(0.0);
    let share = |own: f64, other: f64| {
        if g * own >= other {
            own
        } else if g * other >= own {
            0.0
        } else {
            (own - g * other) / (1.0 - g * g)
        }
    };
    one.1 * share(one.0, two.0) + two.1 * share(two.0, one.0)
}

/// The depth at the nearest wall is the radius minus the distance of the centre from the wall; behind the
/// wall, plus.
#[test]
fn depths_of_balls_are_found_by_a_search_over_the_wall() {
    let mut random = Random::new(1, 0, 0);
    let (mut walls, mut mouths, mut none) = (0, 0, 0);
    for case in 0..300 {
        let bore = random_bore(&mut random);
        let ball = Sphere { center: near(&mut random, &bore), radius: random.between(0.0, 0.5) };
        let (distance, share) = nearest_by_search(&bore, &ball.center);
        let told = format!("case {case}: {bore:?} {ball:?} {distance} {share}");
        let arm = ball.center - bore.hole.ends[0];
        let along = bore.hole.axis.dot(&arm);
        let aside = (arm - bore.hole.axis * along).norm();
        let at_end = [share < 1e-6, share > 1.0 - 1e-6];
        let [first, last] = bore.hole.radii;
        let found = ball_bore(&ball, &bore)[0].map_or(0.0, |contact| contact.depth);
        let expected = if let Some(end) = at_end.iter().position(|at| *at) {
            let is_pushed = bore.mouths[end] && aside <= bore.hole.radii[end];
            if is_pushed { ball.radius - distance } else { 0.0 }
        } else {
            let is_behind = aside > first + (last - first) * along / bore.hole.length;
            let height = if is_behind { distance } else { -distance };
            if height < bore.thickness { ball.radius + height } else { 0.0 }
        };
        assert!((found - expected.max(0.0)).abs() < 1e-7, "{told}: {found} {expected}");
        let kind = if found == 0.0 {
            &mut none
        } else if share > 1e-6 && share < 1.0 - 1e-6 {
            &mut walls
        } else {
            &mut mouths
        };
        *kind += 1;
    }
    assert!(walls > 50 && mouths > 10 && none > 50, "{walls} {mouths} {none}");
}

/// The deepest of N planes around a straight or tapered hole converges to the depth at the wall as 1/N².
#[test]
fn planes_around_a_hole_come_closer_as_the_square_of_their_number() {
    let mut random = Random::new(2, 0, 0);
    for _ in 0..300 {
        let bore = random_bore(&mut random);
        let place = on_wall(&bore, random.between(0.3, 0.7), random.between(0.0, TAU));
        let wall = |angle: f64| {
            let [one, other] = across(&bore);
            let [along, aside] = bore.hole.wall;
            bore.hole.axis * along + (one * angle.cos() + other * angle.sin()) * aside
        };
        let center = place * 0.9 + 0.1 * (bore.hole.ends[0] + bore.hole.ends[1]) * 0.5;
        let ball = Sphere { center, radius: 0.4 };
        let Some(exact) = ball_bore(&ball, &bore)[0].filter(|contact| contact.feature.is_face()) else {
            continue;
        };
        let depth = |count: u32| {
            let planes = (0..count).map(|k| {
                let angle = TAU * f64::from(k) / f64::from(count);
                wall(angle).dot(&(center - on_wall(&bore, 0.5, angle))) + ball.radius
            });
            planes.fold(f64::NEG_INFINITY, f64::max)
        };
        for count in [16, 64, 256] {
            let off = exact.depth - depth(count);
            let most = 2.0 * (TAU / f64::from(count)).powi(2);
            assert!((-1e-12..most).contains(&off), "{count}: {off:e} {bore:?}");
        }
    }
}

/// Where no mouth shares its spring, the wrench is minus the derivative of the stored energy: on the wall, at
/// a mouth, and for spheres too large for the hole.
#[test]
fn wrenches_of_balls_derive_from_the_stored_energy() {
    const STEP: f64 = 1e-6;
    let mut random = Random::new(3, 0, 0);
    let (mut compared, mut both, mut kinks) = (0, 0, 0);
    for _ in 0..30_000 {
        let bore = random_bore(&mut random);
        let ball = Sphere { center: near(&mut random, &bore), radius: random.between(0.0, 1.5) };
        let contacts = ball_bore(&ball, &bore);
        let [one, two] = contacts;
        let shares_a_mouth = one.zip(two).is_some_and(|(one, two)| {
            !(one.feature.is_face() && two.feature.is_face()) && one.normal_b.dot(&two.normal_b) > 0.0
        });
        if energy(&contacts) < 1e-6 || shares_a_mouth {
            continue;
        }
        let velocity = random.direction();
        let moved = |time: f64| {
            energy(&ball_bore(&Sphere { center: ball.center + velocity * time, radius: ball.radius }, &bore))
        };
        compared += 1;
        both += usize::from(two.is_some());
        let halves = [moved(STEP) - moved(0.0), moved(0.0) - moved(-STEP)].map(|change| change / STEP);
        if (halves[0] - halves[1]).abs() > 1e-4 {
            kinks += 1;
            continue;
        }
        let slope = 0.5 * (halves[0] + halves[1]);
        let power = force(&contacts).dot(&velocity);
        assert!((power + slope).abs() < 1e-5, "{power} {slope} {bore:?} {ball:?} {contacts:?}");
    }
    assert!(compared > 5000 && both > 500 && kinks * 200 < compared, "{compared} {both} {kinks}");
}

/// The force is continuous while a sphere moves from the wall over the mouth, and through the axis of a hole
/// too small for it.
#[test]
fn balls_pass_seams_without_a_jump() {
    let mut random = Random::new(4, 0, 0);
    let mut pushed = 0;
    for _ in 0..200 {
        let bore = Bore { mouths: [true; 2], ..random_bore(&mut random) };
        let radius = random.between(0.05, 0.15);
        let end = random.below(2);
        let rim = on_wall(&bore, if end == 0 { 0.0 } else { 1.0 }, random.between(0.0, TAU));
        let inward = (bore.hole.ends[end] - rim).normalize();
        let along = bore.hole.axis * 0.1;
        let center = |t: f64| rim + inward * (0.9 * radius) + along * t;
        let walk = (-1000..=1000)
            .map(|i| force(&ball_bore(&Sphere { center: center(f64::from(i) * 1e-3), radius }, &bore)));
        let steps: Vec<Vec3> = walk.collect();
        pushed += usize::from(steps.iter().any(|force| force.norm() > 0.0));
        for pair in steps.windows(2) {
            assert!((pair[0] - pair[1]).norm() < 2e-3, "{:?} {:?} {bore:?}", pair[0], pair[1]);
        }
    }
    assert!(pushed > 150);
    let hole = Frustum::new([Vec3::zeros(), Vec3::x()], [0.4, 0.3]);
    let bore = Bore { hole, thickness: 0.3, mouths: [true; 2] };
    let through = (-1000..=1000).map(|i| {
        let center = Vec3::new(0.5, 1e-5 * f64::from(i), 2e-6);
        force(&ball_bore(&Sphere { center, radius: 0.4 }, &bore))
    });
    let steps: Vec<Vec3> = through.collect();
    assert!(steps.windows(2).all(|pair| (pair[0] - pair[1]).norm() < 1e-4));
}

/// Moved together, rotated about its own axis, its ends exchanged, rounded to f32 or not, scaled: nothing
/// changes.
#[test]
fn no_pose_no_naming_of_ends_and_no_scale_changes_what_balls_feel() {
    let mut random = Random::new(5, 0, 0);
    for case in 0..3000 {
        let bore = random_bore(&mut random);
        let bore = if case % 2 == 0 { bore } else { rounded(&bore) };
        let ball = Sphere { center: near(&mut random, &bore), radius: random.between(0.0, 1.0) };
        let expected = force(&ball_bore(&ball, &bore));
        let close = |found: Vec3, what: &str| {
            assert!((found - expected).norm() < 1e-11, "{what}: {found:?} {expected:?} {bore:?} {ball:?}");
        };
        let x = random_motion(&mut random, 2.0);
        let moved = Sphere { center: x.point(&ball.center), radius: ball.radius };
        close(x.rotation.tr_mul(&force(&ball_bore(&moved, &carried(&bore, &x)))), "moved");
        close(force(&ball_bore(&ball, &swapped(&bore))), "ends exchanged");
        let about = bore.hole.ends[0];
        let turn = pong_geometry::Quat::from_scaled_axis(bore.hole.axis * random.between(0.0, 6.0));
        let turn = turn.to_rotation_matrix().into_inner();
        let own = Transform { rotation: turn, translation: about - turn * about };
        close(force(&ball_bore(&ball, &carried(&bore, &own))), "turned about its own axis");
        for factor in [1e-6, 1e6] {
            let of_size = Sphere { center: ball.center * factor, radius: ball.radius * factor };
            close(force(&ball_bore(&of_size, &scaled(&bore, factor))) / factor, "scaled");
        }
    }
}

/// Every point that a bore may push lies in its support, for any thickness of the wall.
#[test]
fn bounding_volumes_hold_all_that_is_pushed() {
    let mut random = Random::new(6, 0, 0);
    let mut pushed = 0;
    for _ in 0..20_000 {
        let bore = random_bore(&mut random);
        let ball = Sphere { center: near(&mut random, &bore), radius: 0.0 };
        if ball_bore(&ball, &bore)[0].is_none() {
            continue;
        }
        pushed += 1;
        let direction = random.direction();
        let room = bore.support(&direction) - direction.dot(&ball.center);
        assert!(room > -1e-12, "{room} {bore:?} {ball:?}");
        assert!(Bounded::farthest(&bore, &Vec3::zeros()) > ball.center.norm() - 1e-12);
        assert!(is_behind_wall(&ball.center, &bore));
    }
    assert!(pushed > 1000);
}

/// A ray meets the wall where it leaves the hole, at the point found by small steps along it.
#[test]
fn rays_hit_the_wall_from_within_the_hole() {
    let mut random = Random::new(7, 0, 0);
    let (mut hits, mut misses) = (0, 0);
    for case in 0..2000 {
        let bore = random_bore(&mut random);
        let origin = near(&mut random, &bore);
        let direction = random.direction();
        let (length, reach) = (random.between(0.1, 3.0), random.between(0.0, 0.5));
        let ray = Ray { origin, direction, length, reach: Some(reach), response: RayResponse::Normal };
        let height = |t: f64| {
            let arm = origin + direction * t - bore.hole.ends[0];
            let along = bore.hole.axis.dot(&arm);
            let [first, last] = bore.hole.radii;
            let radius = first + (last - first) * along / bore.hole.length;
            let is_between = (0.0..=bore.hole.length).contains(&along);
            ((arm - bore.hole.axis * along).norm() - radius, is_between && radius > 0.0)
        };
        const STEPS: u32 = 2000;
        let at = |i: u32| -reach + (length + reach) * f64::from(i) / f64::from(STEPS);
        let step = (0..STEPS).find(|&i| {
            let ((before, _), (after, is_between)) = (height(at(i)), height(at(i + 1)));
            before <= 0.0 && after > 0.0 && is_between
        });
        let found = ray_bore(&ray, &bore);
        match (step, found) {
            (Some(i), Some(hit)) => {
                hits += 1;
                assert!(at(i) - 1e-9 <= hit.distance && hit.distance <= at(i + 1) + 1e-9, "case {case}");
                assert!(height(hit.distance).0.abs() < 1e-9 && hit.normal_b.dot(&direction) < 0.0);
                let place = origin + direction * hit.distance;
                let beside = Sphere { center: place - hit.normal_b * 1e-7, radius: 0.0 };
                let wall = ball_bore(&beside, &bore)[0];
                assert!(wall.is_none_or(|wall| (wall.normal_b - hit.normal_b).norm() < 1e-5));
            }
            (None, None) => misses += 1,
            // The ray leaves through an end within a step.
            (_, hit) => {
                let t = hit.map_or_else(|| at(step.unwrap()), |hit| hit.distance);
                let along = bore.hole.axis.dot(&(origin + direction * t - bore.hole.ends[0]));
                let is_at_end = along.abs().min((along - bore.hole.length).abs()) < 4e-3;
                let is_at_tip = [-reach, length].iter().any(|end| (t - end).abs() < 4e-3);
                assert!(is_at_end || is_at_tip, "case {case}: {step:?} {hit:?} {bore:?} {ray:?}");
            }
        }
    }
    assert!(hits > 300 && misses > 300, "{hits} {misses}");
}

/// A ray along the axis of a straight hole, or along a generator of a cone, has no exit.
#[test]
fn rays_along_the_wall_go_out_nowhere() {
    let ray = |origin: Vec3, direction: Vec3| Ray {
        origin,
        direction: direction.normalize(),
        length: 10.0,
        reach: Some(10.0),
        response: RayResponse::Normal,
    };
    let straight =
        Bore { hole: Frustum::new([Vec3::zeros(), Vec3::z()], [0.5; 2]), thickness: 0.1, mouths: [true; 2] };
    let cone = Bore { hole: Frustum::new([Vec3::zeros(), Vec3::z()], [1.0, 2.0]), ..straight };
    for direction in [1.0, -1.0] {
        for aside in [0.0, 0.25, 0.5, 0.75] {
            assert_eq!(ray_bore(&ray(Vec3::x() * aside, Vec3::z() * direction), &straight), None);
        }
        // Parallel to a generator of the cone, beside it: the wall is never met between the ends.
        let found = ray_bore(&ray(Vec3::x() * 0.5, Vec3::new(1.0, 0.0, 1.0) * direction), &cone);
        assert_eq!(found, None, "{direction}");
    }
}
