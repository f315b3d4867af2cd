//! Models whose best grouping is known, proposals that change an answer, logs with events, files that are written.
//!
//! Times are made from counts here, so that the same is found every time.

mod files;
mod logs;
mod refusals;
mod searches;

use crate::Result;
use crate::tree_tuning::bench::Bench;
use crate::tree_tuning::counts::Counts;
use crate::tree_tuning::motions::Motions;
use crate::tree_tuning::run::Run;
use crate::tree_tuning::search::{Judge, Proposal};
use crate::tree_tuning::subject::Subject;
use pong_geometry::extension::Extensions;
use std::path::{Path, PathBuf};

/// A folder of the test's own, gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("pong_tune_{test}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn model(name: &str, root: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"{name}\", surfaces: {{ \"s\": (stiffness: 1e5, friction: Bristle(mu: 0.4)) }},\n    \
         root: (name: \"{name}\", surface: \"s\", {root}))\n"
    )
}

/// A ball of 0.1 m that comes down on a sheet of triangles and slides; both in groups that are there for nothing.
const BALL: &str = "groups: [(name: \"a\", groups: [(name: \"b\", groups: [(name: \"c\", primitives: \
                    [Sphere(name: \"skin\", center: (0, 0, 0), radius: 0.1)])])])]";
const SHEET: &str = "groups: [(name: \"x\", bound: Obb, groups: [(name: \"y\", primitives: [TriangleMesh(name: \"floor\", \
                     vertices: [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], triangles: [(0, 1, 2), (0, 2, 3)])])])]";

/// A scene of a free model above or beside a fixed one.
fn scene(folder: &Folder, moving: (&str, &str), fixed: (&str, &str), start: &str) -> PathBuf {
    for (name, root) in [moving, fixed] {
        folder.write(&format!("{name}.ron"), &model(name, root));
    }
    let (a, b) = (moving.0, fixed.0);
    folder.write(
        "scene.ron",
        &format!(
            "(format: \"pong-scene\", version: 1, name: \"{a} and {b}\", models: {{ \"{a}\": \"{a}.ron\", \"{b}\": \"{b}.ron\" }},\n\
             objects: [(name: \"{a}\", model: \"{a}\", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), {start})]),\n\
             (name: \"{b}\", model: \"{b}\", bodies: [(motion: Fixed)])], pairs: [(\"{a}\", \"{b}\")],\n\
             integrator: SemiImplicitEuler, step: 1e-3, duration: 0.1)"
        ),
    )
}

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

    /// What a search finds where every test has its price.
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
