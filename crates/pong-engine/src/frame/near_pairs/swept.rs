//! What movable groups may have swept since the last commit (docs/theory.md, 2.7).
//!
//! Movable group *i* lies in a ball of radius rᵢ. P and P′ are its centre now and then, seen along common axes from a
//! place that moves with all of them; sᵢ = |P − P′|. With θ the largest chord 2·sin(φ/2) of the rotations φ since then,
//!
//! ```text
//! box of i = box around P and P′, grown by Rᵢ = (rᵢ + θ·sᵢ/4)/(1 − θ)
//! ```
//!
//! If the boxes of two are apart, so are their balls now, and every line that a place of one has gone since then as
//! seen from the other misses the other's ball.

use crate::scene::Scene;
use crate::state::{CommittedPoses, Past};
use pong_geometry::bounding::Volume;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Vec3};
use pong_model::{MovableGroup, PrimitiveInfo};

/// What has turned by a longer chord since the last commit (a quarter: 14°) is not bounded: its lines, seen from itself,
/// come near everything that it turns towards.
const CHORD_MAX: f64 = 0.25;

/// Boxes are grown by this share of all lengths that they are computed from: ten thousand times what rounding makes of
/// them here and in the tests of pairs.
const RELATIVE_MARGIN: f64 = 1e-12;

/// By how many times what it has moved since the last commit a box is widened, so that the next frames find it still inside.
const FRAMES_AHEAD: f64 = 8.0;

/// A box is widened at least and at most by these shares of the ball's radius, or else by its way: by too little it is soon
/// left, by too much pairs become candidates that are not near.
const WIDENED_BY: [f64; 2] = [0.125, 1.0];

/// A box along common axes, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub low_w: Vec3,
    pub high_w: Vec3,
}

impl Bounds {
    /// Holds nothing.
    pub fn nothing() -> Self {
        Self { low_w: Vec3::repeat(f64::INFINITY), high_w: Vec3::repeat(f64::NEG_INFINITY) }
    }

    /// Holds everything.
    pub fn everything() -> Self {
        Self { low_w: Vec3::repeat(f64::NEG_INFINITY), high_w: Vec3::repeat(f64::INFINITY) }
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        (self.high_w - self.low_w).sum().is_finite()
    }

    /// Whether the two are not certainly apart.
    #[inline]
    pub fn overlap(&self, other: &Self) -> bool {
        let apart =
            |axis: usize| self.low_w[axis] > other.high_w[axis] || other.low_w[axis] > self.high_w[axis];
        !(apart(0) || apart(1) || apart(2))
    }

    /// Whether the other lies inside; one that holds everything holds no other.
    #[inline]
    pub fn hold(&self, other: &Self) -> bool {
        let inside =
            |axis: usize| self.low_w[axis] <= other.low_w[axis] && other.high_w[axis] <= self.high_w[axis];
        inside(0) && inside(1) && inside(2) && (self.low_w[0].is_finite() || !other.low_w[0].is_finite())
    }

    /// The smallest that holds both.
    pub fn merge(&self, other: &Self) -> Self {
        Self { low_w: self.low_w.inf(&other.low_w), high_w: self.high_w.sup(&other.high_w) }
    }

    fn grown(&self, by: f64) -> Self {
        Self { low_w: self.low_w.add_scalar(-by), high_w: self.high_w.add_scalar(by) }
    }
}

/// The ball around a movable group, in its frame, m.
#[derive(Clone, Copy, Debug)]
struct Ball {
    center: Vec3,
    /// Infinite if nothing bounds the group.
    radius: f64,
}

impl Ball {
    /// Around a movable group: the ball of the root of its tree of bounding volumes, or a smaller one about the same centre
    /// where that is known.
    fn around(body: &MovableGroup) -> Self {
        let (center, radius) = match &body.tree.nodes[0].volume {
            Volume::Aabb { center, half } | Volume::Obb { center, half, .. } => (*center, half.norm()),
            Volume::Sphere { center, radius } => (*center, *radius),
            Volume::Custom(_) | Volume::Unbounded => (Vec3::zeros(), f64::INFINITY),
        };
        // A box around a ball has corners that reach farther than the ball.
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
        // Differences before anything else: no precision goes to where the common origin is.
        (pose.position - origin) + pose.orientation * self.center
    }
}

/// A movable group on its way from the last commit.
#[derive(Clone, Copy, Debug)]
struct Sweep {
    now: Vec3,
    before: Vec3,
    /// Chord 2·sin(φ/2) of its rotation, or a little more.
    chord: f64,
}

/// Bounds of what movable groups may have swept since the last commit. By number of the movable group; of those that meet
/// nobody there is none.
pub(super) struct SweptBounds {
    pub bounds: Vec<Bounds>,
    /// By how much each is to be widened, m.
    ahead: Vec<f64>,
    balls: Vec<Ball>,
    /// By place among the movable groups that meet others.
    sweeps: Vec<Sweep>,
}

impl SweptBounds {
    /// Memory of a movable group, bytes.
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

    /// Bounds what these movable groups have swept since the only commit that pairs are remembered of, or where they are
    /// if nothing is remembered.
    pub fn sweep(&mut self, bodies: &[usize], poses: &[Pose], committed: &CommittedPoses) {
        let Some(&first) = bodies.first() else { return };
        let pose_before = |body: usize| match committed.past() {
            Past::Nothing => &poses[body],
            Past::OneMoment | Past::Several => committed.pose(0, body),
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

    /// The bounds of a movable group with room for some of what it will do next.
    pub fn widened(&self, body: usize) -> Bounds {
        self.bounds[body].grown(self.ahead[body])
    }
}

/// Chord 2·sin(φ/2) of a rotation, at most 2·|q − q′|: with q and −q one rotation, the shorter of two.
fn chord(pose: &Pose, before: &Pose) -> f64 {
    let (q, p) = (&pose.orientation.coords, &before.orientation.coords);
    2.0 * (q - p).norm_squared().min((q + p).norm_squared()).sqrt()
}
