//! W1 by parry: direct calls of the function that its dispatch would choose.

use super::parry::{pose, vector};
use super::{AnswerFrame, PairPeer};
use crate::hull::{self, Hull, TRIANGLE};
use crate::ours::Elements;
use crate::pairs::{
    Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, ROUND_HALF_LENGTH, SEMI_AXES, TARGET_ROUND, Target,
    along_y,
};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::details::{
    contact_convex_polyhedron_ball, contact_manifold_capsule_capsule, contact_support_map_support_map,
};
use parry3d_f64::query::{Contact, ContactManifold, Ray};
use parry3d_f64::shape::{
    Ball, Capsule, Cone, ConvexPolyhedron, Cylinder, Segment, Shape, SupportMap, Triangle,
};

/// parry on one pair.
pub struct Parry {
    mover: Mover,
    target: Shapes,
}

enum Shapes {
    Hull(ConvexPolyhedron),
    Triangle(Triangle),
    Capsule(Capsule),
    /// A cylinder along y, as is the cone.
    Cylinder(Cylinder),
    Cone(Cone),
    Ellipsoid(Ellipsoid),
}

/// An ellipsoid, given by its support function.
struct Ellipsoid {
    semi_axes: Vector,
}

impl SupportMap for Ellipsoid {
    fn local_support_point(&self, direction: Vector) -> Vector {
        let scaled = direction * self.semi_axes;
        scaled * self.semi_axes / scaled.length()
    }
}

/// The moving cylinder, along z.
struct AlongZ;

impl SupportMap for AlongZ {
    fn local_support_point(&self, direction: Vector) -> Vector {
        let aside = Vector::new(direction.x, direction.y, 0.0);
        let rim = aside * (RADIUS / aside.length().max(f64::MIN_POSITIVE));
        Vector::new(rim.x, rim.y, ROUND_HALF_LENGTH.copysign(direction.z))
    }
}

impl Parry {
    /// Builds one pair, if the target is one of W1's.
    ///
    /// # Panics
    /// If parry refuses the hull.
    pub fn new(mover: Mover, target: &Target) -> Option<Self> {
        if mover == Mover::Cone {
            return None;
        }
        let ([_, half_length], radius) = TARGET_ROUND;
        let target = match target {
            Target::Hull(hull) => Shapes::Hull(convex(hull)),
            Target::Triangle => {
                let [a, b, c] = TRIANGLE.map(Vector::from);
                Shapes::Triangle(Triangle::new(a, b, c))
            }
            Target::Capsule => Shapes::Capsule(Capsule::new_z(half_length, radius)),
            Target::Cylinder => Shapes::Cylinder(Cylinder::new(half_length, radius)),
            Target::Cone => Shapes::Cone(Cone::new(half_length, radius)),
            Target::Ellipsoid => Shapes::Ellipsoid(Ellipsoid { semi_axes: Vector::from(hull::SEMI_AXES) }),
            _ => return None,
        };
        Some(Self { mover, target })
    }

    fn lies_along_y(&self) -> bool {
        matches!(self.target, Shapes::Cylinder(_) | Shapes::Cone(_))
    }
}

fn convex(hull: &Hull) -> ConvexPolyhedron {
    ConvexPolyhedron::from_convex_mesh(hull.vertices.iter().map(vector).collect(), &hull.faces)
        .expect("a hull is convex")
}

impl PairPeer for Parry {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        let relative = |mover: &pong_geometry::Pose, target| own_pose(target).inv_mul(&own_pose(mover));
        match self.lies_along_y() {
            true => self.each(answers, |i| relative(&queries.poses[i][0], &queries.along_y[i])),
            false => self.each(answers, |i| relative(&queries.poses[i][0], &queries.poses[i][1])),
        }
    }

    fn pass_over_elements(&mut self, elements: &Elements, answers: &mut [Answer]) -> bool {
        let x_ba = match self.lies_along_y() {
            true => along_y().inverse().compose(&elements.pose_ba),
            false => elements.pose_ba,
        };
        let x_ba = own_pose(&x_ba);
        self.each(answers, |i| x_ba * own_pose(&elements.placed[i]));
        true
    }

    fn frame_of_answers(&self) -> AnswerFrame {
        match self.lies_along_y() {
            true => AnswerFrame::TargetAlongY,
            false => AnswerFrame::Target,
        }
    }
}

impl Parry {
    /// Answers queries one by one, from the mover's pose in the target's frame.
    fn each(&self, answers: &mut [Answer], x_ba: impl Fn(usize) -> Pose) {
        match &self.target {
            Shapes::Hull(b) => self.on(b, answers, x_ba),
            Shapes::Triangle(b) => self.on(b, answers, x_ba),
            Shapes::Capsule(b) if self.mover == Mover::Capsule => {
                let mut kept = ContactManifold::new();
                each(answers, x_ba, |x| capsules(x, b, &mut kept));
            }
            Shapes::Capsule(b) => self.on(b, answers, x_ba),
            Shapes::Cylinder(b) => self.on(b, answers, x_ba),
            Shapes::Cone(b) => self.on(b, answers, x_ba),
            Shapes::Ellipsoid(b) => self.touching(b, answers, x_ba),
        }
    }

    fn on(&self, b: &(impl Shape + SupportMap), answers: &mut [Answer], x_ba: impl Fn(usize) -> Pose) {
        match self.mover {
            Mover::Point => each(answers, x_ba, |x| point(x, b)),
            Mover::Sphere => each(answers, x_ba, |x| ball(x, b)),
            Mover::Ray => each(answers, x_ba, |x| ray(x, b)),
            _ => self.touching(b, answers, x_ba),
        }
    }

    /// Contacts by support functions.
    fn touching(&self, b: &impl SupportMap, answers: &mut [Answer], x_ba: impl Fn(usize) -> Pose) {
        match self.mover {
            Mover::Segment => {
                let half = Vector::new(0.0, 0.0, HALF_LENGTH);
                let a = Segment::new(-half, half);
                each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &a, 0.0)));
            }
            Mover::Ellipsoid => {
                let a = Ellipsoid { semi_axes: Vector::from(SEMI_AXES) };
                each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &a, 0.0)));
            }
            Mover::Capsule => {
                let a = capsule();
                each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &a, 0.0)));
            }
            Mover::Cylinder => {
                each(answers, x_ba, |x| touch(contact_support_map_support_map(x, b, &AlongZ, 0.0)));
            }
            Mover::Point | Mover::Sphere | Mover::Ray | Mover::Cone => unreachable!("tested otherwise"),
        }
    }
}

fn each(answers: &mut [Answer], x_ba: impl Fn(usize) -> Pose, mut test: impl FnMut(&Pose) -> Option<Answer>) {
    for (i, answer) in answers.iter_mut().enumerate() {
        *answer = test(&x_ba(i)).unwrap_or_default();
    }
}

fn own_pose(x: &pong_geometry::Pose) -> Pose {
    let q = &x.orientation;
    pose(x.position.into(), [q.w, q.i, q.j, q.k])
}

fn capsule() -> Capsule {
    Capsule::new_z(ROUND_HALF_LENGTH, RADIUS)
}

fn point(x: &Pose, b: &impl Shape) -> Option<Answer> {
    let found = b.project_local_point(x.translation, false);
    let arm = found.point - x.translation;
    let depth = arm.length();
    found.is_inside.then(|| Answer::new(depth, arm / depth, x.translation))
}

fn ball(x: &Pose, b: &impl Shape) -> Option<Answer> {
    touch(contact_convex_polyhedron_ball(x, b, &Ball::new(RADIUS), 0.0))
}

/// Contact of two capsules, by parry's dedicated test, which fills a persistent manifold.
fn capsules(x: &Pose, b: &Capsule, kept: &mut ContactManifold<(), ()>) -> Option<Answer> {
    contact_manifold_capsule_capsule(x, b, &capsule(), 0.0, kept);
    let found = kept.points.first()?;
    Some(Answer::new(-found.dist, kept.local_n1, found.local_p1))
}

fn ray(x: &Pose, b: &impl Shape) -> Option<Answer> {
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
