//! Random convex shapes with support functions and membership tests that the search does not use.

use crate::common::{Random, cuboid, hull, stretched_hull};
use pong_geometry::bounding::{Bounded, PointCloud};
use pong_geometry::distance::Solid;
use pong_geometry::primitive::{
    Capsule, Ellipsoid, Frustum, LineSegment, Point, Polyhedron, Ray, RayResponse, Sphere,
};
use pong_geometry::{Transform, Vec3};

/// Shape of one kind in its own frame.
#[derive(Clone, Debug)]
pub enum Shape {
    Point(Point),
    Segment(LineSegment),
    Ray(Ray),
    Triangle([Vec3; 3]),
    Sphere(Sphere),
    Capsule(Capsule),
    Ellipsoid(Ellipsoid),
    Frustum(Frustum),
    Polyhedron(Box<Polyhedron>),
}

/// Number of kinds that [`Shape::random`] makes.
pub const KINDS: usize = 10;

impl Shape {
    /// Shape of a kind below [`KINDS`], of about 1 m, some of them slender or flat.
    pub fn random(kind: usize, random: &mut Random, polyhedra: &[Polyhedron]) -> Self {
        let slender =
            |random: &mut Random| if random.chance(0.4) { random.log_between(1e-6, 1.0) } else { 1.0 };
        let place = random.vector(0.5);
        let ends = [place, place + random.direction() * slender(random)];
        match kind {
            0 => Self::Point(Point { position: place }),
            1 => Self::Segment(LineSegment { ends }),
            2 => {
                let ray = Ray::between(&ends[0], &ends[1]).unwrap();
                Self::Ray(Ray { response: RayResponse::Axial, ..ray })
            }
            3 => {
                // Needles, caps with three corners nearly in line, and full triangles.
                let along = random.between(-0.2, 1.2);
                let across = random.across(&(ends[1] - ends[0]).normalize()) * slender(random);
                Self::Triangle([ends[0], ends[1], ends[0] + (ends[1] - ends[0]) * along + across])
            }
            4 => Self::Sphere(Sphere { center: place, radius: slender(random) }),
            5 => Self::Capsule(Capsule { ends, radius: slender(random) }),
            6 => Self::Ellipsoid(Ellipsoid {
                center: place,
                axes: random.rotation_matrix(),
                semi_axes: Vec3::from_fn(|_, _| random.log_between(0.03, 1.0)),
            }),
            7 => {
                let radius = slender(random);
                Self::Frustum(Frustum::new(ends, [radius; 2]))
            }
            8 => {
                let radius = slender(random);
                let other = if random.chance(0.5) { 0.0 } else { slender(random) };
                Self::Frustum(Frustum::new(ends, [radius, other]))
            }
            _ => Self::Polyhedron(Box::new(polyhedra[random.below(polyhedra.len())].clone())),
        }
    }

    /// Shape as the search takes it, at a pose.
    pub fn solid(&self, x: &Transform) -> Solid<'_> {
        match self {
            Self::Point(point) => Solid::point(&point.carried(x)),
            Self::Segment(segment) => Solid::segment(&segment.carried(x)),
            Self::Ray(ray) => Solid::ray(&ray.carried(x)),
            Self::Triangle(corners) => Solid::triangle(corners.map(|corner| x.point(&corner))),
            Self::Sphere(sphere) => Solid::sphere(&sphere.carried(x)),
            Self::Capsule(capsule) => Solid::capsule(&capsule.carried(x)),
            Self::Ellipsoid(ellipsoid) => Solid::ellipsoid(&ellipsoid.carried(x)),
            Self::Frustum(frustum) => Solid::frustum(&frustum.carried(x)),
            Self::Polyhedron(polyhedron) => Solid::polyhedron(polyhedron, x),
        }
    }

    /// Largest `direction · x`, m, for a unit direction in the shape's own frame: of the bounding volumes, not of the search.
    pub fn width(&self, direction: &Vec3) -> f64 {
        match self {
            Self::Point(point) => Bounded::support(point, direction),
            Self::Segment(segment) => Bounded::support(segment, direction),
            Self::Ray(ray) => direction.dot(&ray.origin).max(direction.dot(&ray.tip())),
            Self::Triangle(corners) => PointCloud(corners).support(direction),
            Self::Sphere(sphere) => Bounded::support(sphere, direction),
            Self::Capsule(capsule) => Bounded::support(capsule, direction),
            Self::Ellipsoid(ellipsoid) => Bounded::support(ellipsoid, direction),
            Self::Frustum(frustum) => Bounded::support(frustum, direction),
            Self::Polyhedron(polyhedron) => Bounded::support(&**polyhedron, direction),
        }
    }

    /// Returns `true` if the shape is bounded by planes, edges and corners, balls around such aside.
    pub fn is_flat(&self) -> bool {
        !matches!(self, Self::Ellipsoid(_) | Self::Frustum(_))
    }

    /// Distance by which a point in the shape's own frame is outside it, m, to first order.
    pub fn outside(&self, p: &Vec3) -> f64 {
        match self {
            Self::Point(point) => (p - point.position).norm(),
            Self::Segment(segment) => from_segment(p, &segment.ends),
            Self::Ray(ray) => from_segment(p, &[ray.origin, ray.tip()]),
            Self::Triangle(corners) => from_triangle(p, corners),
            Self::Sphere(sphere) => (p - sphere.center).norm() - sphere.radius,
            Self::Capsule(capsule) => from_segment(p, &capsule.ends) - capsule.radius,
            Self::Ellipsoid(ellipsoid) => {
                let at = ellipsoid.axes.tr_mul(&(p - ellipsoid.center));
                (at.component_div(&ellipsoid.semi_axes).norm() - 1.0) * ellipsoid.semi_axes.min()
            }
            Self::Frustum(frustum) => {
                let arm = p - frustum.ends[0];
                let along = arm.dot(&frustum.axis);
                let aside = (arm - frustum.axis * along).norm();
                let [cosine, sine] = frustum.wall;
                let over_wall = cosine * along + sine * (aside - frustum.radii[0]);
                over_wall.max(-along).max(along - frustum.length)
            }
            Self::Polyhedron(polyhedron) => {
                polyhedron.faces.iter().map(|face| face.height(p)).fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }

    /// Random member of the shape: support points mixed.
    pub fn member(&self, random: &mut Random) -> Vec3 {
        let solid = self.solid(&Transform::identity());
        let directions = [random.direction(), random.direction(), random.direction()];
        let points = directions.map(|n| solid.core_support(&n) + n * solid.margin());
        let (s, t) = (random.unit(), random.unit());
        (points[0] * s + points[1] * (1.0 - s)) * t + points[2] * (1.0 - t)
    }
}

/// Polyhedra to choose from: boxes, flat and long ones too, and hulls of many corners.
pub fn polyhedra(random: &mut Random) -> Vec<Polyhedron> {
    let cube = |half: Vec3| cuboid(-half, half);
    let tetrahedron = hull(&[Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()]);
    let slanted: Vec<Vec3> = (0..4).map(|_| random.direction()).collect();
    vec![
        cube(Vec3::new(0.5, 0.5, 0.5)),
        cube(Vec3::new(0.5, 0.3, 1e-3)),
        cube(Vec3::new(1.0, 1e-3, 1e-3)),
        cube(Vec3::new(0.2, 0.7, 0.4)),
        tetrahedron,
        hull(&slanted),
        stretched_hull(20, Vec3::new(0.5, 0.5, 0.5)),
        stretched_hull(60, Vec3::new(1.0, 0.2, 0.4)),
    ]
}

/// Distance of a point from a segment, m.
fn from_segment(p: &Vec3, [a, b]: &[Vec3; 2]) -> f64 {
    let (along, arm) = (b - a, p - a);
    let share = (arm.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (arm - along * share).norm()
}

/// Distance of a point from a triangle, m: over the inside its height, else that of the nearest edge.
fn from_triangle(p: &Vec3, [a, b, c]: &[Vec3; 3]) -> f64 {
    let edges = [[*a, *b], [*b, *c], [*c, *a]];
    let normal = (b - a).cross(&(c - a)).normalize();
    let is_inside = edges.iter().all(|[from, to]| normal.dot(&(to - from).cross(&(p - from))) >= 0.0);
    let rim = edges.iter().map(|edge| from_segment(p, edge)).fold(f64::INFINITY, f64::min);
    if is_inside { rim.min(normal.dot(&(p - a)).abs()) } else { rim }
}
