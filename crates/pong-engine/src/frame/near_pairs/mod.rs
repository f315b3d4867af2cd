//! Pairs of movable groups that may have contacts in a frame: the broad phase over groups.
//!
//! If groups have few pairs each, every enabled pair is visited. If they have many, a pair is visited only if
//! the bounds that its two groups have swept since the last commit overlap ([`SweptBounds`]; docs/theory.md,
//! 2.7): a visit of any other pair would find neither a contact nor tunnelling. Records of ended contacts are
//! checked without a visit.
//!
//! Overlaps are found with a tree of widened bounds ([`BoundsTree`]); its result stays valid until a group
//! leaves its widened bounds. A pair is visited if the exact bounds of its groups overlap, so the pairs
//! visited do not depend on results kept from earlier frames.

mod swept;
#[cfg(test)]
mod tests;
mod tree;

use crate::scene::Scene;
use crate::seal::{GroupPair, Sealed};
use crate::state::{CommittedPoses, Past};
use pong_geometry::Pose;
use swept::{Bounds, SweptBounds};
use tree::BoundsTree;

/// Number of pairs whose motions are computed at once. A frame that visits more pairs runs in several rounds.
pub(crate) const MOTIONS_AT_ONCE: usize = 4096;

/// Average number of pairs per movable group above which groups are bounded first. With so many pairs,
/// visiting all of them takes about ten times as long.
const MET_MIN: usize = 32;

/// Pairs of movable groups that a frame visits, in order.
pub(crate) struct NearPairs {
    list: Vec<u32>,
    /// Present only if groups have many pairs each.
    many: Option<Box<ManyPairs>>,
}

impl NearPairs {
    pub fn new(scene: &Scene, sealed: &Sealed) -> Self {
        let many = are_many(sealed.group_pairs.len(), sealed.paired_bodies.len());
        Self {
            list: Vec::with_capacity(sealed.group_pairs.len()),
            many: many.then(|| Box::new(ManyPairs::new(scene, sealed))),
        }
    }

    /// Memory for this many pairs and movable groups, bytes.
    pub fn bytes(pairs: usize, bodies: usize) -> usize {
        let lists = if are_many(pairs, bodies) { 2 } else { 1 };
        let of_body = size_of::<usize>() + SweptBounds::BYTES_EACH + BoundsTree::BYTES_EACH;
        lists * pairs * size_of::<u32>() + bodies * (of_body + size_of::<Bounds>())
    }

    /// The pairs to visit, in order.
    pub fn list(&self) -> &[u32] {
        &self.list
    }

    /// Index of a pair's motions in the list of motions of this frame. `None` if the pair is not visited, or
    /// if the frame visits too many pairs to store all motions at once.
    #[inline]
    pub fn slot(&self, group_pair: u32) -> Option<usize> {
        if self.list.len() > MOTIONS_AT_ONCE {
            return None;
        }
        self.list.binary_search(&group_pair).ok()
    }

    /// Finds the pairs that a frame must visit; [`list`](Self::list) returns them.
    #[inline]
    pub fn find(&mut self, sealed: &Sealed, enabled: &[bool], poses: &[Pose], committed: &CommittedPoses) {
        self.list.clear();
        let pairs = sealed.group_pairs.iter().enumerate();
        match &mut self.many {
            Some(many) if committed.past() != Past::Several => {
                many.find(sealed, enabled, (poses, committed), &mut self.list);
            }
            _ => {
                let on = pairs.filter(|(_, pair)| enabled[pair.pair]);
                self.list.extend(on.map(|(index, _)| index as u32));
            }
        }
    }

    /// Disables the selection: every enabled pair is visited from now on.
    #[cfg(test)]
    pub fn visit_all(&mut self) {
        self.many = None;
    }
}

fn are_many(pairs: usize, bodies: usize) -> bool {
    2 * pairs > MET_MIN * bodies
}

/// Bounds of the movable groups that are in a pair, and the pairs whose widened bounds overlap.
struct ManyPairs {
    swept: SweptBounds,
    /// Widened bounds of each movable group from which `candidates` was found.
    widened: Vec<Bounds>,
    /// Pairs whose widened bounds overlap, in order.
    candidates: Vec<u32>,
    tree: BoundsTree,
    /// Index of the first pair that has a movable group as `first`, by movable group; one more entry marks
    /// the end.
    first_pair: Vec<usize>,
}

impl ManyPairs {
    fn new(scene: &Scene, sealed: &Sealed) -> Self {
        let bodies = scene.bodies.len();
        let starts = |body| sealed.group_pairs.partition_point(|pair| pair.first < body);
        Self {
            swept: SweptBounds::new(scene, &sealed.paired_bodies),
            widened: vec![Bounds::nothing(); bodies],
            candidates: Vec::with_capacity(sealed.group_pairs.len()),
            tree: BoundsTree::with_capacity(sealed.paired_bodies.len()),
            first_pair: (0..=bodies).map(starts).collect(),
        }
    }

    fn find(
        &mut self,
        sealed: &Sealed,
        enabled: &[bool],
        (poses, committed): (&[Pose], &CommittedPoses),
        near: &mut Vec<u32>,
    ) {
        self.swept.sweep(&sealed.paired_bodies, poses, committed);
        let swept = &self.swept.bounds;
        let hold = |body: &usize| self.widened[*body].hold(&swept[*body]);
        if !sealed.paired_bodies.iter().all(hold) {
            self.widen(sealed);
        }
        let swept = &self.swept.bounds;
        near.extend(self.candidates.iter().copied().filter(|&index| {
            let pair = &sealed.group_pairs[index as usize];
            enabled[pair.pair] && swept[pair.first].overlap(&swept[pair.second])
        }));
    }

    /// Widens the current bounds, and lists the pairs whose widened bounds overlap.
    fn widen(&mut self, sealed: &Sealed) {
        for &body in &*sealed.paired_bodies {
            self.widened[body] = self.swept.widened(body);
        }
        self.candidates.clear();
        let (candidates, first_pair) = (&mut self.candidates, &self.first_pair);
        self.tree.overlaps(&sealed.paired_bodies, &self.widened, &mut |a, b| {
            let (first, second) = (a.min(b), a.max(b));
            let from = first_pair[first];
            let of_first = &sealed.group_pairs[from..first_pair[first + 1]];
            candidates.extend(place_of(second, of_first).map(|place| (from + place) as u32));
        });
        self.candidates.sort_unstable();
    }
}

/// Index of the pair with `second` among the pairs of one movable group; `None` if there is no such pair. If
/// that group is paired with every group after it, the index follows from the group indices without a search.
fn place_of(second: usize, of_first: &[GroupPair]) -> Option<usize> {
    let guess = second.checked_sub(of_first.first()?.second)?;
    if of_first.get(guess).is_some_and(|pair| pair.second == second) {
        return Some(guess);
    }
    of_first.binary_search_by_key(&second, |pair| pair.second).ok()
}
