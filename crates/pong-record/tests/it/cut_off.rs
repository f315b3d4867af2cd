//! Truncated or damaged logs: read up to the damage, or refused with the file's name.

use crate::support::{folder, scene};
use pong_record::{Event, Log, LogError, RecordOptions, ReplayOptions};
use std::ops::ControlFlow;
use std::path::Path;

const SIZES: [(&str, usize); 4] =
    [("frames", 48), ("states", 3 * 104), ("wrenches", 3 * 48), ("contacts", 180)];

#[test]
fn a_table_cut_at_any_byte_of_its_last_row_is_read_up_to_the_row_before() {
    let folder = folder("cut");
    let place = scene(&folder).record(&folder, 20, &RecordOptions::default());
    for (table, size) in SIZES {
        let path = place.join(format!("{table}.npy"));
        let whole = std::fs::read(&path).unwrap();
        for cut in 0..=size {
            std::fs::write(&path, &whole[..whole.len() - cut]).unwrap();
            let mut log = Log::open(&place).unwrap();
            let expected = if cut == 0 { 20 } else { 19 };
            assert_eq!((log.frame_count(), log.is_whole()), (expected, cut == 0), "{table} less {cut} bytes");
            log.frame(expected - 1).unwrap();
            assert!(log.frame(expected).is_err());
        }
        std::fs::write(&path, whole).unwrap();
    }
}

fn damage(place: &Path, file: &str, change: impl Fn(Vec<u8>) -> Vec<u8>) -> String {
    let path = place.join(file);
    let whole = std::fs::read(&path).unwrap();
    std::fs::write(&path, change(whole.clone())).unwrap();
    let told = match Log::open(place) {
        Err(error) => error.to_string(),
        Ok(mut log) => (0..log.frame_count())
            .find_map(|frame| log.frame(frame).err())
            .map_or("nothing was found".to_owned(), |error| error.to_string()),
    };
    std::fs::write(&path, whole).unwrap();
    assert!(told.contains(file), "{told}");
    told
}

#[test]
fn damage_is_told_with_file_and_cause() {
    let folder = folder("damaged");
    let place = scene(&folder).record(&folder, 5, &RecordOptions::default());
    let replace = |from: &'static str, to: &'static str| {
        move |bytes: Vec<u8>| {
            // One character for each byte, because tables are not text.
            let text: String = bytes.iter().map(|byte| char::from(*byte)).collect();
            assert!(text.contains(from), "no {from} to replace");
            text.replace(from, to).chars().map(|c| c as u8).collect()
        }
    };
    let cases = [
        ("states.npy", damage(&place, "states.npy", |_| b"no table".to_vec()), "header cannot be read"),
        ("depth", damage(&place, "contacts.npy", replace("'depth'", "'dopth'")), "field `depth` is missing"),
        ("force", damage(&place, "wrenches.npy", replace("<f8", "<f4")), "field `force` is"),
        ("axes", damage(&place, "wrenches.npy", replace(", 3), }", ", 2), }")), "its axes are"),
        ("json", damage(&place, "run.json", |bytes| bytes[..bytes.len() / 2].to_vec()), "line "),
        ("format", damage(&place, "run.json", replace("pong-log", "ping-log")), "its format is"),
        ("version", damage(&place, "run.json", replace("\"version\": 2", "\"version\": 3")), "version 3"),
        (
            "model",
            damage(&place, "run.json", replace("\"model\": 1", "\"model\": 7")),
            "number 7 of the models",
        ),
        ("way out", damage(&place, "run.json", replace("frames.npy", "../frames.npy")), "leads out"),
        ("body", damage(&place, "run.json", replace("\"body\": 2", "\"body\": 3")), "number 3 of the bodies"),
        ("event", damage(&place, "events.jsonl", |_| b"{\"frame\": 1}\n".to_vec()), "line 1"),
        ("contact", damage(&place, "contacts.npy", last_pair_is_99), "pair 99"),
    ];
    for (what, told, expected) in cases {
        assert!(told.contains(expected), "{what}: {told}");
    }
    assert!(Log::open(&place).unwrap().is_whole());
    let nothing = Log::open(&folder.join("nothing"));
    assert!(matches!(nothing, Err(LogError::Unreadable { .. })), "{nothing:?}");
}

fn last_pair_is_99(mut bytes: Vec<u8>) -> Vec<u8> {
    let at = bytes.len() - 180 + 8;
    bytes[at] = 99;
    bytes
}

/// Pipes and devices in place of files are refused at once, because they would block or never end.
#[test]
#[cfg(unix)]
fn only_regular_files_are_read() {
    let folder = folder("regular");
    let place = scene(&folder).record(&folder, 5, &RecordOptions::default());
    let block = place.join("contact_state_0.bin");
    std::fs::write(
        place.join("events.jsonl"),
        "{\"frame\":1,\"event\":\"restore\",\"file\":\"contact_state_0.bin\"}\n",
    )
    .unwrap();
    let put_pipe = |path: &Path| {
        assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
    };
    let put_zeros = |path: &Path| std::os::unix::fs::symlink("/dev/zero", path).unwrap();
    let files = ["run.json", "events.jsonl", "frames.npy", "states.npy", "wrenches.npy", "contacts.npy"];
    for put in [&put_pipe as &dyn Fn(&Path), &put_zeros] {
        for file in files.map(|file| place.join(file)) {
            let whole = std::fs::read(&file).unwrap();
            std::fs::remove_file(&file).unwrap();
            put(&file);
            let told = Log::open(&place).unwrap_err().to_string();
            assert!(told.contains(file.to_str().unwrap()) && told.contains("not a regular file"), "{told}");
            std::fs::remove_file(&file).unwrap();
            std::fs::write(&file, whole).unwrap();
        }
        put(&block);
        let mut log = Log::open(&place).unwrap();
        let told =
            pong_record::replay(&mut log, &ReplayOptions::default(), &mut |_| ControlFlow::Continue(()));
        let told = told.unwrap_err().to_string();
        assert!(told.contains("contact_state_0.bin") && told.contains("not a regular file"), "{told}");
        std::fs::remove_file(&block).unwrap();
    }
}

/// Version 1 had other names for some fields and events; the numbers are the same.
#[test]
fn a_log_of_version_1_reads_as_it_is() {
    let folder = folder("version_1");
    let place = scene(&folder).record(&folder, 5, &RecordOptions::default());
    let contacts = |place: &Path| Log::open(place).unwrap().frame(4).unwrap().contacts;
    let written = contacts(&place);
    let change = |file: &str, from: &[u8], to: &[u8]| {
        let path = place.join(file);
        let mut bytes = std::fs::read(&path).unwrap();
        let at = bytes.windows(from.len()).position(|window| window == from).expect("what is replaced");
        bytes.splice(at..at + from.len(), to.iter().copied());
        if file.ends_with(".npy") {
            // The header keeps its length: NumPy pads it with blanks before the line end.
            let end = bytes.iter().position(|byte| *byte == b'\n').expect("the end of the header");
            bytes.splice(end..end, std::iter::repeat_n(b' ', from.len() - to.len()));
        }
        std::fs::write(&path, bytes).unwrap();
    };
    change("run.json", b"\"version\": 2", b"\"version\": 1");
    change("contacts.npy", b"'depth_rate'", b"'rate'");
    std::fs::write(place.join("events.jsonl"), "{\"frame\":1,\"event\":\"forget\",\"object\":0}\n").unwrap();
    assert!(!written.is_empty());
    assert_eq!(contacts(&place), written);
    let cleared = Event::ClearContactHistory { object: 0 };
    assert_eq!(Log::open(&place).unwrap().events()[0].event, cleared);
}

/// A line that was being written when the run was cut off is skipped.
#[test]
fn half_a_line_of_events_is_passed_over() {
    let folder = folder("half_event");
    let place = scene(&folder).record(&folder, 5, &RecordOptions::default());
    let text = "{\"frame\":1,\"event\":\"clear_contact_history\",\"object\":0}\n{\"frame\":2,\"ev";
    std::fs::write(place.join("events.jsonl"), text).unwrap();
    assert_eq!(Log::open(&place).unwrap().events().len(), 1);
}
