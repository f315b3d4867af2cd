//! W1 by the testers of pong-geometry, as the engine uses them: A is carried into B's frame and tested there.

use crate::hull::triangle_model;
use crate::pairs::{Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, SEMI_AXES, Target};
use crate::peer::PairPeer;
use pong_geometry::extension::Extensions;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_polyhedron;
use pong_geometry::interference::line_segment_polyhedron::line_segment_polyhedron;
use pong_geometry::interference::point_polyhedron::{point_polyhedron_in, shallowest_face};
use pong_geometry::interference::ray_plane::RayHit;
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::sphere_polyhedron::{sphere_inside_polyhedron, sphere_outside_polyhedron};
use pong_geometry::interference::sphere_triangle::sphere_triangle;
use pong_geometry::primitive::{
    Ellipsoid, LineSegment, Point, Polyhedron, Ray, RayResponse, Sphere, TriangleSet,
};
use pong_geometry::simd::{self, Kernel, Simd};
use pong_geometry::{Mat3, Transform, Vec3};
use pong_model::{Body, Model};

/// The testers on one pair.
pub struct Ours {
    mover: Mover,
    model: Model,
}

const POINT: Point = Point { position: Vec3::new(0.0, 0.0, 0.0) };
const SEGMENT: LineSegment =
    LineSegment { ends: [Vec3::new(0.0, 0.0, -HALF_LENGTH), Vec3::new(0.0, 0.0, HALF_LENGTH)] };
const SPHERE: Sphere = Sphere { center: Vec3::new(0.0, 0.0, 0.0), radius: RADIUS };

fn ellipsoid() -> Ellipsoid {
    Ellipsoid { center: Vec3::zeros(), axes: Mat3::identity(), semi_axes: Vec3::from(SEMI_AXES) }
}

fn ray() -> Ray {
    let (origin, direction, length) = RAY;
    Ray {
        origin: origin.into(),
        direction: direction.into(),
        length,
        reach: None,
        response: RayResponse::Normal,
    }
}

impl Ours {
    /// For one pair.
    ///
    /// # Panics
    /// If the model of the target is refused.
    pub fn new(mover: Mover, target: &Target) -> Self {
        let text = match target {
            Target::Hull(hull) => hull.model(),
            Target::Triangle => triangle_model(),
        };
        let model = pong_model::parse(&text, "target.ron", None, &Extensions::new()).expect("a valid model");
        Self { mover, model }
    }

    /// Whether the two touch.
    pub fn touches(&self, x_ba: &Transform) -> bool {
        let mut answers = [Answer::default()];
        self.test_all(std::slice::from_ref(x_ba), &mut answers);
        answers[0].hit()
    }

    fn test_all(&self, transforms: &[Transform], answers: &mut [Answer]) {
        simd::run(Pass { mover: self.mover, body: &self.model.bodies[0], transforms, answers });
    }
}

/// All queries in one kernel, as the engine has all elements of a block in one.
struct Pass<'a> {
    mover: Mover,
    body: &'a Body,
    transforms: &'a [Transform],
    answers: &'a mut [Answer],
}

impl Kernel for Pass<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { mover, body, transforms, answers } = self;
        let triangles = &body.triangles;
        match (mover, body.polyhedra.first()) {
            (Mover::Point, Some(b)) => each(transforms, answers, |x| {
                point_polyhedron_in(simd, &POINT.carried(x).position, b).map(Answer::from)
            }),
            (Mover::Segment, Some(b)) => each(transforms, answers, |x| segment(&SEGMENT.carried(x), b)),
            (Mover::Sphere, Some(b)) => each(transforms, answers, |x| sphere(&SPHERE.carried(x), b)),
            (Mover::Ellipsoid, Some(b)) => {
                let a = ellipsoid();
                each(transforms, answers, |x| ellipsoid_polyhedron(&a.carried(x), b).map(Answer::from));
            }
            (Mover::Ray, b) => {
                let a = ray();
                each(transforms, answers, |x| {
                    let a = a.carried(x);
                    let hit = match b {
                        Some(b) => ray_polyhedron(&a, b),
                        None => ray_triangle(&a, triangles, 0, 0.0),
                    };
                    hit.map(|hit| along(&a, &hit))
                });
            }
            (_, None) => each(transforms, answers, |x| on_triangle(&SPHERE.carried(x), triangles)),
        }
    }
}

impl PairPeer for Ours {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        self.test_all(&queries.transforms, answers);
    }
}

#[inline(always)]
fn each(transforms: &[Transform], answers: &mut [Answer], test: impl Fn(&Transform) -> Option<Answer>) {
    for (transform, answer) in transforms.iter().zip(answers) {
        *answer = test(transform).unwrap_or_default();
    }
}

fn sphere(a: &Sphere, b: &Polyhedron) -> Option<Answer> {
    // Most pairs end here: apart by the plane of one face.
    if b.faces.iter().any(|face| face.height(&a.center) >= a.radius) {
        return None;
    }
    if !b.contains(&a.center) {
        return sphere_outside_polyhedron(a, b).map(Answer::from);
    }
    Some(sphere_inside_polyhedron(a, b, shallowest_face(&a.center, b)?).into())
}

fn segment(a: &LineSegment, b: &Polyhedron) -> Option<Answer> {
    let ends = line_segment_polyhedron(a, b);
    ends.into_iter().flatten().max_by(|a, b| a.depth.total_cmp(&b.depth)).map(Answer::from)
}

fn on_triangle(a: &Sphere, b: &TriangleSet) -> Option<Answer> {
    let mut answer = None;
    sphere_triangle(a, b, 0, a.radius, &mut |contact| answer = Some(contact.interference.into()));
    answer
}

fn along(a: &Ray, hit: &RayHit) -> Answer {
    Answer::new(hit.distance, hit.normal, a.origin + a.direction * hit.distance)
}

impl From<Interference> for Answer {
    fn from(found: Interference) -> Self {
        Self::new(found.depth, found.normal, found.point_a)
    }
}
