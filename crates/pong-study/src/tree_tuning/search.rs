//! The search: proposals from large to small. Those that cannot be faster by the engine's counts are skipped;
//! the others are timed in turn with the best so far, which is timed twice to measure the noise, so that
//! chance is not taken for a gain.

use crate::Result;
use crate::runs::counts::Counts;
use crate::runs::subject::{Grouping, Shape};
use crate::tree_tuning::moves::{Move, Reach, applied, moves};
use std::collections::BTreeSet;

/// A grouping for every model.
pub(crate) type Proposal = Vec<Grouping>;

/// Makes, compares, counts and times proposals.
pub(crate) trait Judge {
    /// A hash of all trees of a proposal; cause and cure if it cannot be made.
    fn trees(&mut self, proposal: &Proposal) -> Result<u64, String>;
    /// The engine's counts with it, or the reason for its refusal: its answers are not the same bits.
    fn compare(&mut self, proposal: &Proposal) -> Result<Result<Counts, String>>;
    /// The time of each, in any unit, measured in turn for `rounds` rounds.
    fn time(&mut self, proposals: &[&Proposal], rounds: u32) -> Result<Vec<f64>>;
}

/// Result of a search.
pub(crate) struct Found {
    pub best: Proposal,
    /// Refused proposals: the model, the proposal, the reason.
    pub refused: Vec<(usize, Grouping, String)>,
    /// Number of proposals compared, and of those timed.
    pub compared: usize,
    pub timed: usize,
}

/// The least gain accepted, whatever the noise: a smaller one is not worth another file.
pub(crate) const LEAST_GAIN: f64 = 0.01;
/// Ratio of the least gain accepted to the noise.
pub(crate) const OVER_NOISE: f64 = 2.0;
/// Number of proposals timed in turn, beside the best so far.
const TOGETHER: usize = 6;
/// Number of passes over all models.
const CYCLES: usize = 2;
/// Number of times that one reach of moves is tried again after a gain.
const REPEATS: usize = 4;

/// Searches from a proposal; `tell` is called with each trial, and its error ends the search.
pub(crate) fn search(
    judge: &mut dyn Judge,
    shapes: &[&Shape],
    start: Proposal,
    rounds: u32,
    tell: &mut dyn FnMut(&str) -> Result<()>,
) -> Result<Found> {
    let found = Found { best: start, refused: Vec::new(), compared: 0, timed: 0 };
    let mut search = Search { judge, shapes, rounds, tell, found };
    for cycle in 0..CYCLES {
        let before = search.found.best.clone();
        for model in 0..shapes.len() {
            search.model(model, cycle)?;
        }
        if search.found.best == before || shapes.len() == 1 {
            break;
        }
    }
    Ok(search.found)
}

struct Search<'a> {
    judge: &'a mut dyn Judge,
    shapes: &'a [&'a Shape],
    rounds: u32,
    tell: &'a mut dyn FnMut(&str) -> Result<()>,
    found: Found,
}

impl Search<'_> {
    fn model(&mut self, model: usize, cycle: usize) -> Result<()> {
        for reach in [Reach::Model, Reach::Family, Reach::Group] {
            for repeat in 0..REPEATS {
                let words = match reach {
                    Reach::Model => "whole",
                    Reach::Family => "families of groups",
                    Reach::Group => "group by group",
                };
                let name = &self.shapes[model].name;
                (self.tell)(&format!("{name}, {words}, pass {}.{}", cycle + 1, repeat + 1))?;
                if !self.step(model, reach)? {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Tries all moves of a reach once; true if one was taken.
    fn step(&mut self, model: usize, reach: Reach) -> Result<bool> {
        let shape = self.shapes[model];
        let best = self.found.best.clone();
        let (Ok(trees), Ok(counts)) = (self.judge.trees(&best), self.judge.compare(&best)?) else {
            return Ok(false);
        };
        let mut seen = BTreeSet::from([trees]);
        let mut ready = Vec::new();
        for change in moves(shape, &best[model], reach) {
            let proposal = with(&best, model, applied(shape, &best[model], &change));
            if self.worth_timing(model, &proposal, &mut seen, &counts)? {
                ready.push((change, proposal));
            }
        }
        let gains = self.gains(ready.iter().map(|(_, proposal)| proposal).collect(), self.rounds)?;
        let mut good: Vec<(f64, usize)> =
            gains.into_iter().zip(0..).filter_map(|(gain, index)| Some((gain?, index))).collect();
        // Equal gains keep the order of the moves.
        good.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut finalists = Vec::new();
        if let Some((_, first)) = good.first() {
            finalists.push(ready[*first].1.clone());
        }
        for count in [good.len(), good.len() / 2] {
            let union = joined(good.iter().take(count).map(|(_, index)| &ready[*index].0));
            let proposal = with(&best, model, applied(shape, &best[model], &union));
            if count > 1 && self.worth_timing(model, &proposal, &mut seen, &counts)? {
                finalists.push(proposal);
            }
        }
        let gains = self.gains(finalists.iter().collect(), 2 * self.rounds)?;
        let winner = (0..gains.len()).filter(|index| gains[*index].is_some());
        let winner = winner
            .max_by(|a, b| gains[*a].partial_cmp(&gains[*b]).expect("gains are numbers").then(b.cmp(a)));
        if let Some(winner) = winner {
            self.found.best = finalists.swap_remove(winner);
        }
        Ok(winner.is_some())
    }

    /// True if a proposal gives the same bits, has new trees, and may be faster by its counts.
    fn worth_timing(
        &mut self,
        model: usize,
        proposal: &Proposal,
        seen: &mut BTreeSet<u64>,
        best: &Counts,
    ) -> Result<bool> {
        let mut refuse = |why| self.found.refused.push((model, proposal[model].clone(), why));
        match self.judge.trees(proposal) {
            Ok(trees) if !seen.insert(trees) => return Ok(false),
            Ok(_) => {}
            Err(why) => {
                refuse(why);
                return Ok(false);
            }
        }
        self.found.compared += 1;
        Ok(match self.judge.compare(proposal)? {
            Ok(counts) => !counts.is_no_less_than(best),
            Err(why) => {
                refuse(why);
                false
            }
        })
    }

    /// Relative gain in time of each proposal over the best so far; `None` if it is not above the noise.
    fn gains(&mut self, proposals: Vec<&Proposal>, rounds: u32) -> Result<Vec<Option<f64>>> {
        let mut gains = Vec::new();
        for some in proposals.chunks(TOGETHER) {
            let best = &self.found.best;
            let mut all = vec![best];
            all.extend(some);
            all.push(best);
            let times = self.judge.time(&all, rounds)?;
            self.found.timed += some.len();
            let (base, noise) = base(times[0], times[times.len() - 1]);
            let gain = |time: &f64| 1.0 - time / base;
            let enough = |gain: &f64| *gain > LEAST_GAIN.max(OVER_NOISE * noise);
            gains.extend(times[1..times.len() - 1].iter().map(gain).map(|gain| Some(gain).filter(enough)));
        }
        Ok(gains)
    }
}

/// The shorter of two times of the same thing, and their relative difference: the noise.
pub(crate) fn base(one: f64, other: f64) -> (f64, f64) {
    let least = one.min(other);
    (least, (one - other).abs() / least)
}

fn with(proposal: &Proposal, model: usize, grouping: Grouping) -> Proposal {
    let mut proposal = proposal.clone();
    proposal[model] = grouping;
    proposal
}

/// Joins moves into one; settings of earlier ones stay.
fn joined<'m>(moves: impl Iterator<Item = &'m Move>) -> Move {
    let mut all: Vec<_> = Vec::new();
    for (group, setting) in moves.flat_map(|one| &one.0) {
        if !all.iter().any(|(known, _)| known == group) {
            all.push((*group, setting.clone()));
        }
    }
    Move(all)
}
