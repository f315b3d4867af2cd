//! `pong view`: pages of real runs. Their display in a browser is checked by ci/view.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn pong(folder: &Path, command: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pong")).args(command).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder with the log `run` of the sampler, which holds primitives of all kinds but custom ones.
fn run(name: &str) -> PathBuf {
    let folder = pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), &format!("view/{name}"));
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("../pong-view/tests/browser/scene.ron");
    let output = pong(&folder, &["run", "-q", from.to_str().unwrap(), "--log", "run"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    folder
}

/// The description of the run in the page.
fn description(page: &str) -> &str {
    let begin = r#"<script type="application/json" id="run">"#;
    page.split_once(begin).unwrap().1.split_once("</script>").unwrap().0
}

#[test]
fn a_page_needs_nothing_else() {
    let folder = run("whole");
    let output = pong(&folder, &["view", "run"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(text(&output.stderr), "");
    assert!(text(&output.stdout).starts_with("run.html: 101 frames, "), "{}", text(&output.stdout));
    let page = std::fs::read_to_string(folder.join("run.html")).unwrap();
    for loads in ["src=\"", "href=\"http", "url(http", "@import", "fetch("] {
        let own = page.split("<script type=\"importmap\">").next().unwrap();
        assert!(!own.contains(loads), "{loads}");
    }
    for kind in ["Point", "LineSegment", "Ray", "Sphere", "Ellipsoid", "Triangle", "Polyhedron", "Plane"] {
        assert!(description(&page).contains(&format!(r#""kind":"{kind}""#)), "{kind}");
    }
    assert!(page.contains("Permission is hereby granted"), "the licence of three.js travels with it");
}

#[test]
fn the_same_log_gives_the_same_page() {
    let folder = run("twice");
    for name in ["a.html", "b.html"] {
        assert!(pong(&folder, &["view", "run", "-o", name, "--quiet"]).status.success());
    }
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    assert!(read("a.html") == read("b.html"));
}

#[test]
fn what_is_left_out_is_said() {
    let folder = run("thin");
    let output = pong(&folder, &["view", "run", "-o", "thin.html", "--every", "30"]);
    // 0, 30, 60, 90 and the last.
    let note = "Thinned: every 30th frame is shown, 5 of 101";
    assert!(text(&output.stderr).contains(note), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("5 of 101 frames (every 30)"), "{}", text(&output.stdout));
    let page = std::fs::read_to_string(folder.join("thin.html")).unwrap();
    assert!(description(&page).contains(note));
    assert!(description(&page).contains(r#""peaks""#));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = run("refused");
    let refused = |arguments: &[&str], words: &[&str]| {
        let output = pong(&folder, arguments);
        assert_eq!(output.status.code(), Some(1));
        for word in words {
            assert!(text(&output.stderr).contains(word), "{word}: {}", text(&output.stderr));
        }
    };
    refused(&["view", "nowhere"], &["nowhere", "cannot be read"]);
    refused(&["view", "run", "-o", "no/such/folder.html"], &["folder.html", "cannot be written"]);
    assert_eq!(pong(&folder, &["view", "run", "--every", "0"]).status.code(), Some(2));
    let files = walk(folder.join("run/models"));
    let model = files.iter().find(|path| path.ends_with("sampler.ron")).unwrap();
    let changed = std::fs::read_to_string(model).unwrap().replace("plunger", "rod");
    std::fs::write(model, changed).unwrap();
    refused(&["view", "run"], &["sampler.ron", "feet/plunger", "changed after the run"]);
    assert!(!folder.join("run.html").exists());
}

#[test]
fn a_model_that_was_changed_is_told() {
    let folder = run("changed");
    let files = walk(folder.join("run/models"));
    let model = files.iter().find(|path| path.ends_with("sampler.ron")).unwrap();
    let changed = std::fs::read_to_string(model).unwrap().replace("radius: 0.08", "radius: 0.09");
    std::fs::write(model, changed).unwrap();
    let output = pong(&folder, &["view", "run"]);
    assert!(output.status.success());
    assert!(
        text(&output.stderr).contains("model sampler is not the one of the run"),
        "{}",
        text(&output.stderr)
    );
}

fn walk(path: PathBuf) -> Vec<PathBuf> {
    if !path.is_dir() {
        return vec![path];
    }
    std::fs::read_dir(path).unwrap().flat_map(|entry| walk(entry.unwrap().path())).collect()
}

/// A full disk leaves the existing files; simulated by a limit on the length of files.
#[test]
#[cfg(unix)]
fn a_full_disk_leaves_the_files_that_were_there() {
    let folder = run("full");
    for command in [&["view", "run", "-o", "page.html", "-q"][..], &["log", "run", "--csv", "csv", "-q"]] {
        assert!(pong(&folder, command).status.success());
    }
    let files =
        ["page.html", "csv/states.csv", "csv/contacts.csv", "csv/wrenches.csv"].map(|file| folder.join(file));
    let good = files.clone().map(|file| std::fs::read(file).unwrap());
    for command in ["view run -o page.html", "view run -o other.html", "log run --csv csv"] {
        // Without the signal the write is refused, as on a full disk. The limit is in blocks of 512 or 1,024 bytes.
        let limited = format!("trap '' XFSZ; ulimit -f 8; exec {} {command} -q", env!("CARGO_BIN_EXE_pong"));
        let output = Command::new("sh").args(["-c", &limited]).current_dir(&folder).output().unwrap();
        assert!(!output.status.success(), "{command}");
        assert!(text(&output.stderr).contains("cannot be written"), "{command}: {}", text(&output.stderr));
        assert!(files.clone().map(|file| std::fs::read(file).unwrap()) == good, "{command}");
    }
    let left = |folder: &Path| std::fs::read_dir(folder).unwrap().count();
    assert_eq!(
        (left(&folder), left(&folder.join("csv"))),
        (3, 3 + usize::from(folder.join("csv/energies.csv").exists()))
    );
}
