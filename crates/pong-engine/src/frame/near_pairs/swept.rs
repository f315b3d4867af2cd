//! Bounds of the volume that movable groups may have swept since the last commit (docs/theory.md, 2.7).
//!
//! Movable group *i* lies in a bounding sphere of radius rᵢ. P and P′ are the positions of its centre now and
//! at the last commit, along the common axes and relative to the mean of all centres; sᵢ = |P − P′|. θ is the
//! largest chord 2·sin(φ/2) of the rotations φ of the groups since the last commit. Then
//!
//! ```text
//! box of i = box around P and P′, grown by Rᵢ = (rᵢ + θ·sᵢ/4)/(1 − θ)
//! ```
//!
//! If two boxes are disjoint, the two spheres are apart now, and the path of every point of one group, seen
//! from the other group, has stayed outside the other group's sphere.

use crate::scene::Scene;
use crate::state::{CommittedPoses, Past};
use pong_geometry::bounding::Volume;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Vec3};
use pong_model::{MovableGroup, PrimitiveInfo};

/// Largest chord for which a group gets bounds (14°). Seen from a group that has turned further, even distant
/// groups move past it, so all its pairs are visited.
const CHORD_MAX: f64 = 0.25;

/// Relative margin of the boxes: ten thousand times the rounding error here and in the pair tests.
const RELATIVE_MARGIN: f64 = 1e-12;

/// Widening, in units of the motion since the last commit: at constant speed the box stays valid for that
/// many frames.
const FRAMES_AHEAD: f64 = 8.0;

/// Least and greatest widening, in units of the radius of the bounding sphere; the greatest is at least the
/// motion since the last commit. A group soon leaves a box that is too small, and a box that is too large
/// overlaps boxes of groups that are not near.
const WIDENED_BY: [f64; 2] = [0.125, 1.0];

/// A box in common axes, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub low_w: Vec3,
    pub high_w: Vec3,
}

impl Bounds {
    /// The empty box.
    pub fn nothing() -> Self {
        Self { low_w: Vec3::repeat(f64::INFINITY), high_w: Vec3::repeat(f64::NEG_INFINITY) }
    }

    /// The unbounded box.
    pub fn everything() -> Self {
        Self { low_w: Vec3::repeat(f64::NEG_INFINITY), high_w: Vec3::repeat(f64::INFINITY) }
    }

    /// Returns true if all bounds are finite.
    pub fn is_finite(&self) -> bool {
        (self.high_w - self.low_w).sum().is_finite()
    }

    /// Returns true unless the two boxes are certainly disjoint.
    #[inline]
    pub fn overlap(&self, other: &Self) -> bool {
        let apart =
            |axis: usize| self.low_w[axis] > other.high_w[axis] || other.low_w[axis] > self.high_w[axis];
        !(apart(0) || apart(1) || apart(2))
    }

    /// Returns true if the other box lies inside this one. An unbounded box contains only unbounded boxes.
    #[inline]
    pub fn hold(&self, other: &Self) -> bool {
        let inside =
            |axis: usize| self.low_w[axis] <= other.low_w[axis] && other.high_w[axis] <= self.high_w[axis];
        inside(0) && inside(1) && inside(2) && (self.low_w[0].is_finite() || !other.low_w[0].is_finite())
    }

    /// Smallest box that contains both boxes.
    pub fn merge(&self, other: &Self) -> Self {
        Self { low_w: self.low_w.inf(&other.low_w), high_w: self.high_w.sup(&other.high_w) }
    }

    fn grown(&self, by: f64) -> Self {
        Self { low_w: self.low_w.add_scalar(-by), high_w: self.high_w.add_scalar(by) }
    }
}

/// Bounding sphere of a movable group, in its frame, m.
#[derive(Clone, Copy, Debug)]
struct Ball {
    center: Vec3,
    /// Infinite if the group is unbounded.
    radius: f64,
}

impl Ball {
    /// Bounding sphere of a movable group: the sphere around its root volume, or a smaller one about the same
    /// centre that contains all its primitives.
    fn around(body: &MovableGroup) -> Self {
        let (center, radius) = match &body.tree.nodes[0].volume {
            Volume::Aabb { center, half } | Volume::Obb { center, half, .. } => (*center, half.norm()),
            Volume::Sphere { center, radius } => (*center, *radius),
            Volume::Custom(_) | Volume::Unbounded => (Vec3::zeros(), f64::INFINITY),
        };
        // The corners of a box around spheres lie outside the spheres, so the spheres themselves are
        // measured.
        let plain = |info: &PrimitiveInfo| {
            matches!(info.kind, PrimitiveKind::Point | PrimitiveKind::LineSegment | PrimitiveKind::Sphere)
        };
        if !body.primitives.iter().all(plain) {
            return Self { center, radius };
        }
        let points = body.points.iter().map(|point| (point.position, 0.0));
        let ends = body.segments.iter().flat_map(|segment| segment.ends.map(|end| (end, 0.0)));
        let balls = body.spheres.iter().map(|sphere| (sphere.center, sphere.radius));
        let reach = points.chain(ends).chain(balls).map(|(place, radius)| (place - center).norm() + radius);
        Self { center, radius: reach.fold(0.0, f64::max).min(radius) }
    }

    fn center_in(&self, pose: &Pose, origin: &Vec3) -> Vec3 {
        // The positions are subtracted first, so that a far origin costs no precision.
        (pose.position - origin) + pose.orientation * self.center
    }
}

/// Motion of the centre of a movable group's bounding sphere since the last commit, m.
#[derive(Clone, Copy, Debug)]
struct Sweep {
    now: Vec3,
    before: Vec3,
    /// Chord 2·sin(φ/2) of its rotation φ, or slightly more.
    chord: f64,
}

/// Bounds of the volumes swept since the last commit, by index of the movable group; only groups in a pair
/// have valid bounds.
pub(super) struct SweptBounds {
    pub bounds: Vec<Bounds>,
    /// Widening of each box, m.
    ahead: Vec<f64>,
    balls: Vec<Ball>,
    /// By position in the list of groups that are in a pair.
    sweeps: Vec<Sweep>,
}

impl SweptBounds {
    /// Memory per movable group, bytes.
    pub const BYTES_EACH: usize =
        size_of::<Bounds>() + size_of::<f64>() + size_of::<Ball>() + size_of::<Sweep>();

    pub fn new(scene: &Scene, bodies: &[usize]) -> Self {
        let count = scene.bodies.len();
        let ball = |body: usize| Ball::around(scene.body(body));
        Self {
            bounds: vec![Bounds::everything(); count],
            ahead: vec![0.0; count],
            balls: (0..count).map(ball).collect(),
            sweeps: Vec::with_capacity(bodies.len()),
        }
    }

    /// Bounds the volumes that these groups have swept since the last commit, which must be the same commit
    /// for all of them. Without a commit, bounds their current volumes.
    pub fn sweep(&mut self, bodies: &[usize], poses: &[Pose], committed: &CommittedPoses) {
        let Some(&first) = bodies.first() else { return };
        let pose_before = |body: usize| match committed.past() {
            Past::Nothing => &poses[body],
            Past::OneEpoch | Past::Several => committed.pose(0, body),
        };
        let origins = [poses[first].position, pose_before(first).position];
        let (mut middle, mut middle_before) = (Vec3::zeros(), Vec3::zeros());
        self.sweeps.clear();
        for &body in bodies {
            let (ball, pose, before) = (&self.balls[body], &poses[body], pose_before(body));
            let sweep = Sweep {
                now: ball.center_in(pose, &origins[0]),
                before: ball.center_in(before, &origins[1]),
                chord: chord(pose, before),
            };
            middle += sweep.now;
            middle_before += sweep.before;
            self.sweeps.push(sweep);
        }
        let share = 1.0 / bodies.len() as f64;
        (middle, middle_before) = (middle * share, middle_before * share);
        let bounded = self.sweeps.iter().map(|sweep| sweep.chord).filter(|chord| *chord <= CHORD_MAX);
        let chord = bounded.fold(0.0, f64::max);
        let far = middle.abs().max() + middle_before.abs().max();
        for (&body, sweep) in bodies.iter().zip(&self.sweeps) {
            let (radius, center) = (self.balls[body].radius, &self.balls[body].center);
            let turns_far = sweep.chord > CHORD_MAX;
            if turns_far || radius == f64::INFINITY {
                self.bounds[body] = Bounds::everything();
                continue;
            }
            let (now, before) = (sweep.now - middle, sweep.before - middle_before);
            let way = (now - before).norm();
            let swept = (radius + 0.25 * chord * way) / (1.0 - chord);
            let lengths = sweep.now.abs().max() + sweep.before.abs().max() + far + center.abs().max() + swept;
            self.bounds[body] = Bounds { low_w: now.inf(&before), high_w: now.sup(&before) }
                .grown(swept + RELATIVE_MARGIN * lengths);
            let most = (WIDENED_BY[1] * radius).max(way);
            self.ahead[body] = (FRAMES_AHEAD * way).max(WIDENED_BY[0] * radius).min(most);
        }
    }

    /// Bounds of a movable group, widened for its next motion.
    pub fn widened(&self, body: usize) -> Bounds {
        self.bounds[body].grown(self.ahead[body])
    }
}

/// Upper bound 2·|q − q′| of the chord 2·sin(φ/2) of the rotation between two poses. q and −q are one
/// orientation; the nearer of them counts.
fn chord(pose: &Pose, before: &Pose) -> f64 {
    let (q, p) = (&pose.orientation.coords, &before.orientation.coords);
    2.0 * (q - p).norm_squared().min((q + p).norm_squared()).sqrt()
}
