//! W3, a bumpy terrain: a grid of 0.1 m cells, two triangles each, and bodies that roll over it.

use crate::ron;
use pong_engine::State;
use pong_geometry::{Quat, Vec3};
use std::fmt::Write as _;

const CELL: f64 = 0.1;
const BUMP: f64 = 0.04;

/// A grid of cells around the origin.
#[derive(Clone, Copy, Debug)]
pub struct Terrain {
    /// Cells along x and y.
    pub cells: [usize; 2],
}

/// Source of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Binary STL, named by the model file.
    Stl,
    /// Wavefront OBJ, named by the model file.
    Obj,
    /// Lists in the model file itself.
    Inline,
}

impl Terrain {
    /// Terrains of about 1e3, 1e4, 1e5 and 1e6 triangles.
    pub const SIZES: [Self; 4] = [
        Self { cells: [25, 20] },
        Self { cells: [100, 50] },
        Self { cells: [250, 200] },
        Self { cells: [1000, 500] },
    ];

    /// Number of triangles.
    pub fn count(&self) -> usize {
        2 * self.cells[0] * self.cells[1]
    }

    /// Vertices, row after row.
    pub fn vertices(&self) -> Vec<Vec3> {
        let [nx, ny] = self.cells;
        let place = |i: usize, n: usize| (i as f64 - 0.5 * n as f64) * CELL;
        let row = |j: usize| (0..=nx).map(move |i| at(place(i, nx), place(j, ny)));
        (0..=ny).flat_map(row).collect()
    }

    /// Vertex numbers of the triangles, front up.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let [nx, ny] = self.cells;
        let cell = |(i, j): (usize, usize)| {
            let v = (j * (nx + 1) + i) as u32;
            let (right, back, across) = (v + 1, v + nx as u32 + 1, v + nx as u32 + 2);
            [[v, right, across], [v, across, back]]
        };
        (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))).flat_map(cell).collect()
    }

    /// The model file, and the mesh file it names, if any.
    pub fn files(&self, source: Source) -> (String, Option<(&'static str, Vec<u8>)>) {
        let named =
            |file: &str| ron::model("terrain", &format!("TriangleMesh(name: \"ground\", file: \"{file}\")"));
        match source {
            Source::Stl => (named("ground.stl"), Some(("ground.stl", self.stl()))),
            Source::Obj => (named("ground.obj"), Some(("ground.obj", self.obj().into_bytes()))),
            Source::Inline => (self.inline(), None),
        }
    }

    /// Heights at the vertices, row after row, and half the size along x and y, m.
    pub fn heights(&self) -> (Vec<f64>, [f64; 2]) {
        let heights = self.vertices().iter().map(|vertex| vertex.z).collect();
        (heights, self.cells.map(|cells| 0.5 * cells as f64 * CELL))
    }

    fn stl(&self) -> Vec<u8> {
        let (vertices, triangles) = (self.vertices(), self.triangles());
        let mut out = vec![0_u8; 80];
        out.extend((triangles.len() as u32).to_le_bytes());
        for triangle in &triangles {
            let [a, b, c] = triangle.map(|v| vertices[v as usize]);
            let normal = (b - a).cross(&(c - a)).normalize();
            for x in [normal, a, b, c].iter().flat_map(|v| v.iter()) {
                out.extend((*x as f32).to_le_bytes());
            }
            out.extend([0, 0]);
        }
        out
    }

    fn obj(&self) -> String {
        let mut out = String::new();
        for v in self.vertices() {
            writeln!(out, "v {} {} {}", v.x, v.y, v.z).expect("memory takes all");
        }
        for [a, b, c] in self.triangles() {
            writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1).expect("memory takes all");
        }
        out
    }

    fn inline(&self) -> String {
        let vertices = ron::vectors(&self.vertices());
        let triangle = |[a, b, c]: [u32; 3]| format!("({a},{b},{c})");
        let triangles = self.triangles().into_iter().map(triangle).collect::<Vec<_>>().join(",");
        let mesh =
            format!("TriangleMesh(name: \"ground\", vertices: [{vertices}], triangles: [{triangles}])");
        ron::model("terrain", &mesh)
    }
}

/// Ground position at x and y, rounded to f32, so that every kind of file holds the same mesh.
fn at(x: f64, y: f64) -> Vec3 {
    let z = BUMP * (x * 1.3).sin() * (y * 1.7).cos() + 0.25 * BUMP * (x * 7.1 + y * 5.3).sin();
    Vec3::new(x, y, z).map(|x| f64::from(x as f32))
}

/// Kind of the wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wheel {
    /// A sphere.
    Sphere {
        /// Radius, m.
        radius: f64,
    },
    /// An ellipsoid with its axes along those of its body.
    Ellipsoid {
        /// Semi-axes, m.
        semi_axes: [f64; 3],
    },
}

impl Wheel {
    /// The two wheels of the workload.
    pub const BOTH: [Self; 2] =
        [Self::Sphere { radius: 0.25 }, Self::Ellipsoid { semi_axes: [0.25, 0.12, 0.25] }];

    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Ellipsoid { .. } => "ellipsoid",
        }
    }

    /// Model file of one wheel.
    pub fn model(self) -> String {
        let shape = match self {
            Self::Sphere { radius } => {
                format!("Sphere(name: \"wheel\", center: (0, 0, 0), radius: {radius:?})")
            }
            Self::Ellipsoid { semi_axes: [a, b, c] } => {
                format!("Ellipsoid(name: \"wheel\", center: (0, 0, 0), semi_axes: ({a:?}, {b:?}, {c:?}))")
            }
        };
        ron::model("wheel", &shape)
    }

    /// Reach below its centre when upright, m.
    fn reach(self) -> f64 {
        match self {
            Self::Sphere { radius } => radius,
            Self::Ellipsoid { semi_axes } => semi_axes[2],
        }
    }
}

/// Number of wheels.
pub const WHEELS: usize = 6;
/// Positions of the wheels about the middle of the vehicle, m.
const PLACES: [(f64, f64); WHEELS] =
    [(-0.5, -0.4), (0.0, -0.4), (0.5, -0.4), (-0.5, 0.4), (0.0, 0.4), (0.5, 0.4)];
/// Depth of a wheel's lowest point below the ground beneath it, m.
const PRESSED: f64 = 0.004;

/// States of the terrain, at rest, and of the wheels, which roll to and fro near the middle, each with the
/// lowest point of its upright shape 4 mm below the ground.
pub fn states(frames: usize, wheel: Wheel) -> Vec<Vec<State>> {
    let states = |frame: usize| {
        let phase = frame as f64 / frames as f64 * std::f64::consts::TAU;
        let wheels = PLACES.map(|place| rolling(phase, place, wheel.reach() - PRESSED));
        std::iter::once(State::identity()).chain(wheels).collect()
    };
    (0..frames).map(states).collect()
}

fn rolling(phase: f64, place: (f64, f64), height: f64) -> State {
    let (x, y) = (place.0 + 0.03 + 0.4 * phase.sin(), place.1 - 0.02 + 0.3 * phase.cos());
    let center = Vec3::new(x, y, at(x, y).z + height);
    let turn = Quat::from_scaled_axis(Vec3::new(0.2 * phase.cos(), 0.3 * phase.sin(), phase.sin()));
    State {
        position: center.into(),
        orientation: [turn.w, turn.i, turn.j, turn.k],
        linear_velocity: [0.4 * phase.cos(), -0.3 * phase.sin(), 0.0],
        ..State::identity()
    }
}
