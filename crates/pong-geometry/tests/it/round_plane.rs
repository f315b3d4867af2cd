//! Capsules, cylinders and cones on a plane: depths by support functions, wrenches as derivatives of the
//! stored energy, full spring for parts that stand or lie, and no steps while a part tilts through upright.

use crate::common::random_motion;
use crate::round_support::Solid;
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::Interference;
use pong_geometry::interference::round_plane::{capsule_plane, frustum_plane};
use pong_geometry::primitive::{Capsule, Frustum, Plane};
use pong_geometry::{Quat, Transform, Vec3};
use pong_testkit::Random;

/// Random solid, about 1 m in size, of any slenderness, near the origin.
fn random_solid(random: &mut Random) -> Solid {
    let one = random.direction() * random.between(0.0, 0.5);
    let ends = [one, one + random.direction() * random.between(0.05, 1.0)];
    let radius = random.between(0.05, 0.5);
    match random.below(3) {
        0 => Solid::Capsule(Capsule { ends, radius }),
        1 => Solid::Frustum(Frustum::new(ends, [radius; 2])),
        _ => Solid::Frustum(Frustum::new(
            ends,
            [radius, f64::from(random.below(3).min(1) as u32) * radius * 0.4],
        )),
    }
}

impl Solid {
    /// Solid rounded to single precision, as a model file holds it.
    fn rounded(&self) -> Self {
        let single = |v: Vec3| v.map(|x| f64::from(x as f32));
        match self {
            Self::Capsule(Capsule { ends, radius }) => {
                Self::Capsule(Capsule { ends: ends.map(single), radius: f64::from(*radius as f32) })
            }
            Self::Frustum(Frustum { ends, radii, .. }) => {
                Self::Frustum(Frustum::new(ends.map(single), radii.map(|r| f64::from(r as f32))))
            }
        }
    }

    fn touch_plane(&self, plane: &Plane) -> Vec<Interference> {
        match self {
            Self::Capsule(capsule) => capsule_plane(capsule, plane).into_iter().flatten().collect(),
            Self::Frustum(frustum) => frustum_plane(frustum, plane).into_iter().flatten().collect(),
        }
    }
}

/// Energy with a stiffness of 1 N/m, half of it at each point.
fn energy(contacts: &[Interference]) -> f64 {
    contacts.iter().map(|contact| 0.25 * contact.depth * contact.depth).sum()
}

/// Force and moment about a point, with a stiffness of 1 N/m.
fn wrench(contacts: &[Interference], about: &Vec3) -> (Vec3, Vec3) {
    contacts.iter().fold((Vec3::zeros(), Vec3::zeros()), |(force, moment), contact| {
        let one = contact.normal_b * (0.5 * contact.depth);
        (force + one, moment + (contact.deepest_b - about).cross(&one))
    })
}

fn deepest(contacts: &[Interference]) -> f64 {
    contacts.iter().map(|contact| contact.depth).fold(0.0, f64::max)
}

fn turned(axis: Vec3, about: &Vec3) -> Transform {
    let rotation = Quat::from_scaled_axis(axis).to_rotation_matrix().into_inner();
    Transform { rotation, translation: about - rotation * about }
}

fn floor() -> Plane {
    Plane { normal: Vec3::z(), offset: 0.0 }
}

/// Cylinder or cone that stands on its end 0, with the middle of the disc at a height, m.
fn standing(radii: [f64; 2], height: f64) -> Frustum {
    Frustum::new([Vec3::new(0.3, -0.2, height), Vec3::new(0.3, -0.2, height + 1.0)], radii)
}

#[test]
fn the_deepest_place_is_the_least_translation() {
    let mut random = Random::new(11, 0, 0);
    let mut touching = 0;
    for _ in 0..5000 {
        let part = random_solid(&mut random);
        let plane = Plane { normal: random.direction(), offset: random.between(-0.7, 0.7) };
        for part in [part, part.rounded()] {
            let expected = plane.offset + part.support(&-plane.normal);
            let found = deepest(&part.touch_plane(&plane));
            assert!((found - expected.max(0.0)).abs() < 1e-12, "{found} {expected} {part:?}");
            touching += usize::from(found > 0.0);
            for contact in part.touch_plane(&plane) {
                assert!((plane.height(&contact.deepest_b) + contact.depth).abs() < 1e-15);
            }
        }
    }
    assert!(touching > 4000, "{touching}");
}

/// The wrench is minus the derivative of the stored energy along any motion.
#[test]
fn wrenches_derive_from_the_stored_energy() {
    const STEP: f64 = 1e-6;
    let mut random = Random::new(12, 0, 0);
    let mut compared = 0;
    for case in 0..6000 {
        let mut part = random_solid(&mut random);
        let normal = random.direction();
        if case % 2 == 0 {
            // Nearly upright, where the lowest point moves around the rim.
            let radius = random.between(0.05, 0.5);
            let axis = (normal + random.direction() * 1e-3 * random.between(0.0, 1.0)).normalize();
            part = Solid::Frustum(Frustum::new([Vec3::zeros(), axis], [radius, 0.5 * radius]));
        }
        let depth = random.between(1e-3, 0.3) * if case % 4 == 0 { 1e-2 } else { 1.0 };
        let plane = Plane { normal, offset: depth - part.support(&-normal) };
        let (velocity, spin) = (random.direction(), random.direction());
        let about = part.ends()[0];
        let moved = |time: f64| {
            let mut x = turned(spin * time, &about);
            x.translation += velocity * time;
            energy(&part.carried(&x).touch_plane(&plane))
        };
        let (force, moment) = wrench(&part.touch_plane(&plane), &about);
        let power = force.dot(&velocity) + moment.dot(&spin);
        let slope = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
        compared += 1;
        assert!((power + slope).abs() < 2e-6, "{power} {slope} {part:?} {plane:?}");
    }
    assert_eq!(compared, 6000);
}

/// A part that stands on a disc or lies on its side carries kδ at the middle of the contact; a rim, an apex
/// or a sphere carries half of it.
#[test]
fn what_stands_or_lies_carries_its_spring_and_a_rim_half_of_it() {
    let mut random = Random::new(13, 0, 0);
    let depth = 1e-3;
    for _ in 0..300 {
        let x = random_motion(&mut random, 3.0);
        let plane =
            Plane { normal: x.rotation * Vec3::z(), offset: (x.rotation * Vec3::z()).dot(&x.translation) };
        let check = |part: Solid, force: f64, place: Vec3, what: &str| {
            let (found, moment) = wrench(&part.carried(&x).touch_plane(&plane), &x.point(&place));
            assert!((found - plane.normal * (force * depth)).norm() < 1e-14, "{what}: {found}");
            assert!(moment.norm() < 1e-14, "{what}: {moment}");
        };
        let ends = [Vec3::new(0.0, 0.0, 0.3 - depth), Vec3::new(0.8, 0.0, 0.3 - depth)];
        let middle = Vec3::new(0.4, 0.0, 0.0);
        check(Solid::Capsule(Capsule { ends, radius: 0.3 }), 1.0, middle, "capsule lies");
        check(Solid::Frustum(Frustum::new(ends, [0.3; 2])), 1.0, middle, "cylinder lies");
        let stands = standing([0.3, 0.1], -depth);
        check(Solid::Frustum(stands), 1.0, stands.ends[0], "stands");
        let on_tip = standing([0.0, 0.2], -depth);
        check(Solid::Frustum(on_tip), 0.5, on_tip.ends[0], "on its tip");
        let leaning = Quat::from_scaled_axis(Vec3::y() * 0.4) * Vec3::z();
        let rim = Vec3::new(leaning.z, 0.0, -leaning.x) * 0.2;
        let leans = [Vec3::z() * (-depth - rim.z), Vec3::z() * (-depth - rim.z) + leaning];
        check(Solid::Frustum(Frustum::new(leans, [0.2; 2])), 0.5, rim, "on its rim");
        let ball = [Vec3::z() * (0.2 - depth), Vec3::z() * (0.2 - depth) + leaning];
        check(Solid::Capsule(Capsule { ends: ball, radius: 0.2 }), 0.5, Vec3::zeros(), "on its ball");
        // A cone on its side touches along a line from the rim to the apex.
        let cone = Frustum::new([Vec3::zeros(), Vec3::x()], [0.5, 0.0]);
        let wall = Vec3::new(cone.wall[0], 0.0, -cone.wall[1]);
        let to_floor = nalgebra::Rotation3::rotation_between(&wall, &-Vec3::z()).unwrap().into_inner();
        let lying = Transform { rotation: to_floor, translation: Vec3::zeros() };
        let lowest = -Bounded::support(&cone.carried(&lying), &-Vec3::z());
        let lying = Transform { translation: -Vec3::z() * (lowest + depth), ..lying };
        let line = [Vec3::new(0.0, 0.0, -0.5), Vec3::x()].map(|place| lying.point(&place));
        check(Solid::Frustum(cone.carried(&lying)), 1.0, 0.5 * (line[0] + line[1]), "cone lies");
    }
}

/// A standing disc resists tilting equally in all directions, and the wrench is continuous when the lowest
/// point changes sides, and when it moves around the rim near upright.
#[test]
fn parts_tilt_through_upright_without_a_jump() {
    const STEP: f64 = 1e-7;
    let (radius, depth) = (0.3, 1e-4);
    let sweeps: [(&str, &dyn Fn(f64) -> Vec3); 3] = [
        ("through upright", &|at| Vec3::new(0.0, at, 0.0)),
        ("beside upright", &|at| Vec3::new(1e-9, at, 0.0)),
        ("until one side lifts off", &|at| Vec3::new(0.0, at + depth / radius, 0.0)),
    ];
    for radii in [[radius; 2], [radius, 0.1], [radius, 0.0]] {
        let part = standing(radii, -depth);
        let about = part.ends[0];
        for (name, tilt) in sweeps {
            let mut last: Option<(Vec3, Vec3)> = None;
            for step in -500..=500 {
                let x = turned(tilt(STEP * f64::from(step)), &about);
                let (force, moment) = wrench(&Solid::Frustum(part.carried(&x)).touch_plane(&floor()), &about);
                if let Some((earlier, earlier_moment)) = last {
                    let jump = (force - earlier).norm() / depth
                        + (moment - earlier_moment).norm() / (depth * radius);
                    assert!(jump < 4.0 * STEP * radius / depth, "{name}, {step}: {jump:e}");
                }
                last = Some((force, moment));
            }
        }
        let mut random = Random::new(14, 0, 0);
        for _ in 0..200 {
            let spin = random.direction().cross(&Vec3::z()).normalize() * random.between(1e-12, 1e-4);
            let (_, moment) =
                wrench(&Solid::Frustum(part.carried(&turned(spin, &about))).touch_plane(&floor()), &about);
            let expected = spin * (-radius * radius);
            let off = (moment - expected).norm();
            assert!(off < 1e-7 * expected.norm() + 1e-16, "{off:e} {spin}");
        }
    }
}

#[test]
fn turning_about_its_own_axis_and_naming_its_ends_changes_nothing() {
    let mut random = Random::new(15, 0, 0);
    for case in 0..3000 {
        let part = random_solid(&mut random);
        let [one, other] = part.ends();
        let axis = (other - one).normalize();
        // Standing upright and lying, too.
        let normal = [random.direction(), axis, axis.cross(&random.direction()).normalize()][case % 3];
        let plane = Plane { normal, offset: random.between(0.0, 0.1) - part.support(&-normal) };
        let (force, moment) = wrench(&part.touch_plane(&plane), &one);
        let close = |other: &Solid, what: &str| {
            let (f, m) = wrench(&other.touch_plane(&plane), &one);
            assert!((f - force).norm() + (m - moment).norm() < 1e-12, "{what}: {part:?}");
        };
        close(&part.carried(&turned(axis * random.between(0.0, 6.0), &one)), "turned");
        let swapped = match part {
            Solid::Capsule(Capsule { ends: [a, b], radius }) => {
                Solid::Capsule(Capsule { ends: [b, a], radius })
            }
            Solid::Frustum(Frustum { ends: [a, b], radii: [r, s], .. }) => {
                Solid::Frustum(Frustum::new([b, a], [s, r]))
            }
        };
        close(&swapped, "ends exchanged");
    }
}

#[test]
fn no_pose_and_no_scale_changes_anything() {
    let mut random = Random::new(16, 0, 0);
    for _ in 0..2000 {
        let part = random_solid(&mut random);
        let normal = random.direction();
        let plane = Plane { normal, offset: random.between(0.0, 0.1) - part.support(&-normal) };
        let about = part.ends()[0];
        let (force, moment) = wrench(&part.touch_plane(&plane), &about);
        let x = random_motion(&mut random, 3.0);
        let carried = x.rotation * normal;
        let moved = Plane { normal: carried, offset: plane.offset + carried.dot(&x.translation) };
        let (f, m) = wrench(&part.carried(&x).touch_plane(&moved), &x.point(&about));
        assert!((f - x.rotation * force).norm() + (m - x.rotation * moment).norm() < 1e-12);
        for factor in [1e-6, 1e6] {
            let scaled = Plane { normal, offset: plane.offset * factor };
            let (f, m) = wrench(&part.scaled(factor).touch_plane(&scaled), &(about * factor));
            assert!((f / factor - force).norm() + (m / (factor * factor) - moment).norm() < 1e-11);
        }
    }
}

/// The lowest corner of a prism of N sides converges to the lowest point of the cylinder as 1/N².
#[test]
fn prisms_of_many_sides_come_closer_as_the_square_of_their_number() {
    let mut random = Random::new(17, 0, 0);
    let (length, radius) = (1.0, 0.3);
    let mut worst = [0.0_f64; 3];
    for _ in 0..500 {
        let x = random_motion(&mut random, 1.0);
        let cylinder = Frustum::new([Vec3::zeros(), Vec3::z() * length], [radius; 2]).carried(&x);
        let depth = deepest(&frustum_plane(&cylinder, &floor()).into_iter().flatten().collect::<Vec<_>>());
        for (worst, sides) in worst.iter_mut().zip([32, 64, 128]) {
            let corners = (0..sides).flat_map(|side| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(side) / f64::from(sides)).sin_cos();
                [0.0, length].map(|z| x.point(&Vec3::new(radius * cos, radius * sin, z)))
            });
            let lowest = corners.map(|corner| corner.z).fold(f64::INFINITY, f64::min);
            *worst = worst.max(((-lowest).max(0.0) - depth).abs());
        }
    }
    let falls = [worst[0] / worst[1], worst[1] / worst[2]];
    assert!(falls.iter().all(|fall| (3.5..4.5).contains(fall)), "{worst:?}");
}
