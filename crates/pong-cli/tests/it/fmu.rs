//! `pong fmu`: the file, the output, and the refusals. The behaviour of FMUs is tested in their own crate and
//! by ci/fmu.

use crate::common::{folder, pong};
use std::path::Path;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/tripod/scene_drop.ron");

#[test]
fn a_scene_becomes_an_fmu() {
    let folder = folder("fmu_made", &[]);
    let (code, out, err) = pong(&folder, &["fmu", SCENE, "-o", "tripod.fmu", "--fmi", "2"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.starts_with("tripod.fmu: `tripod`, FMI 2.0, Model Exchange and Co-Simulation, "), "{out}");
    assert!(out.contains("6 inputs, 44 outputs, 16 parameters, 13 continuous states"), "{out}");
    assert!(std::fs::read(folder.join("tripod.fmu")).unwrap().starts_with(b"PK\x03\x04"));
    let (code, out, _) = pong(&folder, &["fmu", SCENE, "-o", "tripod.fmu", "--contact-only"]);
    assert_eq!(code, 0);
    assert!(out.contains("Moved by the importer: tripod"), "{out}");
}

#[test]
fn what_is_refused_leaves_the_file_that_was_there() {
    let folder = folder("fmu_refused", &[("old.fmu", "old"), ("other.so", "no library")]);
    let absent: &Path = &folder.join("none.so");
    for (arguments, told) in [
        (
            ["--library", "other.so"],
            "other.so: it is no shared library for Linux or macOS on x86-64 or AArch64",
        ),
        (["--library", absent.to_str().unwrap()], "none.so: cannot be read"),
        (["--input", "tripot"], "input `tripot`: the scene has no such body; name one of: ground, tripod"),
        (["--input", "ground/leg"], "input `ground/leg`"),
    ] {
        let [option, value] = arguments;
        let (code, out, err) = pong(&folder, &["fmu", SCENE, "-o", "old.fmu", option, value]);
        assert_eq!((code, out.as_str()), (1, ""));
        assert!(err.contains(told), "{err}");
        assert_eq!(std::fs::read(folder.join("old.fmu")).unwrap(), b"old");
    }
    let (code, _, err) = pong(&folder, &["fmu", SCENE, "-o", "nowhere/new.fmu"]);
    assert!(code == 1 && err.contains("nowhere/new.fmu: cannot be written"), "{err}");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 2, "nothing half written is left");
}
