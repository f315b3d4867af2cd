//! One pair per query by the testers of pong-geometry, as the engine uses them: A is carried into B's frame and tested
//! there.

use crate::pairs::{Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, SEMI_AXES, Target};
use crate::peer::PairPeer;
use pong_geometry::extension::Extensions;
use pong_geometry::interference::{
    Interference, ellipsoid_plane::ellipsoid_plane, ellipsoid_polyhedron::ellipsoid_polyhedron,
    ellipsoid_triangle::ellipsoid_triangle, line_segment_plane::line_segment_plane,
    line_segment_polyhedron::line_segment_polyhedron, point_ellipsoid::point_ellipsoid,
    point_plane::point_plane, point_polyhedron::point_polyhedron_in, point_polyhedron::shallowest_face,
    point_sphere::point_sphere, ray_plane::RayHit, ray_plane::ray_plane, ray_polyhedron::ray_polyhedron,
    ray_triangle::ray_triangle, sphere_plane::sphere_plane, sphere_polyhedron::sphere_inside_polyhedron,
    sphere_polyhedron::sphere_outside_polyhedron, sphere_sphere::sphere_sphere,
    sphere_triangle::sphere_over_face, sphere_triangle::sphere_triangle,
    sphere_triangle_pairs::SphereTrianglePairs, triangle_features::TriangleContact,
};
use pong_geometry::primitive::PrimitiveKind::{self, Plane, Polyhedron as Hull, Triangle};
use pong_geometry::primitive::{Ellipsoid, LineSegment, Point, Polyhedron, Ray, RayResponse, Sphere};
use pong_geometry::simd::{self, Kernel, LANES, Simd};
use pong_geometry::{Mat3, Transform, Vec3};
use pong_model::{Body, Model};

/// The testers on one pair.
pub struct Ours {
    mover: Mover,
    kind: PrimitiveKind,
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
        let text = target.model();
        let model = pong_model::parse(&text, "target.ron", None, &Extensions::new()).expect("a valid model");
        Self { mover, kind: target.kind(), model }
    }

    /// The movable group that holds the target.
    pub fn body(&self) -> &Body {
        &self.model.bodies[0]
    }

    /// Whether the two touch.
    pub fn touches(&self, x_ba: &Transform) -> bool {
        let mut answers = [Answer::default()];
        self.test_all(std::slice::from_ref(x_ba), &mut answers);
        answers[0].hit()
    }

    fn test_all(&self, transforms: &[Transform], answers: &mut [Answer]) {
        let Self { mover, kind, .. } = *self;
        simd::run(Pass { mover, kind, body: self.body(), transforms, answers });
    }
}

/// All queries in one kernel, as the engine has all elements of a block in one.
struct Pass<'a> {
    mover: Mover,
    kind: PrimitiveKind,
    body: &'a Body,
    transforms: &'a [Transform],
    answers: &'a mut [Answer],
}

impl Kernel for Pass<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        match self.mover {
            Mover::Point => self.points(simd),
            Mover::Segment => self.segments(),
            Mover::Ray => self.rays(),
            Mover::Sphere => self.spheres(simd),
            Mover::Ellipsoid => self.ellipsoids(),
        }
    }
}

impl Pass<'_> {
    #[inline(always)]
    fn points<S: Simd>(self, simd: S) {
        let (a, b) = (POINT, self.body);
        match self.kind {
            Hull => self.each(|x| point_polyhedron_in(simd, &a.carried(x).position, &b.polyhedra[0])),
            Plane => self.each(|x| point_plane(&a.carried(x), &b.planes[0])),
            PrimitiveKind::Sphere => self.each(|x| point_sphere(&a.carried(x), &b.spheres[0])),
            PrimitiveKind::Ellipsoid => {
                self.each(|x| point_ellipsoid(&a.carried(x).position, &b.ellipsoids[0]));
            }
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn segments(self) {
        let (a, b) = (SEGMENT, self.body);
        match self.kind {
            Hull => self.each(|x| deepest(line_segment_polyhedron(&a.carried(x), &b.polyhedra[0]))),
            Plane => self.each(|x| deepest(line_segment_plane(&a.carried(x), &b.planes[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn rays(self) {
        let b = self.body;
        match self.kind {
            Hull => self.each(|x| along(ray().carried(x), |a| ray_polyhedron(a, &b.polyhedra[0]))),
            Triangle => self.each(|x| along(ray().carried(x), |a| ray_triangle(a, &b.triangles, 0, 0.0))),
            Plane => self.each(|x| along(ray().carried(x), |a| ray_plane(a, &b.planes[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn spheres<S: Simd>(self, simd: S) {
        let (a, b) = (SPHERE, self.body);
        match self.kind {
            Hull => self.each(|x| sphere(&a.carried(x), &b.polyhedra[0])),
            Plane => self.each(|x| sphere_plane(&a.carried(x), &b.planes[0])),
            PrimitiveKind::Sphere => self.each(|x| sphere_sphere(&a.carried(x), &b.spheres[0])),
            Triangle => self.spheres_on_triangle(simd),
            _ => self.no_tester(),
        }
    }

    /// Each sphere is carried by itself; those near triangles wait until there are eight pairs, as in the engine.
    #[inline(always)]
    fn spheres_on_triangle<S: Simd>(self, simd: S) {
        let b = &self.body.triangles;
        let mut pairs = SphereTrianglePairs::default();
        for (transforms, answers) in self.transforms.chunks(LANES).zip(self.answers.chunks_mut(LANES)) {
            let mut spheres = [SPHERE; LANES];
            for (sphere, transform) in spheres.iter_mut().zip(transforms) {
                *sphere = SPHERE.carried(transform);
                pairs.add(sphere, b, 0, RADIUS);
            }
            let told = pairs.take_in(simd);
            for (lane, (a, answer)) in spheres.iter().zip(answers).enumerate() {
                let found = match [told.near, told.over_face].map(|bits| bits >> lane & 1 == 1) {
                    [false, _] => None,
                    [true, true] => sphere_over_face(a, b, 0).map(|contact| contact.interference),
                    [true, false] => last(|emit| sphere_triangle(a, b, 0, a.radius, emit)),
                };
                *answer = found.map(Answer::from).unwrap_or_default();
            }
        }
    }

    #[inline(always)]
    fn ellipsoids(self) {
        let (a, b) = (ellipsoid(), self.body);
        let thickness = a.smallest_semi_axis();
        match self.kind {
            Hull => self.each(|x| ellipsoid_polyhedron(&a.carried(x), &b.polyhedra[0])),
            Plane => self.each(|x| ellipsoid_plane(&a.carried(x), &b.planes[0])),
            Triangle => self
                .each(|x| last(|emit| ellipsoid_triangle(&a.carried(x), &b.triangles, 0, thickness, emit))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn each<T: Into<Answer>>(self, test: impl Fn(&Transform) -> Option<T>) {
        for (transform, answer) in self.transforms.iter().zip(self.answers) {
            *answer = test(transform).map(T::into).unwrap_or_default();
        }
    }

    #[cold]
    fn no_tester(&self) -> ! {
        let names = [self.mover.kind(), self.kind].map(PrimitiveKind::name).join("–");
        panic!("{names}: the engine has a tester that bench/src/ours.rs does not call");
    }
}

impl PairPeer for Ours {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        self.test_all(&queries.transforms, answers);
    }
}

fn sphere(a: &Sphere, b: &Polyhedron) -> Option<Interference> {
    // Most pairs end here: apart by the plane of one face.
    if b.faces.iter().any(|face| face.height(&a.center) >= a.radius) {
        return None;
    }
    if !b.contains(&a.center) {
        return sphere_outside_polyhedron(a, b);
    }
    Some(sphere_inside_polyhedron(a, b, shallowest_face(&a.center, b)?))
}

fn deepest(ends: [Option<Interference>; 2]) -> Option<Interference> {
    ends.into_iter().flatten().max_by(|a, b| a.depth.total_cmp(&b.depth))
}

/// What a test that may emit several contacts emits last.
#[inline(always)]
fn last(test: impl FnOnce(&mut dyn FnMut(TriangleContact))) -> Option<Interference> {
    let mut found = None;
    test(&mut |contact| found = Some(contact.interference));
    found
}

#[inline(always)]
fn along(a: Ray, test: impl FnOnce(&Ray) -> Option<RayHit>) -> Option<Answer> {
    let hit = test(&a)?;
    Some(Answer::new(hit.distance, hit.normal, a.origin + a.direction * hit.distance))
}

impl From<Interference> for Answer {
    fn from(found: Interference) -> Self {
        Self::new(found.depth, found.normal, found.point_a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairs::{self, TARGET_RADIUS};
    use std::collections::BTreeSet;

    #[test]
    fn every_tester_of_the_engine_finds_the_hits_and_misses_that_were_made() {
        let mut kinds = BTreeSet::new();
        for (mover, target) in pairs::all() {
            let mut ours = Ours::new(mover, &target);
            let queries = Queries::new(256, mover, &target, |x| ours.touches(x));
            let mut answers = vec![Answer::default(); queries.hits.len()];
            ours.pass(&queries, &mut answers);
            let found: Vec<bool> = answers.iter().map(Answer::hit).collect();
            assert_eq!(found, queries.hits, "{mover:?}–{:?}", target.kind());
            kinds.insert((mover.kind(), target.kind()));
        }
        let all = PrimitiveKind::ALL.into_iter().flat_map(|a| PrimitiveKind::ALL.map(|b| (a, b)));
        let tested = all.filter(|&(a, b)| pong_engine::has_tester(a, b)).collect();
        assert_eq!(kinds, tested);
    }

    #[test]
    fn depths_of_points_and_spheres_below_a_plane_and_in_a_sphere_are_the_closed_forms() {
        type Height = fn(&Vec3) -> f64;
        let heights: [(Target, Height); 2] =
            [(Target::Plane, |p| p.z), (Target::Sphere, |p| p.norm() - TARGET_RADIUS)];
        for (target, height) in heights {
            for (mover, radius) in [(Mover::Point, 0.0), (Mover::Sphere, RADIUS)] {
                let mut ours = Ours::new(mover, &target);
                let queries = Queries::new(64, mover, &target, |x| ours.touches(x));
                let mut answers = vec![Answer::default(); 64];
                ours.pass(&queries, &mut answers);
                for (x, answer) in queries.transforms.iter().zip(answers) {
                    let expected = (radius - height(&x.translation)).max(0.0);
                    assert!((answer.depth - expected).abs() < 1e-12, "{mover:?}–{:?}", target.kind());
                }
            }
        }
    }
}
