//! W2, the docking ring: wedges on a ring of radius 0.6 m on one body, many small tips around it on the other.
//!
//! Both bodies move and turn; relative to each other they move by a few millimetres and milliradians. The
//! motion closes after [`FRAMES`], so that passes can follow one another.

use crate::motion::state;
use crate::random::Random;
use crate::ron;
use pong_engine::State;
use pong_geometry::{Pose, Quat, Vec3};
use std::f64::consts::TAU;

/// Numbers of wedges and tips.
pub const SIZES: [(usize, usize); 3] = [(12, 200), (48, 1000), (96, 5000)];
/// A ring with work for many cores.
pub const LARGE: (usize, usize) = (96, 50_000);
/// All sizes from the smallest to [`LARGE`], or only the smallest for a smoke test.
pub fn sizes(smoke: bool) -> impl Iterator<Item = (usize, usize)> {
    SIZES.into_iter().chain([LARGE]).take(if smoke { 1 } else { usize::MAX })
}

/// Frames of one pass.
pub const FRAMES: usize = 64;
/// Radius of a spherical tip, m.
pub const TIP_RADIUS: f64 = 2e-3;
/// Vertex numbers of a wedge's faces, counter-clockwise seen from outside.
pub const WEDGE_FACES: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

const RING_RADIUS: f64 = 0.6;
/// Share of the ring that wedges fill at their base.
const FILLED: f64 = 0.6;
const WEDGE_HEIGHT: f64 = 0.1;
const HALF_THICKNESS: f64 = 0.015;
/// Outward lean of a wedge's top, m.
const FLARE: f64 = 0.03;
/// Width and thickness of a wedge's top, relative to its base.
const TAPER: [f64; 2] = [0.8, 0.6];
const FRAME_SECONDS: f64 = 0.01;

/// Kind of the tips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tip {
    /// Spheres of [`TIP_RADIUS`].
    Sphere,
    /// Points.
    Point,
}

impl Tip {
    /// Radius, m; zero for points.
    pub fn radius(self) -> f64 {
        if self == Self::Sphere { TIP_RADIUS } else { 0.0 }
    }
}

/// The scene, each body in its own frame.
pub struct Ring {
    /// Corners of the wedges; the bits of a corner's index select outward, forward, up.
    pub wedges: Vec<[Vec3; 8]>,
    /// Centres of the tips.
    pub tips: Vec<Vec3>,
}

impl Ring {
    /// The scene of a size.
    pub fn new((wedges, tips): (usize, usize)) -> Self {
        let mut random = Random(0x7069_6e67 + tips as u64);
        Self {
            wedges: (0..wedges).map(|i| wedge(i as f64 / wedges as f64 * TAU, wedges)).collect(),
            tips: (0..tips).map(|_| tip(&mut random)).collect(),
        }
    }

    /// Model file of the body with the wedges.
    pub fn wedge_model(&self) -> String {
        let faces = WEDGE_FACES.map(|face| format!("{face:?}")).join(",");
        let polyhedron = |(i, corners): (usize, &[Vec3; 8])| {
            let vertices = ron::vectors(corners);
            format!("Polyhedron(name: \"wedge_{i}\", vertices: [{vertices}], faces: [{faces}]),\n")
        };
        ron::model("ring", &self.wedges.iter().enumerate().map(polyhedron).collect::<String>())
    }

    /// Model file of the body with the tips.
    pub fn tip_model(&self, kind: Tip) -> String {
        let tip = |(i, center): (usize, &Vec3)| {
            let center = ron::vector(center);
            match kind {
                Tip::Sphere => {
                    format!("Sphere(name: \"tip_{i}\", center: {center}, radius: {TIP_RADIUS:?}),\n")
                }
                Tip::Point => format!("Point(name: \"tip_{i}\", position: {center}),\n"),
            }
        };
        ron::model("tips", &self.tips.iter().enumerate().map(tip).collect::<String>())
    }
}

fn wedge(angle: f64, count: usize) -> [Vec3; 8] {
    let (sine, cosine) = angle.sin_cos();
    let (outward, forward) = (Vec3::new(cosine, sine, 0.0), Vec3::new(-sine, cosine, 0.0));
    let half_width = RING_RADIUS * (0.5 * FILLED * TAU / count as f64).tan();
    std::array::from_fn(|corner| {
        let sign = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let top = corner >> 2 & 1 == 1;
        let [width, thickness] = if top { TAPER } else { [1.0, 1.0] };
        let lean = if top { FLARE } else { 0.0 };
        outward * (RING_RADIUS + lean + sign(0) * thickness * HALF_THICKNESS)
            + forward * (sign(1) * width * half_width)
            + Vec3::z() * if top { WEDGE_HEIGHT } else { 0.0 }
    })
}

/// A point in the zone around the ring, of which the wedges fill about 3 %.
fn tip(random: &mut Random) -> Vec3 {
    let angle = random.between(0.0, TAU);
    let radius = RING_RADIUS + random.between(-0.085, 0.115);
    Vec3::new(radius * angle.cos(), radius * angle.sin(), random.between(-0.085, 0.185))
}

/// States of both bodies in every frame, the wedges' first.
pub fn states() -> Vec<[State; 2]> {
    (0..FRAMES)
        .map(|frame| [0, 1].map(|body| state(|frame| pose(frame, body), frame as f64, FRAME_SECONDS)))
        .collect()
}

/// Pose of the wedges (0) or the tips (1) in the common frame.
fn pose(frame: f64, body: usize) -> Pose {
    let phase = frame / FRAMES as f64 * TAU;
    let wave = |shift: f64| {
        Vec3::new((phase + shift).sin(), (phase + shift + 1.0).sin(), (phase + shift + 2.5).sin())
    };
    let ring = Pose {
        position: Vec3::new(40.0, -30.0, 20.0) + wave(0.3) * 0.2,
        orientation: Quat::from_scaled_axis(Vec3::new(0.4, -0.7, 1.1) + wave(1.7) * 0.1),
    };
    let relative = Pose { position: wave(4.0) * 2e-3, orientation: Quat::from_scaled_axis(wave(5.1) * 4e-3) };
    if body == 0 { ring } else { ring.compose(&relative) }
}
