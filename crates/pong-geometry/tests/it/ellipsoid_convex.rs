//! Ellipsoids against spheres, ellipsoids, capsules, cylinders and cones: depths by a search over all directions with
//! support functions only, closed forms, the answers of spheres, forces and moments as derivatives of the stored
//! energy, and invariances.

use crate::common::{fibonacci_sphere, random_motion, scaled_ellipsoid};
use crate::round_support::Solid;
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ball_round::{ball_capsule, ball_frustum};
use pong_geometry::interference::ellipsoid_ellipsoid::ellipsoid_ellipsoid;
use pong_geometry::interference::ellipsoid_round::{ellipsoid_capsule, ellipsoid_frustum};
use pong_geometry::interference::sphere_ellipsoid::sphere_ellipsoid;
use pong_geometry::primitive::{Capsule, Ellipsoid, Frustum, Sphere};
use pong_geometry::{Mat3, Transform, Vec3};
use pong_testkit::{Random, long_samples, samples};

/// Convex body that an ellipsoid touches.
#[derive(Clone, Copy, Debug)]
enum Body {
    Ball(Sphere),
    Egg(Ellipsoid),
    Round(Solid),
}

impl Body {
    /// Body about 1 m in size near the origin, `slender` times as thin as long at most.
    fn random(random: &mut Random, slender: f64) -> Self {
        let one = random.direction() * random.between(0.0, 0.5);
        let other = one + random.direction() * random.between(0.1, 1.5);
        let radius = random.log_between(0.7 / slender, 0.7);
        match random.below(5) {
            0 => Self::Ball(Sphere { center: one, radius }),
            1 => Self::Egg(random_ellipsoid(random, one, slender)),
            2 => Self::Round(Solid::Capsule(Capsule { ends: [one, other], radius })),
            3 => Self::Round(Solid::Frustum(Frustum::new([one, other], [radius; 2]))),
            _ => {
                let tip = if random.below(3) == 0 { 0.0 } else { random.between(0.05, 0.7) };
                Self::Round(Solid::Frustum(Frustum::new([one, other], [radius, tip])))
            }
        }
    }

    fn support(&self, direction: &Vec3) -> f64 {
        match self {
            Self::Ball(sphere) => Bounded::support(sphere, direction),
            Self::Egg(ellipsoid) => Bounded::support(ellipsoid, direction),
            Self::Round(solid) => solid.support(direction),
        }
    }

    fn support_point(&self, direction: &Vec3) -> Vec3 {
        match self {
            Self::Ball(sphere) => sphere.center + direction * sphere.radius,
            Self::Egg(ellipsoid) => ellipsoid.support(direction),
            Self::Round(Solid::Frustum(frustum)) => frustum.support_point(direction),
            Self::Round(Solid::Capsule(Capsule { ends: [one, other], radius })) => {
                let end = if direction.dot(&(other - one)) > 0.0 { other } else { one };
                end + direction * *radius
            }
        }
    }

    fn center(&self) -> Vec3 {
        match self {
            Self::Ball(sphere) => sphere.center,
            Self::Egg(ellipsoid) => ellipsoid.center,
            Self::Round(solid) => 0.5 * (solid.ends()[0] + solid.ends()[1]),
        }
    }

    fn carried(&self, x: &Transform) -> Self {
        match self {
            Self::Ball(sphere) => Self::Ball(sphere.carried(x)),
            Self::Egg(ellipsoid) => Self::Egg(ellipsoid.carried(x)),
            Self::Round(solid) => Self::Round(solid.carried(x)),
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Ball(Sphere { center, radius }) => {
                Self::Ball(Sphere { center: center * factor, radius: radius * factor })
            }
            Self::Egg(ellipsoid) => Self::Egg(scaled_ellipsoid(ellipsoid, factor)),
            Self::Round(solid) => Self::Round(solid.scaled(factor)),
        }
    }

    /// Contact of the ellipsoid, as A, with the body. A sphere is A itself: its contact is turned round.
    fn touched_by(&self, ellipsoid: &Ellipsoid) -> Option<Interference> {
        match self {
            Self::Ball(sphere) => sphere_ellipsoid(sphere, ellipsoid).map(|contact| Interference {
                normal_b: -contact.normal_b,
                deepest_b: contact.deepest_b + contact.normal_b * contact.depth,
                ..contact
            }),
            Self::Egg(other) => ellipsoid_ellipsoid(ellipsoid, other),
            Self::Round(Solid::Capsule(capsule)) => ellipsoid_capsule(ellipsoid, capsule),
            Self::Round(Solid::Frustum(frustum)) => ellipsoid_frustum(ellipsoid, frustum),
        }
    }
}

fn random_ellipsoid(random: &mut Random, center: Vec3, slender: f64) -> Ellipsoid {
    let semi_axes = Vec3::from_fn(|_, _| random.log_between(0.7 / slender, 0.7));
    Ellipsoid { center, axes: random.rotation_matrix(), semi_axes }
}

/// Ellipsoid that overlaps the body by at most a chosen depth, or reaches into it at random.
fn random_touch(random: &mut Random, body: &Body, slender: f64) -> Ellipsoid {
    let mut ellipsoid = random_ellipsoid(random, Vec3::zeros(), slender);
    let normal = random.direction();
    ellipsoid.center = match random.below(4) {
        0 => body.center() + random.direction() * random.between(0.0, 0.7),
        _ => {
            let depth = random.log_between(1e-5, 0.1);
            body.support_point(&normal) - normal * depth - ellipsoid.support(&-normal)
        }
    };
    ellipsoid
}

/// Least overlap over all unit vectors, m, by descent from many of them: the definition of depth.
fn depth_by_search(ellipsoid: &Ellipsoid, body: &Body) -> f64 {
    let overlap = |n: &Vec3| body.support(n) + Bounded::support(ellipsoid, &-n);
    let scaled = |n: Vec3| (ellipsoid.axes * n.component_div(&ellipsoid.semi_axes)).normalize();
    let spread = fibonacci_sphere(700);
    let of_body = |n: Vec3| match body {
        Body::Egg(egg) => (egg.axes * n.component_div(&egg.semi_axes)).normalize(),
        Body::Round(solid) => (solid.ends()[1] - solid.ends()[0]).cross(&n).try_normalize(1e-9).unwrap_or(n),
        Body::Ball(_) => n,
    };
    let all = spread.iter().flat_map(|n| [*n, scaled(*n), of_body(*n)]);
    let mut starts: Vec<(f64, Vec3)> = all.map(|n| (overlap(&n), n)).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut least = f64::INFINITY;
    for (_, start) in starts.into_iter().step_by(3).take(12) {
        let (mut n, mut best, mut step) = (start, overlap(&start), 0.03);
        while step > 1e-8 {
            let u = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
            let v = n.cross(&u);
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

/// The depth is the least overlap over all directions, the normal one along which it is reached, and the deepest point
/// one of the ellipsoid.
#[test]
fn the_depth_is_the_least_translation() {
    let mut random = Random::new(49, 1, 0);
    let (mut touched, mut worst) = (0, 0.0_f64);
    for case in 0..long_samples(1000, 4000) {
        let slender = if case % 2 == 0 { 5.0 } else { 50.0 };
        let body = Body::random(&mut random, slender);
        let ellipsoid = random_touch(&mut random, &body, slender);
        let expected = depth_by_search(&ellipsoid, &body);
        let Some(contact) = body.touched_by(&ellipsoid) else {
            assert!(expected < 1e-9, "case {case}: {body:?} {ellipsoid:?} overlap by {expected:e}");
            continue;
        };
        touched += 1;
        let own = body.support(&contact.normal_b) + Bounded::support(&ellipsoid, &-contact.normal_b);
        assert!((own - contact.depth).abs() < 1e-13, "case {case}: {contact:?} overlaps by {own}");
        let on_plane = contact.normal_b.dot(&contact.deepest_b) - body.support(&contact.normal_b);
        assert!((on_plane + contact.depth).abs() < 1e-12, "case {case}: {contact:?}");
        worst = worst.max(contact.depth - expected);
        let excess = contact.depth - expected;
        assert!(
            excess < 1e-9,
            "case {case}: {excess:e} more than {expected}: {body:?} {ellipsoid:?} {contact:?}"
        );
    }
    println!("{touched} contacts, at most {worst:.1e} m above the search");
    assert!(touched > long_samples(1000, 4000) / 2);
}

/// An ellipsoid with three equal semi-axes is a sphere.
#[test]
fn equal_semi_axes_make_a_sphere() {
    let mut random = Random::new(49, 2, 0);
    let mut touched = 0;
    for case in 0..samples(20_000) {
        let body = Body::random(&mut random, 10.0);
        let radius = random.log_between(0.05, 1.0);
        let center = body.center() + random.direction() * random.between(0.0, 1.5);
        let ellipsoid = Ellipsoid { center, axes: random.rotation_matrix(), semi_axes: Vec3::repeat(radius) };
        let ball = Sphere { center, radius };
        let expected = match &body {
            Body::Round(Solid::Capsule(capsule)) => ball_capsule(&ball, capsule),
            Body::Round(Solid::Frustum(frustum)) => ball_frustum(&ball, frustum),
            Body::Egg(egg) => sphere_ellipsoid(&ball, egg),
            Body::Ball(other) => {
                let arm = center - other.center;
                let depth = radius + other.radius - arm.norm();
                let normal = arm.normalize();
                (depth > 0.0).then(|| Interference {
                    depth,
                    normal_b: normal,
                    deepest_b: center - normal * radius,
                    feature: pong_geometry::interference::Feature::WHOLE,
                })
            }
        };
        let found = body.touched_by(&ellipsoid);
        let (Some(expected), Some(found)) = (expected, found) else {
            let least = [expected, found].into_iter().flatten().map(|c| c.depth).fold(0.0, f64::max);
            assert!(least < 1e-13, "case {case}: {expected:?} {found:?} {body:?}");
            continue;
        };
        touched += 1;
        assert!((found.depth - expected.depth).abs() < 1e-13, "case {case}: {found:?} {expected:?} {body:?}");
        // Deep inside, several ways out may be equally short.
        if expected.depth < 0.99 * radius {
            let turned = (found.normal_b - expected.normal_b).norm();
            assert!(turned < 1e-7, "case {case}: {found:?} {expected:?} {body:?} {ellipsoid:?}");
        }
    }
    assert!(touched > samples(20_000) / 4, "{touched}");
}

/// Contacts whose depths are known in closed form.
#[test]
fn aligned_bodies_overlap_by_the_sum_of_their_half_widths() {
    let egg = |center: Vec3, semi_axes: Vec3| Ellipsoid { center, axes: Mat3::identity(), semi_axes };
    let a = egg(Vec3::new(0.0, 0.0, 0.55), Vec3::new(0.3, 0.2, 0.1));
    let b = egg(Vec3::zeros(), Vec3::new(1.0, 0.6, 0.5));
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    close(ellipsoid_ellipsoid(&a, &b).unwrap().depth, 0.05);
    let capsule = Capsule { ends: [Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)], radius: 0.5 };
    let on_capsule = ellipsoid_capsule(&a, &capsule).unwrap();
    close(on_capsule.depth, 0.05);
    close((on_capsule.normal_b - Vec3::z()).norm(), 0.0);
    let lying = Frustum::new(capsule.ends, [0.5; 2]);
    close(ellipsoid_frustum(&a, &lying).unwrap().depth, 0.05);
    let standing = Frustum::new([Vec3::new(0.1, 0.0, -0.5), Vec3::new(0.1, 0.0, 0.5)], [0.5; 2]);
    let on_end = ellipsoid_frustum(&a, &standing).unwrap();
    close(on_end.depth, 0.05);
    close((on_end.deepest_b - Vec3::new(0.0, 0.0, 0.45)).norm(), 0.0);
    // Concentric: out over the shortest axes.
    let inside = ellipsoid_ellipsoid(&egg(Vec3::zeros(), a.semi_axes), &b).unwrap();
    close(inside.depth, 0.6);
    close(inside.normal_b.z.abs(), 1.0);
    // A sphere beside the end of the long axis, where the radius of curvature is 0.25/1.
    let ball = Sphere { center: Vec3::new(1.2, 0.0, 0.0), radius: 0.25 };
    close(sphere_ellipsoid(&ball, &b).unwrap().depth, 0.05);
}

/// The wrench of the spring is the derivative of its energy: the contact's normal, at its place, tells how the depth
/// changes with each of the six displacements of the ellipsoid.
#[test]
fn the_wrench_is_the_derivative_of_the_energy() {
    const STEP: f64 = 1e-6;
    let mut random = Random::new(49, 3, 0);
    let (mut tested, mut worst) = (0, 0.0_f64);
    for case in 0..samples(4000) {
        let body = Body::random(&mut random, 5.0);
        let ellipsoid = random_touch(&mut random, &body, 5.0);
        let Some(contact) = body.touched_by(&ellipsoid) else { continue };
        let about = ellipsoid.center;
        let moment = (contact.deepest_b - about).cross(&contact.normal_b);
        let depth_at = |x: &Transform| {
            let moved = ellipsoid.carried(&Transform { rotation: Mat3::identity(), translation: -about });
            let mut moved = moved.carried(x);
            moved.center += about;
            body.touched_by(&moved).map(|c| (c.depth, c.normal_b))
        };
        for index in 0..6 {
            let shifted = |step: f64| {
                let vector = Vec3::ith(index % 3, step);
                depth_at(&if index < 3 {
                    Transform { rotation: Mat3::identity(), translation: vector }
                } else {
                    let rotation = pong_geometry::Quat::from_scaled_axis(vector).to_rotation_matrix();
                    Transform { rotation: *rotation.matrix(), translation: Vec3::zeros() }
                })
            };
            let (Some((more, n1)), Some((less, n2))) = (shifted(STEP), shifted(-STEP)) else { continue };
            // Where the way out changes between the two, the depth has a kink.
            if n1.dot(&n2) < 0.999 {
                continue;
            }
            let slope = -(more - less) / (2.0 * STEP);
            let expected = if index < 3 { contact.normal_b[index] } else { moment[index - 3] };
            let kinked = (n1 - n2).norm() > 1e-3;
            if !kinked {
                worst = worst.max((slope - expected).abs());
                assert!((slope - expected).abs() < 2e-6, "case {case}, {index}: {slope} {expected} {body:?}");
                tested += 1;
            }
        }
    }
    println!("{tested} derivatives, worst {worst:.1e}");
    assert!(tested > samples(4000) * 3);
}

/// Two ellipsoids exchanged give the same depth and the opposite normal; a moved, turned or scaled pair gives the same
/// contact.
#[test]
fn exchanging_moving_and_scaling_change_nothing() {
    let mut random = Random::new(49, 4, 0);
    for case in 0..samples(4000) {
        let body = Body::random(&mut random, 20.0);
        let ellipsoid = random_touch(&mut random, &body, 20.0);
        let Some(contact) = body.touched_by(&ellipsoid) else { continue };
        if let Body::Egg(other) = &body {
            let back = ellipsoid_ellipsoid(other, &ellipsoid).expect("both overlap");
            assert!((back.depth - contact.depth).abs() < 1e-10, "case {case}: {back:?} {contact:?}");
        }
        let x = random_motion(&mut random, 3.0);
        let moved = body.carried(&x).touched_by(&ellipsoid.carried(&x)).expect("still overlaps");
        assert!((moved.depth - contact.depth).abs() < 1e-11, "case {case}: {moved:?} {contact:?} {body:?}");
        let factor = random.log_between(1e-6, 1e6);
        let larger = body.scaled(factor).touched_by(&scaled_ellipsoid(&ellipsoid, factor)).expect("overlaps");
        assert!((larger.depth / factor - contact.depth).abs() < 1e-11, "case {case}: {larger:?} {contact:?}");
    }
}
