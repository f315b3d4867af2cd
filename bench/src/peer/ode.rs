//! ODE, through `shim/ode.c`.

use super::{AnswerFrame, PairPeer, Peer, hull_of, pose_numbers};
use crate::floor::ring::planes;
use crate::hull::{Hull, TRIANGLE};
use crate::pairs::{
    Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, ROUND_HALF_LENGTH, TARGET_ROUND, Target,
};
use crate::ring::{Ring, Tip, WEDGE_FACES};
use crate::solids::{Pair, Shape, SolidsPeer};
use crate::terrain::{Terrain, Wheel};
use pong_engine::State;
use pong_geometry::Vec3;
use std::ffi::{c_int, c_uint};

#[repr(C)]
struct Opaque {
    _private: [u8; 0],
}

const SPHERE: c_int = 0;
const CAPSULE: c_int = 1;
const A_RAY: c_int = 2;
const CYLINDER: c_int = 3;
/// Radius of the sphere in place of a point, which ODE lacks, m.
const THIN: f64 = 1e-9;

unsafe extern "C" {
    fn pong_ode_new(space: c_int, center: *const f64, extents: *const f64) -> *mut Opaque;
    fn pong_ode_free(scene: *mut Opaque);
    fn pong_ode_add_convex(
        scene: *mut Opaque,
        planes: *const f64,
        plane_count: c_uint,
        points: *const f64,
        point_count: c_uint,
        polygons: *const c_uint,
        center: *const f64,
    );
    fn pong_ode_add_sphere(scene: *mut Opaque, center: *const f64, radius: f64);
    fn pong_ode_frame(scene: *mut Opaque, poses: *const f64) -> c_int;
    fn pong_ode_target_convex(
        scene: *mut Opaque,
        planes: *const f64,
        plane_count: c_uint,
        points: *const f64,
        point_count: c_uint,
        polygons: *const c_uint,
    );
    fn pong_ode_target_mesh(
        scene: *mut Opaque,
        vertices: *const f64,
        vertex_count: c_int,
        triangles: *const c_uint,
        triangle_count: c_int,
    );
    fn pong_ode_target_round(scene: *mut Opaque, kind: c_int, radius: f64, length: f64);
    fn pong_ode_mover(scene: *mut Opaque, kind: c_int, radius: f64, length: f64);
    fn pong_ode_boxes(scene: *mut Opaque, edges: *const f64);
    fn pong_ode_mover_convex(
        scene: *mut Opaque,
        planes: *const f64,
        plane_count: c_uint,
        points: *const f64,
        point_count: c_uint,
        polygons: *const c_uint,
    );
    fn pong_ode_wheels(scene: *mut Opaque, poses: *const f64, count: c_int) -> c_int;
    fn pong_ode_deepest(scene: *const Opaque) -> f64;
    fn pong_ode_pairs(scene: *mut Opaque, poses: *const f64, count: c_int, answers: *mut Answer);
    fn pong_ode_rays(scene: *mut Opaque, poses: *const f64, count: c_int, start: f64, answers: *mut Answer);
}

/// A convex geom in ODE's layout; ODE keeps pointers into it.
struct Convex {
    planes: Vec<[f64; 4]>,
    points: Vec<[f64; 3]>,
    /// Number of corners, then the corners, for each polygon.
    polygons: Vec<c_uint>,
}

impl Convex {
    fn new<const N: usize>(vertices: &[Vec3], planes: &[(Vec3, f64)], faces: &[[u32; N]]) -> Self {
        Self {
            planes: planes.iter().map(|(n, offset)| [n.x, n.y, n.z, *offset]).collect(),
            points: vertices.iter().map(|&v| v.into()).collect(),
            polygons: faces.iter().flat_map(|face| std::iter::once(N as u32).chain(*face)).collect(),
        }
    }
}

/// The scene, with the memory it points into.
struct Scene {
    pointer: *mut Opaque,
    convexes: Vec<Convex>,
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Kind of space that holds the geoms of a body. ODE's default, a hash space, is slower on these scenes than
/// either.
#[derive(Clone, Copy, Debug)]
pub enum Space {
    /// A quadtree over the region of the scene.
    Quadtree,
    /// Sweep and prune along x, then y, then z.
    SweepAndPrune,
}

impl Scene {
    fn new(space: Space) -> Self {
        // The ring is some 40 m from the origin and moves a little: docs of `ring`.
        let (center, extents) = ([40.0, -30.0, 20.0, 0.0], [1.5, 1.5, 1.5, 0.0]);
        // SAFETY: four numbers each.
        let pointer = unsafe { pong_ode_new(space as c_int, center.as_ptr(), extents.as_ptr()) };
        Self { pointer, convexes: Vec::new(), vertices: Vec::new(), triangles: Vec::new() }
    }

    fn target_mesh(&mut self, vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) {
        (self.vertices, self.triangles) = (vertices, triangles);
        // SAFETY: the arrays live as long as the scene and are not touched again.
        unsafe {
            pong_ode_target_mesh(
                self.pointer,
                self.vertices.as_ptr().cast(),
                self.vertices.len() as c_int,
                self.triangles.as_ptr().cast(),
                self.triangles.len() as c_int,
            );
        }
    }

    fn target_convex(&mut self, hull: &Hull) {
        self.convexes.push(Convex::new(&hull.vertices, &hull.planes(), &hull.faces));
        let convex = &self.convexes[0];
        let (planes, points) = (&convex.planes, &convex.points);
        // SAFETY: the arrays live as long as the scene and are not touched again.
        unsafe {
            pong_ode_target_convex(
                self.pointer,
                planes.as_ptr().cast(),
                planes.len() as c_uint,
                points.as_ptr().cast(),
                points.len() as c_uint,
                convex.polygons.as_ptr(),
            );
        }
    }

    fn target_round(&mut self, kind: c_int) {
        let ([one, other], radius) = TARGET_ROUND;
        // SAFETY: the scene lives.
        unsafe { pong_ode_target_round(self.pointer, kind, radius, other - one) };
    }

    fn mover(&mut self, kind: c_int, radius: f64, length: f64) {
        // SAFETY: the scene lives.
        unsafe { pong_ode_mover(self.pointer, kind, radius, length) };
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: made by new, freed once.
        unsafe { pong_ode_free(self.pointer) }
    }
}

/// ODE on the ring: two spaces against each other.
pub struct OdeRing {
    scene: Scene,
    poses: Vec<f64>,
}

impl OdeRing {
    /// The ring.
    pub fn new(ring: &Ring, tip: Tip, space: Space) -> Self {
        let mut scene = Scene::new(space);
        // ODE requires the origin of a convex geom to be inside.
        let centers: Vec<Vec3> = ring.wedges.iter().map(|wedge| wedge.iter().sum::<Vec3>() / 8.0).collect();
        let convex = |(wedge, center): (&[Vec3; 8], &Vec3)| {
            let wedge = wedge.map(|corner| corner - center);
            Convex::new(&wedge, &planes(&wedge), &WEDGE_FACES)
        };
        scene.convexes = ring.wedges.iter().zip(&centers).map(convex).collect();
        for (convex, center) in scene.convexes.iter().zip(&centers) {
            let (planes, points) = (&convex.planes, &convex.points);
            // SAFETY: the arrays live as long as the scene and are not touched again.
            unsafe {
                pong_ode_add_convex(
                    scene.pointer,
                    planes.as_ptr().cast(),
                    planes.len() as c_uint,
                    points.as_ptr().cast(),
                    points.len() as c_uint,
                    convex.polygons.as_ptr(),
                    center.as_ptr(),
                );
            }
        }
        for center in &ring.tips {
            // SAFETY: three numbers.
            unsafe { pong_ode_add_sphere(scene.pointer, center.as_ptr(), tip.radius().max(THIN)) };
        }
        Self { scene, poses: Vec::new() }
    }
}

impl Peer for OdeRing {
    fn frame(&mut self, states: &[State]) -> usize {
        self.poses.clear();
        self.poses.extend(states.iter().flat_map(pose_numbers));
        // SAFETY: poses of two bodies.
        unsafe { pong_ode_frame(self.scene.pointer, self.poses.as_ptr()) as usize }
    }
}

/// ODE's triangle mesh and wheels on it, each queried alone.
pub struct OdeTerrain {
    scene: Scene,
    poses: Vec<f64>,
}

impl OdeTerrain {
    /// `None` for ellipsoids, which ODE does not have.
    pub fn new(terrain: &Terrain, wheel: Wheel) -> Option<Self> {
        let Wheel::Sphere { radius } = wheel else { return None };
        let mut scene = Scene::new(Space::SweepAndPrune);
        scene.target_mesh(terrain.vertices().iter().map(|&v| v.into()).collect(), terrain.triangles());
        scene.mover(SPHERE, radius, 0.0);
        Some(Self { scene, poses: Vec::new() })
    }
}

impl Peer for OdeTerrain {
    fn frame(&mut self, states: &[State]) -> usize {
        self.poses.clear();
        self.poses.extend(states[1..].iter().flat_map(pose_numbers));
        let count = (states.len() - 1) as c_int;
        // SAFETY: as many poses as told.
        unsafe { pong_ode_wheels(self.scene.pointer, self.poses.as_ptr(), count) as usize }
    }

    fn deepest(&self) -> Option<f64> {
        // SAFETY: the scene lives.
        Some(unsafe { pong_ode_deepest(self.scene.pointer) })
    }
}

/// ODE on one pair.
pub struct OdePair {
    scene: Scene,
    mover: Mover,
}

impl OdePair {
    /// Builds one pair; `None` if ODE lacks the primitive. Its rays against convex bodies find hardly any
    /// hits. Cones are polyhedra.
    pub fn new(mover: Mover, target: &Target) -> Option<Self> {
        if matches!(mover, Mover::Ellipsoid | Mover::Cylinder | Mover::Cone) {
            return None;
        }
        let hull = hull_of(target);
        if mover == Mover::Ray && hull.is_some() {
            return None;
        }
        let mut scene = Scene::new(Space::SweepAndPrune);
        match (hull, target) {
            (Some(hull), _) => scene.target_convex(&hull),
            (_, Target::Capsule) => scene.target_round(CAPSULE),
            (_, Target::Cylinder) => scene.target_round(CYLINDER),
            (_, Target::Triangle) => scene.target_mesh(TRIANGLE.to_vec(), vec![[0, 1, 2]]),
            _ => return None,
        }
        match mover {
            Mover::Sphere => scene.mover(SPHERE, RADIUS, 0.0),
            Mover::Segment => scene.mover(CAPSULE, THIN, 2.0 * HALF_LENGTH),
            Mover::Ray => scene.mover(A_RAY, 0.0, RAY.2),
            Mover::Capsule => scene.mover(CAPSULE, RADIUS, 2.0 * ROUND_HALF_LENGTH),
            Mover::Point | Mover::Ellipsoid | Mover::Cylinder | Mover::Cone => scene.mover(SPHERE, THIN, 0.0),
        }
        Some(Self { scene, mover })
    }
}

impl PairPeer for OdePair {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        let poses = queries.numbers.as_ptr().cast();
        let count = answers.len().min(queries.numbers.len()) as c_int;
        let (scene, answers) = (self.scene.pointer, answers.as_mut_ptr());
        // SAFETY: the scene lives; there are as many poses and answers as told, in the form that C knows.
        unsafe {
            match self.mover {
                Mover::Ray => pong_ode_rays(scene, poses, count, RAY.0[2], answers),
                _ => pong_ode_pairs(scene, poses, count, answers),
            }
        }
    }

    fn frame_of_answers(&self) -> AnswerFrame {
        AnswerFrame::Common
    }
}

/// ODE on two equal convex solids: boxes, or convex geoms.
pub struct OdeSolids {
    scene: Scene,
    answers: Vec<Answer>,
}

impl OdeSolids {
    /// Builds the pair.
    pub fn new(shape: &Shape) -> Self {
        let mut scene = Scene::new(Space::SweepAndPrune);
        match shape.half {
            Some(half) => {
                let edges = half.map(|half| 2.0 * half);
                // SAFETY: three numbers.
                unsafe { pong_ode_boxes(scene.pointer, edges.as_ptr()) };
            }
            None => {
                scene.target_convex(&shape.hull());
                let Convex { planes, points, polygons } = &scene.convexes[0];
                // SAFETY: the arrays live as long as the scene and are not touched again.
                unsafe {
                    pong_ode_mover_convex(
                        scene.pointer,
                        planes.as_ptr().cast(),
                        planes.len() as c_uint,
                        points.as_ptr().cast(),
                        points.len() as c_uint,
                        polygons.as_ptr(),
                    );
                }
            }
        }
        Self { scene, answers: Vec::new() }
    }
}

impl SolidsPeer for OdeSolids {
    fn pass(&mut self, pairs: &[Pair]) -> usize {
        self.answers.resize(pairs.len(), Answer::default());
        for (pair, answer) in pairs.iter().zip(&mut self.answers) {
            // SAFETY: the scene lives; there are one pair of poses and one answer, in the form that C knows.
            unsafe { pong_ode_pairs(self.scene.pointer, pair.numbers.as_ptr().cast(), 1, answer) };
        }
        self.answers.iter().filter(|answer| answer.hit()).count()
    }
}
