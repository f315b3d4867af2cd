//! Line segment and capsule (A) – cylinder and cone (B): the two ends of the axis yield (docs/theory.md, 2.8).
//!
//! Let x be a place on A's axis, −½ at end 0 and ½ at end 1, and W = 1 + 4x². On a plane that has B behind it, A
//! stores ¼k·(e₀² + e₁²) with e₀ and e₁ the depths of its ends, 0 above the plane. The energy is the least on such a
//! plane. Let δ(x) be the radius of A minus the distance of the place from B's surface, negative inside. No plane
//! stores less than ½k·δ²/W of any place, and where this has its maximum, the plane beside the place stores as
//! much, unless the nearest point of the surface jumps there: then the plane is searched (`planes_at_round.rs`).

use super::planes_at_round::{BarAtPlanes, Plane};
use super::round_surface::{Nearest, ROUNDING, of_frustum};
pub use super::two_capsules::EndContact;
use super::two_capsules::{OverlapContacts, lever_shares, load_of, place_on_axis, spread, zero_of_rising};
use super::{Feature, Interference};
use crate::primitive::{Capsule, Frustum, LineSegment};
use crate::{Mat3, Vec3, divisor};

/// Tests a segment against a cylinder or a cone.
pub fn segment_frustum(segment: &LineSegment, frustum: &Frustum) -> OverlapContacts {
    BarOnFrustum::new(&segment.ends, 0.0, frustum).contacts()
}

/// Tests a capsule against a cylinder or a cone.
pub fn capsule_frustum(capsule: &Capsule, frustum: &Frustum) -> OverlapContacts {
    BarOnFrustum::new(&capsule.ends, capsule.radius, frustum).contacts()
}

/// A segment or a capsule, and a cylinder or a cone, in the frame of the latter.
#[derive(Clone, Copy, Debug)]
pub struct BarOnFrustum<'a> {
    ends: [Vec3; 2],
    /// Vector from end 0 to end 1, m.
    pub along_b: Vec3,
    radius: f64,
    frustum: &'a Frustum,
}

/// Load on the plane of the least energy.
#[derive(Clone, Copy, Debug)]
pub struct BarLoad {
    /// Its place on the axis, −½ at end 0, ½ at end 1, no unit.
    pub at: f64,
    /// Depth δ of this place below the plane, m.
    pub depth: f64,
    /// Unit normal of the plane, away from B.
    pub normal_b: Vec3,
    /// Feature that the plane touches: a face for the wall or an end, an edge for a rim.
    pub feature: Feature,
    /// A place of the axis that is less than the radius away from B.
    touching: f64,
}

impl BarLoad {
    /// Returns W: the stiffness is divided by it, 1…2.
    pub fn spread(&self) -> f64 {
        spread(self.at)
    }
}

/// A place that the search for the load visits.
struct Visit {
    at: f64,
    nearest: Nearest,
    depth: f64,
    /// e₀² + e₁² on the plane beside the place, m².
    energy: f64,
}

/// A place inside B, and the sum of n·u and the pull of the yield there, which is zero at the load.
#[derive(Clone, Copy)]
struct Side {
    at: f64,
    nearest: Nearest,
    value: f64,
}

impl Side {
    fn differs(&self, other: &Self) -> bool {
        self.nearest.feature != other.nearest.feature
    }
}

/// Returns the end of B whose rim is between two places inside, and the normal between theirs at which the load would be
/// if the rim were there.
fn rim_between(inside: &[Option<Side>; 2]) -> Option<(usize, Vec3)> {
    let [Some(one), Some(other)] = inside else { return None };
    let faces = [one.nearest.feature.index(), other.nearest.feature.index()];
    let end = match faces {
        [0, end] | [end, 0] if end > 0 => end - 1,
        _ => return None,
    };
    let share = one.value / divisor(one.value - other.value);
    let normal = one.nearest.normal_b * (1.0 - share) + other.nearest.normal_b * share;
    Some((end, normal.normalize()))
}

impl<'a> BarOnFrustum<'a> {
    /// Creates the pair from the ends, m, and the radius of A, m.
    pub fn new(ends: &[Vec3; 2], radius: f64, frustum: &'a Frustum) -> Self {
        Self { ends: *ends, along_b: ends[1] - ends[0], radius, frustum }
    }

    /// Returns a place on the axis, m.
    pub fn place(&self, at: f64) -> Vec3 {
        place_on_axis(&self.ends, &self.along_b, at)
    }

    fn contacts(&self) -> OverlapContacts {
        let Some(load) = self.load() else { return [None; 2] };
        let overlap = self.overlap(&load);
        let shares = lever_shares(&overlap, load.at);
        [0, 1].map(|end| {
            let interference = Interference {
                depth: load.depth,
                normal_b: load.normal_b,
                deepest_b: self.place(overlap[end]) - load.normal_b * self.radius,
                feature: load.feature,
            };
            (shares[end] > 0.0).then(|| EndContact { interference, share: 2.0 * shares[end] / load.spread() })
        })
    }

    /// Returns the load; `None` if the two do not touch.
    pub fn load(&self) -> Option<BarLoad> {
        /// Energy, relative to the whole, that may be missing where the search has found the plane.
        const ENOUGH: f64 = 1e-12;
        let around = self.along_b.cross(&self.frustum.axis);
        // The last places inside B before and behind the load.
        let mut inside: [Option<Side>; 2] = [None; 2];
        let visit = zero_of_rising(0.0, |at| {
            let visit = self.visit(at);
            let Visit { nearest, depth, energy, .. } = &visit;
            let lean = nearest.normal_b.dot(&self.along_b);
            let pull = 4.0 * depth.max(0.0) / spread(at);
            let value = lean + pull * at;
            let side = Side { at, nearest: *nearest, value };
            inside[usize::from(value > 0.0)] = (nearest.distance < 0.0).then_some(side);
            let jumps = match &inside {
                [Some(one), Some(other)] => one.differs(other) && other.at - one.at < NEAR,
                _ => false,
            };
            if *energy <= 0.0 || jumps {
                return (0.0, 1.0, visit);
            }
            let slope = self.bend(at, nearest, lean, &around) + pull / spread(at);
            (value, slope, visit)
        });
        if visit.energy <= 0.0 || visit.depth <= 0.0 {
            return None;
        }
        let missing = visit.energy - 2.0 * visit.depth * visit.depth / spread(visit.at);
        if missing <= ENOUGH * visit.energy + self.rounding() * visit.depth {
            let Nearest { normal_b, feature, .. } = visit.nearest;
            return Some(BarLoad { at: visit.at, depth: visit.depth, normal_b, feature, touching: visit.at });
        }
        let planes = BarAtPlanes { ends_b: &self.ends, radius: self.radius, frustum: self.frustum };
        let Plane { normal_b, depths, feature, .. } = planes.least(rim_between(&inside))?;
        let (at, depth) = load_of(depths);
        Some(BarLoad { at, depth, normal_b, feature, touching: visit.at })
    }

    /// Rounding error of a distance, m.
    fn rounding(&self) -> f64 {
        ROUNDING * self.ends[0].amax().max(self.ends[1].amax()).max(self.frustum.ends[0].amax())
    }

    fn visit(&self, at: f64) -> Visit {
        let place = self.place(at);
        let nearest = of_frustum(&place, self.frustum);
        let depth = self.radius - nearest.distance;
        let lean = nearest.normal_b.dot(&self.along_b);
        let depths = [-0.5, 0.5].map(|end| (depth + lean * (at - end)).max(0.0));
        Visit { at, nearest, depth, energy: depths[0] * depths[0] + depths[1] * depths[1] }
    }

    /// Returns the second derivative of the distance along the axis, m; `lean` is n·u and `around` u × B's axis, with u
    /// the axis of A.
    fn bend(&self, at: f64, nearest: &Nearest, lean: f64, around: &Vec3) -> f64 {
        let (axis, normal) = (&self.frustum.axis, &nearest.normal_b);
        let arm = self.place(at) - self.frustum.ends[0];
        let rise = axis.dot(normal);
        let aside = arm.dot(normal) - axis.dot(&arm) * rise;
        let turned = around.dot(normal);
        let square = turned * turned;
        let mut bend = square / divisor(aside.max(0.0));
        if !nearest.feature.is_face() {
            let flat = (1.0 - rise * rise).max(f64::EPSILON);
            let rest = self.along_b.norm_squared() - lean * lean - square / flat;
            bend += rest.max(0.0) / divisor(nearest.distance.max(0.0));
        }
        bend
    }

    /// Returns the part of the axis that is less than the radius away from B, as places from −½ to ½, enlarged to the
    /// place of the load, which may be beside it.
    pub fn overlap(&self, load: &BarLoad) -> [f64; 2] {
        let [from, to] = [-0.5, 0.5].map(|tip| self.leaves(load.touching, tip));
        [from.min(load.at), to.max(load.at)]
    }

    /// Returns the place where the axis leaves the reach of B on its way from a place within it to an end. The distance
    /// is convex, so that Newton's steps from outside do not pass the place.
    fn leaves(&self, from: f64, tip: f64) -> f64 {
        const STEPS: usize = 40;
        let rounding = self.rounding();
        let mut at = self.leaves_sides(from, tip);
        for _ in 0..STEPS {
            let nearest = of_frustum(&self.place(at), self.frustum);
            let beyond = nearest.distance - self.radius;
            let rate = nearest.normal_b.dot(&self.along_b);
            let next = at - beyond / divisor(rate);
            if beyond <= rounding || rate * tip <= 0.0 || (next - from) * tip <= 0.0 {
                break;
            }
            at = next;
        }
        at
    }

    /// Returns the place where the axis comes to be the radius beyond the wall, continued past its ends, or beyond the
    /// plane of an end of B; the end of the axis if this is before.
    fn leaves_sides(&self, from: f64, tip: f64) -> f64 {
        let Frustum { axis, radii, length, wall, .. } = self.frustum;
        let arm = self.place(from) - self.frustum.ends[0];
        let (height, climb) = (axis.dot(&arm), axis.dot(&self.along_b));
        let (beside, across) = (arm - axis * height, self.along_b - axis * climb);
        let whole = (tip - from).abs();
        let mut way = whole;
        let sign = tip.signum();
        let forward = climb * sign;
        if forward != 0.0 {
            let left = if forward > 0.0 { length + self.radius - height } else { height + self.radius };
            way = way.min(left.max(0.0) / divisor(forward.abs()));
        }
        // Distance from B's axis at which the place is the radius beyond the wall: limit + slope·way.
        let limit = radii[0] + (self.radius - height * wall[0]) / wall[1];
        let slope = -forward * wall[0] / wall[1];
        let square = across.norm_squared() - slope * slope;
        let half = beside.dot(&across) * sign - limit * slope;
        let rest = beside.norm_squared() - limit * limit;
        let root = half * half - square * rest;
        if root >= 0.0 {
            let sum = -half - root.sqrt().copysign(half);
            let roots = [sum / divisor(square), rest / divisor(sum)];
            for (is_one, root) in [(square != 0.0, roots[0]), (sum != 0.0, roots[1])] {
                if is_one && root > 0.0 {
                    way = way.min(root);
                }
            }
        }
        if way < whole { from + sign * way } else { tip }
    }

    /// Returns the derivative of the normal with the place of the load on B's side, 1/m; `None` where the axis passes
    /// through what the plane touches, which leaves the normal undetermined.
    pub fn turn_of_normal(&self, load: &BarLoad) -> Option<Mat3> {
        /// Distance, relative to the depth, below which most digits of the normal are rounding.
        const CROSSING: f64 = 1e-9;
        let (axis, normal) = (&self.frustum.axis, &load.normal_b);
        let arm = self.place(load.at) - self.frustum.ends[0];
        let flat = normal - axis * axis.dot(normal);
        let square = flat.norm_squared();
        let aside = arm.dot(&flat);
        let least = CROSSING * load.depth;
        if square <= f64::EPSILON {
            return Some(Mat3::zeros());
        }
        if aside.abs() <= least * square.sqrt() {
            return None;
        }
        let level = axis.cross(&flat);
        let mut turn = level * level.transpose() / divisor(aside);
        if !load.feature.is_face() {
            let distance = self.radius - load.depth;
            if distance.abs() <= least {
                return None;
            }
            let steep = normal.cross(&level);
            turn += steep * steep.transpose() / (square * divisor(distance));
        }
        Some(turn)
    }

    /// Returns the direction from B's surface to a place on the axis.
    pub fn away_at(&self, at: f64) -> Vec3 {
        of_frustum(&self.place(at), self.frustum).normal_b
    }
}

/// Distance of two places inside B, relative to the length of the axis, below which different nearest sides tell that the
/// load is where both are equally near.
const NEAR: f64 = 0.05;
