//! W1 by parry: the function that its own dispatch would call, called directly.

use super::PairPeer;
use super::parry::{pose, vector};
use crate::hull::{Hull, TRIANGLE};
use crate::ours::Elements;
use crate::pairs::{Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, ROUND_HALF_LENGTH, SEMI_AXES, Target};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::details::{contact_convex_polyhedron_ball, contact_support_map_support_map};
use parry3d_f64::query::{Contact, PointQuery, Ray, RayCast};
use parry3d_f64::shape::{Ball, Capsule, ConvexPolyhedron, Segment, Shape, SupportMap, Triangle};

/// parry on one pair.
pub struct Parry {
    mover: Mover,
    target: Shapes,
}

enum Shapes {
    Hull(ConvexPolyhedron),
    Triangle(Triangle),
}

/// An ellipsoid is one support function away.
struct Ellipsoid;

impl SupportMap for Ellipsoid {
    fn local_support_point(&self, direction: Vector) -> Vector {
        let semi_axes = Vector::from(SEMI_AXES);
        let scaled = direction * semi_axes;
        scaled * semi_axes / scaled.length()
    }
}

impl Parry {
    /// For one pair, if the target is one of W1's.
    ///
    /// # Panics
    /// If parry refuses the hull.
    pub fn new(mover: Mover, target: &Target) -> Option<Self> {
        if matches!(mover, Mover::Cylinder | Mover::Cone) {
            return None;
        }
        let target = match target {
            Target::Hull(hull) => Shapes::Hull(convex(hull)),
            Target::Triangle => {
                let [a, b, c] = TRIANGLE.map(Vector::from);
                Shapes::Triangle(Triangle::new(a, b, c))
            }
            _ => return None,
        };
        Some(Self { mover, target })
    }
}

fn convex(hull: &Hull) -> ConvexPolyhedron {
    ConvexPolyhedron::from_convex_mesh(hull.vertices.iter().map(vector).collect(), &hull.faces)
        .expect("a hull is convex")
}

impl PairPeer for Parry {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        self.each(answers, |i| {
            let [mover, target] = queries.poses[i].each_ref().map(own_pose);
            target.inv_mul(&mover)
        });
    }

    fn pass_over_elements(&mut self, elements: &Elements, answers: &mut [Answer]) -> bool {
        let x_ba = own_pose(&elements.pose_ba);
        self.each(answers, |i| x_ba * own_pose(&elements.placed[i]));
        true
    }
}

impl Parry {
    /// Answers one query after another, given the mover's pose in the target's frame of each.
    fn each(&self, answers: &mut [Answer], x_ba: impl Fn(usize) -> Pose) {
        match &self.target {
            Shapes::Hull(b) => match self.mover {
                Mover::Point => each(answers, x_ba, |x| point(x, b)),
                Mover::Sphere => each(answers, x_ba, |x| ball(x, b)),
                Mover::Ray => each(answers, x_ba, |x| ray(x, b)),
                Mover::Segment => {
                    let half = Vector::new(0.0, 0.0, HALF_LENGTH);
                    let a = Segment::new(-half, half);
                    each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &a, 0.0)));
                }
                Mover::Ellipsoid => {
                    each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &Ellipsoid, 0.0)));
                }
                Mover::Capsule => {
                    let a = Capsule::new_z(ROUND_HALF_LENGTH, RADIUS);
                    each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &a, 0.0)));
                }
                Mover::Cylinder | Mover::Cone => unreachable!("not one of W1's"),
            },
            Shapes::Triangle(b) => match self.mover {
                Mover::Ray => each(answers, x_ba, |x| ray(x, b)),
                _ => each(answers, x_ba, |x| ball(x, b)),
            },
        }
    }
}

fn each(answers: &mut [Answer], x_ba: impl Fn(usize) -> Pose, test: impl Fn(&Pose) -> Option<Answer>) {
    for (i, answer) in answers.iter_mut().enumerate() {
        *answer = test(&x_ba(i)).unwrap_or_default();
    }
}

fn own_pose(x: &pong_geometry::Pose) -> Pose {
    let q = &x.orientation;
    pose(x.position.into(), [q.w, q.i, q.j, q.k])
}

fn point(x: &Pose, b: &ConvexPolyhedron) -> Option<Answer> {
    let found = b.project_local_point(x.translation, false);
    let arm = found.point - x.translation;
    let depth = arm.length();
    found.is_inside.then(|| Answer::new(depth, arm / depth, x.translation))
}

fn ball(x: &Pose, b: &impl Shape) -> Option<Answer> {
    touch(contact_convex_polyhedron_ball(x, b, &Ball::new(RADIUS), 0.0))
}

fn ray(x: &Pose, b: &impl RayCast) -> Option<Answer> {
    let (origin, direction, length) = RAY;
    let ray = Ray::new(x.transform_point(origin.into()), x.rotation * Vector::from(direction));
    let hit = b.cast_local_ray_and_get_normal(&ray, length, false)?;
    let point = ray.origin + ray.dir * hit.time_of_impact;
    Some(Answer::new(hit.time_of_impact, hit.normal, point))
}

fn touch(found: Option<Contact>) -> Option<Answer> {
    let found = found?;
    Some(Answer::new(-found.dist, found.normal1, found.point1))
}
