//! Solids of A that go through solids of B between two commits (docs/theory.md, 2.9).
//!
//! Two convex parts went through each other if they are apart now, were apart at the last commit or had entered
//! from a known side, overlapped in between, and have changed sides.

use super::followed::{Seen, TunnellingEvents};
use super::golden_section::time_inside;
use super::travel;
use crate::frame::input::motion::{Motion, SinceCommit};
use crate::frame::solids::committed_entry;
use crate::seal::{Partner, Plan, SolidPair};
use pong_geometry::distance::{Distance, Solid as Hull};
use pong_geometry::{Transform, Vec3};
use pong_model::{Solid, SolidPart};

/// Cosine between the directions from B to A before and after, below which A has changed sides. That of a body
/// which only cuts a corner turns by less.
const CHANGED_SIDES_COSINE_MAX: f64 = -0.3;

/// Number of equal time intervals at whose ends the distance is sampled.
const TIMES: usize = 16;

impl Seen<'_> {
    /// Follows the solids of A that may touch solids of B, and records one event per pair that has a passage.
    /// Nothing passes a plane, whose solid is a half space.
    pub fn follow_solids(&self, plan: &Plan, events: &mut TunnellingEvents) {
        let Some(since) = &self.context.motion.since_commit else { return };
        for pair in &plan.solids {
            let Partner::Solid(b) = pair.b else { continue };
            let solids =
                [&self.context.body_a.solids[pair.a as usize], &self.context.body_b.solids[b as usize]];
            if !solids.iter().all(|solid| solid.has_convex_parts()) {
                continue;
            }
            if let Some(part) = self.part_that_went_through(pair, solids, since) {
                events.note(self.passed(part.primitive));
            }
        }
    }

    /// First part of A that went through a part of B.
    fn part_that_went_through<'s>(
        &self,
        pair: &SolidPair,
        [a, b]: [&'s Solid; 2],
        since: &SinceCommit,
    ) -> Option<&'s SolidPart> {
        let motion = self.context.motion;
        let entry = committed_entry(&self.context, pair);
        a.parts.iter().find(|part_a| {
            b.parts
                .iter()
                .any(|part_b| Passage { since, motion, parts: [part_a, part_b] }.went_through(entry))
        })
    }
}

/// Two convex parts between two commits.
struct Passage<'a> {
    since: &'a SinceCommit,
    motion: &'a Motion,
    parts: [&'a SolidPart; 2],
}

impl Passage<'_> {
    /// Returns true if A went through B. `entry` is the direction from B to A in which A entered, if they
    /// overlapped at the last commit.
    fn went_through(&self, entry: Option<Vec3>) -> bool {
        if !travel::sweeps_box([&self.parts[0].bound, &self.parts[1].bound], self.since, self.motion) {
            return false;
        }
        let last = self.distance(1.0);
        if last.distance <= 0.0 {
            return false;
        }
        let first = self.distance(0.0);
        let side = match entry {
            Some(entry) if first.distance <= 0.0 => entry,
            _ if first.distance <= 0.0 => return false,
            _ => direction(&first),
        };
        side.dot(&direction(&last)) < CHANGED_SIDES_COSINE_MAX
            && (first.distance <= 0.0 || self.overlap_in_between())
    }

    /// Distance of the parts at a time between the last commit (0) and now (1). All vertices of A move along
    /// straight lines, seen from B.
    fn distance(&self, time: f64) -> Distance {
        let (from, to) = (&self.since.x_ba, &self.motion.x_ba);
        let x_ba = Transform {
            rotation: from.rotation * (1.0 - time) + to.rotation * time,
            translation: from.translation * (1.0 - time) + to.translation * time,
        };
        let [a, b] = self.parts.map(|part| part.surface.vertices());
        Hull::hull(a, &x_ba).to(&Hull::hull(b, &Transform::identity()))
    }

    /// Returns true if the parts overlap at some time. Without rotation the distance is convex in time, and
    /// the search around the least sample finds its minimum; with rotation a short overlap may be missed.
    fn overlap_in_between(&self) -> bool {
        let time = |index: usize| index as f64 / TIMES as f64;
        let samples: [f64; TIMES + 1] = std::array::from_fn(|index| self.distance(time(index)).distance);
        let least = (0..=TIMES).min_by(|&a, &b| samples[a].total_cmp(&samples[b])).unwrap_or(0);
        let around = [time(least.saturating_sub(1)), time((least + 1).min(TIMES))];
        // Parts that overlap have the distance 0; the search looks for a negative gap.
        let gap = |time: f64| match self.distance(time).distance {
            distance if distance <= 0.0 => -1.0,
            distance => distance,
        };
        samples[least] <= 0.0 || time_inside(around, gap).is_some()
    }
}

/// Direction from B to A, for parts that are apart.
fn direction(distance: &Distance) -> Vec3 {
    (distance.points_b[0] - distance.points_b[1]) / distance.distance.max(f64::MIN_POSITIVE)
}
