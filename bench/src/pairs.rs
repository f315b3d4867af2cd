//! One pair of primitives per query: kinds, poses and the form of an answer. W1 uses some of the pairs, the
//! tester benchmark all.

use crate::hull::{self, Hull, TRIANGLE};
use crate::random::{Random, rotation};
use crate::ron;
use pong_engine::has_tester;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Quat, Transform, Vec3};

/// Radius of the sphere, m.
pub const RADIUS: f64 = 0.1;
/// Semi-axes of the ellipsoid, m.
pub const SEMI_AXES: [f64; 3] = [0.2, 0.12, 0.08];
/// Half the length of the segment, which lies along z, m.
pub const HALF_LENGTH: f64 = 0.25;
/// The ray: origin, direction and length, m, long enough to begin and end outside everything.
pub const RAY: ([f64; 3], [f64; 3], f64) = ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 2.0);
/// Vertices of the hulls: 12, 32 and 128 faces.
pub const HULLS: [usize; 3] = [8, 18, 66];
/// Radius of the target sphere, m.
pub const TARGET_RADIUS: f64 = 0.3;
/// Half the length of the moving round parts along z, m; their radius is [`RADIUS`], half of it at end 1 of a
/// cone.
pub const ROUND_HALF_LENGTH: f64 = 0.15;
/// Ends on z, m, and radius, m, of the target round parts. A cone is pointed at its end 1, the only kind in
/// parry.
pub const TARGET_ROUND: ([f64; 2], f64) = ([-0.3, 0.3], 0.3);
/// Half the length and radius of the target hole, m: every mover fits in.
pub const HOLE: (f64, f64) = (8.0, 3.0);
/// Start depth of the movers below a plane, m: less than a ray reaches above its middle.
const BELOW_PLANE: f64 = 0.2;
/// Depths of the hits and gaps of the misses, m.
const DEPTHS: (f64, f64) = (0.005, 0.1);
const GAPS: (f64, f64) = (0.005, 0.3);

/// The moving primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mover {
    /// A point at its own origin.
    Point,
    /// See [`HALF_LENGTH`].
    Segment,
    /// See [`RAY`].
    Ray,
    /// See [`RADIUS`].
    Sphere,
    /// See [`SEMI_AXES`].
    Ellipsoid,
    /// See [`ROUND_HALF_LENGTH`].
    Capsule,
    /// See [`ROUND_HALF_LENGTH`].
    Cylinder,
    /// See [`ROUND_HALF_LENGTH`].
    Cone,
}

/// The target primitive, in whose frame the query is made.
pub enum Target {
    /// A convex polyhedron.
    Hull(Hull),
    /// The front of [`TRIANGLE`].
    Triangle,
    /// A sphere.
    Sphere,
    /// An ellipsoid as large as the hulls.
    Ellipsoid,
    /// The half space below z = 0.
    Plane,
    /// See [`TARGET_ROUND`].
    Capsule,
    /// See [`TARGET_ROUND`].
    Cylinder,
    /// See [`TARGET_ROUND`].
    Cone,
    /// [`HOLE`], touched from within.
    Bore,
}

impl Mover {
    /// The mover of a kind, if there is one.
    pub fn of(kind: PrimitiveKind) -> Option<Self> {
        Some(match kind {
            PrimitiveKind::Point => Self::Point,
            PrimitiveKind::LineSegment => Self::Segment,
            PrimitiveKind::Ray => Self::Ray,
            PrimitiveKind::Sphere => Self::Sphere,
            PrimitiveKind::Ellipsoid => Self::Ellipsoid,
            PrimitiveKind::Capsule => Self::Capsule,
            PrimitiveKind::Cylinder => Self::Cylinder,
            PrimitiveKind::Cone => Self::Cone,
            _ => return None,
        })
    }

    /// Kind in the engine's table.
    pub fn kind(self) -> PrimitiveKind {
        match self {
            Self::Point => PrimitiveKind::Point,
            Self::Segment => PrimitiveKind::LineSegment,
            Self::Ray => PrimitiveKind::Ray,
            Self::Sphere => PrimitiveKind::Sphere,
            Self::Ellipsoid => PrimitiveKind::Ellipsoid,
            Self::Capsule => PrimitiveKind::Capsule,
            Self::Cylinder => PrimitiveKind::Cylinder,
            Self::Cone => PrimitiveKind::Cone,
        }
    }
}

impl Target {
    /// Targets of a kind: hulls in three sizes, one of each other kind, none of kinds that are never B.
    pub fn of(kind: PrimitiveKind) -> Vec<Self> {
        match kind {
            PrimitiveKind::Polyhedron => {
                HULLS.into_iter().map(|vertices| Self::Hull(Hull::fibonacci(vertices))).collect()
            }
            PrimitiveKind::Triangle => vec![Self::Triangle],
            PrimitiveKind::Sphere => vec![Self::Sphere],
            PrimitiveKind::Ellipsoid => vec![Self::Ellipsoid],
            PrimitiveKind::Plane => vec![Self::Plane],
            PrimitiveKind::Capsule => vec![Self::Capsule],
            PrimitiveKind::Cylinder => vec![Self::Cylinder],
            PrimitiveKind::Cone => vec![Self::Cone],
            PrimitiveKind::Bore => vec![Self::Bore],
            _ => Vec::new(),
        }
    }

    /// Kind in the engine's table.
    pub fn kind(&self) -> PrimitiveKind {
        match self {
            Self::Hull(_) => PrimitiveKind::Polyhedron,
            Self::Triangle => PrimitiveKind::Triangle,
            Self::Sphere => PrimitiveKind::Sphere,
            Self::Ellipsoid => PrimitiveKind::Ellipsoid,
            Self::Plane => PrimitiveKind::Plane,
            Self::Capsule => PrimitiveKind::Capsule,
            Self::Cylinder => PrimitiveKind::Cylinder,
            Self::Cone => PrimitiveKind::Cone,
            Self::Bore => PrimitiveKind::Bore,
        }
    }

    /// Number of faces of a hull.
    pub fn faces(&self) -> Option<usize> {
        match self {
            Self::Hull(hull) => Some(hull.faces.len()),
            _ => None,
        }
    }

    /// Model file.
    pub fn model(&self) -> String {
        let at_origin = "center: (0, 0, 0)";
        let primitive = match self {
            Self::Hull(hull) => return hull.model(),
            Self::Triangle => return hull::triangle_model(),
            Self::Sphere => format!("Sphere(name: \"b\", {at_origin}, radius: {TARGET_RADIUS:?})"),
            Self::Ellipsoid => {
                let semi_axes = ron::vector(&hull::SEMI_AXES.into());
                format!("Ellipsoid(name: \"b\", {at_origin}, semi_axes: {semi_axes})")
            }
            Self::Plane => "Plane(name: \"b\", normal: (0, 0, 1), offset: 0)".to_owned(),
            Self::Capsule => round_model("Capsule", TARGET_ROUND.0, "radius", TARGET_ROUND.1),
            Self::Cylinder => round_model("Cylinder", TARGET_ROUND.0, "radius", TARGET_ROUND.1),
            Self::Cone => round_model("Cone", TARGET_ROUND.0, "radii", (TARGET_ROUND.1, 0.0)),
            Self::Bore => round_model("Bore", [-HOLE.0, HOLE.0], "radii", (HOLE.1, HOLE.1)),
        };
        ron::model("target", &primitive)
    }
}

fn round_model(kind: &str, [one, other]: [f64; 2], radius: &str, value: impl std::fmt::Debug) -> String {
    format!("{kind}(name: \"b\", ends: ((0, 0, {one:?}), (0, 0, {other:?})), {radius}: {value:?})")
}

/// Every pair of kinds with a tester in the engine; hulls in three sizes.
///
/// # Panics
/// A kind that the engine tests has no mover or no target, so its tester has no benchmark.
pub fn all() -> Vec<(Mover, Target)> {
    let kinds = PrimitiveKind::ALL;
    let tested = kinds.into_iter().flat_map(|a| kinds.map(|b| (a, b))).filter(|&(a, b)| has_tester(a, b));
    tested.flat_map(|(a, b)| of_kinds(a, b)).collect()
}

fn of_kinds(a: PrimitiveKind, b: PrimitiveKind) -> impl Iterator<Item = (Mover, Target)> {
    let (mover, targets) = (Mover::of(a), Target::of(b));
    assert!(
        mover.is_some() && !targets.is_empty(),
        "the tester {}–{} has no benchmark: name its kinds in bench/src/pairs.rs",
        a.name(),
        b.name()
    );
    mover.into_iter().cycle().zip(targets)
}

/// Pairs of poses in a common frame, in the forms that engines take, in an order that can be shuffled.
pub struct Queries {
    /// Poses of the mover and of the target, in the common frame.
    pub poses: Vec<[Pose; 2]>,
    /// Poses of the target for engines whose cylinders lie along y, see [`along_y`].
    pub along_y: Vec<Pose>,
    /// The `poses` for engines in C: a position, m, and a quaternion (w, x, y, z) each.
    pub numbers: Vec<[[f64; 7]; 2]>,
    /// Poses of the mover in the target's frame.
    pub transforms: Vec<Transform>,
    /// True for pairs that touch, by construction.
    pub hits: Vec<bool>,
    shuffles: Random,
}

/// The deepest contact, if there is one, in the layout of engines in C; in the target's frame or the common
/// one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Answer {
    /// Depth; for rays the distance along the ray, m; zero for no contact.
    pub depth: f64,
    /// Unit normal from the target to the mover.
    pub normal: [f64; 3],
    /// A point of the contact, m; each engine chooses its own.
    pub point: [f64; 3],
}

impl Answer {
    /// A contact.
    pub fn new(depth: f64, normal: impl Into<[f64; 3]>, point: impl Into<[f64; 3]>) -> Self {
        Self { depth, normal: normal.into(), point: point.into() }
    }

    /// True if there is a contact.
    pub fn hit(&self) -> bool {
        self.depth > 0.0
    }
}

/// Largest distance of a target from the origin of the common frame along each axis, m.
const TARGET_PLACES: f64 = 2.0;

impl Queries {
    /// `count` pairs of poses in random order: half overlap by 5 to 100 mm along a random line, half are 5 to
    /// 300 mm apart. `touches` tests for contact; it is used only to find its onset.
    pub fn new(count: usize, mover: Mover, target: &Target, touches: impl Fn(&Transform) -> bool) -> Self {
        let mut random = Random(0x7731 + count as u64);
        let hits: Vec<bool> = (0..count).map(|i| i % 2 == 0).collect();
        let mut out = Self {
            poses: Vec::with_capacity(count),
            along_y: Vec::with_capacity(count),
            numbers: Vec::with_capacity(count),
            transforms: Vec::with_capacity(count),
            hits,
            shuffles: Random(0x5afe + count as u64),
        };
        for i in 0..count {
            let x_ba = pose(&mut random, mover, target, out.hits[i], &touches);
            let position = Vec3::from_fn(|_, _| random.between(-TARGET_PLACES, TARGET_PLACES));
            let x_wb = Pose { position, orientation: rotation(&mut random) };
            out.add([x_wb.compose(&x_ba), x_wb]);
        }
        out.shuffle();
        out
    }

    fn add(&mut self, poses: [Pose; 2]) {
        self.poses.push(poses);
        self.along_y.push(poses[1].compose(&along_y()));
        self.numbers.push(poses.map(|pose| numbers(&pose)));
        self.transforms.push(Pose::relative(&poses[0], &poses[1]).transform());
    }

    /// Shuffles the order. In a fixed order the branch predictor learns the hits and misses from pass to
    /// pass, which no frame of a simulation allows.
    pub fn shuffle(&mut self) {
        for i in (1..self.hits.len()).rev() {
            let j = self.shuffles.between(0.0, (i + 1) as f64) as usize;
            self.poses.swap(i, j);
            self.along_y.swap(i, j);
            self.numbers.swap(i, j);
            self.transforms.swap(i, j);
            self.hits.swap(i, j);
        }
    }
}

/// Pose, in our frame, of a frame whose y axis is our z axis: its x, y and z are our y, z and x.
pub fn along_y() -> Pose {
    Pose::new(Vec3::zeros(), [0.5; 4])
}

/// Position and quaternion (w, x, y, z).
fn numbers(pose: &Pose) -> [f64; 7] {
    let (p, q) = (&pose.position, &pose.orientation);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k]
}

fn pose(
    random: &mut Random,
    mover: Mover,
    target: &Target,
    hit: bool,
    touches: &impl Fn(&Transform) -> bool,
) -> Pose {
    let (orientation, line) = loop {
        let (orientation, line) = (rotation(random), random.direction());
        if let Some(line) = usable_line(mover, target, &orientation, line) {
            break (orientation, line);
        }
    };
    let middle = middle(random, target);
    let at = |along: f64| Pose { position: middle + line * along, orientation };
    match target {
        // A body in a hole begins to touch on its way outward.
        Target::Bore => place(random, !hit, at, |x| !touches(x)),
        // An end disc is not pushed by a triangle, which has one side, once its centre is behind it, nor a side by an edge
        // that its axis has passed.
        Target::Triangle | Target::Hull(_) if matches!(mover, Mover::Cylinder | Mover::Cone) => {
            place_up_to(0.25 * RADIUS, random, hit, at, touches)
        }
        _ => place(random, hit, at, touches),
    }
}

/// A pose along a line on which two convex bodies, overlapping at its start, separate within 4 m: 5 to 100 mm
/// before they separate, or 5 to 300 mm after.
pub fn place(
    random: &mut Random,
    hit: bool,
    at: impl Fn(f64) -> Pose,
    touches: impl Fn(&Transform) -> bool,
) -> Pose {
    place_up_to(DEPTHS.1, random, hit, at, touches)
}

/// As [`place`], at most `deepest` before they separate, m.
fn place_up_to(
    deepest: f64,
    random: &mut Random,
    hit: bool,
    at: impl Fn(f64) -> Pose,
    touches: impl Fn(&Transform) -> bool,
) -> Pose {
    // Convex bodies overlap along one interval of a line: from the middle outward to first contact.
    let (mut inside, mut outside) = (0.0, 4.0);
    if deepest < DEPTHS.1 {
        // Those that do not touch once they are deeper: from outside, in steps that are shorter.
        while outside > deepest && !touches(&at(outside - 0.5 * deepest).transform()) {
            outside -= 0.5 * deepest;
        }
        inside = outside - 0.5 * deepest;
    }
    for _ in 0..60 {
        let half = 0.5 * (inside + outside);
        *(if touches(&at(half).transform()) { &mut inside } else { &mut outside }) = half;
    }
    at(match hit {
        true => inside - random.between(DEPTHS.0, deepest).min(inside),
        false => inside + random.between(GAPS.0, GAPS.1),
    })
}

/// Line of approach of the mover, adapted to the pair; `None` if it is unusable.
///
/// A ray moves sideways, so that its line hits or misses wherever it ends; over a plane it is lifted. Planes
/// and triangles are approached from the front, by rays within 60° of their normal.
fn usable_line(mover: Mover, target: &Target, orientation: &Quat, line: Vec3) -> Option<Vec3> {
    let one_sided = matches!(target, Target::Triangle | Target::Plane);
    let upward = Vec3::new(line.x, line.y, line.z.abs());
    let direction = orientation * Vec3::from(RAY.1);
    if mover == Mover::Ray && one_sided && direction.z >= -0.5 {
        return None;
    }
    if let Target::Bore = target {
        return outward_line(mover, &direction, &line);
    }
    match (mover, target) {
        (_, Target::Plane) => (upward.z > 0.5).then_some(upward),
        (Mover::Ray, _) => Some((line - direction * line.dot(&direction)).normalize()),
        // A capsule that lies flat: beside a thin triangle the lower end of an upright one is soon behind it.
        (Mover::Capsule | Mover::Cylinder | Mover::Cone, Target::Triangle) => {
            (direction.z.abs() < 0.3 && upward.z > 0.5).then_some(upward)
        }
        (_, Target::Triangle) => Some(upward),
        _ => Some(line),
    }
}

/// Direction across the axis of a hole; a ray leaves it ahead.
fn outward_line(mover: Mover, direction: &Vec3, line: &Vec3) -> Option<Vec3> {
    let across = Vec3::new(line.x, line.y, 0.0).try_normalize(0.1)?;
    (mover != Mover::Ray || direction.dot(&across) > 0.3).then_some(across)
}

fn middle(random: &mut Random, target: &Target) -> Vec3 {
    match target {
        Target::Triangle => TRIANGLE.map(Vec3::from).iter().sum::<Vec3>() / 3.0,
        Target::Plane => -BELOW_PLANE * Vec3::z(),
        _ => random.direction() * 0.05,
    }
}
