//! Shape queries of the fitters (support, farthest distance, representative points) compared with the points
//! of the shapes.

use crate::bounding_support::{KINDS, Random, tricky_direction};
use crate::common::{fibonacci_sphere, stretched_hull};
use pong_geometry::bounding::{
    BoundKind, Bounded, CustomBounds, CustomVolume, Dilated, PointCloud, Volume, fit,
};
use pong_geometry::extension::Extensions;
use pong_geometry::primitive::{
    CustomPrimitive, Ellipsoid, LineSegment, Plane, Point, Polyhedron, Ray, RayResponse, Sphere,
};
use pong_geometry::{Mat3, Vec3};
use std::sync::Arc;

/// Shape and points of it that include the extreme ones, up to the relative error `missed`.
struct Known<'a> {
    name: &'static str,
    thing: &'a dyn Bounded,
    points: Vec<Vec3>,
    missed: f64,
    stand_for_it: Vec<Vec3>,
}

/// Post that stands on the plane z = 0 without an upper end, or hangs from it without a lower end.
#[derive(Debug)]
struct Post {
    up: f64,
}

impl CustomPrimitive for Post {
    fn kind_name(&self) -> &str {
        "Post"
    }
    fn support(&self, direction: &Vec3) -> f64 {
        if direction.z * self.up > 0.0 { f64::INFINITY } else { direction.xy().abs().sum() }
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

/// Sphere that provides only its support function, as primitive and as volume.
#[derive(Debug)]
struct Told(Sphere);

impl CustomPrimitive for Told {
    fn kind_name(&self) -> &str {
        "Told"
    }
    fn support(&self, direction: &Vec3) -> f64 {
        self.0.support(direction)
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

impl CustomVolume for Told {
    fn kind_name(&self) -> &str {
        "Told"
    }
    fn support(&self, direction: &Vec3) -> f64 {
        self.0.support(direction)
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

const CENTER: Vec3 = Vec3::new(0.5, -2.0, 1.25);
const HALF: Vec3 = Vec3::new(0.25, 0.5, 1.5);
const RADIUS: f64 = 0.75;
/// Tens of units in the last place of positions some metres away, m; relative for quantities that do not
/// scale.
const ROUNDING: f64 = 1e-14;

fn along_axes(axes: &Mat3, reach: &Vec3) -> Vec<Vec3> {
    (0..3).flat_map(|i| [1.0, -1.0].map(|sign| CENTER + axes.column(i) * (sign * reach[i]))).collect()
}

fn corners(axes: &Mat3) -> Vec<Vec3> {
    let signs = [1.0, -1.0];
    let all = signs
        .into_iter()
        .flat_map(|x| signs.into_iter().flat_map(move |y| signs.map(|z| Vec3::new(x, y, z))));
    all.map(|sign| CENTER + axes * HALF.component_mul(&sign)).collect()
}

fn check(known: &Known<'_>, random: &mut Random) {
    let Known { name, thing, points, missed, stand_for_it } = known;
    let mut told = Vec::new();
    thing.representatives(&mut told);
    let near = |p: &Vec3, all: &[Vec3]| all.iter().any(|q| (p - q).norm() < ROUNDING);
    assert_eq!(told.len(), stand_for_it.len(), "{name}");
    assert!(told.iter().all(|p| near(p, stand_for_it)), "{name}: {told:?}");
    assert!(stand_for_it.iter().all(|p| near(p, &told)), "{name}: {told:?}");
    for _ in 0..300 {
        let direction = tricky_direction(random);
        let reached = points.iter().map(|p| direction.dot(p)).fold(f64::NEG_INFINITY, f64::max);
        let support = thing.support(&direction);
        assert!(support >= reached - ROUNDING, "{name}: support {support}, but {reached}");
        assert!(support <= reached + missed + ROUNDING, "{name}: support {support}, reached {reached}");
        let from = random.vector(1.0) * 4.0;
        let reached = points.iter().map(|p| (p - from).norm()).fold(0.0, f64::max);
        let farthest = thing.farthest(&from);
        assert!(farthest >= reached - ROUNDING, "{name}: farthest {farthest}, but {reached}");
        assert!(farthest <= reached + missed + ROUNDING, "{name}: farthest {farthest}, reached {reached}");
    }
}

#[test]
fn things_reach_as_far_as_their_points() {
    let mut random = Random(31);
    let axes = Random(32).rotation_matrix();
    let (one, other) = (Vec3::new(1.0, 2.0, -0.5), Vec3::new(-0.75, 0.25, 3.0));
    let (point, segment) = (Point { position: one }, LineSegment { ends: [one, other] });
    let ray = Ray {
        origin: one,
        direction: (other - one).normalize(),
        length: 2.0,
        reach: Some(0.5),
        response: RayResponse::Axial,
    };
    let ends = vec![one - ray.direction * 0.5, one + ray.direction * 2.0];
    let solid: Polyhedron = stretched_hull(20, Vec3::new(1.0, 0.7, 0.4));
    let vertices: Vec<Vec3> = solid.vertices.iter().map(|vertex| vertex.position).collect();
    let cloud = PointCloud(&vertices);
    let sphere = Sphere { center: CENTER, radius: RADIUS };
    let ellipsoid = Ellipsoid { center: CENTER, axes, semi_axes: HALF };
    let dilated = Dilated { thing: &segment, reach: RADIUS };
    let directions = fibonacci_sphere(20_000);
    let on_ball: Vec<Vec3> = directions.iter().map(|d| CENTER + d * RADIUS).collect();
    let on_ellipsoid = directions.iter().map(|d| CENTER + axes * HALF.component_mul(d)).collect();
    let round_ends = directions.iter().flat_map(|d| [one + d * RADIUS, other + d * RADIUS]).collect();
    let aabb = Volume::Aabb { center: CENTER, half: HALF };
    let obb = Volume::Obb { center: CENTER, axes, half: HALF };
    let ball = Volume::Sphere { center: CENTER, radius: RADIUS };
    let six = along_axes(&Mat3::identity(), &Vec3::repeat(RADIUS));
    let known = |name, thing, points: &[Vec3]| Known {
        name,
        thing,
        points: points.to_vec(),
        missed: 0.0,
        stand_for_it: points.to_vec(),
    };
    // Twenty thousand directions miss the extreme one by at most 0.02 rad: 2e-4 of the size, squared.
    let curved =
        |name, thing, points, stand_for_it| Known { name, thing, points, missed: 3e-4, stand_for_it };
    let all = [
        known("Point", &point, &[one]),
        known("LineSegment", &segment, &[one, other]),
        known("Ray", &ray, &ends),
        known("Polyhedron", &solid, &vertices),
        known("PointCloud", &cloud, &vertices),
        known("volume Aabb", &aabb, &corners(&Mat3::identity())),
        known("volume Obb", &obb, &corners(&axes)),
        curved("Sphere", &sphere, on_ball.clone(), six.clone()),
        curved("volume Sphere", &ball, on_ball, six),
        curved("Ellipsoid", &ellipsoid, on_ellipsoid, along_axes(&axes, &HALF)),
        curved("Dilated", &dilated, round_ends, vec![one, other]),
    ];
    all.iter().for_each(|known| check(known, &mut random));
}

/// The search for the farthest point of an ellipsoid does not depend on the unit of length.
#[test]
fn farthest_scales_with_the_scene() {
    let axes = Random(34).rotation_matrix();
    let mut random = Random(35);
    for _ in 0..100 {
        let from = random.vector(1.0) * 4.0;
        let farthest = |scale: f64| {
            let e = Ellipsoid { center: CENTER * scale, axes, semi_axes: HALF * scale };
            e.farthest(&(from * scale)) / scale
        };
        for scale in [f64::exp2(-20.0), f64::exp2(20.0)] {
            assert!((farthest(scale) / farthest(1.0) - 1.0).abs() < ROUNDING);
        }
    }
}

/// A shape that provides only its support is represented by its axis-aligned box.
#[test]
fn a_thing_of_ones_own_is_asked_for_six_supports() {
    let told = Told(Sphere { center: CENTER, radius: RADIUS });
    let as_primitive = CustomBounds(&told);
    let as_volume = Volume::Custom(Arc::new(Told(told.0)));
    let cube = Volume::Aabb { center: CENTER, half: Vec3::repeat(RADIUS) };
    let mut random = Random(33);
    let mut expected = Vec::new();
    cube.representatives(&mut expected);
    for thing in [&as_primitive as &dyn Bounded, &as_volume] {
        let mut corners = Vec::new();
        thing.representatives(&mut corners);
        assert_eq!(corners, expected);
        for _ in 0..100 {
            let direction = tricky_direction(&mut random);
            assert_eq!(thing.support(&direction), told.0.support(&direction));
            let from = random.vector(1.0) * 4.0;
            assert!((thing.farthest(&from) - cube.farthest(&from)).abs() < ROUNDING);
        }
    }
}

#[test]
fn what_has_no_end_is_infinitely_far() {
    let plane = Plane { normal: Vec3::z(), offset: 0.0 };
    for thing in [&plane as &dyn Bounded, &Volume::Unbounded] {
        let mut points = Vec::new();
        thing.representatives(&mut points);
        assert!(points.is_empty());
        assert_eq!(
            (thing.support(&Vec3::x()), thing.farthest(&Vec3::zeros())),
            (f64::INFINITY, f64::INFINITY)
        );
    }
}

#[test]
fn what_has_one_end_has_no_volume() {
    for up in [1.0, -1.0] {
        for kind in KINDS {
            let fitted = fit(&kind, &[&CustomBounds(&Post { up })], &Extensions::new());
            assert!(matches!(fitted, Ok(Volume::Unbounded)), "{kind:?}: {fitted:?}");
        }
    }
}

/// The squares of such numbers overflow: the result is an error, or a valid bound.
#[test]
fn what_is_beyond_all_squares_is_refused_or_bounded() {
    for size in [1e160, 1e300] {
        let points =
            [Vec3::new(size, 0.0, 0.0), Vec3::new(-size, 0.5 * size, 0.0), Vec3::new(0.0, 0.0, size)];
        for kind in KINDS {
            let Ok(volume) = fit(&kind, &[&PointCloud(&points)], &Extensions::new()) else { continue };
            for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
                let most = points.iter().map(|p| p.dot(&axis)).fold(0.0, f64::max);
                assert!(volume.support(&axis) >= most, "{kind:?} {size}: {volume:?}");
            }
        }
        let ball = fit(&BoundKind::Sphere, &[&PointCloud(&points)], &Extensions::new());
        assert!(ball.is_err_and(|cause| cause.contains("not finite")));
    }
}
