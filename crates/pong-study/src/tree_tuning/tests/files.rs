//! Output files: written, and refused.

use super::{Folder, Ready, ball_on_sheet, model};
use crate::runs::output::{Output, headed};
use crate::runs::subject::{Subject, hash_of_trees};
use crate::tree_tuning::tune::{DONE, TUNED};
use crate::tree_tuning::words;
use crate::tree_tuning::{Settings, tune};
use pong_model::{Extensions, Model};
use std::ops::ControlFlow::{Break, Continue};
use std::path::PathBuf;

/// Check of the model read from a file.
fn as_measured(subject: &Subject, trees: u64) -> impl Fn(&Model) -> bool {
    let hash = subject.hash;
    move |model| model.hash == hash && hash_of_trees(model) == trees
}

fn best_of(ready: &Ready) -> (Vec<String>, crate::tree_tuning::search::Proposal) {
    let best = ready.search().best;
    let texts = ready
        .subjects
        .iter()
        .zip(&best)
        .map(|(subject, best)| headed(&subject.text(best).unwrap(), DONE, "a run"));
    (texts.collect(), best)
}

/// A written file reads back as the model that was measured, can be tuned again, and is the same bytes every
/// time.
#[test]
fn a_tuned_file_reads_back() {
    let folder = Folder::new("round_trip");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let (texts, best) = best_of(&ready);
    for (index, subject) in ready.subjects.iter().enumerate() {
        let trees = ready.bench().trees_of(&best, index).unwrap();
        let output = Output::default();
        let place = output.write((subject, TUNED), &texts[index], &as_measured(subject, trees)).unwrap();
        assert_eq!(place, folder.0.join(format!("{}_tuned.ron", subject.shape.name)));
        let again = Subject::load(&place, false, &Extensions::new()).unwrap();
        assert_eq!(again.hash, subject.hash);
        assert_eq!(again.shape.authored(), best[index]);
        assert_eq!(again.make(&best[index]).unwrap().trees, trees);
        // All but the head, the bounds and the sizes is unchanged, including names and paths.
        let back = headed(&again.text(&subject.shape.authored()).unwrap(), DONE, "a run");
        let own = subject.make(&subject.shape.authored()).unwrap().model;
        let model = pong_model::parse(&back, "back", None, &Default::default()).unwrap();
        assert_eq!(crate::runs::subject::hash_of_trees(&model), crate::runs::subject::hash_of_trees(&own));
        let paths = |model: &pong_model::Model| -> Vec<String> {
            model.bodies.iter().flat_map(|body| body.primitives.iter().map(|p| p.path.clone())).collect()
        };
        assert_eq!(paths(&again.make(&best[index]).unwrap().model), paths(&own));
        let bytes = std::fs::read(&place).unwrap();
        let replaced = Output { force: true, ..Output::default() }
            .write((subject, TUNED), &texts[index], &as_measured(subject, trees))
            .unwrap();
        assert_eq!(std::fs::read(replaced).unwrap(), bytes);
    }
    assert_eq!(headed(&texts[0], DONE, "a run"), texts[0]);
    // A line end in the head would begin a line that is read as part of the model.
    assert!(headed("()", DONE, "a\nb").starts_with("// Bounds and leaves by `pong tune` for `ab`;"));
    let left: Vec<_> =
        std::fs::read_dir(&folder.0).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 5, "{left:?}");
}

#[test]
fn files_that_are_there_are_refused_before_anything_is_run() {
    let folder = Folder::new("there");
    let scene = ball_on_sheet(&folder);
    let there = folder.write("sheet_tuned.ron", "mine");
    let run =
        |output: Output| tune(&[&scene], &Settings { output, ..Settings::default() }, &mut |_| Continue(()));
    let mut ran = false;
    let refused = tune(&[&scene], &Settings::default(), &mut |_| {
        ran = true;
        Continue(())
    })
    .unwrap_err()
    .to_string();
    assert!(!ran && refused.contains("sheet_tuned.ron") && refused.contains("--force"), "{refused}");
    assert_eq!(std::fs::read_to_string(&there).unwrap(), "mine");
    assert!(run(Output { folder: Some(folder.0.join("elsewhere")), force: false }).is_ok());
}

/// If the text read back is not the model that was measured, no file is put in place.
#[test]
fn a_file_that_reads_otherwise_is_not_put_in_place() {
    let folder = Folder::new("otherwise");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let subject = &ready.subjects[0];
    let trees = ready.bench().trees_of(&ready.authored(), 0).unwrap();
    for (text, trees) in [
        (subject.text.clone(), trees ^ 1),
        (subject.text.replace("radius: 0.1", "radius: 0.2"), trees),
        ("(format: 1)".to_owned(), trees),
    ] {
        assert!(Output::default().write((subject, TUNED), &text, &as_measured(subject, trees)).is_err());
    }
    assert_eq!(std::fs::read_dir(&folder.0).unwrap().count(), 3);
}

/// A model with a mesh, tuned into another folder.
#[test]
fn meshes_go_along_into_another_folder() {
    let folder = Folder::new("meshes");
    folder.write("parts/floor.obj", "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nf 1 2 3\n");
    let file = folder.write(
        "sheet.ron",
        &model("sheet", "primitives: [TriangleMesh(name: \"floor\", file: \"parts/floor.obj\")]"),
    );
    let subject = Subject::load(&file, false, &Extensions::new()).unwrap();
    let authored = subject.shape.authored();
    let trees = subject.make(&authored).unwrap().trees;
    let output = |force| Output { folder: Some(folder.0.join("new/home")), force };
    let place = output(false).write((&subject, TUNED), &subject.text, &as_measured(&subject, trees)).unwrap();
    assert_eq!(Subject::load(&place, false, &Extensions::new()).unwrap().hash, subject.hash);
    folder.write("new/home/parts/floor.obj", "another");
    let refused = output(false)
        .write((&subject, TUNED), &subject.text, &as_measured(&subject, trees))
        .unwrap_err()
        .to_string();
    assert!(refused.contains("floor.obj") && refused.contains("--force"), "{refused}");
    output(true).write((&subject, TUNED), &subject.text, &as_measured(&subject, trees)).unwrap();
}

#[test]
fn what_cannot_be_tuned_is_refused_with_a_cure() {
    let folder = Folder::new("refused");
    let scene = ball_on_sheet(&folder);
    let refused =
        |settings: Settings| tune(&[&scene], &settings, &mut |_| Continue(())).unwrap_err().to_string();
    for duration_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let told = refused(Settings { duration_s: Some(duration_s), ..Settings::default() });
        assert!(told.contains("--duration") && told.contains("above zero"), "{told}");
    }
    assert!(refused(Settings { rounds: 0, ..Settings::default() }).contains("at least 1 round"));
    let missing = PathBuf::from("nowhere.ron");
    assert!(
        tune(&[&missing], &Settings::default(), &mut |_| Continue(()))
            .unwrap_err()
            .to_string()
            .contains("nowhere.ron")
    );
}

/// A tuning that is stopped at any time says so, makes no further calls and leaves the folder unchanged.
#[test]
fn a_tuning_that_is_told_to_stop_writes_nothing() {
    let folder = Folder::new("stopped");
    let scene = ball_on_sheet(&folder);
    let settings = Settings { rounds: 2, frames: 64, ..Settings::default() };
    for last in 1..=4 {
        let mut calls = 0;
        let stopped = tune(&[&scene], &settings, &mut |_| {
            calls += 1;
            if calls == last { Break(()) } else { Continue(()) }
        });
        let told = stopped.map_or_else(|stopped| stopped.to_string(), |_| "went on".to_owned());
        assert_eq!(told, "tuning: stopped; run it again");
        assert_eq!(calls, last);
        assert_eq!(std::fs::read_dir(&folder.0).unwrap().count(), 3);
    }
}

/// Models shared by two runs are tuned once, and the report has both runs.
#[test]
fn runs_share_the_models_that_they_share() {
    let folder = Folder::new("also");
    let scene = ball_on_sheet(&folder);
    let other = folder.write("other.ron", &std::fs::read_to_string(&scene).unwrap().replace("0.0999", "0.3"));
    let settings = Settings { rounds: 2, frames: 64, ..Settings::default() };
    let tuned = tune(&[&scene, &other], &settings, &mut |_| Continue(())).unwrap();
    assert_eq!((tuned.runs.len(), tuned.models.len()), (2, 2));
    assert!(
        tuned.runs.iter().all(|run| run.frames == 101 && run.times_ns.iter().all(|times| times.len() == 64))
    );
    let written = tuned.models.iter().filter(|model| model.written.is_some()).count();
    assert_eq!(written > 0, tuned.taken);
    let page = crate::tree_tuning::report::page(&tuned);
    assert!(page.contains("# ball and sheet") && page.contains("tests of bounds per frame"), "{page}");
    assert!(page.contains(if tuned.taken { "less time" } else { "as good as this finds" }), "{page}");
}

#[test]
fn changes_are_told_group_by_group() {
    let folder = Folder::new("words");
    let ready = Ready::new(&ball_on_sheet(&folder));
    let shape = &ready.subjects[0].shape;
    let (before, mut after) = (shape.authored(), shape.authored());
    assert!(words::changes(shape, &before, &after).is_empty());
    after[1].bound = pong_model::grouping::Bound::Above;
    after[3].leaf_size = Some(32);
    let told = words::changes(shape, &before, &after);
    let expected = [
        "ball/a: Aabb → no volume of its own, what it holds counts to ball",
        "ball/a/b/c: leaves of at most 32 elements",
    ];
    assert_eq!(told, expected);
    assert_eq!(words::changes(shape, &after, &before).len(), 2);
    // A branch that is merged as a whole is one line.
    after[3].leaf_size = None;
    (1..4).for_each(|group| after[group].bound = pong_model::grouping::Bound::Above);
    let told = words::changes(shape, &before, &after);
    assert_eq!(told, ["ball/a: with all below no volume of its own, what it holds counts to ball"]);
}
