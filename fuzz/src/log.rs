//! The log reader, on a folder with files altered by the bytes.

use crate::input::Input;
use crate::{count, files};
use pong_engine::{Config, State, WorldBuilder};
use pong_model::Extensions;
use pong_record::{Log, ModelSource, RecordOptions, Recorder, ReplayOptions};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

const MODEL: &str = include_str!("../seeds/c_models/ball.ron");
/// Number of frames that are read.
const LOOK_AT: u64 = 8;

/// Names and contents of the files of a valid log.
static GOOD: OnceLock<Vec<(PathBuf, Vec<u8>)>> = OnceLock::new();

/// The first byte selects the altered file, and whether all of it or some bytes are replaced.
pub fn run(data: &[u8]) {
    count::input();
    let good = GOOD.get_or_init(good_log);
    let mut input = Input::new(data);
    let (name, contents) = &good[input.below(good.len())];
    let changed = if input.chance(128) { input.rest().to_vec() } else { patched(contents, &mut input) };
    let folder = files::folder().join("log");
    std::fs::write(folder.join(name), changed).expect("a file of the log");
    read(&folder);
    std::fs::write(folder.join(name), contents).expect("a file of the log");
}

/// Overwrites, removes or inserts bytes.
fn patched(good: &[u8], input: &mut Input<'_>) -> Vec<u8> {
    let mut bytes = good.to_vec();
    while !input.is_empty() {
        let at = usize::from(u16::from_le_bytes(input.bytes())) % bytes.len().max(1);
        let length = input.below(16);
        let end = (at + length).min(bytes.len());
        let new = match input.below(3) {
            0 => Vec::new(),
            1 => input.slice(length).to_vec(),
            _ => input.number().to_le_bytes().to_vec(),
        };
        bytes.splice(at.min(end)..end, new);
    }
    bytes
}

fn read(folder: &Path) {
    let mut log = match Log::open(folder) {
        Ok(log) => log,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    count::accepted();
    for index in 0..log.frame_count().min(LOOK_AT) {
        match log.frame(index) {
            Ok(_) => count::frame(),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    let _ = log.frame_rows(0, LOOK_AT);
    let _ = log.frame_rows(u64::MAX, u64::MAX);
    assert!(log.frame(log.frame_count()).is_err(), "a frame beyond the last");
    if log.frame_count() <= LOOK_AT {
        let _ = pong_record::replay(&mut log, &ReplayOptions::default(), &mut |_| ControlFlow::Continue(()));
    }
}

/// A log of two colliding balls, as the recorder writes it, with every kind of event.
fn good_log() -> Vec<(PathBuf, Vec<u8>)> {
    let folder = files::folder().join("log");
    let mut builder = WorldBuilder::new(Config { contact_capacity: Some(32), ..Config::default() });
    let model = pong_model::parse(MODEL, "ball.ron", None, &Extensions::new()).expect("a good model");
    let model = builder.add_model(Arc::new(model));
    let objects = ["a", "b"].map(|name| builder.create_object(model, name).expect("set-up"));
    let pair = builder.pair(objects[0], objects[1]).expect("set-up");
    let (mut world, _) = builder.seal().expect("a good scene");
    let interfaces = objects.map(|object| world.scene().interfaces(object).expect("sealed"));
    let options = RecordOptions::default();
    let sources = [ModelSource::Text { text: MODEL.to_owned(), mesh_dir: None }];
    let mut recorder =
        Recorder::start(&world, &folder, &sources, &options).expect("a folder that can be written");
    for k in 0..4 {
        let mut state = State::identity();
        for interface in &interfaces[0] {
            world.set_state(*interface, &state).expect("a good state");
        }
        state.position = [0.9 - 0.01 * f64::from(k), 0.0, 0.0];
        state.linear_velocity = [-1.0, 0.1, 0.0];
        for interface in &interfaces[1] {
            world.set_state(*interface, &state).expect("a good state");
        }
        world.step().expect("good states");
        recorder.evaluated();
        recorder.committed();
        let _ = recorder.record(&world, 0.01 * f64::from(k), 0, None);
        if k == 1 {
            world.clear_contact_history(objects[0]).expect("an Object of this world");
            recorder.forgot(objects[0]);
            world.set_pair_enabled(pair, true).expect("a pair of this world");
            recorder.pair_switched(pair, true);
        }
    }
    recorder.finish().expect("a disk with room");
    let mut files = Vec::new();
    gather(&folder, &folder, &mut files);
    files.sort();
    files
}

/// All files of a folder and its subfolders, with their paths relative to `top`.
fn gather(top: &Path, folder: &Path, files: &mut Vec<(PathBuf, Vec<u8>)>) {
    for entry in std::fs::read_dir(folder).expect("the folder of the log") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => gather(top, &path, files),
            false => {
                let name = path.strip_prefix(top).expect("below the top").to_owned();
                files.push((name, std::fs::read(&path).expect("a file of the log")));
            }
        }
    }
}
