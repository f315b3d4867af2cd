//! A fitted volume contains all shapes it was fitted around and is not much larger; fitting reports when it
//! is impossible.
//!
//! Degenerate cases: a single point, coincident points, needles, plates, a cube (no principal axes), an ellipsoid
//! seen from its own axis, a half space, nothing at all, not a number.

use crate::bounding_support::{
    Body, KINDS, Random, as_bounded, corner, fitted_bodies, tricky_direction, tricky_rotation,
};
use pong_geometry::bounding::{
    BoundKind, Bounded, CustomBounds, CustomVolume, Dilated, PointCloud, Volume, VolumeTests, aabb_of_points,
    fit,
};
use pong_geometry::extension::Extensions;
use pong_geometry::primitive::{
    CustomPrimitive, Ellipsoid, LineSegment, Plane, Point, Ray, RayResponse, Sphere,
};
use pong_geometry::{Transform, Vec3};
use std::sync::Arc;

fn fitted(kind: &BoundKind, thing: &dyn Bounded) -> Volume {
    fit(kind, &[thing], &Extensions::new()).expect("a good thing")
}

fn contains(volume: &Volume, p: &Vec3) -> bool {
    match volume {
        Volume::Unbounded => true,
        Volume::Aabb { center, half } => (0..3).all(|i| (p[i] - center[i]).abs() <= half[i]),
        Volume::Sphere { center, radius } => (p - center).norm() <= *radius,
        Volume::Obb { center, axes, half } => {
            let q = axes.tr_mul(&(p - center));
            (0..3).all(|i| q[i].abs() <= half[i])
        }
        Volume::Custom(_) => unreachable!(),
    }
}

fn measure(volume: &Volume) -> f64 {
    match volume {
        Volume::Aabb { half, .. } | Volume::Obb { half, .. } => 8.0 * half.product(),
        Volume::Sphere { radius, .. } => *radius,
        _ => f64::INFINITY,
    }
}

#[test]
fn no_point_is_lost() {
    let mut random = Random(21);
    for fitted in fitted_bodies(&mut random, 1000) {
        for _ in 0..200 {
            let p = fitted.body.extreme(&tricky_direction(&mut random));
            for volume in &fitted.volumes {
                assert!(contains(volume, &p), "{volume:?} lost {p:?}");
            }
        }
    }
}

#[test]
fn axis_aligned_box_is_exact() {
    let points = [Vec3::new(1.0, -2.0, 0.0), Vec3::new(3.0, 5.0, 0.5), Vec3::new(2.0, 0.0, -0.5)];
    let direct = aabb_of_points(points).expect("points");
    let Volume::Aabb { center, half } = fitted(&BoundKind::Aabb, &PointCloud(&points)) else { panic!() };
    assert!(matches!(direct, Volume::Aabb { center: c, half: h } if c == center && h == half));
    assert!((center - Vec3::new(2.0, 1.5, 0.0)).norm() < 1e-14);
    assert!((half - Vec3::new(1.0, 3.5, 0.5)).norm() < 1e-10);
    assert!(aabb_of_points([]).is_none());
}

#[test]
fn sphere_is_nearly_the_smallest() {
    let (mut random, mut sum) = (Random(22), 0.0);
    for _ in 0..300 {
        // Four points on a sphere whose hull contains the centre, and many points inside.
        let center = random.vector(1.0);
        let turn = tricky_rotation(&mut random);
        let tetrahedron = [0, 3, 5, 6].map(|i| center + turn * corner(i, &Vec3::repeat(1.0 / 3f64.sqrt())));
        let mut points = tetrahedron.to_vec();
        points.extend((0..30).map(|_| center + tricky_direction(&mut random) * random.unit()));
        let radius = measure(&fitted(&BoundKind::Sphere, &PointCloud(&points)));
        assert!((1.0 - 1e-12..1.004).contains(&radius), "radius {radius}");
        sum += radius;
    }
    assert!(sum / 300.0 < 1.0006, "{}", sum / 300.0);
    let pair = [Sphere { center: Vec3::x() * 2.0, radius: 3.0 }, Sphere { center: -Vec3::x(), radius: 0.5 }];
    let ball = fit(&BoundKind::Sphere, &as_bounded(&pair), &Extensions::new()).expect("two balls");
    assert!((measure(&ball) / 3.25 - 1.0).abs() < 1e-3, "{ball:?}");
}

#[test]
fn oriented_box_finds_turned_boxes() {
    let mut random = Random(23);
    let worst_over = |half: Vec3, random: &mut Random| {
        let excess = |_| {
            // At the origin and far from it.
            let place = tricky_direction(random) * random.pick(&[0.0, 1000.0]);
            let turn = tricky_rotation(random);
            let points: Vec<_> = (0..8).map(|i| place + turn * corner(i, &half)).collect();
            measure(&fitted(&BoundKind::Obb, &PointCloud(&points))) / (8.0 * half.product())
        };
        (0..200).map(excess).fold(0.0, f64::max)
    };
    let shapes = [[1.0, 2.0, 3.0], [1.0, 1.0, 30.0], [1e-3, 2.0, 3.0], [1e-3, 2.0, 2.0], [1.0, 1.0, 1.0]];
    for shape in shapes {
        let worst = worst_over(Vec3::from(shape), &mut random);
        assert!(worst < 1.001, "{shape:?}: {worst}");
    }
}

#[test]
fn farthest_point_of_an_ellipsoid_is_bounded_tightly() {
    let mut random = Random(24);
    for _ in 0..300 {
        let semi_axes = Vec3::from_fn(|_, _| random.log_between(1e-2, 1.0));
        let ellipsoid =
            Ellipsoid { center: random.vector(1.0), axes: tricky_rotation(&mut random), semi_axes };
        let from = match random.below(3) {
            0 => ellipsoid.center,
            1 => ellipsoid.center + ellipsoid.axes.column(random.below(3)) * random.between(-1.0, 1.0),
            _ => random.vector(1.0) * 2.0,
        };
        let bound = ellipsoid.farthest(&from);
        // Ascent from many starts: the point farthest along the direction of the previous one.
        let climb = |start: Vec3| {
            let distance = |d: &Vec3| (ellipsoid.support(d) - from).norm();
            (0..200).fold(start, |d, _| (ellipsoid.support(&d) - from).normalize()).pipe(distance)
        };
        let reached = (0..20).map(|_| climb(tricky_direction(&mut random))).fold(0.0, f64::max);
        assert!(bound >= reached * (1.0 - 1e-14), "{bound} {reached}");
        assert!(bound <= reached * (1.0 + 1e-4), "{bound} {reached} {ellipsoid:?} {from:?}");
    }
}

trait Pipe: Sized {
    fn pipe<T>(self, f: impl Fn(&Self) -> T) -> T {
        f(&self)
    }
}
impl Pipe for Vec3 {}

#[test]
fn rays_reach_back_and_dilation_reaches_out() {
    let ray = |reach| Ray {
        origin: Vec3::x(),
        direction: Vec3::x(),
        length: 2.0,
        reach,
        response: RayResponse::Normal,
    };
    assert_eq!((ray(None).support(&Vec3::x()), ray(None).support(&-Vec3::x())), (3.0, -1.0));
    assert_eq!(ray(Some(1.5)).support(&-Vec3::x()), 0.5);
    let point = Point { position: Vec3::y() };
    let grown = Dilated { thing: &point, reach: 0.25 };
    assert_eq!((grown.support(&Vec3::y()), grown.farthest(&Vec3::zeros())), (1.25, 1.25));
    let segment = LineSegment { ends: [Vec3::zeros(), Vec3::new(3.0, 4.0, 0.0)] };
    assert_eq!((segment.support(&Vec3::y()), segment.farthest(&Vec3::zeros())), (4.0, 5.0));
}

#[test]
fn a_half_space_is_unbounded_and_overlaps_everything() {
    let plane = Plane { normal: Vec3::z(), offset: 0.0 };
    let ball = Sphere { center: Vec3::zeros(), radius: 1.0 };
    let tests = VolumeTests::default();
    let far = Transform { translation: Vec3::repeat(1e9), ..Transform::identity() };
    for kind in &KINDS {
        let all = fit(kind, &[&ball, &plane], &Extensions::new()).expect("unbounded is no error");
        assert!(matches!(all, Volume::Unbounded));
        assert!(tests.supports(all.kind_name(), kind.name()));
        let other = fitted(kind, &ball);
        assert!(tests.overlap(&all, &other, &far) && tests.overlap(&other, &all, &far));
        assert!(matches!(fitted(kind, &all), Volume::Unbounded), "and so is its parent");
    }
}

#[test]
fn what_cannot_be_bounded_is_refused() {
    let ext = Extensions::new();
    let bad = Sphere { center: Vec3::new(0.0, f64::NAN, 0.0), radius: 1.0 };
    let good = Sphere { center: Vec3::zeros(), radius: 1.0 };
    for kind in &KINDS {
        assert!(fit(kind, &[], &ext).is_err());
        assert!(fit(kind, &[&PointCloud(&[])], &ext).is_err());
        assert!(fit(kind, &[&good, &bad], &ext).is_err());
        assert!(fit(kind, &[&bad, &good], &ext).is_err());
    }
    let unknown = fit(&BoundKind::Custom("Slab".to_owned()), &[&good], &ext);
    assert!(unknown.is_err_and(|message| message.contains("Slab")));
}

#[test]
fn a_single_point_and_equal_points_have_volumes() {
    let place = Vec3::new(1.0, 2.0, 3.0);
    for kind in &KINDS {
        let body = Body::Points(vec![place; 5]);
        assert!(contains(&body.fit(kind), &place));
        assert!(contains(&fitted(kind, &Point { position: place }), &place));
    }
}

/// User-defined volume: the layer between two heights.
#[derive(Debug)]
struct Slab {
    low: f64,
    high: f64,
}

impl CustomVolume for Slab {
    fn kind_name(&self) -> &str {
        "Slab"
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

#[derive(Debug)]
struct Disc;

impl CustomPrimitive for Disc {
    fn kind_name(&self) -> &str {
        "Disc"
    }
    fn support(&self, direction: &Vec3) -> f64 {
        direction.xy().norm()
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

#[test]
fn a_custom_volume_is_fitted_and_tested_in_either_order() {
    let mut ext = Extensions::new();
    ext.add_volume(
        "Slab",
        Arc::new(|things| {
            let most =
                |direction: Vec3| things.iter().map(|t| t.support(&direction)).fold(f64::MIN, f64::max);
            Arc::new(Slab { low: -most(-Vec3::z()), high: most(Vec3::z()) })
        }),
    );
    ext.add_volume_test(
        "Slab",
        "Sphere",
        Arc::new(|slab, ball, x_ba| {
            let (Volume::Custom(slab), Volume::Sphere { center, radius }) = (slab, ball) else { panic!() };
            let slab = slab.as_any().downcast_ref::<Slab>().expect("a slab");
            let height = x_ba.inverse().point(center).z;
            height + radius >= slab.low && height - radius <= slab.high
        }),
    );
    let slab = fit(&BoundKind::Custom("Slab".to_owned()), &[&CustomBounds(&Disc)], &ext).expect("a slab");
    let ball = fitted(&BoundKind::Sphere, &Sphere { center: Vec3::zeros(), radius: 1.0 });
    let tests = VolumeTests::new(&ext);
    // From the slab's frame to the sphere's; a quarter turn about x, so that the inverse is a different
    // transform.
    let up = |height: f64| {
        let turn = pong_geometry::Quat::from_axis_angle(&Vec3::x_axis(), std::f64::consts::FRAC_PI_2);
        let rotation = turn.to_rotation_matrix().into_inner();
        Transform { rotation, translation: -(rotation * Vec3::new(0.3, 4.0, height)) }
    };
    assert!(tests.overlap(&slab, &ball, &up(0.9)) && tests.overlap(&ball, &slab, &up(0.9).inverse()));
    assert!(!tests.overlap(&slab, &ball, &up(1.1)) && !tests.overlap(&ball, &slab, &up(1.1).inverse()));
    assert!(tests.supports("Slab", "Sphere") && tests.supports("Sphere", "Slab"));
    assert!(!tests.supports("Slab", "Obb") && !tests.supports("Slab", "Slab"), "nobody registered these");
    let obb = fitted(&BoundKind::Obb, &Sphere { center: Vec3::zeros(), radius: 1.0 });
    assert!(tests.overlap(&slab, &obb, &up(9.0)), "without a test nothing is certainly apart");
    assert!(matches!(fitted(&BoundKind::Aabb, &slab), Volume::Unbounded), "it gives no support");
    let disc = CustomBounds(&Disc);
    assert!((measure(&fitted(&BoundKind::Sphere, &disc)) - 2f64.sqrt()).abs() < 1e-9, "by the box around it");
}

/// If a face pushes an ellipsoid, the foot of the deepest point lies within the reach of feet of the centre
/// along each axis, or within the ellipsoid's own extent: with the centre in front, in the plane, or behind
/// it by up to the smallest semi-axis.
#[test]
fn the_reach_of_feet_holds_every_foot() {
    let mut random = Random(77);
    let mut beside = 0;
    for _ in 0..20_000 {
        let semi_axes = Vec3::from_fn(|_, _| 0.05 + 0.95 * random.unit());
        let ellipsoid = Ellipsoid { center: Vec3::zeros(), axes: tricky_rotation(&mut random), semi_axes };
        let normal = tricky_direction(&mut random);
        let half_width = ellipsoid.half_width(&normal);
        let height = half_width - (half_width + semi_axes.min()) * random.unit();
        let foot = ellipsoid.support(&-normal) + normal * (half_width - height);
        assert!((normal.dot(&foot) + height).abs() < 1e-12, "in the plane");
        for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
            let own = ellipsoid.half_width(&axis);
            let along = axis.dot(&foot).abs();
            assert!(along <= own.max(ellipsoid.reach_of_feet()) * (1.0 + 1e-12), "{foot:?} of {semi_axes:?}");
            beside += usize::from(along > own);
        }
    }
    assert!(beside > 500, "only {beside} feet lie beside the extent");
}
