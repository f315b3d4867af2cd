//! `pong trade` on the command line.

use crate::common;
use crate::common::pong;
use std::path::PathBuf;

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball", surfaces: { "soft": (stiffness: 1e5) },
    root: (name: "ball", surface: "soft", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]))"#;

fn folder(test: &str) -> PathBuf {
    common::resting_ball(&format!("trade/{test}"), BALL, 0.064)
}

/// The report and the files, for a scene and for its log; a stop in between has no effect on errors.csv.
#[test]
fn a_scene_and_its_log_are_studied() {
    let folder = folder("studied");
    let study = ["trade", "rest.ron", "--rounds", "1", "--within", "5%"];
    let (code, page, err) = pong(&folder, &study);
    assert_eq!(code, 0, "{page}{err}");
    assert!(page.contains("cheapest level within 5 %"), "{page}");
    let read = |name: &str| std::fs::read_to_string(folder.join("rest_trade").join(name)).unwrap();
    assert!(page.starts_with(&read("trade.md")));
    assert!(read("trade.svg").starts_with("<svg") && read("trade.csv").lines().count() > 20);
    let errors = read("errors.csv");
    let again = pong(&folder, &[&study[..], &["--fresh", "-q"]].concat());
    assert_eq!(again, (0, String::new(), String::new()));
    assert_eq!(read("errors.csv"), errors);

    assert_eq!(pong(&folder, &["run", "rest.ron", "--log", "log", "--every-step", "-q"]).0, 0);
    let (code, page, err) =
        pong(&folder, &["trade", "log", "--rounds", "1", "--alternative", "same:ball=ball.ron"]);
    assert_eq!(code, 0, "{page}{err}");
    assert!(page.contains("the log's own wrenches bit for bit"), "{page}");
    assert!(page.contains("every frame, `same`"), "{page}");
    let (code, _, err) = pong(&folder, &["trade", "log", "--of", "pose"]);
    assert!(code != 0 && err.contains("any of wrench, impulse, peak"), "{err}");
}

#[test]
fn what_cannot_be_studied_is_told() {
    let folder = folder("refused");
    let cases = [
        (&["trade", "rest.ron", "--within", "2"][..], 2, "above 0 and below 100 %"),
        (&["trade", "rest.ron", "--of", "weight"], 2, "give any of wrench, impulse"),
        (&["trade", "rest.ron", "--frame", "-1"], 2, "unexpected argument"),
        (&["trade", "rest.ron", "--frame=-1"], 1, "--frame: it is -1 s"),
        (&["trade", "rest.ron", "--frame", "1"], 1, "hold no frame of 1 s; give a shorter --frame"),
        (&["trade", "rest.ron", "--alternative", "a:b=c"], 1, "write `alternatives` into it"),
        (&["trade", "none.ron"], 1, "name a scene file that can be read"),
    ];
    for (arguments, code, cause) in cases {
        let (ended, _, err) = pong(&folder, arguments);
        assert_eq!(ended, code, "{arguments:?}: {err}");
        assert!(err.contains(cause), "{arguments:?}: {err}");
    }
}
