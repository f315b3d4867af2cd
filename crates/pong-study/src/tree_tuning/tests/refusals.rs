//! Proposals that change an answer are refused, and reported. Models are broken on purpose here.

use super::{Folder, Priced, Ready, ball_on_sheet, scene};
use crate::Result;
use crate::runs::counts::Counts;
use crate::runs::play::Compared;
use crate::tree_tuning::search::{Judge, Proposal, search};
use pong_model::Model;
use std::sync::Arc;

fn models(ready: &Ready) -> Vec<Arc<Model>> {
    ready.bench().models(&ready.authored()).unwrap().0
}

/// A bar on a floor.
fn bar_on_floor(folder: &Folder) -> std::path::PathBuf {
    let bar = "primitives: [LineSegment(name: \"edge\", ends: ((-0.5, 0, -0.1), (0.5, 0, -0.1)))]";
    let floor = "primitives: [Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)]";
    let start = "position: (0, 0, 0.0999), linear_velocity: (0.3, 0.1, -0.2)";
    scene(folder, ("bar", bar), ("floor", floor), start)
}

/// Models with one end of the bar higher by one unit in the last place.
fn by_one_bit(ready: &Ready) -> Vec<Arc<Model>> {
    let mut models = models(ready);
    let bar = &mut Arc::make_mut(&mut models[0]).bodies[0];
    let end = &mut bar.segments[0].ends[0];
    end.z = end.z.next_up();
    // The model also has it in the arrays for vector code.
    bar.tree.batches[0].segments[0].ends[0].z[0] = end.z;
    models
}

#[test]
fn one_bit_of_one_primitive_is_seen_in_the_sample_and_in_the_whole_run() {
    let folder = Folder::new("one_bit");
    let ready = Ready::new(&bar_on_floor(&folder));
    let (run, motions) = (&ready.runs[0], &ready.motions[0]);
    let same = run.player(&models(&ready)).unwrap().compare(motions, 1).unwrap();
    assert!(matches!(same, Compared::Same(counts) if counts.frames == 101));
    assert_eq!(run.differs(&models(&ready), motions, &mut |_| Ok(())).unwrap(), None);

    let mut player = run.player(&by_one_bit(&ready)).unwrap();
    let Compared::Differs(what) = player.compare(motions, 1).unwrap() else { panic!("a bit was missed") };
    assert_eq!(what, "the wrenches of frame 0");
    let what = run.differs(&by_one_bit(&ready), motions, &mut |_| Ok(())).unwrap();
    assert_eq!(what.as_deref(), Some("the wrenches of frame 0"));
}

/// The report names the first frame that differs, with the run.
#[test]
fn the_frame_that_differs_is_named() {
    let folder = Folder::new("parts");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let mut motions = Ready::new(&ball_on_sheet(&folder)).motions;
    let answers = motions[0].answers.clone();
    let parts = |frame: usize| answers[frame].difference(&answers[frame + 1]);
    assert_eq!(parts(0), Some("the wrenches"));
    motions[0].answers[7] = answers[8];
    let refused = crate::tree_tuning::bench::Bench::new(&ready.subjects, &ready.runs, &motions, 1)
        .compare(&ready.authored());
    let why = refused.unwrap().unwrap_err();
    assert!(
        why.contains("frame 7") && why.contains("ball and sheet") && why.contains("not be the same bits"),
        "{why}"
    );
}

/// A judge whose engine gives another answer as soon as a group of the first model has no volume of its own.
struct Broken<'a>(Priced<'a>);

impl Judge for Broken<'_> {
    fn trees(&mut self, proposal: &Proposal) -> Result<u64, String> {
        self.0.trees(proposal)
    }

    fn compare(&mut self, proposal: &Proposal) -> Result<Result<Counts, String>> {
        if proposal[0].iter().any(|setting| setting.bound == pong_model::grouping::Bound::Above) {
            return Ok(Err("the contacts of frame 3".to_owned()));
        }
        self.0.compare(proposal)
    }

    fn time(&mut self, proposals: &[&Proposal], rounds: u32) -> Result<Vec<f64>> {
        self.0.time(proposals, rounds)
    }
}

#[test]
fn what_is_refused_is_never_taken_and_told() {
    let folder = Folder::new("broken");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let shapes: Vec<_> = ready.subjects.iter().map(|subject| &subject.shape).collect();
    let mut judge = Broken(Priced { bench: ready.bench(), timings: 0 });
    let found = search(&mut judge, &shapes, ready.authored(), 1, &mut |_| Ok(())).unwrap();
    assert!(judge.0.timings > 0);
    assert!(found.refused.iter().all(|(model, _, why)| *model == 0 && why.contains("frame 3")));
    assert!(!found.refused.is_empty());
    let above = |model: usize| {
        found.best[model].iter().filter(|s| s.bound == pong_model::grouping::Bound::Above).count()
    };
    assert_eq!((above(0), above(1)), (0, 2));
}

/// A clock by which every proposal takes half the time, and two timings of the best so far differ by a given
/// share.
struct Noisy<'a>(Priced<'a>, f64);

impl Judge for Noisy<'_> {
    fn trees(&mut self, proposal: &Proposal) -> Result<u64, String> {
        self.0.trees(proposal)
    }

    fn compare(&mut self, proposal: &Proposal) -> Result<Result<Counts, String>> {
        self.0.compare(proposal)
    }

    fn time(&mut self, proposals: &[&Proposal], _: u32) -> Result<Vec<f64>> {
        let mut times = vec![0.5; proposals.len()];
        times[0] = 1.0;
        times[proposals.len() - 1] = 1.0 + self.1;
        Ok(times)
    }
}

/// Half the time is a gain of 0.5: taken if two timings of the same thing differ by less than half of that.
#[test]
fn what_is_not_beyond_noise_is_not_taken() {
    let folder = Folder::new("noise");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let shapes: Vec<_> = ready.subjects.iter().map(|subject| &subject.shape).collect();
    for (noise, taken) in [(0.0, true), (0.24, true), (0.26, false), (1.0, false)] {
        let mut judge = Noisy(Priced { bench: ready.bench(), timings: 0 }, noise);
        let found = search(&mut judge, &shapes, ready.authored(), 1, &mut |_| Ok(())).unwrap();
        assert_eq!(found.best != ready.authored(), taken, "{noise}");
        assert!(found.timed > 0);
    }
}

/// A frame without contacts, and one with some.
#[test]
fn contacts_are_part_of_an_answer() {
    let folder = Folder::new("contacts");
    let start = "position: (0, 0, 0.11), linear_velocity: (0, 0, -0.2)";
    let ready = Ready::new(&scene(&folder, ("ball", super::BALL), ("sheet", super::SHEET), start));
    let answers = &ready.motions[0].answers;
    assert_eq!(answers[0].contacts, answers[10].contacts);
    assert_ne!(answers[0].contacts, answers[54].contacts);
    assert_ne!(answers[54].contacts, answers[55].contacts);
}
