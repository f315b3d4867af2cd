//! One pair per query by the testers of pong-geometry, as the engine uses them: A is transformed to B's frame
//! and tested there.

use crate::pairs::{Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, ROUND_HALF_LENGTH, SEMI_AXES, Target};
use pong_geometry::interference::{
    Feature, Interference, ball_bore::ball_bore, ball_round::ball_capsule, ball_round::ball_frustum,
    bar_polyhedron::capsule_solid, bar_polyhedron::segment_solid, capsule_edge::ConvexEdge,
    capsule_edge::capsule_edge, ellipsoid_ellipsoid::ellipsoid_ellipsoid, ellipsoid_plane::ellipsoid_plane,
    ellipsoid_polyhedron::ellipsoid_polyhedron, ellipsoid_round::ellipsoid_capsule,
    ellipsoid_round::ellipsoid_frustum, ellipsoid_triangle::ellipsoid_triangle, end_disc::EndDisc,
    frustum_solid::frustum_solid, line_segment_plane::line_segment_plane, point_ellipsoid::point_ellipsoid,
    point_plane::point_plane, point_polyhedron::point_below_face, point_polyhedron::shallowest_face,
    point_sphere::point_sphere, ray_bore::ray_bore, ray_plane::RayHit, ray_plane::ray_plane,
    ray_polyhedron::ray_polyhedron, ray_round::ray_capsule, ray_round::ray_ellipsoid, ray_round::ray_frustum,
    ray_round::ray_sphere, ray_triangle::ray_triangle, round_plane::capsule_plane,
    round_plane::frustum_plane, side_edge::side_edge, sphere_ellipsoid::sphere_ellipsoid,
    sphere_plane::sphere_plane, sphere_polyhedron::sphere_inside_polyhedron,
    sphere_polyhedron::sphere_outside_polyhedron, sphere_sphere::sphere_sphere,
    sphere_triangle::sphere_over_face, sphere_triangle::sphere_triangle,
    sphere_triangle_pairs::SphereTrianglePairs, triangle_features::TriangleContact,
    triangle_features::TriangleView, two_capsules::capsule_capsule, two_capsules::segment_capsule,
    two_ended_bore::EndsInBore, two_ended_bore::capsule_bore, two_ended_bore::cylinder_bore,
    two_ended_bore::segment_bore, two_ended_round::EndContact, two_ended_round::capsule_frustum,
    two_ended_round::segment_frustum, two_frusta::two_frusta,
};
use pong_geometry::primitive::PrimitiveKind::{
    self, Bore, Cone, Cylinder, Plane, Polyhedron as Hull, Triangle,
};
use pong_geometry::primitive::{
    Capsule, Ellipsoid, Frustum, LineSegment, Point, Polyhedron, Ray, RayResponse, Sphere,
};
use pong_geometry::simd::{self, Kernel, LANES, Simd};
use pong_geometry::{Lanes, Mat3, Pose, Transform, Vec3};
use pong_model::{Extensions, Model, MovableGroup};

/// Testers of one pair.
pub struct Ours {
    mover: Mover,
    kind: PrimitiveKind,
    model: Model,
}

const POINT: Point = Point { position: Vec3::new(0.0, 0.0, 0.0) };
const SEGMENT: LineSegment =
    LineSegment { ends: [Vec3::new(0.0, 0.0, -HALF_LENGTH), Vec3::new(0.0, 0.0, HALF_LENGTH)] };
const SPHERE: Sphere = Sphere { center: Vec3::new(0.0, 0.0, 0.0), radius: RADIUS };

const ROUND_ENDS: [Vec3; 2] =
    [Vec3::new(0.0, 0.0, -ROUND_HALF_LENGTH), Vec3::new(0.0, 0.0, ROUND_HALF_LENGTH)];
const CAPSULE: Capsule = Capsule { ends: ROUND_ENDS, radius: RADIUS };

fn cylinder() -> Frustum {
    Frustum::new(ROUND_ENDS, [RADIUS; 2])
}

fn cone() -> Frustum {
    Frustum::new(ROUND_ENDS, [RADIUS, 0.5 * RADIUS])
}

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
    /// Prepares the testers of one pair.
    ///
    /// # Panics
    /// If the model of the target is refused.
    pub fn new(mover: Mover, target: &Target) -> Self {
        let text = target.model();
        let model = pong_model::parse(&text, "target.ron", None, &Extensions::new()).expect("a valid model");
        Self { mover, kind: target.kind(), model }
    }

    /// The movable group that holds the target.
    pub fn body(&self) -> &MovableGroup {
        &self.model.bodies[0]
    }

    /// True if the two touch.
    pub fn touches(&self, x_ba: &Transform) -> bool {
        let mut answers = [Answer::default()];
        self.test_all(&OneElement([*x_ba]), &mut answers);
        answers[0].hit()
    }

    /// Tests all movers against the target.
    pub(crate) fn test_all(&self, movers: &impl Movers, answers: &mut [Answer]) {
        let Self { mover, kind, .. } = *self;
        simd::run(Pass { mover, kind, body: self.body(), movers, answers });
    }
}

/// Movers of a pass, each in the target's frame.
pub(crate) trait Movers {
    fn point(&self, i: usize) -> Point;
    fn segment(&self, i: usize) -> LineSegment;
    fn ray(&self, i: usize) -> Ray;
    fn sphere(&self, i: usize) -> Sphere;
    fn ellipsoid(&self, i: usize) -> Ellipsoid;
    fn capsule(&self, i: usize) -> Capsule;
    fn cylinder(&self, i: usize) -> Frustum;
    fn cone(&self, i: usize) -> Frustum;
}

/// One element of A, with a separate pose in every query.
trait Poses {
    fn x_ba(&self, i: usize) -> Transform;
}

struct OneElement([Transform; 1]);

impl Poses for OneElement {
    #[inline(always)]
    fn x_ba(&self, i: usize) -> Transform {
        self.0[i]
    }
}

impl Poses for Queries {
    #[inline(always)]
    fn x_ba(&self, i: usize) -> Transform {
        let [a, b] = &self.poses[i];
        Pose::relative(a, b).transform()
    }
}

impl<P: Poses> Movers for P {
    #[inline(always)]
    fn point(&self, i: usize) -> Point {
        POINT.carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn segment(&self, i: usize) -> LineSegment {
        SEGMENT.carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn ray(&self, i: usize) -> Ray {
        ray().carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn sphere(&self, i: usize) -> Sphere {
        SPHERE.carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn ellipsoid(&self, i: usize) -> Ellipsoid {
        ellipsoid().carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn capsule(&self, i: usize) -> Capsule {
        CAPSULE.carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn cylinder(&self, i: usize) -> Frustum {
        cylinder().carried(&self.x_ba(i))
    }

    #[inline(always)]
    fn cone(&self, i: usize) -> Frustum {
        cone().carried(&self.x_ba(i))
    }
}

/// Elements of one movable group A, each placed where a query has its mover, and one pose of A in B's frame.
pub struct Elements {
    /// Pose of each element in A's frame.
    pub placed: Vec<Pose>,
    /// Origins of the elements in A's frame, m.
    pub positions: Vec<Vec3>,
    /// Pose of A in B's frame.
    pub pose_ba: Pose,
    points: Vec<Point>,
    segments: Vec<LineSegment>,
    rays: Vec<Ray>,
    spheres: Vec<Sphere>,
    ellipsoids: Vec<Ellipsoid>,
    capsules: Vec<Capsule>,
    cylinders: Vec<Frustum>,
    cones: Vec<Frustum>,
    x_ba: Transform,
}

impl Elements {
    /// Builds the elements of the queries, in their order.
    pub fn new(queries: &Queries) -> Self {
        // Any pose will do; a rotation avoids trivial products with zero and one.
        let pose_ba = Pose::new(Vec3::new(0.3, -0.2, 0.1), [0.8, 0.1, -0.5, 0.3]);
        let x_ab = pose_ba.inverse();
        let placed: Vec<Pose> =
            queries.poses.iter().map(|[a, b]| x_ab.compose(&Pose::relative(a, b))).collect();
        let transforms: Vec<Transform> = placed.iter().map(Pose::transform).collect();
        Self {
            points: transforms.iter().map(|x| POINT.carried(x)).collect(),
            segments: transforms.iter().map(|x| SEGMENT.carried(x)).collect(),
            rays: transforms.iter().map(|x| ray().carried(x)).collect(),
            spheres: transforms.iter().map(|x| SPHERE.carried(x)).collect(),
            ellipsoids: transforms.iter().map(|x| ellipsoid().carried(x)).collect(),
            capsules: transforms.iter().map(|x| CAPSULE.carried(x)).collect(),
            cylinders: transforms.iter().map(|x| cylinder().carried(x)).collect(),
            cones: transforms.iter().map(|x| cone().carried(x)).collect(),
            x_ba: pose_ba.transform(),
            positions: placed.iter().map(|pose| pose.position).collect(),
            placed,
            pose_ba,
        }
    }
}

impl Movers for Elements {
    #[inline(always)]
    fn point(&self, i: usize) -> Point {
        self.points[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn segment(&self, i: usize) -> LineSegment {
        self.segments[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn ray(&self, i: usize) -> Ray {
        self.rays[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn sphere(&self, i: usize) -> Sphere {
        self.spheres[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn ellipsoid(&self, i: usize) -> Ellipsoid {
        self.ellipsoids[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn capsule(&self, i: usize) -> Capsule {
        self.capsules[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn cylinder(&self, i: usize) -> Frustum {
        self.cylinders[i].carried(&self.x_ba)
    }

    #[inline(always)]
    fn cone(&self, i: usize) -> Frustum {
        self.cones[i].carried(&self.x_ba)
    }
}

/// All queries in one kernel, as the engine tests all elements of a block in one.
struct Pass<'a, M> {
    mover: Mover,
    kind: PrimitiveKind,
    body: &'a MovableGroup,
    movers: &'a M,
    answers: &'a mut [Answer],
}

impl<M: Movers> Kernel for Pass<'_, M> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        match self.mover {
            Mover::Point => self.points(simd),
            Mover::Segment => self.segments(simd),
            Mover::Ray => self.rays(),
            Mover::Sphere => self.spheres(simd),
            Mover::Ellipsoid => self.ellipsoids(),
            Mover::Capsule => self.capsules(),
            Mover::Cylinder => self.cylinders(),
            Mover::Cone => self.cones(),
        }
    }
}

impl<M: Movers> Pass<'_, M> {
    #[inline(always)]
    fn points<S: Simd>(self, simd: S) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.points_in_hull(simd),
            Plane => self.each(|i| point_plane(&m.point(i), &b.planes[0])),
            PrimitiveKind::Sphere => self.each(|i| point_sphere(&m.point(i), &b.spheres[0])),
            PrimitiveKind::Ellipsoid => {
                self.each(|i| point_ellipsoid(&m.point(i).position, &b.ellipsoids[0]));
            }
            PrimitiveKind::Capsule => self.each(|i| ball_capsule(&ball(&m.point(i)), &b.capsules[0])),
            Cylinder | Cone => self.each(|i| ball_frustum(&ball(&m.point(i)), &b.frusta[0])),
            Bore => self.each(|i| deepest(ball_bore(&ball(&m.point(i)), &b.bores[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn segments<S: Simd>(self, simd: S) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.segments_in_hull(simd),
            Plane => self.each(|i| deepest(line_segment_plane(&m.segment(i), &b.planes[0]))),
            PrimitiveKind::Capsule => {
                self.each(|i| deepest_end(segment_capsule(&m.segment(i), &b.capsules[0])));
            }
            Cylinder | Cone => self.each(|i| deepest_end(segment_frustum(&m.segment(i), &b.frusta[0]))),
            Bore => self.each(|i| deepest_in_bore(segment_bore(&m.segment(i), &b.bores[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn rays(self) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.each(|i| along(m.ray(i), |a| ray_polyhedron(a, &b.polyhedra[0]))),
            Triangle => self.each(|i| along(m.ray(i), |a| ray_triangle(a, &b.triangles, 0, 0.0))),
            Plane => self.each(|i| along(m.ray(i), |a| ray_plane(a, &b.planes[0]))),
            PrimitiveKind::Sphere => self.each(|i| along(m.ray(i), |a| ray_sphere(a, &b.spheres[0]))),
            PrimitiveKind::Ellipsoid => {
                self.each(|i| along(m.ray(i), |a| ray_ellipsoid(a, &b.ellipsoids[0])));
            }
            PrimitiveKind::Capsule => self.each(|i| along(m.ray(i), |a| ray_capsule(a, &b.capsules[0]))),
            Cylinder | Cone => self.each(|i| along(m.ray(i), |a| ray_frustum(a, &b.frusta[0]))),
            Bore => self.each(|i| along(m.ray(i), |a| ray_bore(a, &b.bores[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn spheres<S: Simd>(self, simd: S) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.spheres_on_hull(simd),
            Plane => self.each(|i| sphere_plane(&m.sphere(i), &b.planes[0])),
            PrimitiveKind::Sphere => self.each(|i| sphere_sphere(&m.sphere(i), &b.spheres[0])),
            Triangle => self.spheres_on_triangle(simd),
            PrimitiveKind::Capsule => self.each(|i| ball_capsule(&m.sphere(i), &b.capsules[0])),
            Cylinder | Cone => self.each(|i| ball_frustum(&m.sphere(i), &b.frusta[0])),
            Bore => self.each(|i| deepest(ball_bore(&m.sphere(i), &b.bores[0]))),
            PrimitiveKind::Ellipsoid => self.each(|i| sphere_ellipsoid(&m.sphere(i), &b.ellipsoids[0])),
            _ => self.no_tester(),
        }
    }

    /// Tests eight points at a time against all faces; then those inside one by one, as first contacts.
    #[inline(always)]
    fn points_in_hull<S: Simd>(self, simd: S) {
        let b = &self.body.polyhedra[0];
        for (chunk, answers) in self.answers.chunks_mut(LANES).enumerate() {
            let (mut points, mut lanes) = ([POINT; LANES], Lanes::ORIGIN);
            for (lane, point) in points.iter_mut().enumerate().take(answers.len()) {
                *point = self.movers.point(LANES * chunk + lane);
                lanes.set(lane, &point.position);
            }
            let inside = b.lanes_contain_in(simd, &lanes);
            for (lane, (point, answer)) in points.iter().zip(answers).enumerate() {
                let p = &point.position;
                let below = || point_below_face(p, b, shallowest_face(p, b)?);
                *answer =
                    (inside >> lane & 1 == 1).then(below).flatten().map(Answer::from).unwrap_or_default();
            }
        }
    }

    /// Tests eight segments at a time; then those not separated by a face, one by one.
    #[inline(always)]
    fn segments_in_hull<S: Simd>(self, simd: S) {
        let b = &self.body.polyhedra[0];
        for (chunk, answers) in self.answers.chunks_mut(LANES).enumerate() {
            let (mut segments, mut ends) = ([SEGMENT; LANES], [Lanes::ORIGIN; 2]);
            for (lane, segment) in segments.iter_mut().enumerate().take(answers.len()) {
                *segment = self.movers.segment(LANES * chunk + lane);
                ends[0].set(lane, &segment.ends[0]);
                ends[1].set(lane, &segment.ends[1]);
            }
            let kept_out = b.lanes_kept_out_in(simd, &ends);
            for (lane, (segment, answer)) in segments.iter().zip(answers).enumerate() {
                let near = || deepest_end(segment_solid(segment, b));
                *answer =
                    (kept_out >> lane & 1 == 0).then(near).flatten().map(Answer::from).unwrap_or_default();
            }
        }
    }

    /// Tests eight centres at a time; then those not separated by a face, one by one, as first contacts.
    #[inline(always)]
    fn spheres_on_hull<S: Simd>(self, simd: S) {
        let b = &self.body.polyhedra[0];
        for (chunk, answers) in self.answers.chunks_mut(LANES).enumerate() {
            let (mut spheres, mut lanes) = ([SPHERE; LANES], Lanes::ORIGIN);
            for (lane, sphere) in spheres.iter_mut().enumerate().take(answers.len()) {
                *sphere = self.movers.sphere(LANES * chunk + lane);
                lanes.set(lane, &sphere.center);
            }
            let apart = b.lanes_outside_in(simd, &lanes, &[RADIUS; LANES]);
            for (lane, (sphere, answer)) in spheres.iter().zip(answers).enumerate() {
                let near = || sphere_on_hull(sphere, b);
                *answer = (apart >> lane & 1 == 0).then(near).flatten().map(Answer::from).unwrap_or_default();
            }
        }
    }

    /// Transforms each sphere alone; those near triangles are collected in eights, as in the engine.
    #[inline(always)]
    fn spheres_on_triangle<S: Simd>(self, simd: S) {
        let b = &self.body.triangles;
        let mut pairs = SphereTrianglePairs::default();
        for (chunk, answers) in self.answers.chunks_mut(LANES).enumerate() {
            let mut spheres = [SPHERE; LANES];
            for (lane, sphere) in spheres.iter_mut().enumerate().take(answers.len()) {
                *sphere = self.movers.sphere(LANES * chunk + lane);
                pairs.add(sphere, 0, RADIUS);
            }
            let told = pairs.take_in(simd, b);
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
        let (m, b) = (self.movers, self.body);
        let thickness = ellipsoid().smallest_semi_axis();
        match self.kind {
            Hull => self.each(|i| ellipsoid_polyhedron(&m.ellipsoid(i), &b.polyhedra[0])),
            Plane => self.each(|i| ellipsoid_plane(&m.ellipsoid(i), &b.planes[0])),
            Triangle => self
                .each(|i| last(|emit| ellipsoid_triangle(&m.ellipsoid(i), &b.triangles, 0, thickness, emit))),
            PrimitiveKind::Ellipsoid => {
                self.each(|i| ellipsoid_ellipsoid(&m.ellipsoid(i), &b.ellipsoids[0]));
            }
            PrimitiveKind::Capsule => self.each(|i| ellipsoid_capsule(&m.ellipsoid(i), &b.capsules[0])),
            Cylinder | Cone => self.each(|i| ellipsoid_frustum(&m.ellipsoid(i), &b.frusta[0])),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn capsules(self) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.each(|i| capsule_on_hull(&m.capsule(i), &b.polyhedra[0])),
            Triangle => self.each(|i| capsule_on_triangle(&m.capsule(i), b)),
            Plane => self.each(|i| deepest(capsule_plane(&m.capsule(i), &b.planes[0]))),
            PrimitiveKind::Capsule => {
                self.each(|i| deepest_end(capsule_capsule(&m.capsule(i), &b.capsules[0])));
            }
            Cylinder | Cone => self.each(|i| deepest_end(capsule_frustum(&m.capsule(i), &b.frusta[0]))),
            Bore => self.each(|i| deepest_in_bore(capsule_bore(&m.capsule(i), &b.bores[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn cylinders(self) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.each(|i| deepest(frustum_solid(&m.cylinder(i), &b.polyhedra[0]))),
            Triangle => self.each(|i| frustum_on_triangle(&m.cylinder(i), b)),
            Plane => self.each(|i| deepest(frustum_plane(&m.cylinder(i), &b.planes[0]))),
            Cylinder | Cone => self.each(|i| deepest_end(two_frusta(&m.cylinder(i), &b.frusta[0]))),
            Bore => self.each(|i| deepest_in_bore(cylinder_bore(&m.cylinder(i), &b.bores[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn cones(self) {
        let (m, b) = (self.movers, self.body);
        match self.kind {
            Hull => self.each(|i| deepest(frustum_solid(&m.cone(i), &b.polyhedra[0]))),
            Triangle => self.each(|i| frustum_on_triangle(&m.cone(i), b)),
            Plane => self.each(|i| deepest(frustum_plane(&m.cone(i), &b.planes[0]))),
            Cylinder | Cone => self.each(|i| deepest_end(two_frusta(&m.cone(i), &b.frusta[0]))),
            _ => self.no_tester(),
        }
    }

    #[inline(always)]
    fn each<T: Into<Answer>>(self, test: impl Fn(usize) -> Option<T>) {
        for (i, answer) in self.answers.iter_mut().enumerate() {
            *answer = test(i).map(T::into).unwrap_or_default();
        }
    }

    #[cold]
    fn no_tester(&self) -> ! {
        let names = [self.mover.kind(), self.kind].map(PrimitiveKind::name).join("–");
        panic!("{names}: the engine has a tester that bench/src/ours.rs does not call");
    }
}

fn sphere_on_hull(a: &Sphere, b: &Polyhedron) -> Option<Interference> {
    match b.contains(&a.center) {
        true => Some(sphere_inside_polyhedron(a, b, shallowest_face(&a.center, b)?)),
        false => sphere_outside_polyhedron(a, b),
    }
}

/// A point as a sphere of radius zero.
fn ball(point: &Point) -> Sphere {
    Sphere { center: point.position, radius: 0.0 }
}

fn capsule_on_hull(a: &Capsule, b: &Polyhedron) -> Option<Interference> {
    deepest_end(capsule_solid(a, b, &[]))
}

fn capsule_on_triangle(a: &Capsule, b: &MovableGroup) -> Option<Interference> {
    let view = TriangleView::new(&b.triangles, 0);
    let edges = (0..3).filter_map(|k| {
        let (ends_b, normals_b) = (view.edge_ends(k), [view.normal; 2]);
        let (outwards_b, free_outward_b, feature) = (None, Some(view.outward(k)), Feature::edge(k));
        capsule_edge(a, &ConvexEdge { ends_b, normals_b, outwards_b, free_outward_b, feature })
    });
    let over = |ball: &Sphere| last(|emit| sphere_triangle(ball, &b.triangles, 0, ball.radius, emit));
    deepest(balls(a).iter().map(over).chain(edges.map(Some)))
}

fn frustum_on_triangle(a: &Frustum, b: &MovableGroup) -> Option<Interference> {
    let view = TriangleView::new(&b.triangles, 0);
    let sides = (0..3).map(|k| {
        let (ends_b, normals_b) = (view.edge_ends(k), [view.normal; 2]);
        let (outwards_b, free_outward_b, feature) = (None, Some(view.outward(k)), Feature::edge(k));
        side_edge(a, &ConvexEdge { ends_b, normals_b, outwards_b, free_outward_b, feature })
    });
    let thickness = a.radii[0].min(a.radii[1]);
    let over = |end| last(|emit| EndDisc { frustum: a, end }.on_triangle(&b.triangles, 0, thickness, emit));
    deepest((0..2).map(over).chain(sides))
}

fn balls(a: &Capsule) -> [Sphere; 2] {
    a.ends.map(|center| Sphere { center, radius: a.radius })
}

fn deepest(found: impl IntoIterator<Item = Option<Interference>>) -> Option<Interference> {
    found.into_iter().flatten().max_by(|a, b| a.depth.total_cmp(&b.depth))
}

fn deepest_end<const N: usize>(found: [Option<EndContact>; N]) -> Option<Interference> {
    deepest(found.map(|end| end.map(|contact| contact.interference)))
}

fn deepest_in_bore(found: EndsInBore) -> Option<Interference> {
    deepest(found.into_iter().flatten().map(|end| end.map(|contact| contact.interference)))
}

/// The last contact of a test that may emit several.
#[inline(always)]
fn last(test: impl FnOnce(&mut dyn FnMut(TriangleContact))) -> Option<Interference> {
    let mut found = None;
    test(&mut |contact| found = Some(contact.interference));
    found
}

#[inline(always)]
fn along(a: Ray, test: impl FnOnce(&Ray) -> Option<RayHit>) -> Option<Answer> {
    let hit = test(&a)?;
    Some(Answer::new(hit.distance, hit.normal_b, a.origin + a.direction * hit.distance))
}

impl From<Interference> for Answer {
    fn from(found: Interference) -> Self {
        Self::new(found.depth, found.normal_b, found.deepest_b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairs::{self, TARGET_RADIUS};
    use crate::peer::PairPeer;
    use std::collections::BTreeSet;

    #[test]
    fn every_tester_of_the_engine_finds_the_hits_and_misses_that_were_made() {
        let mut kinds = BTreeSet::new();
        for (mover, target) in pairs::all() {
            let mut ours = Ours::new(mover, &target);
            let queries = Queries::new(64, mover, &target, |x| ours.touches(x));
            let mut answers = vec![Answer::default(); queries.hits.len()];
            ours.pass(&queries, &mut answers);
            let differs = |i: &usize| answers[*i].hit() != queries.hits[*i];
            let differing: Vec<usize> = (0..answers.len()).filter(differs).collect();
            assert!(differing.is_empty(), "{mover:?}–{:?}: {differing:?}", target.kind());
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
