//! A study that was stopped, and one that was run twice.

use crate::common::{RADIUS, ball_scene, settings};
use pong_study::sweep::{Settings, report, study};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

fn scene(test: &str) -> PathBuf {
    let more = r#"alternatives: [(name: "soft", models: { "ball": "soft_ball.ron" })],"#;
    ball_scene(test, (RADIUS + 0.001, -0.3), (2e-4, 0.016), more)
}

/// The study, or `None` if it was stopped after a number of runs; and the number of runs.
fn after(
    scene: &Path,
    output: &str,
    settings: &Settings,
    runs: usize,
) -> (Option<pong_study::sweep::Study>, usize) {
    let mut made = 0;
    let study = study(scene, &scene.parent().unwrap().join(output), settings, &mut |_| {
        if made == runs {
            return ControlFlow::Break(());
        }
        made += 1;
        ControlFlow::Continue(())
    });
    (study.ok(), made)
}

/// The table without the columns that hold times or are derived from them.
fn without_times(csv: &str) -> String {
    csv.lines().map(|line| line.rsplitn(6, ',').last().unwrap().to_owned() + "\n").collect()
}

#[test]
fn a_study_that_was_stopped_goes_on_and_ends_as_one_that_was_not() {
    let (scene, settings) = (scene("resume"), settings(8e-4, 2));
    let (whole, all) = after(&scene, "whole", &settings, usize::MAX);
    let whole = whole.unwrap();
    for stop in [0, 1, 3, 7, all - 2] {
        let output = format!("stopped_{stop}");
        let (stopped, made) = after(&scene, &output, &settings, stop);
        assert!(stopped.is_none() && made == stop, "{stop}");
        let (resumed, rest) = after(&scene, &output, &settings, usize::MAX);
        let resumed = resumed.unwrap();
        assert_eq!(report::errors_csv(&resumed), report::errors_csv(&whole), "{stop}");
        assert_eq!(without_times(&report::csv(&resumed)), report::errors_csv(&whole), "{stop}");
        // The reference, which is three runs, is kept only when complete.
        let kept = if stop < 3 { 0 } else { stop };
        assert_eq!(rest, all - kept, "{stop}");
    }
    let (_, again) = after(&scene, "whole", &settings, usize::MAX);
    assert_eq!(again, 0, "everything was kept");
    let (_, fresh) = after(&scene, "whole", &Settings { fresh: true, ..settings }, usize::MAX);
    assert_eq!(fresh, all, "nothing was used");
}

/// Kept results belong to the inputs: another text of a model is another study.
#[test]
fn a_changed_model_is_run_again() {
    let (scene, settings) = (scene("changed"), settings(8e-4, 1));
    let (first, all) = after(&scene, "out", &settings, usize::MAX);
    let model = scene.with_file_name("ball.ron");
    let text = std::fs::read_to_string(&model).unwrap();
    std::fs::write(&model, text.replace("100000.0", "50000.0")).unwrap();
    let (second, made) = after(&scene, "out", &settings, usize::MAX);
    assert_eq!(made, all);
    assert_ne!(report::errors_csv(&first.unwrap()), report::errors_csv(&second.unwrap()));
}

/// Levers that must not change an answer do not: the rows say so, and there are such rows.
#[test]
fn bounds_leaves_and_workers_change_no_bit() {
    let study = after(&scene("bits"), "out", &settings(8e-4, 2), usize::MAX).0.unwrap();
    let judged: Vec<bool> = study.rows.iter().filter_map(|row| study.same_bits(row)).collect();
    assert!(judged.len() >= 7 && judged.iter().all(|same| *same), "{judged:?}");
    let changed = study.rows.iter().any(|row| row.level.alternative.is_some());
    assert!(changed, "the alternative was run");
}
