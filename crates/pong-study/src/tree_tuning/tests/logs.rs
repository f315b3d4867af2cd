//! Logs whose host did more than set states.

use super::{BALL, Folder, Ready, SHEET, model};
use crate::StudyError;
use pong_engine::{Config, State, WorldBuilder};
use pong_model::Extensions;
use pong_record::{ModelSource, RecordOptions, Recorder};
use std::path::PathBuf;
use std::sync::Arc;

/// A log of 300 frames in which a pair is switched, a surface set, a ball's history cleared, and not every
/// frame committed.
fn log(folder: &Folder) -> PathBuf {
    let ext = Extensions::new();
    let mut builder = WorldBuilder::new(Config { contact_capacity: Some(64), ..Config::default() });
    let mut objects = Vec::new();
    let mut sources = Vec::new();
    for (name, root) in [("ball", BALL), ("sheet", SHEET)] {
        let text = model(name, root);
        let loaded = pong_model::parse(&text, name, None, &ext).unwrap();
        let id = builder.add_model(Arc::new(loaded));
        objects.push((id, builder.create_object(id, name).unwrap()));
        sources.push(ModelSource::Text { text, mesh_dir: None });
    }
    let (ball, sheet) = (objects[0].1, objects[1].1);
    let pair = builder.pair(ball, sheet).unwrap();
    let (mut world, _) = builder.seal().unwrap();
    let bodies = [world.scene().interfaces(ball).unwrap()[0], world.scene().interfaces(sheet).unwrap()[0]];
    let place = folder.0.join("log");
    let mut recorder = Recorder::start(&world, &place, &sources, &RecordOptions::default()).unwrap();
    for n in 0..300_u32 {
        match n {
            80 => {
                world.clear_contact_history(ball).unwrap();
                recorder.forgot(ball);
            }
            100 | 120 => {
                world.set_pair_enabled(pair, n == 120).unwrap();
                recorder.pair_switched(pair, n == 120);
            }
            150 => {
                let mut surface = world.surface(objects[0].0, "s").unwrap().clone();
                surface.stiffness = 7e4;
                world.set_surface(objects[0].0, &surface).unwrap();
                recorder.surface_set(objects[0].0, &surface);
            }
            _ => {}
        }
        let mut state = State::identity();
        let t = f64::from(n);
        state.position = [1e-5 * t, 2e-6 * t, 0.0999 + 3e-7 * t];
        state.linear_velocity = [1e-2, 2e-3, 3e-4];
        world.set_states(&[(bodies[0], state), (bodies[1], State::identity())]).unwrap();
        world.evaluate().unwrap();
        recorder.evaluated();
        match n % 5 {
            0 => {}
            1 => {
                world.commit_pairs(&[pair]).unwrap();
                recorder.committed_some(&[pair]);
            }
            2 => {
                world.commit_pairs(&[]).unwrap();
                recorder.committed_some(&[]);
            }
            _ => {
                world.commit().unwrap();
                recorder.committed();
            }
        }
        recorder.record(&world, 0.01 * t, 0, None).unwrap();
    }
    recorder.finish().unwrap();
    place
}

/// Played window by window, in any order, the log's frames are the same bits: no call of its host is missing.
#[test]
fn a_log_with_events_is_played_as_it_was() {
    let folder = Folder::new("events");
    let mut ready = Ready::new(&log(&folder));
    let frames: usize = ready.motions[0].windows.iter().map(|window| window.frames.len()).sum();
    assert!(frames > 250 && ready.motions[0].answers.len() == 300, "{frames}");
    ready.motions[0].windows.reverse();
    let counts = ready.counts(&ready.authored());
    assert_eq!(counts.frames as usize, frames);
    assert!(counts.primitives_tested()[1] > 200, "{counts:?}");
    let found = ready.search();
    let made = ready.bench().models(&found.best).unwrap().0;
    assert_eq!(
        ready.counts(&found.best).volumes_tested()[0],
        ready.counts(&found.best).frames - switched_off(&ready)
    );
    assert_eq!(ready.runs[0].differs(&made, &ready.motions[0], &mut |_| Ok(())).unwrap(), None);
    let stop = StudyError("stop".to_owned());
    let stopped = ready.runs[0].differs(&made, &ready.motions[0], &mut |_| Err(stop.clone()));
    assert_eq!(stopped, Err(stop));
}

/// Number of kept frames in which the pair is switched off.
fn switched_off(ready: &Ready) -> u64 {
    let frames =
        |window: &crate::runs::motions::Window| window.first..window.first + window.frames.len() as u64;
    ready.motions[0].windows.iter().flat_map(frames).filter(|frame| (100..120).contains(frame)).count() as u64
}

/// A surface that was set in the run is set again before the frames that follow.
#[test]
fn what_is_not_restored_would_be_seen() {
    let folder = Folder::new("restored");
    let ready = Ready::new(&log(&folder));
    let windows = &ready.motions[0].windows;
    let late = windows.iter().position(|window| window.first > 200).unwrap();
    let mut early = Ready::new(&folder.0.join("log")).motions;
    // The frames of a late window with the state before an early one.
    let mut moved = early[0].windows.swap_remove(late);
    let first = early[0].windows.swap_remove(0);
    moved.before = first.before;
    early[0].windows = vec![moved];
    let compared = crate::tree_tuning::bench::Bench::new(&ready.subjects, &ready.runs, &early, 1)
        .compare(&ready.authored());
    assert!(compared.unwrap().is_err());
}

#[test]
fn a_duration_cuts_a_log() {
    let folder = Folder::new("cut_log");
    let path = log(&folder);
    let run = crate::runs::run::Run::load(&path, Some(0.995), &Extensions::new(), &mut Vec::new()).unwrap();
    assert_eq!(run.frames, 100);
}
