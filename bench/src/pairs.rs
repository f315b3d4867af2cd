//! W1, one pair of primitives per query: which pairs, at which poses, and what an answer is.

use crate::hull::{Hull, TRIANGLE};
use crate::random::Random;
use pong_geometry::{Pose, Quat, Transform, Vec3};

/// Radius of the sphere, m.
pub const RADIUS: f64 = 0.1;
/// Semi-axes of the ellipsoid, m.
pub const SEMI_AXES: [f64; 3] = [0.2, 0.12, 0.08];
/// Half the length of the segment, which lies along z, m.
pub const HALF_LENGTH: f64 = 0.25;
/// The ray: origin, direction and length, m. Long enough to begin and end outside everything.
pub const RAY: ([f64; 3], [f64; 3], f64) = ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 2.0);
/// Depths of the hits and gaps of the misses, m.
const DEPTHS: (f64, f64) = (0.005, 0.1);
const GAPS: (f64, f64) = (0.005, 0.3);

/// The primitive that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mover {
    /// At its own origin.
    Point,
    /// [`HALF_LENGTH`]
    Segment,
    /// [`RAY`]
    Ray,
    /// [`RADIUS`]
    Sphere,
    /// [`SEMI_AXES`]
    Ellipsoid,
}

/// The primitive in whose frame is asked.
pub enum Target {
    /// A convex polyhedron.
    Hull(Hull),
    /// [`TRIANGLE`], from its front.
    Triangle,
}

/// Poses of the mover in the target's frame, in the two forms that engines take.
pub struct Queries {
    /// With matrices.
    pub transforms: Vec<Transform>,
    /// With quaternions.
    pub poses: Vec<Pose>,
    /// Position, then the matrix row by row.
    pub rows: Vec<[f64; 12]>,
    /// Whether they touch, by construction.
    pub hits: Vec<bool>,
}

/// The deepest contact, if there is one: as an engine in C writes it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Answer {
    /// Depth; for rays the distance along the ray, m. Zero: no contact.
    pub depth: f64,
    /// Unit normal from the target to the mover.
    pub normal: [f64; 3],
    /// A point of the contact, m, in the target's frame; which one is each engine's own choice.
    pub point: [f64; 3],
}

impl Answer {
    /// A contact.
    pub fn new(depth: f64, normal: impl Into<[f64; 3]>, point: impl Into<[f64; 3]>) -> Self {
        Self { depth, normal: normal.into(), point: point.into() }
    }

    /// Whether there is a contact.
    pub fn hit(&self) -> bool {
        self.depth > 0.0
    }
}

impl Queries {
    /// `count` poses in random order: half overlap by 5 to 100 mm along a random line, half are 5 to 300 mm apart.
    /// `touches` says whether the two touch; it is only asked where they begin to.
    pub fn new(count: usize, mover: Mover, target: &Target, touches: impl Fn(&Transform) -> bool) -> Self {
        let mut random = Random(0x7731 + count as u64);
        let mut hits: Vec<bool> = (0..count).map(|i| i % 2 == 0).collect();
        for i in (1..count).rev() {
            hits.swap(i, random.between(0.0, (i + 1) as f64) as usize);
        }
        let poses: Vec<Pose> =
            hits.iter().map(|&hit| pose(&mut random, mover, target, hit, &touches)).collect();
        let transforms: Vec<Transform> = poses.iter().map(Pose::transform).collect();
        let rows = transforms.iter().map(rows).collect();
        Self { transforms, poses, rows, hits }
    }
}

fn rows(x: &Transform) -> [f64; 12] {
    let (t, r) = (&x.translation, &x.rotation);
    std::array::from_fn(|i| if i < 3 { t[i] } else { r[(i / 3 - 1, i % 3)] })
}

fn pose(
    random: &mut Random,
    mover: Mover,
    target: &Target,
    hit: bool,
    touches: &impl Fn(&Transform) -> bool,
) -> Pose {
    let (orientation, line) = loop {
        let (orientation, line) = (rotation(random), unit(random));
        if let Some(line) = usable_line(mover, target, &orientation, line) {
            break (orientation, line);
        }
    };
    let middle = middle(random, target);
    let at = |along: f64| Pose { position: middle + line * along, orientation };
    // Convex bodies overlap along one stretch of a line: from the middle out to where they just touch.
    let (mut inside, mut outside) = (0.0, 4.0);
    for _ in 0..60 {
        let half = 0.5 * (inside + outside);
        *(if touches(&at(half).transform()) { &mut inside } else { &mut outside }) = half;
    }
    at(match hit {
        true => inside - random.between(DEPTHS.0, DEPTHS.1).min(inside),
        false => inside + random.between(GAPS.0, GAPS.1),
    })
}

/// The line along which the mover comes, made to suit the pair; `None` if it cannot be.
///
/// A ray is moved across itself, so that its line hits or misses, wherever it ends. Triangles are met from the
/// front, rays within 60° of their normal.
fn usable_line(mover: Mover, target: &Target, orientation: &Quat, line: Vec3) -> Option<Vec3> {
    let one_sided = matches!(target, Target::Triangle);
    if mover != Mover::Ray {
        return Some(if one_sided { Vec3::new(line.x, line.y, line.z.abs()) } else { line });
    }
    let direction = orientation * Vec3::from(RAY.1);
    let across = (line - direction * line.dot(&direction)).normalize();
    (!one_sided || direction.z < -0.5).then_some(across)
}

fn middle(random: &mut Random, target: &Target) -> Vec3 {
    match target {
        Target::Hull(_) => unit(random) * 0.05,
        Target::Triangle => TRIANGLE.map(Vec3::from).iter().sum::<Vec3>() / 3.0,
    }
}

fn unit(random: &mut Random) -> Vec3 {
    loop {
        let v = Vec3::from_fn(|_, _| random.between(-1.0, 1.0));
        if (0.01..1.0).contains(&v.norm()) {
            return v.normalize();
        }
    }
}

fn rotation(random: &mut Random) -> Quat {
    loop {
        let wxyz: [f64; 4] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        if (0.01..1.0).contains(&wxyz.iter().map(|x| x * x).sum::<f64>()) {
            return Pose::new(Vec3::zeros(), wxyz).orientation;
        }
    }
}
