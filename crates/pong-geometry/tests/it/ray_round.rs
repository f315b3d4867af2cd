//! Rays into capsules, cylinders and cones: entry by bisection, from the definition of the solid alone;
//! normals by the support function; limits of length and reach; and invariances.

use crate::common::{hull, random_motion};
use crate::round_support::Solid;
use pong_geometry::interference::ray_plane::{RayHit, ray_contact};
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_round::{ray_capsule, ray_ellipsoid, ray_frustum, ray_sphere};
use pong_geometry::primitive::{Capsule, Ellipsoid, Frustum, Ray, RayResponse, Sphere};
use pong_geometry::{Quat, Transform, Vec3};
use pong_testkit::Random;

fn random_solid(random: &mut Random) -> Solid {
    let one = random.direction() * random.between(0.0, 0.5);
    let ends = [one, one + random.direction() * random.between(0.05, 1.5)];
    let radius = random.between(0.05, 0.7);
    match random.below(4) {
        0 => Solid::Capsule(Capsule { ends, radius }),
        1 => Solid::Frustum(Frustum::new(ends, [radius; 2])),
        2 => Solid::Frustum(Frustum::new(ends, [radius, random.between(0.05, 0.7)])),
        _ => Solid::Frustum(Frustum::new(ends, [0.0, radius])),
    }
}

impl Solid {
    /// Signed function, negative inside and convex along every line, from the definition of the solid.
    fn outside(&self, place: &Vec3) -> f64 {
        match self {
            Self::Capsule(Capsule { ends: [a, b], radius }) => {
                let share = ((place - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
                (place - (a + (b - a) * share)).norm() - radius
            }
            Self::Frustum(Frustum { ends: [a, b], radii: [r, s], .. }) => {
                let axis = (b - a).normalize();
                let (length, along) = ((b - a).norm(), (place - a).dot(&axis));
                let aside = (place - a).cross(&axis).norm();
                (aside - (r + (s - r) * along / length)).max(-along).max(along - length)
            }
        }
    }

    fn hit(&self, ray: &Ray) -> Option<RayHit> {
        match self {
            Self::Capsule(capsule) => ray_capsule(ray, capsule),
            Self::Frustum(frustum) => ray_frustum(ray, frustum),
        }
    }
}

fn random_ray(random: &mut Random) -> Ray {
    Ray {
        origin: random.direction() * random.between(0.0, 2.0),
        direction: random.direction(),
        length: random.between(0.1, 4.0),
        reach: (random.below(2) == 0).then(|| random.between(0.0, 1.0)),
        response: RayResponse::Normal,
    }
}

/// Entry and exit of the ray's line, m from the origin, by ternary search and bisection.
fn passage(ray: &Ray, outside: impl Fn(&Vec3) -> f64) -> Option<[f64; 2]> {
    const FAR: f64 = 10.0;
    let at = |along: f64| outside(&(ray.origin + ray.direction * along));
    let (mut low, mut high) = (-FAR, FAR);
    for _ in 0..200 {
        let thirds = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if at(thirds[0]) < at(thirds[1]) { high = thirds[1] } else { low = thirds[0] }
    }
    let deepest = 0.5 * (low + high);
    if at(deepest) >= 0.0 {
        return None;
    }
    Some([-FAR, FAR].map(|far| {
        let (mut inside, mut outside) = (deepest, far);
        for _ in 0..100 {
            let middle = 0.5 * (inside + outside);
            if at(middle) < 0.0 { inside = middle } else { outside = middle }
        }
        0.5 * (inside + outside)
    }))
}

#[test]
fn the_entrance_is_where_the_line_comes_into_the_solid() {
    let mut random = Random::new(21, 0, 0);
    let (mut hits, mut behind) = (0, 0);
    for case in 0..20_000 {
        let (solid, ray) = (random_solid(&mut random), random_ray(&mut random));
        let found = solid.hit(&ray);
        let told = format!("case {case}: {found:?} {ray:?} {solid:?}");
        let Some([comes_in, goes_out]) = passage(&ray, |place| solid.outside(place)) else {
            assert!(found.is_none(), "{told}");
            continue;
        };
        // Grazing rays, and hits at a limit, are decided by rounding.
        let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
        let reach = ray.reach.unwrap_or(0.0);
        if close(comes_in, goes_out)
            || close(comes_in, -reach)
            || close(comes_in, ray.length)
            || close(goes_out, 0.0)
        {
            continue;
        }
        let expected = -reach < comes_in && comes_in < ray.length && goes_out > 0.0;
        assert_eq!(found.is_some(), expected, "{told} {comes_in} {goes_out}");
        let Some(hit) = found else { continue };
        hits += 1;
        behind += usize::from(hit.distance < 0.0);
        let place = ray.origin + ray.direction * hit.distance;
        let slope = -ray.direction.dot(&hit.normal_b);
        assert!(slope > 0.0 && (hit.distance - comes_in).abs() * slope < 1e-13, "{told} {comes_in}");
        // The solid lies behind the plane of its surface there.
        let error = (solid.support(&hit.normal_b) - hit.normal_b.dot(&place)).abs();
        assert!((hit.normal_b.norm() - 1.0).abs() < 1e-14 && error < 1e-12 / slope, "{told} {error:e}");
    }
    assert!(hits > 1500 && behind > 50, "{hits} {behind}");
}

/// Spheres and ellipsoids of any slenderness: entry, normal there, and invariance under motions.
#[test]
fn the_entrance_into_balls_and_ellipsoids_is_where_the_line_comes_in() {
    let mut random = Random::new(24, 0, 0);
    let mut hits = 0;
    for case in 0..10_000 {
        let center = random.vector(0.5);
        let semi_axes = match case % 2 {
            0 => Vec3::repeat(random.between(0.05, 1.0)),
            _ => Vec3::from_fn(|_, _| random.between(0.05, 1.0)),
        };
        let axes = random.rotation_matrix();
        let ray = random_ray(&mut random);
        let in_axes = |place: &Vec3| axes.tr_mul(&(place - center));
        let ellipsoid = Ellipsoid { center, axes, semi_axes };
        let found = match case % 2 {
            0 => ray_sphere(&ray, &Sphere { center, radius: semi_axes.x }),
            _ => ray_ellipsoid(&ray, &ellipsoid),
        };
        let comes_through = passage(&ray, |place| in_axes(place).component_div(&semi_axes).norm() - 1.0);
        let told = format!("case {case}: {found:?} {ray:?} {ellipsoid:?}");
        let Some([comes_in, goes_out]) = comes_through else {
            assert!(found.is_none(), "{told}");
            continue;
        };
        let reach = ray.reach.unwrap_or(0.0);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
        let limits = [(comes_in, goes_out), (comes_in, -reach), (comes_in, ray.length), (goes_out, 0.0)];
        if limits.iter().any(|&(a, b)| close(a, b)) {
            continue;
        }
        let expected = -reach < comes_in && comes_in < ray.length && goes_out > 0.0;
        assert_eq!(found.is_some(), expected, "{told}");
        let Some(hit) = found else { continue };
        hits += 1;
        let place = ray.origin + ray.direction * hit.distance;
        let gradient = in_axes(&place).component_div(&semi_axes.component_mul(&semi_axes));
        let outward = (axes * gradient).normalize();
        let slope = -ray.direction.dot(&outward);
        assert!((hit.distance - comes_in).abs() * slope < 1e-12, "{told} {comes_in}");
        assert!((hit.normal_b - outward).norm() * slope < 1e-11, "{told} {outward}");
    }
    assert!(hits > 800, "{hits}");
}

/// A tapered plunger's tip is as deep below the surface as its ray is pushed in.
#[test]
fn depths_are_those_below_the_surface_that_is_hit() {
    let ray = |response| Ray {
        origin: Vec3::new(0.2, -0.5, 1.0),
        direction: Vec3::new(0.0, 0.6, -0.8),
        length: 1.0,
        reach: None,
        response,
    };
    let cylinder = Frustum::new([-Vec3::x(), Vec3::x()], [0.5; 2]);
    let hit = ray_frustum(&ray(RayResponse::Normal), &cylinder).unwrap();
    // (0.6t − 0.5)² + (1 − 0.8t)² = 0.25
    let distance = 1.1 - 0.21_f64.sqrt();
    assert!((hit.distance - distance).abs() < 1e-15);
    let place = Vec3::new(0.0, 0.6 * distance - 0.5, 1.0 - 0.8 * distance) * 2.0;
    assert!((hit.normal_b - place).norm() < 1e-14);
    let contact = ray_contact(&ray(RayResponse::Normal), &hit);
    let slope = 0.8 * place.z - 0.6 * place.y;
    assert!((contact.depth - (1.0 - distance) * slope).abs() < 1e-14);
    let axial = ray_contact(&ray(RayResponse::Axial), &hit);
    assert!((axial.depth - (1.0 - hit.distance)).abs() < 1e-15);
}

/// Rays along the axis, along the lateral surface, across an apex, through a rim, in the plane of an end.
#[test]
fn what_lies_along_the_solid_is_decided_alike() {
    let cylinder = Frustum::new([Vec3::zeros(), Vec3::z()], [0.5; 2]);
    let cone = Frustum::new([Vec3::zeros(), Vec3::z()], [0.5, 0.0]);
    let log = Capsule { ends: [Vec3::zeros(), Vec3::z()], radius: 0.5 };
    let ray = |origin, direction: Vec3| Ray {
        origin,
        direction: direction.normalize(),
        length: 10.0,
        reach: None,
        response: RayResponse::Normal,
    };
    let distance = |hit: Option<RayHit>| hit.map(|hit| (hit.distance, hit.normal_b));
    let down = ray(Vec3::z() * 3.0, -Vec3::z());
    assert_eq!(distance(ray_frustum(&down, &cylinder)), Some((2.0, Vec3::z())));
    assert_eq!(distance(ray_capsule(&down, &log)), Some((1.5, Vec3::z())));
    let on_tip = ray_frustum(&down, &cone).unwrap();
    assert!((on_tip.distance - 2.0).abs() < 1e-12 && on_tip.normal_b.z > 0.0);
    for (from, way) in [
        (Vec3::new(0.5, 0.0, 3.0), -Vec3::z()),
        (Vec3::new(3.0, 0.5, 0.3), -Vec3::x()),
        (Vec3::new(3.0, 0.0, 1.0), -Vec3::x()),
    ] {
        assert_eq!(distance(ray_frustum(&ray(from, way), &cylinder)), None, "{from} grazes");
    }
    assert_eq!(distance(ray_capsule(&ray(Vec3::new(3.0, 0.5, 0.3), -Vec3::x()), &log)), None);
    // Along a generator of the cone, and beside it.
    let generator = Vec3::new(-0.5, 0.0, 1.0);
    assert_eq!(distance(ray_frustum(&ray(Vec3::new(1.0, 0.0, -1.0), generator), &cone)), None);
    let beside = ray_frustum(&ray(Vec3::new(0.9, 0.0, -1.0), generator), &cone).unwrap();
    assert_eq!(beside.normal_b, -Vec3::z());
    let rim = ray_frustum(&ray(Vec3::new(1.5, 0.0, 2.0), Vec3::new(-1.0, 0.0, -1.0)), &cylinder).unwrap();
    assert_eq!((rim.normal_b, rim.feature.index()), (Vec3::x(), 0));
}

#[test]
fn no_pose_no_scale_and_no_naming_of_ends_changes_anything() {
    let mut random = Random::new(22, 0, 0);
    let mut compared = 0;
    for _ in 0..5000 {
        let (solid, ray) = (random_solid(&mut random), random_ray(&mut random));
        let Some(hit) = solid.hit(&ray) else { continue };
        let slope = -ray.direction.dot(&hit.normal_b);
        if slope < 1e-2 {
            continue;
        }
        compared += 1;
        let close = |solid: Solid, ray: Ray, turn: &Transform, factor: f64, limit: f64, what: &str| {
            let other = solid.hit(&ray).unwrap_or_else(|| panic!("{what}: {solid:?} {ray:?}"));
            let off = (other.distance / factor - hit.distance).abs()
                + (other.normal_b - turn.rotation * hit.normal_b).norm();
            assert!(off < limit, "{what}: {off:e} {solid:?} {ray:?}");
        };
        let x = random_motion(&mut random, 3.0);
        // In another frame, rounding of the direction moves the entry of a grazing ray.
        close(solid.carried(&x), ray.carried(&x), &x, 1.0, 1e-10, "moved");
        let still = Transform { rotation: nalgebra::Matrix3::identity(), translation: Vec3::zeros() };
        let [a, b] = solid.ends();
        let own = Quat::from_scaled_axis((b - a).normalize() * random.between(0.0, 6.0)).to_rotation_matrix();
        let own = Transform { rotation: own.into_inner(), translation: a - own * a };
        close(solid.carried(&own), ray, &still, 1.0, 1e-11, "turned about its own axis");
        close(solid.swapped(), ray, &still, 1.0, 1e-11, "ends exchanged");
        for factor in [1e-6, 1e6] {
            let scaled = Ray {
                origin: ray.origin * factor,
                length: ray.length * factor,
                reach: ray.reach.map(|reach| reach * factor),
                ..ray
            };
            close(solid.scaled(factor), scaled, &still, factor, 1e-10, "scaled");
        }
    }
    assert!(compared > 300, "{compared}");
}

/// A ray from far away meets the same point, up to the rounding of its direction.
#[test]
fn rays_from_far_away_keep_their_digits() {
    let mut random = Random::new(23, 0, 0);
    for _ in 0..2000 {
        let solid = random_solid(&mut random);
        let ray = Ray { reach: None, length: 100.0, ..random_ray(&mut random) };
        let Some(hit) = solid.hit(&ray) else { continue };
        let back = 1e6;
        let far = Ray { origin: ray.origin - ray.direction * back, length: ray.length + back, ..ray };
        let slope = -ray.direction.dot(&hit.normal_b);
        if slope < 0.05 {
            continue;
        }
        let other = solid.hit(&far).expect("the same line");
        assert!(
            (other.distance - back - hit.distance).abs() < 1e-7,
            "{} {}",
            other.distance - back,
            hit.distance
        );
    }
}

/// A line through the tip of a cone, or past it by less than rounding, enters there.
#[test]
fn a_line_through_a_tip_enters_at_the_tip() {
    let mut random = Random::new(25, 0, 0);
    for index in 0..2000 {
        let (tip, way) = (random.direction() * random.between(0.0, 2.0), random.direction());
        let (length, radius) = (random.between(0.05, 1.5), random.between(0.01, 0.7));
        let base = tip + way * length;
        let cone = match index % 2 {
            0 => Frustum::new([tip, base], [0.0, radius]),
            _ => Frustum::new([base, tip], [radius, 0.0]),
        };
        // Within the cone behind the tip.
        let aside = way.cross(&random.direction()) * (0.8 * radius / length);
        let direction = (way + aside).normalize();
        let past = direction.cross(&random.direction()) * random.log_between(1e-18, 1e-12);
        let ray = Ray {
            origin: tip + past - direction,
            direction,
            length: 2.0,
            reach: None,
            response: RayResponse::Normal,
        };
        let hit = ray_frustum(&ray, &cone).expect("through the tip");
        let steep = length / radius + radius / length;
        assert!((hit.distance - 1.0).abs() < (2e-15 + 20.0 * past.norm()) * steep, "{}", hit.distance - 1.0);
        let is_upright = (hit.normal_b + way).norm() < 1e-12;
        assert!(is_upright || past.norm() > 1e-16, "{:?} {:e}", hit.normal_b, past.norm());
    }
}

#[test]
fn prisms_of_many_sides_come_closer_as_the_square_of_their_number() {
    let mut random = Random::new(24, 0, 0);
    let (first, last) = (0.4, 0.25);
    let cone = Frustum::new([Vec3::zeros(), Vec3::z()], [first, last]);
    let prisms = [32, 64, 128].map(|sides| {
        let corners: Vec<Vec3> = (0..sides)
            .flat_map(|side| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(side) / f64::from(sides)).sin_cos();
                [(first, 0.0), (last, 1.0)].map(|(r, z)| Vec3::new(r * cos, r * sin, z))
            })
            .collect();
        hull(&corners)
    });
    let mut worst = [0.0_f64; 3];
    for _ in 0..300 {
        let target =
            Vec3::new(random.between(-0.15, 0.15), random.between(-0.15, 0.15), random.between(0.1, 0.9));
        let direction = random.direction();
        let ray = Ray {
            origin: target - direction * 3.0,
            direction,
            length: 10.0,
            reach: None,
            response: RayResponse::Normal,
        };
        let expected = ray_frustum(&ray, &cone).unwrap();
        for (worst, prism) in worst.iter_mut().zip(&prisms) {
            let found = ray_polyhedron(&ray, prism).unwrap();
            *worst = worst.max((found.distance - expected.distance).abs());
        }
    }
    let falls = [worst[0] / worst[1], worst[1] / worst[2]];
    assert!(falls.iter().all(|fall| (3.0..5.0).contains(fall)), "{worst:?}");
}
