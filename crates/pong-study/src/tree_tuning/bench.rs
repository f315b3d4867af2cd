//! Proposals on the kept motions of all runs: made, compared, counted, timed.

use crate::Result;
use crate::runs::counts::Counts;
use crate::runs::motions::Motions;
use crate::runs::play::{Compared, Player};
use crate::runs::run::Run;
use crate::runs::subject::{Grouping, Made, Subject};
use crate::tree_tuning::search::{Judge, Proposal};
use pong_model::Fnv;
use pong_model::Model;
use std::sync::Arc;

/// Runs, their motions, and their models.
pub(crate) struct Bench<'a> {
    pub subjects: &'a [Subject],
    pub runs: &'a [Run],
    pub motions: &'a [Motions],
    /// Stride of the windows that are played.
    pub stride: usize,
    /// The last model made for each subject.
    made: Vec<Option<(Grouping, Made)>>,
}

/// Times of a proposal in one run: the shortest of each frame, ns.
pub(crate) type FrameTimes = Vec<u64>;

/// A proposal slower than the first by more than this factor after two rounds is not timed further.
const HOPELESS: f64 = 1.05;

impl<'a> Bench<'a> {
    pub fn new(subjects: &'a [Subject], runs: &'a [Run], motions: &'a [Motions], stride: usize) -> Self {
        let made = subjects.iter().map(|_| None).collect();
        Self { subjects, runs, motions, stride, made }
    }

    /// The models of a proposal, and the hash of all their trees.
    pub fn models(&mut self, proposal: &Proposal) -> Result<(Vec<Arc<Model>>, u64)> {
        let mut trees = Fnv::default();
        let mut models = Vec::new();
        for ((subject, grouping), made) in self.subjects.iter().zip(proposal).zip(&mut self.made) {
            if made.as_ref().is_none_or(|(known, _)| known != grouping) {
                *made = Some((grouping.clone(), subject.make(grouping)?));
            }
            let (_, made) = made.as_ref().expect("made above");
            trees.word(made.trees);
            models.push(Arc::clone(&made.model));
        }
        Ok((models, trees.value()))
    }

    /// The hash of the trees of one subject in a proposal.
    pub fn trees_of(&mut self, proposal: &Proposal, subject: usize) -> Result<u64> {
        self.models(proposal)?;
        Ok(self.made[subject].as_ref().map_or(0, |(_, made)| made.trees))
    }

    fn players(&mut self, proposal: &Proposal) -> Result<Vec<Player>> {
        let models = self.models(proposal)?.0;
        self.runs.iter().map(|run| run.player(&models)).collect()
    }

    /// Counts of each run with a proposal, or the reason for its refusal.
    pub fn compare(&mut self, proposal: &Proposal) -> Result<Result<Vec<Counts>, String>> {
        let mut counts = Vec::new();
        let players = match self.players(proposal) {
            Ok(players) => players,
            Err(error) => return Ok(Err(error.to_string())),
        };
        for ((mut player, run), motions) in players.into_iter().zip(self.runs).zip(self.motions) {
            match player.compare(motions, self.stride).map_err(|error| run.refused(&error))? {
                Compared::Same(counted) => counts.push(counted),
                Compared::Differs(what) => {
                    return Ok(Err(format!("{what} of `{}` would not be the same bits", run.name)));
                }
            }
        }
        Ok(Ok(counts))
    }

    /// Times of each proposal in each run, measured in turn.
    pub fn times(&mut self, proposals: &[&Proposal], rounds: u32) -> Result<Vec<Vec<FrameTimes>>> {
        let mut players = Vec::new();
        for proposal in proposals {
            players.push(self.players(proposal)?);
        }
        let mut times = vec![vec![FrameTimes::new(); self.runs.len()]; proposals.len()];
        for round in 0..rounds {
            let mut order: Vec<usize> = (0..players.len()).collect();
            if round % 2 == 1 {
                order.reverse();
            }
            let last = players.len() - 1;
            for index in order {
                let between = index > 0 && index < last;
                if between && round >= 2 && relative(&times[index], &times[0]) > HOPELESS {
                    continue;
                }
                for (run, player) in players[index].iter_mut().enumerate() {
                    let refused = |error| self.runs[run].refused(&error);
                    player.time(&self.motions[run], self.stride, &mut times[index][run]).map_err(refused)?;
                }
            }
        }
        Ok(times)
    }
}

impl Judge for Bench<'_> {
    fn trees(&mut self, proposal: &Proposal) -> Result<u64, String> {
        self.models(proposal).map(|(_, trees)| trees).map_err(|error| error.to_string())
    }

    fn compare(&mut self, proposal: &Proposal) -> Result<Result<Counts, String>> {
        Ok(Bench::compare(self, proposal)?.map(|counts| Counts::of_all(&counts)))
    }

    fn time(&mut self, proposals: &[&Proposal], rounds: u32) -> Result<Vec<f64>> {
        let times = self.times(proposals, rounds)?;
        Ok(times.iter().map(|own| relative(own, &times[0])).collect())
    }
}

/// The mean over all runs of the ratio of the times.
pub(crate) fn relative(own: &[FrameTimes], other: &[FrameTimes]) -> f64 {
    let sum = |frames: &FrameTimes| frames.iter().map(|ns| *ns as f64).sum::<f64>();
    let ratios = own.iter().zip(other).map(|(own, other)| sum(own) / sum(other).max(1.0));
    ratios.sum::<f64>() / own.len() as f64
}
