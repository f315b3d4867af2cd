//! A log replays with the same bits; any change in it is reported by name.

use crate::support::{CART, HeldDisk, folder, scene, scene_with};
use pong_engine::{Laws, State, WorldBuilder};
use pong_record::{
    Log, LogError, Obstacle, RecordOptions, Recorder, ReplayOptions, ReplayReport, WhenFull, replay,
};
use std::ops::ControlFlow;
use std::path::Path;

fn replayed(place: &Path, options: &ReplayOptions) -> ReplayReport {
    replay(&mut Log::open(place).unwrap(), options, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn exactly(place: &Path) -> ReplayReport {
    replayed(place, &ReplayOptions::default())
}

/// Flips the lowest bit of one byte of a row.
fn plant(place: &Path, table: &str, row: usize, row_size: usize, at: usize) {
    let path = place.join(format!("{table}.npy"));
    let mut bytes = std::fs::read(&path).unwrap();
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[start + row * row_size + at] ^= 1;
    std::fs::write(&path, bytes).unwrap();
}

#[test]
fn every_frame_comes_again() {
    let folder = folder("again");
    let place = scene(&folder).record(&folder, 300, &RecordOptions::default());
    let report = exactly(&place);
    assert!(report.agrees() && report.compared == 300 && report.contacts > 300, "{report:?}");
    let two = pong_engine::WorkerSettings { workers: 2, oversubscribe: true, ..Default::default() };
    assert!(replayed(&place, &ReplayOptions { workers: Some(two), ..Default::default() }).agrees());
}

/// A world that goes on with more Objects is not the one that is recorded: that log ends whole, and the next one begins where it
/// ends.
#[test]
fn a_world_that_goes_on_gets_a_log_of_its_own() {
    let folder = folder("goes_on");
    let mut scene = scene(&folder);
    let [first, second] = ["first", "second"].map(|name| folder.join(name));
    let options = RecordOptions::default();
    let mut recorder = Recorder::start(&scene.world, &first, &scene.sources, &options).unwrap();
    for n in 0..100 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n) * 0.01, 0, None).unwrap();
    }
    let known = scene.world.scene();
    let (model, ground) = (known.model_id_of(scene.cart).unwrap(), known.object("ground").unwrap());
    let mut builder = WorldBuilder::extending(&scene.world);
    let arrived = builder.create_object(model, "second").unwrap();
    builder.pair(arrived, ground).unwrap();
    for (group, height) in builder.scene().interfaces(arrived).unwrap().into_iter().zip([0.099, 0.2]) {
        let state = State { position: [0.0, 1.0, height], ..State::identity() };
        builder.set_states(&[(group, state)]).unwrap();
    }
    let (mut world, _) = builder.seal().unwrap();
    assert!(world.continue_from(&scene.world).unwrap().contacts > 0);
    world.evaluate().unwrap();
    let refused = recorder.record(&world, 1.0, 0, None).unwrap_err().to_string();
    assert!(refused.contains("other Objects") && refused.contains("begin one"), "{refused}");
    assert_eq!(recorder.finish().unwrap().frames, 100);
    scene.world = world;
    let mut recorder = Recorder::start(&scene.world, &second, &scene.sources, &options).unwrap();
    for n in 100..200 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n) * 0.01, 0, None).unwrap();
    }
    recorder.finish().unwrap();
    for place in [first, second] {
        let report = exactly(&place);
        assert!(report.agrees() && report.compared == 100 && report.contacts > 50, "{report:?}");
    }
}

/// Groups that the host or the model keeps apart are kept apart again.
#[test]
fn filters_come_again() {
    let of_model = CART.replace("root:", "filters: [(\"wheels\", \"arm\")], root:");
    let mut contacts = Vec::new();
    for (text, apart) in [(CART, &[][..]), (CART, &["wheels"]), (&of_model, &["arm"])] {
        let folder = folder(&format!("filters_{}", contacts.len()));
        let place = scene_with(&folder, text, apart).record(&folder, 100, &RecordOptions::default());
        let report = exactly(&place);
        assert!(report.agrees() && report.compared == 100, "{report:?}");
        contacts.push(report.contacts);
        // A log whose filters were taken out is another run.
        let run = std::fs::read_to_string(place.join("run.json")).unwrap();
        let mut changed: serde_json::Value = serde_json::from_str(&run).unwrap();
        if changed.as_object_mut().unwrap().remove("filters").is_some() {
            std::fs::write(place.join("run.json"), changed.to_string()).unwrap();
            let mut log = Log::open(&place).unwrap();
            let refused =
                replay(&mut log, &ReplayOptions::default(), &mut |_| ControlFlow::Continue(())).unwrap_err();
            assert!(refused.to_string().contains("has hash"), "{refused}");
            let loose = ReplayOptions { tolerance: Some(1e-9), ..ReplayOptions::default() };
            assert!(!replayed(&place, &loose).agrees(), "{apart:?}");
        }
    }
    assert!(
        contacts[1] > 0 && contacts[1] < contacts[0] && contacts[2] > 0 && contacts[2] < contacts[0],
        "{contacts:?}"
    );
}

/// Ended after some frames, a replay does not say that the log agrees.
#[test]
fn a_replay_can_be_ended() {
    let folder = folder("ended");
    let place = scene(&folder).record(&folder, 10, &RecordOptions::default());
    let mut log = Log::open(&place).unwrap();
    let report = replay(&mut log, &ReplayOptions::default(), &mut |done| match done {
        3 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    let report = report.unwrap();
    assert!(
        report.frames == 10 && report.compared == 3 && report.differences.is_empty() && !report.agrees(),
        "{report:?}"
    );
}

#[test]
fn a_planted_change_is_named() {
    let folder = folder("planted");
    let mut scene = scene(&folder);
    for (table, row, size, at, of, quantity) in [
        // Movable group 1 of frame 120: three wrenches of 48 bytes a frame; the lowest byte of the moment's y.
        ("wrenches", 120 * 3 + 1, 48, 32, "wrench on `cart/arm`", "moment"),
        ("contacts", 200, 180, 44 + 48, "contact ", "depth"),
        ("contacts", 200, 180, 40, "contact ", "sticks"),
    ] {
        let _ = std::fs::remove_dir_all(folder.join("log"));
        let place =
            scene.record(&folder, 200, &RecordOptions { overwrite: true, ..RecordOptions::default() });
        plant(&place, table, row, size, at);
        let report = exactly(&place);
        assert_eq!(report.differences.len(), 1, "{table}: {report:?}");
        let difference = &report.differences[0];
        assert!(difference.of.starts_with(of), "{difference}");
        assert_eq!(difference.quantity, quantity, "{difference}");
        assert_ne!(difference.logged, difference.replayed);
        if table == "wrenches" {
            assert_eq!((difference.frame, report.compared), (120, 121));
            // The last bit of a number is far below any tolerance.
            let loose = ReplayOptions { tolerance: Some(1e-12), ..ReplayOptions::default() };
            assert!(replayed(&place, &loose).agrees());
        }
    }
}

/// Friction has memory: a tiny change of a state changes wrenches from its frame on.
#[test]
fn a_planted_change_of_a_state_is_seen_in_what_follows_from_it() {
    let folder = folder("planted_state");
    let place = scene(&folder).record(&folder, 100, &RecordOptions::default());
    plant(&place, "states", 50 * 3, 104, 6);
    let report = exactly(&place);
    let first = report.differences.first().map(|difference| (difference.frame, difference.quantity));
    assert!(matches!(first, Some((50, "force" | "moment"))), "{report:?}");
    assert_eq!(report.differences.len(), 2, "{report:?}");
}

#[test]
fn what_the_host_did_between_frames_is_done_again() {
    let folder = folder("events");
    let mut scene = scene(&folder);
    let place = folder.join("log");
    // A history before the log, with a surface and a pair changed since the start.
    for n in 0..50 {
        scene.place(n);
        scene.world.step().unwrap();
    }
    let (model, _) = scene.world.scene().models().next().unwrap();
    let mut rubber = scene.world.surface(model, "rubber").unwrap().clone();
    rubber.stiffness = 1e4 / 3.0;
    scene.world.set_surface(model, &rubber).unwrap();
    let mut recorder =
        Recorder::start(&scene.world, &place, &scene.sources, &RecordOptions::default()).unwrap();
    let mut block = vec![0; scene.world.state_size()];
    for n in 50..300 {
        match n {
            80 => {
                scene.world.clear_contact_history(scene.cart).unwrap();
                recorder.forgot(scene.cart);
            }
            100 | 120 => {
                scene.world.set_pair_enabled(scene.pair, n == 120).unwrap();
                recorder.pair_switched(scene.pair, n == 120);
            }
            150 => {
                rubber.stiffness = 7e3;
                scene.world.set_surface(model, &rubber).unwrap();
                recorder.surface_set(model, &rubber);
            }
            170 => scene.world.save_state(&mut block).unwrap(),
            200 => {
                scene.world.restore_state(&block).unwrap();
                recorder.restored(&block);
            }
            _ => {}
        }
        scene.place(n);
        scene.world.evaluate().unwrap();
        recorder.evaluated();
        match n % 5 {
            0 => {}
            1 => {
                scene.world.commit_pairs(&[scene.pair]).unwrap();
                recorder.committed_some(&[scene.pair]);
            }
            2 => {
                scene.world.commit_pairs(&[]).unwrap();
                recorder.committed_some(&[]);
            }
            _ => {
                scene.world.commit().unwrap();
                recorder.committed();
            }
        }
        recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
    }
    recorder.finish().unwrap();
    let report = exactly(&place);
    assert!(report.agrees() && report.contacts > 200, "{report:?}");

    // Each event matters: without it the replay differs.
    let events = std::fs::read_to_string(place.join("events.jsonl")).unwrap();
    let kinds = ["\"surface\"", "\"pair\"", "\"clear_contact_history\"", "\"restore\"", "\"commit\""];
    for kind in kinds {
        let left: Vec<&str> = events.lines().filter(|line| !line.contains(kind)).collect();
        assert!(left.len() < events.lines().count(), "no event {kind}");
        std::fs::write(place.join("events.jsonl"), left.join("\n") + "\n").unwrap();
        assert!(!exactly(&place).agrees(), "the replay does not need {kind}");
    }
    std::fs::write(place.join("events.jsonl"), &events).unwrap();
    assert!(exactly(&place).agrees());
}

/// Stages are evaluated and discarded, the step is committed: as a Runge-Kutta host does.
#[test]
fn stages_that_are_not_committed_need_not_be_in_the_log() {
    let folder = folder("stages");
    let mut scene = scene(&folder);
    let place = folder.join("log");
    let mut recorder =
        Recorder::start(&scene.world, &place, &scene.sources, &RecordOptions::default()).unwrap();
    for n in 0..100 {
        for stage in 0..3 {
            scene.place(5 * n + stage);
            scene.world.evaluate().unwrap();
            recorder.evaluated();
        }
        scene.step(&mut recorder, 5 * n);
        recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
    }
    recorder.finish().unwrap();
    assert!(exactly(&place).agrees());
}

#[test]
fn commits_that_are_in_no_frame_are_told() {
    let folder = folder("every_tenth");
    let mut scene = scene(&folder);
    let place = folder.join("log");
    let mut recorder =
        Recorder::start(&scene.world, &place, &scene.sources, &RecordOptions::default()).unwrap();
    for n in 0..100 {
        scene.step(&mut recorder, n);
        if n % 10 == 0 {
            recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
        }
    }
    recorder.finish().unwrap();
    let report = exactly(&place);
    assert_eq!(report.obstacle, Some(Obstacle::CommitsMissed { frame: 1, count: 9 }));
    assert!(!report.agrees() && report.compared == 1 && report.differences.is_empty());
    let loose = ReplayOptions { tolerance: Some(1e-12), ..ReplayOptions::default() };
    assert!(!replayed(&place, &loose).differences.is_empty(), "friction forgets between frames");
}

#[test]
fn frames_that_were_lost_are_told() {
    let folder = folder("replay_lost");
    let mut scene = scene(&folder);
    let disk = HeldDisk::hold();
    let options = RecordOptions { when_full: WhenFull::Lose, ..disk.options() };
    let place = folder.join("log");
    let mut recorder = Recorder::start(&scene.world, &place, &scene.sources, &options).unwrap();
    for n in 0..200 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
    }
    disk.release(&recorder);
    scene.step(&mut recorder, 200);
    recorder.record(&scene.world, 200.0, 0, None).unwrap();
    let lost = recorder.finish().unwrap().lost;
    let report = exactly(&place);
    assert_eq!(report.obstacle, Some(Obstacle::FramesLost { frame: 200, count: lost }));
    assert_eq!(report.compared, 200 - lost);
}

#[test]
fn a_law_of_the_hosts_is_asked_for_by_name() {
    let folder = folder("law");
    let text = r#"(format: "pong-model", version: 1, name: "pad", surfaces: {"s": (stiffness: 1e4,
        normal: Custom(name: "foam", parameters: [2.0]))},
        root: (name: "pad", surface: "s", primitives: [Sphere(name: "b", center: (0, 0, 0), radius: 0.1)]))"#;
    #[derive(Debug)]
    struct Foam;
    impl pong_engine::NormalForce for Foam {
        fn force(&self, input: &pong_engine::NormalInput<'_>) -> f64 {
            input.stiffness * input.depth * input.depth
        }

        fn stored(&self, input: &pong_engine::NormalInput<'_>) -> f64 {
            input.stiffness * input.depth.powi(3) / 3.0
        }
    }
    let laws = || {
        let mut laws = Laws::default();
        laws.add_normal("foam", std::sync::Arc::new(Foam));
        laws
    };
    let mut builder =
        pong_engine::WorldBuilder::with_extensions(Default::default(), Default::default(), laws());
    let model = pong_model::parse(text, "pad", None, &Default::default()).unwrap();
    let model = builder.add_model(std::sync::Arc::new(model));
    let a = builder.create_object(model, "a").unwrap();
    let b = builder.create_object(model, "b").unwrap();
    builder.pair(a, b).unwrap();
    let (mut world, _) = builder.seal().unwrap();
    let source = pong_record::ModelSource::Text { text: text.to_owned(), mesh_dir: None };
    let place = folder.join("log");
    let mut recorder = Recorder::start(&world, &place, &[source], &RecordOptions::default()).unwrap();
    for n in 0..20 {
        let mut state = pong_engine::State::identity();
        world.set_state(world.scene().interface(a, "").unwrap(), &state).unwrap();
        state.position[2] = 0.21 - 0.001 * f64::from(n);
        world.set_state(world.scene().interface(b, "").unwrap(), &state).unwrap();
        world.step().unwrap();
        recorder.evaluated();
        recorder.committed();
        recorder.record(&world, f64::from(n), 0, None).unwrap();
    }
    recorder.finish().unwrap();
    let refused =
        replay(
            &mut Log::open(&place).unwrap(),
            &ReplayOptions::default(),
            &mut |_| ControlFlow::Continue(()),
        );
    let Err(LogError::Refused { cause, .. }) = refused else { panic!("{refused:?}") };
    assert!(cause.contains("`foam`"), "{cause}");
    let report = replayed(&place, &ReplayOptions { laws: laws(), ..ReplayOptions::default() });
    assert!(report.agrees() && report.contacts > 5, "{report:?}");
}
