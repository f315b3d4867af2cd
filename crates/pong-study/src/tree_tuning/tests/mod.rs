//! Models whose best grouping is known, proposals that change an answer, logs with events, output files.
//!
//! Times are computed from counts here, so that the result is the same every time.

mod files;
mod logs;
mod refusals;
mod searches;

use crate::Result;
use crate::runs::counts::Counts;
use crate::runs::motions::Motions;
use crate::runs::run::Run;
use crate::runs::samples::{Folder, model, scene};
use crate::runs::subject::Subject;
use crate::tree_tuning::bench::Bench;
use crate::tree_tuning::search::{Judge, Proposal};
use pong_model::Extensions;
use std::path::{Path, PathBuf};

/// A ball of 0.1 m that falls on a sheet of triangles and slides; both in groups without purpose.
const BALL: &str = "groups: [(name: \"a\", bound: Aabb, groups: [(name: \"b\", bound: Aabb, \
                    groups: [(name: \"c\", bound: Aabb, primitives: [Sphere(name: \"skin\", center: (0, 0, 0), radius: 0.1)])])])]";
const SHEET: &str = "groups: [(name: \"x\", bound: Obb, groups: [(name: \"y\", bound: Aabb, primitives: [TriangleMesh(name: \"floor\", \
                     vertices: [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], triangles: [(0, 1, 2), (0, 2, 3)])])])]";

fn ball_on_sheet(folder: &Folder) -> PathBuf {
    let start = "position: (0, 0, 0.0999), linear_velocity: (0.3, 0.1, -0.2)";
    scene(folder, ("ball", BALL), ("sheet", SHEET), start)
}

/// A run, its models and its motions.
struct Ready {
    runs: [Run; 1],
    subjects: Vec<Subject>,
    motions: [Motions; 1],
}

impl Ready {
    fn new(path: &Path) -> Self {
        let mut subjects = Vec::new();
        let run = Run::load(path, None, &Extensions::new(), &mut subjects)
            .unwrap_or_else(|error| panic!("{error}"));
        let motions = run.gather(1000, &mut |_| Ok(())).unwrap_or_else(|error| panic!("{error}"));
        Self { runs: [run], subjects, motions: [motions] }
    }

    fn bench(&self) -> Bench<'_> {
        Bench::new(&self.subjects, &self.runs, &self.motions, 1)
    }

    fn authored(&self) -> Proposal {
        self.subjects.iter().map(|subject| subject.shape.authored()).collect()
    }

    fn counts(&self, proposal: &Proposal) -> Counts {
        let counts = self.bench().compare(proposal).unwrap().unwrap_or_else(|why| panic!("{why}"));
        Counts::of_all(&counts)
    }

    /// The result of a search in which every test has a fixed price.
    fn search(&self) -> crate::tree_tuning::search::Found {
        let shapes: Vec<_> = self.subjects.iter().map(|subject| &subject.shape).collect();
        let mut judge = Priced { bench: self.bench(), timings: 0 };
        crate::tree_tuning::search::search(&mut judge, &shapes, self.authored(), 1, &mut |_| Ok(())).unwrap()
    }
}

/// A judge without a clock.
struct Priced<'a> {
    bench: Bench<'a>,
    timings: usize,
}

impl Judge for Priced<'_> {
    fn trees(&mut self, proposal: &Proposal) -> Result<u64, String> {
        Judge::trees(&mut self.bench, proposal)
    }

    fn compare(&mut self, proposal: &Proposal) -> Result<Result<Counts, String>> {
        Judge::compare(&mut self.bench, proposal)
    }

    fn time(&mut self, proposals: &[&Proposal], _: u32) -> Result<Vec<f64>> {
        self.timings += proposals.len();
        let mut times = Vec::new();
        for proposal in proposals {
            let counts = Judge::compare(&mut self.bench, proposal)?.expect("it was compared before");
            times.push(price(&counts));
        }
        Ok(times)
    }
}

fn price(counts: &Counts) -> f64 {
    let volume = |(kinds, tally): (&(&str, &str), &[u64; 2])| {
        let each = if *kinds == ("Aabb", "Aabb") { 10.0 } else { 12.0 };
        each * tally[0] as f64
    };
    counts.volumes.iter().map(volume).sum::<f64>()
        + 30.0 * counts.leaf_pairs as f64
        + 8.0 * counts.boxes as f64
        + 20.0 * counts.primitives_tested()[0] as f64
}
