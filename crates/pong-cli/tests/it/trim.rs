//! `pong trim` on the command line: its files load, and runs of them give the same bytes.

use crate::common;
use crate::common::pong;

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball", surfaces: { "soft": (stiffness: 1e5) },
    // The skin of the ball.
    root: (name: "ball", surface: "soft", groups: [
        (name: "inner", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]),
        (name: "antenna", primitives: [Point(name: "tip", position: (0, 0, 1.5))]),
    ]))"#;

#[test]
fn a_scene_and_its_log_are_trimmed() {
    let folder = common::resting_ball("trim/trimmed", BALL, 0.2);
    let (code, page, err) = pong(&folder, &["trim", "rest.ron", "--margin", "0.5", "--rounds", "1"]);
    assert_eq!(code, 0, "{page}{err}");
    assert!(page.contains("1 of 2 primitives go") && page.contains("ball/antenna/tip"), "{page}");
    assert!(page.contains("201 frames compared"), "{page}");
    assert_eq!(std::fs::read_to_string(folder.join("ball.ron")).unwrap(), BALL);
    let text = std::fs::read_to_string(folder.join("ball_trimmed.ron")).unwrap();
    assert!(text.contains("// The skin of the ball.") && text.contains("`pong trim` for `rest`"), "{text}");
    assert_eq!(pong(&folder, &["check", "ball_trimmed.ron"]).0, 0);
    let scene = std::fs::read_to_string(folder.join("rest.ron")).unwrap();
    std::fs::write(folder.join("again.ron"), scene.replace("\"ball.ron\"", "\"ball_trimmed.ron\"")).unwrap();
    for scene in ["rest.ron", "again.ron"] {
        assert_eq!(pong(&folder, &["run", scene, "-q", "-o", &format!("{scene}_out")]).0, 0);
    }
    for table in ["states.csv", "wrenches.csv"] {
        let read = |scene: &str| std::fs::read(folder.join(format!("{scene}_out")).join(table)).unwrap();
        assert_eq!(read("rest.ron"), read("again.ron"), "{table}");
    }
    assert_eq!(pong(&folder, &["run", "rest.ron", "--log", "log", "--every-step", "-q"]).0, 0);
    let (code, page, err) = pong(&folder, &["trim", "log", "--margin", "0.5", "--rounds", "1"]);
    assert!(code == 0 && page.contains("1 of 2 primitives go"), "{page}{err}");
    assert!(folder.join("log_trimmed/ball_trimmed.ron").exists());
    let (code, out, err) = pong(&folder, &["trim", "rest.ron", "--margin", "5", "-q", "-o", "all"]);
    assert!(code == 0 && out.is_empty() && !folder.join("all").exists(), "{out}{err}");
}

#[test]
fn what_is_wrong_is_told_with_a_cure() {
    let folder = common::resting_ball("trim/refused", BALL, 0.2);
    let refused = |arguments: &[&str], words: &[&str]| {
        let (code, _, err) = pong(&folder, &[&["trim"], arguments].concat());
        assert_ne!(code, 0, "{arguments:?}");
        for word in words {
            assert!(err.contains(word), "{arguments:?}: {err}");
        }
    };
    refused(&["rest.ron", "--margin=-1"], &["--margin", "give a distance of zero or more"]);
    refused(&["nowhere.ron"], &["nowhere.ron"]);
    assert_eq!(pong(&folder, &["trim", "rest.ron", "--margin", "0.5", "--rounds", "1", "-q"]).0, 0);
    refused(&["rest.ron", "--margin", "0.5"], &["ball_trimmed.ron", "--force"]);
}
