//! Values read from a log are, bit for bit, those of the world.

use crate::support::{HeldDisk, folder, scene};
use pong_engine::{Contact, EngineError};
use pong_record::{ContactRow, FrameRow, Log, LogError, RecordOptions, Recorder, WhenFull};
use std::path::Path;
use std::time::{Duration, Instant};

fn bits<const N: usize>(row: [f64; N]) -> [u64; N] {
    row.map(f64::to_bits)
}

fn same_contact(row: &ContactRow, contact: &Contact) -> bool {
    bits(row.point) == bits(contact.point.into())
        && bits(row.normal) == bits(contact.normal.into())
        && bits(row.friction_force) == bits(contact.friction_force.into())
        && bits(row.slip_velocity) == bits(contact.slip_velocity.into())
        && bits([row.depth, row.depth_rate, row.weight, row.normal_force, row.stored])
            == bits([contact.depth, contact.depth_rate, contact.weight, contact.normal_force, contact.stored])
        && (row.element_a, row.element_b, row.end) == (contact.a.element, contact.b.element, contact.end)
        && row.feature_kind << 30 | row.feature_index == contact.feature.0
        && (row.sticks == 1) == contact.sticks
        && row.pair as usize == contact.pair.index()
}

#[test]
fn states_wrenches_and_contacts_come_back_with_the_same_bits() {
    let folder = folder("round_trip");
    let mut scene = scene(&folder);
    let place = folder.join("log");
    let options = RecordOptions { name: "carts".to_owned(), step: Some(0.01), ..RecordOptions::default() };
    let mut recorder = Recorder::start(&scene.world, &place, &scene.sources, &options).unwrap();
    let mut seen = Vec::new();
    for n in 0..400 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n) * 0.01, u64::from(n) + 7, None).unwrap();
        let states: Vec<_> =
            scene.bodies.iter().map(|id| *scene.world.state_as_set(*id).unwrap().unwrap()).collect();
        let wrenches: Vec<_> =
            scene.bodies.iter().map(|id| scene.world.wrench_common(*id).unwrap()).collect();
        seen.push((states, wrenches, scene.world.contacts()));
    }
    let status = recorder.finish().unwrap();
    assert_eq!((status.frames, status.flushed, status.lost, status.error), (400, 400, 0, None));

    let mut log = Log::open(&place).unwrap();
    assert!(log.is_whole() && log.frame_count() == 400);
    let mut contacts = 0;
    for (index, (states, wrenches, listed)) in seen.iter().enumerate() {
        let frame = log.frame(index as u64).unwrap();
        let FrameRow { frame: number, time, first_contact, evaluate_ns, committed, commits_missed, .. } =
            frame.row;
        assert_eq!((number, evaluate_ns, first_contact), (index as u64, index as u64 + 7, contacts));
        assert_eq!((time.to_bits(), committed, commits_missed), ((index as f64 * 0.01).to_bits(), 1, 0));
        for (row, state) in frame.states.iter().zip(states) {
            assert_eq!(bits(row.position), bits(state.position));
            assert_eq!(bits(row.orientation), bits(state.orientation));
            assert_eq!(bits(row.linear_velocity), bits(state.linear_velocity));
            assert_eq!(bits(row.angular_velocity), bits(state.angular_velocity));
        }
        for (row, wrench) in frame.wrenches.iter().zip(wrenches) {
            assert_eq!(bits(row.force), bits(wrench.force.into()));
            assert_eq!(bits(row.moment), bits(wrench.moment.into()));
        }
        assert_eq!((frame.states.len(), frame.wrenches.len(), frame.contacts.len()), (3, 3, listed.len()));
        assert!(frame.contacts.iter().zip(listed).all(|(row, contact)| same_contact(row, contact)));
        for (row, contact) in frame.contacts.iter().zip(listed) {
            for (primitive, side) in [(row.primitive_a, &contact.a), (row.primitive_b, &contact.b)] {
                let object = scene.world.scene().object_name(side.object).unwrap();
                let path = scene.world.scene().primitive_path(side.interface, side.primitive).unwrap();
                assert_eq!(log.run().primitive_name(primitive as usize).unwrap(), format!("{object}/{path}"));
            }
        }
        contacts += listed.len() as u64;
    }
    assert!(contacts > 400, "only {contacts} contacts: the scene shows nothing");
}

#[test]
fn run_json_names_bodies_pairs_and_primitives() {
    let folder = folder("names");
    let place = scene(&folder).record(&folder, 3, &RecordOptions::default());
    let log = Log::open(&place).unwrap();
    let run = log.run();
    let bodies: Vec<_> = run.bodies.iter().map(|b| (b.name.as_str(), b.object, b.parent)).collect();
    assert_eq!(bodies, [("cart", 0, None), ("cart/arm", 0, Some(0)), ("ground", 1, None)]);
    assert_eq!(run.pair_names(0), Some(["cart", "ground"]));
    let kinds: Vec<_> =
        run.primitives.iter().map(|p| (p.path.as_str(), p.kind.as_str(), p.surface.as_str())).collect();
    assert_eq!(kinds[2], ("cart/arm/tip", "Sphere", "rubber"));
    assert_eq!(kinds[3], ("ground/floor", "Triangle", "stone"));
    // The model and its mesh can be loaded from the log alone.
    std::fs::remove_dir_all(folder.join("given")).unwrap();
    let model = pong_model::load(&log.model_path(1).unwrap(), &Default::default()).unwrap();
    assert_eq!(model.hash, run.models[1].hash);
}

#[test]
fn a_folder_with_a_log_is_left_alone_unless_it_may_be_overwritten() {
    let folder = folder("occupied");
    let mut scene = scene(&folder);
    let place = scene.record(&folder, 5, &RecordOptions::default());
    let before = std::fs::read(place.join("states.npy")).unwrap();
    let refused = Recorder::start(&scene.world, &place, &scene.sources, &RecordOptions::default());
    assert!(matches!(refused, Err(LogError::Occupied { .. })), "{refused:?}");
    assert_eq!(std::fs::read(place.join("states.npy")).unwrap(), before);
    std::fs::write(place.join("notes.txt"), "mine").unwrap();
    scene.record(&folder, 2, &RecordOptions { overwrite: true, ..RecordOptions::default() });
    assert_eq!(Log::open(&place).unwrap().frame_count(), 2);
    assert!(place.join("notes.txt").exists());
}

#[test]
fn a_model_that_was_changed_since_it_was_loaded_is_refused() {
    let folder = folder("changed_model");
    let scene = scene(&folder);
    std::fs::write(folder.join("given/floor.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let refused =
        Recorder::start(&scene.world, &folder.join("log"), &scene.sources, &RecordOptions::default());
    assert!(matches!(&refused, Err(LogError::Model { name, .. }) if name == "ground"), "{refused:?}");
}

#[test]
fn a_frame_that_does_not_belong_to_the_states_is_refused() {
    let folder = folder("stale");
    let mut scene = scene(&folder);
    let options = RecordOptions::default();
    let mut recorder = Recorder::start(&scene.world, &folder.join("log"), &scene.sources, &options).unwrap();
    let early = recorder.record(&scene.world, 0.0, 0, None);
    assert!(early.is_err());
    scene.step(&mut recorder, 0);
    recorder.record(&scene.world, 0.0, 0, None).unwrap();
    assert!(recorder.record(&scene.world, f64::NAN, 0, None).is_err());
    scene.place(1);
    let stale = recorder.record(&scene.world, 0.1, 0, None).unwrap_err().to_string();
    assert!(stale.contains("before states, pairs or surfaces change"), "{stale}");
    assert_eq!(recorder.finish().unwrap().frames, 1);
}

#[test]
fn frames_for_which_there_is_no_room_are_lost_whole_and_counted() {
    let folder = folder("lost");
    let mut scene = scene(&folder);
    let disk = HeldDisk::hold();
    let options = RecordOptions { when_full: WhenFull::Lose, ..disk.options() };
    let mut recorder = Recorder::start(&scene.world, &folder.join("log"), &scene.sources, &options).unwrap();
    let size = recorder.status().buffer_size;
    for n in 0..200 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
    }
    disk.release(&recorder);
    for n in 200..210 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
    }
    let status = recorder.finish().unwrap();
    assert!(status.lost > 0 && status.lost < 200, "{status:?}");
    let mut log = Log::open(&folder.join("log")).unwrap();
    assert_eq!((log.run().lost, log.frame_count()), (status.lost, 210 - status.lost));
    assert!(log.is_whole() && status.buffer_peak <= size);
    let rows = log.frame_rows(0, u64::MAX).unwrap();
    let gap = rows.iter().position(|row| row.commits_missed > 0).unwrap();
    // The frame after the gap counts every commit of the lost frames.
    assert_eq!(rows[gap].frame, gap as u64 + status.lost);
    assert_eq!(u64::from(rows[gap].commits_missed), status.lost);
    assert!(rows.iter().all(|row| row.time == row.frame as f64));
    let last = log.frame(log.frame_count() - 1).unwrap();
    assert_eq!(last.contacts.len(), scene.world.contact_count());
}

#[test]
fn a_host_that_waits_loses_nothing() {
    let folder = folder("waits");
    let mut scene = scene(&folder);
    let options = RecordOptions {
        buffer_bytes: Some(0),
        on_thread_start: Some(|| std::thread::sleep(Duration::from_millis(100))),
        ..RecordOptions::default()
    };
    let place = scene.record(&folder, 3000, &options);
    let log = Log::open(&place).unwrap();
    assert_eq!((log.run().lost, log.frame_count()), (0, 3000));
}

#[test]
fn files_that_take_nothing_are_given_up() {
    let folder = folder("stalled");
    let mut scene = scene(&folder);
    let disk = HeldDisk::hold();
    let options = RecordOptions { longest_wait: Duration::from_millis(20), ..disk.options() };
    let started = Instant::now();
    for frames in [3000, 1] {
        let place = folder.join(format!("log_{frames}"));
        let mut recorder = Recorder::start(&scene.world, &place, &scene.sources, &options).unwrap();
        for n in 0..frames {
            scene.step(&mut recorder, n);
            recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
        }
        let lost = recorder.status().lost;
        assert_eq!(lost > 0, frames > 1, "{lost} of {frames} frames lost while the host waited");
        let error = recorder.finish().unwrap_err().to_string();
        assert!(error.contains("took nothing for 0.02 s; the log ends after 0 frames"), "{error}");
    }
    // Generous limit, for slow machines.
    assert!(started.elapsed() < Duration::from_secs(15), "{:?}", started.elapsed());
}

/// An empty name, as from an undefined shell variable.
#[test]
fn a_folder_without_a_name_is_refused_as_that() {
    let scene = scene(&folder("unnamed"));
    let refused = Recorder::start(&scene.world, Path::new(""), &scene.sources, &RecordOptions::default());
    let told = refused.unwrap_err().to_string();
    assert_eq!(told, "log: the name of its folder is empty; name the folder that is to hold it");
}

/// Files that were given up while a frame waited are not waited for again.
#[test]
fn a_log_that_was_given_up_closes_at_once() {
    let folder = folder("given_up");
    let mut scene = scene(&folder);
    let disk = HeldDisk::hold();
    let options = RecordOptions { longest_wait: Duration::from_secs(2), ..disk.options() };
    let mut recorder = Recorder::start(&scene.world, &folder.join("log"), &scene.sources, &options).unwrap();
    for n in 0..3000 {
        scene.step(&mut recorder, n);
        recorder.record(&scene.world, f64::from(n), 0, None).unwrap();
    }
    assert!(recorder.status().error.is_some(), "nothing was given up");
    let begun = Instant::now();
    assert!(recorder.finish().is_err());
    assert!(begun.elapsed() < options.longest_wait, "{:?}", begun.elapsed());
}

#[test]
fn a_buffer_that_no_machine_has_is_refused_with_its_size() {
    let folder = folder("no_memory");
    let scene = scene(&folder);
    let options = RecordOptions { buffer_bytes: Some(1 << 60), ..RecordOptions::default() };
    let refused = Recorder::start(&scene.world, &folder.join("log"), &scene.sources, &options);
    let Err(LogError::Engine(EngineError::OutOfMemory { bytes, .. })) = refused else {
        panic!("{refused:?}")
    };
    assert!(bytes > 1 << 60);
    assert!(!folder.join("log").join("run.json").exists(), "nothing was begun");
}
