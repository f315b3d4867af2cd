//! Random bodies and poses for the tests of bounding volumes.

use pong_geometry::bounding::{BoundKind, Bounded, PointCloud, Volume, fit};
use pong_geometry::extension::Extensions;
use pong_geometry::primitive::{Ellipsoid, Sphere};
use pong_geometry::{Mat3, Quat, Transform, Vec3};

pub const KINDS: [BoundKind; 3] = [BoundKind::Aabb, BoundKind::Sphere, BoundKind::Obb];

pub use pong_testkit::Random;

/// Unit vector; one in four lies along an axis of the frame.
pub fn tricky_direction(random: &mut Random) -> Vec3 {
    if random.chance(0.25) {
        let mut axis = Vec3::zeros();
        axis[random.below(3)] = random.pick(&[1.0, -1.0]);
        return axis;
    }
    random.direction()
}

/// Random rotation; often one that leaves axes parallel, exactly or nearly.
pub fn tricky_rotation(random: &mut Random) -> Mat3 {
    let axis = nalgebra::Unit::new_normalize(tricky_direction(random));
    let angle = match random.below(4) {
        0 => random.below(4) as f64 * std::f64::consts::FRAC_PI_2,
        1 => random.log_between(1e-17, 1.0),
        _ => random.between(-1.0, 1.0) * std::f64::consts::PI,
    };
    Quat::from_axis_angle(&axis, angle).to_rotation_matrix().into_inner()
}

/// Body with known points, to be bounded.
pub enum Body {
    Points(Vec<Vec3>),
    Spheres(Vec<Sphere>),
    Ellipsoids(Vec<Ellipsoid>),
}

impl Body {
    /// Random body of 1e-4 to 1e4 m: round, flat, thin or degenerate, at or far from its frame's origin,
    /// aligned with the frame or not.
    pub fn random(random: &mut Random) -> Self {
        let scale = random.log_between(1e-4, 1e4);
        let offset = random.vector(1.0) * random.pick(&[0.0, scale, 1e3 * scale, 1e4]);
        let flatness = [1.0, random.log_between(1e-8, 1.0), 0.0];
        let stretch = Vec3::from_fn(|_, _| scale * random.pick(&flatness));
        let turn = if random.below(3) == 0 { Mat3::identity() } else { tricky_rotation(random) };
        let mut place = || offset + turn * random.vector(1.0).component_mul(&stretch);
        match (scale.to_bits() >> 3) % 4 {
            0 => Self::Points((0..8).map(|i| corner(i, &stretch)).map(|p| offset + turn * p).collect()),
            1 => Self::Points((0..12).map(|_| place()).collect()),
            2 => {
                let centers: Vec<_> = (0..4).map(|_| place()).collect();
                let ball = |center| Sphere { center, radius: scale * random.log_between(1e-3, 1.0) };
                Self::Spheres(centers.into_iter().map(ball).collect())
            }
            _ => {
                let centers: Vec<_> = (0..3).map(|_| place()).collect();
                let ellipsoid = |center| Ellipsoid {
                    center,
                    axes: tricky_rotation(random),
                    semi_axes: Vec3::from_fn(|_, _| scale * random.log_between(1e-3, 1.0)),
                };
                Self::Ellipsoids(centers.into_iter().map(ellipsoid).collect())
            }
        }
    }

    pub fn fit(&self, kind: &BoundKind) -> Volume {
        let ext = Extensions::new();
        match self {
            Self::Points(points) => fit(kind, &[&PointCloud(points)], &ext),
            Self::Spheres(things) => fit(kind, &as_bounded(things), &ext),
            Self::Ellipsoids(things) => fit(kind, &as_bounded(things), &ext),
        }
        .expect("a good body")
    }

    /// Point farthest along a direction.
    pub fn extreme(&self, direction: &Vec3) -> Vec3 {
        let points: Vec<_> = match self {
            Self::Points(points) => points.clone(),
            Self::Spheres(things) => things.iter().map(|s| s.center + direction * s.radius).collect(),
            Self::Ellipsoids(things) => things.iter().map(|e| e.support(direction)).collect(),
        };
        extreme_of(&points, direction)
    }

    /// Random point of its convex hull.
    pub fn inside(&self, random: &mut Random) -> Vec3 {
        let (p, q) = (self.extreme(&tricky_direction(random)), self.extreme(&tricky_direction(random)));
        p + (q - p) * random.unit()
    }
}

pub fn as_bounded<T: Bounded>(things: &[T]) -> Vec<&dyn Bounded> {
    things.iter().map(|thing| thing as &dyn Bounded).collect()
}

pub fn extreme_of(points: &[Vec3], direction: &Vec3) -> Vec3 {
    let by_height = |a: &&Vec3, b: &&Vec3| direction.dot(a).total_cmp(&direction.dot(b));
    *points.iter().max_by(by_height).expect("points")
}

/// One of the eight corners of a box around the origin.
pub fn corner(index: usize, half: &Vec3) -> Vec3 {
    Vec3::from_fn(|i, _| if index >> i & 1 == 1 { half[i] } else { -half[i] })
}

/// Body with its volume of each kind, in the order of [`KINDS`].
pub struct Fitted {
    pub body: Body,
    pub volumes: [Volume; 3],
}

pub fn fitted_bodies(random: &mut Random, count: usize) -> Vec<Fitted> {
    let one = |_| {
        let body = Body::random(random);
        let volumes = KINDS.each_ref().map(|kind| body.fit(kind));
        Fitted { body, volumes }
    };
    (0..count).map(one).collect()
}

/// Transform with a given rotation that maps a point of A to a point of B.
pub fn meeting(rotation: Mat3, in_a: &Vec3, in_b: &Vec3) -> Transform {
    Transform { rotation, translation: in_b - rotation * in_a }
}
