//! W11: pairs of convex solids at the poses of `peers/solids_pairs.json`.

use crate::hull::Hull;
use crate::random::Random;
use crate::rig::{Rig, config};
use crate::scenes::parse;
use pong_engine::{State, WorldBuilder};
use pong_geometry::overlap::{Field, Overlap, Surface};
use pong_geometry::{Pose, Twist, Vec3};
use pong_model::Model;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::error::Error;
use std::sync::Arc;

const FILE: &str = include_str!("../peers/solids_pairs.json");

/// Poses of both bodies of a pair in a common frame.
#[derive(Clone, Copy)]
pub struct Pair {
    /// Position (m) and quaternion (w, x, y, z) of each, the form of engines in C.
    pub numbers: [[f64; 7]; 2],
    poses: [Pose; 2],
}

/// All shapes and cases.
#[derive(Deserialize)]
pub struct File {
    shapes: BTreeMap<String, Shape>,
    /// Pairs of equal shapes.
    pub cases: Vec<Case>,
}

/// A convex solid.
#[derive(Clone, Deserialize)]
pub struct Shape {
    /// Half edges, m, if the solid is a box.
    pub half: Option<[f64; 3]>,
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Two equal shapes at several poses.
#[derive(Deserialize)]
pub struct Case {
    /// Name of the case.
    pub name: String,
    first: String,
    /// True if the bodies overlap at all poses, false if they do at none.
    pub overlap: bool,
    poses: Vec<Vec<f64>>,
}

impl File {
    /// Reads the file.
    ///
    /// # Errors
    /// A fault of the file.
    pub fn read() -> Result<Self, serde_json::Error> {
        serde_json::from_str(FILE)
    }

    /// Shape of a case.
    pub fn shape(&self, case: &Case) -> &Shape {
        &self.shapes[&case.first]
    }
}

impl Shape {
    /// The solid as a polyhedron.
    pub fn hull(&self) -> Hull {
        Hull { vertices: self.vertices.iter().map(|&v| v.into()).collect(), faces: self.triangles.clone() }
    }

    /// Model of the solid, without memory of the side of entry: the poses of a case do not follow each other.
    ///
    /// # Errors
    /// A fault of the model.
    pub fn model(&self) -> Result<Arc<Model>, Box<dyn Error>> {
        let text = self.hull().model();
        parse(
            &text
                .replace("surfaces:", "entry_memory: false, surfaces:")
                .replace("root: (", "root: (contact: Solid, "),
        )
    }
}

impl Case {
    /// `count` pairs in random order; each pose of the case comes several times.
    pub fn pairs(&self, count: usize, random: &mut Random) -> Vec<Pair> {
        let pair = |row: &Vec<f64>| {
            let numbers = [0, 7].map(|first| std::array::from_fn(|i| row[first + i]));
            Pair { numbers, poses: numbers.map(|numbers| pose(&numbers)) }
        };
        let mut pairs: Vec<Pair> = self.poses.iter().map(pair).cycle().take(count).collect();
        for i in (1..count).rev() {
            pairs.swap(i, random.between(0.0, (i + 1) as f64) as usize);
        }
        pairs
    }
}

/// Pose from a position and a quaternion (w, x, y, z).
fn pose(&[x, y, z, w, i, j, k]: &[f64; 7]) -> Pose {
    Pose::new(Vec3::new(x, y, z), [w, i, j, k])
}

/// An engine on pairs of equal convex solids.
pub trait SolidsPeer {
    /// Finds the contacts of all pairs; returns how many pairs have one.
    fn pass(&mut self, pairs: &[Pair]) -> usize;
}

/// Pong's overlapped volume: bodies apart or not, then the cells of both fields. No forces.
pub struct Volume {
    model: Arc<Model>,
    overlap: Overlap,
}

impl Volume {
    /// The volume of two such solids.
    pub fn new(model: Arc<Model>) -> Self {
        let facets = model.bodies[0].solids[0].parts[0].surface.facet_count();
        Self { model, overlap: Overlap::with_capacity(4 * facets) }
    }
}

impl SolidsPeer for Volume {
    fn pass(&mut self, pairs: &[Pair]) -> usize {
        let solid = &self.model.bodies[0].solids[0];
        let surface: &Surface = &solid.parts[0].surface;
        let field = Field { faces: &solid.fields[0].faces, walls: &solid.fields[0].walls };
        let at_rest = Twist::zero();
        let touches = |pair: &&Pair| {
            let x_ba = Pose::relative(&pair.poses[0], &pair.poses[1]).transform();
            let x_ab = x_ba.inverse();
            if Overlap::apart(surface, &x_ba, &field) || Overlap::apart(surface, &x_ab, &field) {
                return false;
            }
            if !self.overlap.share_volume(surface, &x_ba, &field) {
                return false;
            }
            let of_b = self.overlap.cells(surface, &x_ba, &field, &at_rest).len();
            let of_a = self.overlap.cells(surface, &x_ab, &field, &at_rest).len();
            of_b + of_a > 0
        };
        pairs.iter().filter(touches).count()
    }
}

/// Pong's whole frame: states in, contacts, normal forces and friction, contact memory, wrenches out.
pub struct Frame(Rig);

impl Frame {
    /// A world of two such solids.
    ///
    /// # Errors
    /// Any error of the engine.
    pub fn new(model: Arc<Model>) -> Result<Self, Box<dyn Error>> {
        let models = [Arc::clone(&model), model];
        Ok(Self(Rig::in_world(WorldBuilder::new(config(1)), &models, &[(0, 1)])?))
    }
}

impl SolidsPeer for Frame {
    fn pass(&mut self, pairs: &[Pair]) -> usize {
        let mut touching = 0;
        for pair in pairs {
            let states = pair.poses.map(|pose| State::from_motion(&pose, &Twist::zero()));
            std::hint::black_box(self.0.step(&states));
            touching += usize::from(self.0.world.report().contacts > 0);
        }
        touching
    }
}
