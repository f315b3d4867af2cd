//! MuJoCo, through `shim/mujoco.c`.

use super::{AnswerFrame, PairPeer, Peer, hull_of, pose_numbers};
use crate::hull;
use crate::pairs::{
    Answer, HALF_LENGTH, Mover, Queries, RADIUS, RAY, ROUND_HALF_LENGTH, SEMI_AXES, TARGET_ROUND, Target,
};
use crate::ring::{Ring, Tip};
use crate::solids::{Pair, Shape, SolidsPeer};
use crate::terrain::{Terrain, Wheel};
use pong_engine::State;
use pong_geometry::Vec3;
use std::ffi::{CStr, CString, c_char, c_int};
use std::ptr::NonNull;

#[repr(C)]
struct Opaque {
    _private: [u8; 0],
}

unsafe extern "C" {
    fn pong_mujoco_load(xml: *const c_char, message: *mut c_char, size: c_int) -> *mut Opaque;
    fn pong_mujoco_free(scene: *mut Opaque);
    fn pong_mujoco_heights(scene: *mut Opaque, heights: *const f32, count: c_int);
    fn pong_mujoco_frame(scene: *mut Opaque, poses: *const f64, bodies: c_int) -> c_int;
    fn pong_mujoco_deepest(scene: *const Opaque) -> f64;
    fn pong_mujoco_pairs(scene: *mut Opaque, poses: *const f64, count: c_int, answers: *mut Answer);
    fn pong_mujoco_rays(
        scene: *mut Opaque,
        poses: *const f64,
        count: c_int,
        start: f64,
        length: f64,
        answers: *mut Answer,
    );
    fn pong_mujoco_version() -> *const c_char;
}

/// Version of the library.
pub fn version() -> String {
    // SAFETY: a static string of the library.
    unsafe { CStr::from_ptr(pong_mujoco_version()) }.to_string_lossy().into_owned()
}

/// MJCF of a free body; its inertia is irrelevant here, but MuJoCo requires one.
const FREE: &str = "<freejoint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>";

/// A scene from MJCF text.
struct Scene(NonNull<Opaque>);

impl Scene {
    fn load(assets: &str, world: &str) -> Self {
        let xml = format!(
            "<mujoco><size memory=\"512M\"/><asset>{assets}</asset><worldbody>{world}</worldbody></mujoco>"
        );
        let xml = CString::new(xml).expect("no zero in the text");
        let mut message = vec![0_u8; 1000];
        // SAFETY: both texts live through the call; the message has room for what it is told.
        let scene = unsafe { pong_mujoco_load(xml.as_ptr(), message.as_mut_ptr().cast(), 1000) };
        let told = CStr::from_bytes_until_nul(&message).unwrap_or_default().to_string_lossy();
        Self(NonNull::new(scene).unwrap_or_else(|| panic!("MuJoCo: {told}")))
    }

    fn frame(&mut self, poses: &[f64]) -> usize {
        // SAFETY: the scene lives; the poses are those of as many bodies.
        unsafe { pong_mujoco_frame(self.0.as_ptr(), poses.as_ptr(), (poses.len() / 7) as c_int) as usize }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: made by load, freed once.
        unsafe { pong_mujoco_free(self.0.as_ptr()) }
    }
}

/// MuJoCo on a scene of free bodies.
pub struct Mujoco {
    scene: Scene,
    poses: Vec<f64>,
    /// True if the first state is that of the world body.
    on_ground: bool,
}

impl Mujoco {
    /// The ring: a body of convex meshes and a body of spheres.
    pub fn ring(ring: &Ring, tip: Tip) -> Self {
        let names = |i: usize| format!("wedge_{i}");
        let assets: String = ring.wedges.iter().enumerate().map(|(i, w)| mesh(&names(i), w)).collect();
        let wedge =
            |i| format!("<geom type=\"mesh\" mesh=\"{}\" contype=\"1\" conaffinity=\"0\"/>", names(i));
        let wedges: String = (0..ring.wedges.len()).map(wedge).collect();
        let tip = |center: &Vec3| {
            format!(
                "<geom type=\"sphere\" size=\"{}\" pos=\"{}\" contype=\"0\" conaffinity=\"1\"/>",
                tip.radius().max(1e-9),
                numbers(center.as_slice())
            )
        };
        let tips: String = ring.tips.iter().map(tip).collect();
        let world = format!("<body>{FREE}{wedges}</body><body>{FREE}{tips}</body>");
        Self { scene: Scene::load(&assets, &world), poses: Vec::new(), on_ground: false }
    }

    /// W7: spheres as free bodies, any two of which may touch.
    pub fn cloud(count: usize) -> Self {
        let body = format!("<body>{FREE}<geom type=\"sphere\" size=\"{}\"/></body>", crate::cloud::RADIUS);
        Self { scene: Scene::load("", &body.repeat(count)), poses: Vec::new(), on_ground: false }
    }

    /// Wheels on a height field: MuJoCo has no non-convex meshes.
    pub fn terrain(terrain: &Terrain, wheel: Wheel, wheels: usize) -> Self {
        let (heights, [half_x, half_y]) = terrain.heights();
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let span = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low;
        let [columns, rows] = terrain.cells.map(|cells| cells + 1);
        let assets = format!(
            "<hfield name=\"ground\" nrow=\"{rows}\" ncol=\"{columns}\" size=\"{half_x} {half_y} {span} 0.1\"/>"
        );
        let shape = match wheel {
            Wheel::Sphere { radius } => format!("type=\"sphere\" size=\"{radius}\""),
            Wheel::Ellipsoid { semi_axes } => format!("type=\"ellipsoid\" size=\"{}\"", numbers(&semi_axes)),
        };
        let wheel = format!("<body>{FREE}<geom {shape} contype=\"1\" conaffinity=\"0\"/></body>");
        let ground = format!(
            "<geom type=\"hfield\" hfield=\"ground\" pos=\"0 0 {low}\" contype=\"0\" conaffinity=\"1\"/>"
        );
        let scene = Scene::load(&assets, &(ground + &wheel.repeat(wheels)));
        let shares: Vec<f32> = heights.iter().map(|height| ((height - low) / span) as f32).collect();
        // SAFETY: the field was declared with as many numbers.
        unsafe { pong_mujoco_heights(scene.0.as_ptr(), shares.as_ptr(), shares.len() as c_int) };
        Self { scene, poses: Vec::new(), on_ground: true }
    }
}

impl Peer for Mujoco {
    fn frame(&mut self, states: &[State]) -> usize {
        self.poses.clear();
        self.poses.extend(states[usize::from(self.on_ground)..].iter().flat_map(pose_numbers));
        self.scene.frame(&self.poses)
    }

    fn deepest(&self) -> Option<f64> {
        // SAFETY: the scene lives.
        Some(unsafe { pong_mujoco_deepest(self.scene.0.as_ptr()) })
    }
}

/// MuJoCo on one pair. A point is a sphere of a nanometre, a segment a capsule as thin.
pub struct MujocoPair {
    scene: Scene,
    mover: Mover,
}

impl MujocoPair {
    /// Builds one pair; `None` for the triangle, which MuJoCo does not have. Cones are polyhedra, and do not move.
    pub fn new(mover: Mover, target: &Target) -> Option<Self> {
        const THIN: f64 = 1e-9;
        let shape = match mover {
            Mover::Point | Mover::Ray => format!("type=\"sphere\" size=\"{THIN}\""),
            Mover::Sphere => format!("type=\"sphere\" size=\"{RADIUS}\""),
            Mover::Segment => format!("type=\"capsule\" size=\"{THIN} {HALF_LENGTH}\""),
            Mover::Ellipsoid => format!("type=\"ellipsoid\" size=\"{}\"", numbers(&SEMI_AXES)),
            Mover::Capsule => format!("type=\"capsule\" size=\"{RADIUS} {ROUND_HALF_LENGTH}\""),
            Mover::Cylinder => format!("type=\"cylinder\" size=\"{RADIUS} {ROUND_HALF_LENGTH}\""),
            Mover::Cone => return None,
        };
        let ([_, half_length], radius) = TARGET_ROUND;
        let (assets, target) = match (hull_of(target), target) {
            (Some(hull), _) => (mesh("hull", &hull.vertices), "type=\"mesh\" mesh=\"hull\"".to_owned()),
            (_, Target::Capsule) => {
                (String::new(), format!("type=\"capsule\" size=\"{radius} {half_length}\""))
            }
            (_, Target::Cylinder) => {
                (String::new(), format!("type=\"cylinder\" size=\"{radius} {half_length}\""))
            }
            (_, Target::Ellipsoid) => {
                (String::new(), format!("type=\"ellipsoid\" size=\"{}\"", numbers(&hull::SEMI_AXES)))
            }
            _ => return None,
        };
        let world = format!("<geom {target}/><body>{FREE}<geom {shape}/></body>");
        let scene = Scene::load(&assets, &world);
        Some(Self { scene, mover })
    }
}

impl PairPeer for MujocoPair {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        let poses = queries.numbers.as_ptr().cast();
        let count = answers.len().min(queries.numbers.len()) as c_int;
        let (scene, answers) = (self.scene.0.as_ptr(), answers.as_mut_ptr());
        // SAFETY: the scene lives; there are as many poses and answers as told, in the form that C knows.
        unsafe {
            match self.mover {
                Mover::Ray => pong_mujoco_rays(scene, poses, count, RAY.0[2], RAY.2, answers),
                _ => pong_mujoco_pairs(scene, poses, count, answers),
            }
        }
    }

    fn frame_of_answers(&self) -> AnswerFrame {
        AnswerFrame::Common
    }
}

/// MuJoCo on two equal convex solids: boxes or meshes. A pair of meshes has one contact, MuJoCo's default.
pub struct MujocoSolids {
    scene: Scene,
    answers: Vec<Answer>,
}

impl MujocoSolids {
    /// Builds the pair.
    pub fn new(shape: &Shape) -> Self {
        let (assets, geom) = match shape.half {
            Some(half) => (String::new(), format!("type=\"box\" size=\"{}\"", numbers(&half))),
            None => (mesh("hull", &shape.hull().vertices), "type=\"mesh\" mesh=\"hull\"".to_owned()),
        };
        let scene = Scene::load(&assets, &format!("<geom {geom}/><body>{FREE}<geom {geom}/></body>"));
        Self { scene, answers: Vec::new() }
    }
}

impl SolidsPeer for MujocoSolids {
    fn pass(&mut self, pairs: &[Pair]) -> usize {
        self.answers.resize(pairs.len(), Answer::default());
        for (pair, answer) in pairs.iter().zip(&mut self.answers) {
            // SAFETY: the scene lives; there are one pair of poses and one answer, in the form that C knows.
            unsafe { pong_mujoco_pairs(self.scene.0.as_ptr(), pair.numbers.as_ptr().cast(), 1, answer) };
        }
        self.answers.iter().filter(|answer| answer.hit()).count()
    }
}

fn mesh(name: &str, vertices: &[Vec3]) -> String {
    let vertices: Vec<f64> = vertices.iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    format!("<mesh name=\"{name}\" vertex=\"{}\"/>", numbers(&vertices))
}

fn numbers(list: &[f64]) -> String {
    list.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(" ")
}
