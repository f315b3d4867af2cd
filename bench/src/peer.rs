//! parry on the same scenes: collision detection alone, without forces, friction or memory of contacts.

use crate::ring::{Ring, TIP_RADIUS, Tip, WEDGE_FACES};
use crate::terrain::Terrain;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{
    ContactManifold, ContactManifoldsWorkspace, DefaultQueryDispatcher, PersistentQueryDispatcher, PointQuery,
};
use parry3d_f64::shape::{Ball, Compound, ConvexPolyhedron, Shape, SharedShape, TriMesh};
use pong_engine::State;
use pong_geometry::Vec3;

fn vector(v: &Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn pose(state: &State) -> Pose {
    let [w, x, y, z] = state.orientation;
    let [px, py, pz] = state.position;
    Pose::from_parts(Vector::new(px, py, pz), Rotation::from_xyzw(x, y, z, w))
}

/// Pose of the second body seen from the first.
fn relative(states: &[State; 2]) -> Pose {
    pose(&states[0]).inv_mul(&pose(&states[1]))
}

fn wedge(corners: &[Vec3; 8]) -> ConvexPolyhedron {
    let triangles: Vec<[u32; 3]> =
        WEDGE_FACES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ConvexPolyhedron::from_convex_mesh(corners.iter().map(vector).collect(), &triangles)
        .expect("a wedge is convex")
}

/// One shape against another through parry's own pair dispatch, with what it keeps from frame to frame.
pub struct Manifolds {
    shapes: [Box<dyn Shape>; 2],
    manifolds: Vec<ContactManifold<(), ()>>,
    workspace: Option<ContactManifoldsWorkspace>,
}

impl Manifolds {
    /// The ring: one compound of wedges, one of balls.
    pub fn ring(ring: &Ring) -> Self {
        let wedges = ring.wedges.iter().map(|corners| (Pose::IDENTITY, SharedShape::new(wedge(corners))));
        let balls = ring
            .tips
            .iter()
            .map(|tip| (Pose::from_translation(vector(tip)), SharedShape::new(Ball::new(TIP_RADIUS))));
        Self::of(Compound::new(wedges.collect()), Compound::new(balls.collect()))
    }

    /// A terrain and one ball around its own origin.
    pub fn terrain(terrain: &Terrain, radius: f64) -> Self {
        let vertices = terrain.vertices().iter().map(vector).collect();
        let mesh = TriMesh::new(vertices, terrain.triangles()).expect("a terrain has triangles");
        Self::of(mesh, Ball::new(radius))
    }

    fn of(first: impl Shape, second: impl Shape) -> Self {
        Self { shapes: [Box::new(first), Box::new(second)], manifolds: Vec::new(), workspace: None }
    }

    /// One frame; the number of contacts.
    ///
    /// # Panics
    /// If parry does not know the pair of shapes.
    pub fn frame(&mut self, states: &[State; 2]) -> usize {
        let [first, second] = &self.shapes;
        DefaultQueryDispatcher
            .contact_manifolds(
                &relative(states),
                &**first,
                &**second,
                0.0,
                &mut self.manifolds,
                &mut self.workspace,
            )
            .expect("parry knows these shapes");
        self.manifolds.iter().flat_map(|manifold| &manifold.points).filter(|point| point.dist < 0.0).count()
    }
}

/// A loop of one's own over parry's tree of wedges and its projection of a point.
pub struct Loop {
    wedges: Vec<ConvexPolyhedron>,
    tree: Bvh,
    tips: Vec<Vector>,
    radius: f64,
}

impl Loop {
    /// The ring.
    pub fn ring(ring: &Ring, tip: Tip) -> Self {
        let wedges: Vec<_> = ring.wedges.iter().map(wedge).collect();
        let boxes = wedges.iter().map(|wedge| wedge.local_aabb()).enumerate();
        Self {
            tree: Bvh::from_iter(BvhBuildStrategy::Binned, boxes),
            wedges,
            tips: ring.tips.iter().map(vector).collect(),
            radius: if tip == Tip::Sphere { TIP_RADIUS } else { 0.0 },
        }
    }

    /// One frame; the number of contacts.
    pub fn frame(&self, states: &[State; 2]) -> usize {
        let pose = relative(states);
        let mut contacts = 0;
        for tip in &self.tips {
            let center = pose.transform_point(*tip);
            let around = Aabb::from_half_extents(center, Vector::splat(self.radius));
            for index in self.tree.intersect_aabb(&around) {
                let projection = self.wedges[index as usize].project_local_point(center, false);
                let touches = projection.is_inside || (center - projection.point).length() < self.radius;
                contacts += usize::from(touches);
            }
        }
        contacts
    }
}
