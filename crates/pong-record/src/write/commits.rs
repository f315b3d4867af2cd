//! Assignment of commits to the frames of the log.

use crate::table::FrameRow;
use pong_engine::PairId;

/// Commit of the last evaluation, and the count of earlier ones since the last frame of the log.
#[derive(Debug)]
pub(super) struct Commits {
    committed: u32,
    missed: u32,
    /// The pairs of a partial commit, sorted. Its memory is reused.
    pairs: Vec<u32>,
}

impl Commits {
    pub fn new(pairs: usize) -> Self {
        Self { committed: FrameRow::EVALUATED, missed: 0, pairs: Vec::with_capacity(pairs) }
    }

    /// Notes an evaluation: a commit of the one before can no longer get a frame.
    pub fn evaluated(&mut self) {
        self.missed = self.missed.saturating_add(u32::from(self.committed != FrameRow::EVALUATED));
        self.committed = FrameRow::EVALUATED;
    }

    pub fn committed(&mut self) {
        self.committed = FrameRow::COMMITTED;
    }

    pub fn committed_some(&mut self, pairs: &[PairId]) {
        self.committed = FrameRow::COMMITTED_SOME;
        self.pairs.clear();
        for pair in pairs.iter().map(|pair| pair.index() as u32) {
            // The capacity holds each pair once: if it is full after removing duplicates, it has all pairs.
            if self.pairs.len() == self.pairs.capacity() {
                self.order();
                if self.pairs.len() == self.pairs.capacity() {
                    return;
                }
            }
            self.pairs.push(pair);
        }
        self.order();
    }

    /// Sorts the pairs and removes duplicates.
    fn order(&mut self) {
        self.pairs.sort_unstable();
        self.pairs.dedup();
    }

    /// Writes the commit fields of a frame, and begins the next.
    pub fn tell(&mut self, row: &mut FrameRow) {
        (row.committed, row.commits_missed) = (self.committed, self.missed);
        (self.committed, self.missed) = (FrameRow::EVALUATED, 0);
    }

    /// Takes back a frame that could not be logged.
    pub fn lost(&mut self, row: &FrameRow) {
        let own = u32::from(row.committed != FrameRow::EVALUATED);
        self.missed = self.missed.saturating_add(row.commits_missed).saturating_add(own);
    }

    /// The pairs of the last partial commit.
    pub fn pairs(&self) -> &[u32] {
        &self.pairs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(commits: &mut Commits) -> (u32, u32) {
        let mut row = crate::Frame::default().row;
        commits.tell(&mut row);
        (row.committed, row.commits_missed)
    }

    #[test]
    fn pairs_are_told_in_order_and_once_without_more_room() {
        let of = |pairs: &[u64]| {
            pairs.iter().map(|pair| PairId::from_bits((1 << 32) | (pair + 1))).collect::<Vec<_>>()
        };
        let mut commits = Commits::new(4);
        let room = commits.pairs.capacity();
        let four = [3, 0, 2, 1];
        let (often, again): (Vec<u64>, Vec<u64>) =
            ([1, 1, 3].repeat(10).into_iter().chain([0]).collect(), four.repeat(3));
        for (given, told) in [
            (&[][..], &[][..]),
            (&[2, 0], &[0, 2]),
            (&four, &[0, 1, 2, 3]),
            (&often, &[0, 1, 3]),
            (&again, &[0, 1, 2, 3]),
        ] {
            commits.committed_some(&of(given));
            assert_eq!(commits.pairs(), told, "{given:?}");
            assert_eq!(commits.pairs.capacity(), room);
        }
    }

    #[test]
    fn a_frame_tells_its_own_commit_and_those_that_were_missed() {
        let mut commits = Commits::new(2);
        let step = |commits: &mut Commits| {
            commits.evaluated();
            commits.committed();
        };
        step(&mut commits);
        assert_eq!(told(&mut commits), (1, 0));
        (0..10).for_each(|_| step(&mut commits));
        assert_eq!(told(&mut commits), (1, 9));
        // Stages of an integrator make no commits.
        (0..3).for_each(|_| commits.evaluated());
        step(&mut commits);
        assert_eq!(told(&mut commits), (1, 0));
        // Recorded before it was committed: the commit belongs to no frame.
        commits.evaluated();
        assert_eq!(told(&mut commits), (0, 0));
        commits.committed();
        commits.evaluated();
        assert_eq!(told(&mut commits), (0, 1));
        // Commits of a lost frame are counted with the next.
        step(&mut commits);
        let mut row = crate::Frame::default().row;
        commits.tell(&mut row);
        commits.lost(&row);
        step(&mut commits);
        assert_eq!(told(&mut commits), (1, 1));
    }
}
