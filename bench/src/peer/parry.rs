//! parry on the ring, on the terrain, and on pairs of convex solids.

use super::Peer;
use crate::ring::{Ring, TIP_RADIUS, Tip, WEDGE_FACES};
use crate::solids::{self, SolidsPeer};
use crate::terrain::{Terrain, Wheel};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{
    ContactManifold, ContactManifoldsWorkspace, DefaultQueryDispatcher, PersistentQueryDispatcher, PointQuery,
};
use parry3d_f64::shape::{Ball, Compound, ConvexPolyhedron, Cuboid, Shape, SharedShape, TriMesh};
use pong_engine::State;
use pong_geometry::Vec3;

/// A vector in parry's form.
pub fn vector(v: &Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

/// A pose in parry's form.
pub fn pose(position: [f64; 3], [w, x, y, z]: [f64; 4]) -> Pose {
    let [px, py, pz] = position;
    Pose::from_parts(Vector::new(px, py, pz), Rotation::from_xyzw(x, y, z, w))
}

fn pose_of(state: &State) -> Pose {
    pose(state.position, state.orientation)
}

fn wedge(corners: &[Vec3; 8]) -> ConvexPolyhedron {
    let triangles: Vec<[u32; 3]> =
        WEDGE_FACES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ConvexPolyhedron::from_convex_mesh(corners.iter().map(vector).collect(), &triangles)
        .expect("a wedge is convex")
}

/// Data kept by parry for one pair of shapes.
type Kept = (Vec<ContactManifold<(), ()>>, Option<ContactManifoldsWorkspace>);

/// One shape against others through parry's own pair dispatch, with its data kept from frame to frame.
pub struct Manifolds {
    first: Box<dyn Shape>,
    second: Box<dyn Shape>,
    pairs: Vec<Kept>,
}

impl Manifolds {
    /// The ring: one compound of wedges, one of balls.
    pub fn ring(ring: &Ring) -> Self {
        let wedges = ring.wedges.iter().map(|corners| (Pose::IDENTITY, SharedShape::new(wedge(corners))));
        let balls = ring
            .tips
            .iter()
            .map(|tip| (Pose::from_translation(vector(tip)), SharedShape::new(Ball::new(TIP_RADIUS))));
        Self::of(Compound::new(wedges.collect()), Compound::new(balls.collect()), 1)
    }

    /// A terrain and wheels; `None` for ellipsoids, which parry does not have.
    pub fn terrain(terrain: &Terrain, wheel: Wheel, wheels: usize) -> Option<Self> {
        let Wheel::Sphere { radius } = wheel else { return None };
        Some(Self::of(trimesh(terrain), Ball::new(radius), wheels))
    }

    /// Two equal convex solids: cuboids, or convex polyhedra.
    ///
    /// # Panics
    /// If parry refuses the hull.
    pub fn solids(shape: &solids::Shape) -> Self {
        if let Some(half) = shape.half {
            let cuboid = Cuboid::new(half.into());
            return Self::of(cuboid, cuboid, 1);
        }
        let hull = shape.hull();
        let vertices = hull.vertices.iter().map(vector).collect();
        let polyhedron = ConvexPolyhedron::from_convex_mesh(vertices, &hull.faces).expect("a hull is convex");
        Self::of(polyhedron.clone(), polyhedron, 1)
    }

    fn of(first: impl Shape, second: impl Shape, pairs: usize) -> Self {
        Self {
            first: Box::new(first),
            second: Box::new(second),
            pairs: (0..pairs).map(|_| Default::default()).collect(),
        }
    }
}

impl Peer for Manifolds {
    fn frame(&mut self, states: &[State]) -> usize {
        let first = pose_of(&states[0]);
        let mut contacts = 0;
        for (state, (manifolds, workspace)) in states[1..].iter().zip(&mut self.pairs) {
            let relative = first.inv_mul(&pose_of(state));
            DefaultQueryDispatcher
                .contact_manifolds(&relative, &*self.first, &*self.second, 0.0, manifolds, workspace)
                .expect("parry knows these shapes");
            contacts += manifolds
                .iter()
                .flat_map(|manifold| &manifold.points)
                .filter(|point| point.dist < 0.0)
                .count();
        }
        contacts
    }

    fn deepest(&self) -> Option<f64> {
        let manifolds = self.pairs.iter().flat_map(|(manifolds, _)| manifolds);
        manifolds.flat_map(|manifold| &manifold.points).map(|point| -point.dist).max_by(f64::total_cmp)
    }
}

impl SolidsPeer for Manifolds {
    /// Every pair begins without kept data, because the pairs do not follow each other in time.
    fn pass(&mut self, pairs: &[solids::Pair]) -> usize {
        let touches = |pair: &&solids::Pair| {
            let [first, second] = pair.numbers.map(|[x, y, z, w, i, j, k]| pose([x, y, z], [w, i, j, k]));
            let (mut manifolds, mut workspace): Kept = Kept::default();
            DefaultQueryDispatcher
                .contact_manifolds(
                    &first.inv_mul(&second),
                    &*self.first,
                    &*self.second,
                    0.0,
                    &mut manifolds,
                    &mut workspace,
                )
                .expect("parry knows these shapes");
            manifolds.iter().flat_map(|manifold| &manifold.points).any(|point| point.dist < 0.0)
        };
        pairs.iter().filter(touches).count()
    }
}

/// parry's triangle mesh of a terrain.
///
/// # Panics
/// If the terrain has no triangle.
pub fn trimesh(terrain: &Terrain) -> TriMesh {
    let vertices = terrain.vertices().iter().map(vector).collect();
    TriMesh::new(vertices, terrain.triangles()).expect("a terrain has triangles")
}

/// A custom loop over parry's tree of wedges and its point projection.
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
            radius: tip.radius(),
        }
    }
}

impl Peer for Loop {
    fn frame(&mut self, states: &[State]) -> usize {
        let pose = pose_of(&states[0]).inv_mul(&pose_of(&states[1]));
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
