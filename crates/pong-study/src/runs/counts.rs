//! Counters of the engine over some frames: the same numbers every time.

use pong_engine::{FrameCounts, Tally};
use pong_geometry::primitive::PrimitiveKind;
use std::collections::BTreeMap;

/// Counts over some frames.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Frames counted.
    pub frames: u64,
    /// Tests of authored bounding volumes by their kinds, A's first: number of tests, and of those that met.
    pub volumes: BTreeMap<(&'static str, &'static str), [u64; 2]>,
    /// Pairs of leaves whose contents were tested.
    pub leaf_pairs: u64,
    /// Comparisons of a box with eight boxes below a leaf.
    pub boxes: u64,
    /// Contact tests by the kinds of primitives, A's first: number of tests, and of contacts found.
    pub testers: BTreeMap<(String, String), [u64; 2]>,
}

impl Counts {
    pub(crate) fn add(&mut self, frame: &FrameCounts) {
        let count = |tally: Tally, sum: &mut [u64; 2]| {
            sum[0] += u64::from(tally.tested);
            sum[1] += u64::from(tally.met);
        };
        self.frames += 1;
        self.leaf_pairs += frame.leaf_pairs;
        self.boxes += frame.boxes_tested;
        for (a, b, tally) in frame.volumes() {
            count(tally, self.volumes.entry((a, b)).or_default());
        }
        for (a, b, tally) in frame.testers() {
            count(tally, self.testers.entry((name(a), name(b))).or_default());
        }
    }

    /// Sum over several runs.
    pub(crate) fn of_all(runs: &[Self]) -> Self {
        let mut all = Self::default();
        for run in runs {
            all.frames += run.frames;
            all.leaf_pairs += run.leaf_pairs;
            all.boxes += run.boxes;
            join(&mut all.volumes, &run.volumes);
            join(&mut all.testers, &run.testers);
        }
        all
    }

    /// Number of tests of bounding volumes, and of those that met.
    pub fn volumes_tested(&self) -> [u64; 2] {
        sum(self.volumes.values())
    }

    /// Number of contact tests, and of contacts found.
    pub fn primitives_tested(&self) -> [u64; 2] {
        sum(self.testers.values())
    }

    /// True if no count is below the other's, so that it cannot be faster.
    pub(crate) fn is_no_less_than(&self, other: &Self) -> bool {
        let at_least = |own: Option<&[u64; 2]>, other: u64| own.map_or(0, |own| own[0]) >= other;
        self.leaf_pairs >= other.leaf_pairs
            && self.boxes >= other.boxes
            && other.volumes.iter().all(|(kinds, tally)| at_least(self.volumes.get(kinds), tally[0]))
            && other.testers.iter().all(|(kinds, tally)| at_least(self.testers.get(kinds), tally[0]))
    }
}

fn join<K: Ord + Clone>(all: &mut BTreeMap<K, [u64; 2]>, more: &BTreeMap<K, [u64; 2]>) {
    for (kinds, tally) in more {
        let sum = all.entry(kinds.clone()).or_default();
        *sum = [sum[0] + tally[0], sum[1] + tally[1]];
    }
}

fn sum<'a>(tallies: impl Iterator<Item = &'a [u64; 2]>) -> [u64; 2] {
    tallies.fold([0, 0], |sum, tally| [sum[0] + tally[0], sum[1] + tally[1]])
}

fn name(kind: PrimitiveKind) -> String {
    format!("{kind:?}")
}
