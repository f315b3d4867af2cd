//! `pong tune` on the command line. The gain in time is not tested; all statements of the report are.

use crate::common;
use crate::common::pong;
use std::path::PathBuf;

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball", surfaces: { "soft": (stiffness: 1e5) },
    // The skin of the ball.
    root: (name: "ball", surface: "soft", groups: [(name: "inner", bound: Aabb, groups: [(name: "core", bound: Obb, primitives: [
        Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)])])]))"#;

fn folder(test: &str) -> PathBuf {
    common::resting_ball(&format!("tune/{test}"), BALL, 0.2)
}

/// A scene and its log. A file is written if and only if the report says so; it loads, and runs of it give
/// the same bytes.
#[test]
fn a_scene_and_its_log_are_tuned() {
    let folder = folder("tuned");
    let (code, page, err) = pong(&folder, &["tune", "rest.ron", "--rounds", "2", "--frames", "128"]);
    assert_eq!(code, 0, "{page}{err}");
    assert!(page.contains("201 frames, every one compared") && page.contains("128 of them"), "{page}");
    let tuned = folder.join("ball_tuned.ron");
    assert_eq!(
        page.contains("less time"),
        tuned.exists() || folder.join("ground_tuned.ron").exists(),
        "{page}"
    );
    assert!(page.contains("less time") || page.contains("Nothing was written"), "{page}");
    assert_eq!(std::fs::read_to_string(folder.join("ball.ron")).unwrap(), BALL);
    if tuned.exists() {
        let text = std::fs::read_to_string(&tuned).unwrap();
        assert!(
            text.contains("// The skin of the ball.") && text.contains("`pong tune` for `rest`"),
            "{text}"
        );
        assert_eq!(pong(&folder, &["check", "ball_tuned.ron"]).0, 0);
        let scene = std::fs::read_to_string(folder.join("rest.ron"))
            .unwrap()
            .replace("\"ball.ron\"", "\"ball_tuned.ron\"");
        std::fs::write(folder.join("again.ron"), scene).unwrap();
        for scene in ["rest.ron", "again.ron"] {
            let folder_of = format!("{scene}_out");
            assert_eq!(pong(&folder, &["run", scene, "-q", "-o", &folder_of]).0, 0);
        }
        for table in ["states.csv", "wrenches.csv", "contacts.csv"] {
            let read = |scene: &str| std::fs::read(folder.join(format!("{scene}_out")).join(table)).unwrap();
            assert_eq!(read("rest.ron"), read("again.ron"), "{table}");
        }
    }
    assert_eq!(pong(&folder, &["run", "rest.ron", "--log", "log", "--every-step", "-q"]).0, 0);
    let (code, page, err) =
        pong(&folder, &["tune", "log", "--rounds", "2", "--frames", "64", "--duration", "0.1"]);
    assert!(code == 0 && page.contains("64 of them"), "{page}{err}");
    assert!(!folder.join("log/models/ball/ball_tuned.ron").exists());
    let (code, out, err) =
        pong(&folder, &["tune", "rest.ron", "--also", "log", "-q", "-o", "both", "--rounds", "2"]);
    assert!(code == 0 && out.is_empty(), "{out}{err}");
}

#[test]
fn what_is_wrong_is_told_with_a_cure() {
    let folder = folder("refused");
    let refused = |arguments: &[&str], words: &[&str]| {
        let (code, _, err) = pong(&folder, &[&["tune"], arguments].concat());
        assert_ne!(code, 0, "{arguments:?}");
        for word in words {
            assert!(err.contains(word), "{arguments:?}: {err}");
        }
    };
    refused(&["nowhere.ron"], &["nowhere.ron"]);
    refused(&["rest.ron", "--duration", "0"], &["--duration", "above zero"]);
    refused(&["rest.ron", "--rounds", "1"], &["rounds"]);
    std::fs::write(folder.join("ball_tuned.ron"), "mine").unwrap();
    refused(&["rest.ron"], &["ball_tuned.ron", "--force", "-o"]);
    assert_eq!(std::fs::read_to_string(folder.join("ball_tuned.ron")).unwrap(), "mine");
}

/// `pong check` draws the groups as in the file, whatever their bounds.
#[test]
fn groups_without_volumes_and_cut_leaves_are_drawn() {
    let folder = folder("drawn");
    let balls = |name: &str| {
        let ball = |k: i32| format!("Sphere(name: \"{name}_{k}\", center: ({k}, 0, 0), radius: 0.1)");
        (0..4).map(ball).collect::<Vec<_>>().join(", ")
    };
    let text = format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e5) }}, root: (name: \"m\", surface: \"s\", \
         groups: [(name: \"a\", bound: Above, groups: [(name: \"b\", bound: Above, primitives: [{}]), \
         (name: \"c\", bound: Obb, leaf_size: 2, primitives: [{}])]), (name: \"d\", movable: true, primitives: [{}])]))",
        balls("b"),
        balls("c"),
        balls("d")
    );
    std::fs::write(folder.join("drawn.ron"), text).unwrap();
    let (_, found, _) = pong(&folder, &["check", "drawn.ron"]);
    let lines = [
        "  m (Aabb movable)\n",
        "    a (Above)\n",
        "      b (Above): 4 Sphere\n",
        "      c (Obb, 2 leaves): 4 Sphere\n",
        "    d (Aabb movable): 4 Sphere\n",
    ];
    let mut rest = found.as_str();
    for line in lines {
        let at = rest.find(line).unwrap_or_else(|| panic!("no {line:?} in {found}"));
        rest = &rest[at + line.len()..];
    }
}

/// A cable of capsules, with a single leaf chosen by its author, can be tuned as any other model: every frame
/// is the same.
#[test]
fn a_cable_of_capsules_is_tuned() {
    let link = |i: usize| {
        let [x, y] = [0.1 * i as f64, 0.1 * (i + 1) as f64];
        format!("Capsule(name: \"link_{i}\", ends: (({x:?}, 0, 0), ({y:?}, 0, 0)), radius: 0.1),")
    };
    let links: String = (0..12).map(link).collect();
    let cable = format!(
        "(format: \"pong-model\", version: 1, name: \"ball\", surfaces: {{ \"soft\": (stiffness: 1e5) }},
         root: (name: \"ball\", surface: \"soft\", primitives: [{links}]))"
    );
    let folder = common::resting_ball("tune/cable", &cable, 0.2);
    let (code, page, err) = pong(&folder, &["tune", "rest.ron", "--rounds", "2", "--frames", "64"]);
    assert_eq!(code, 0, "{page}{err}");
    assert!(page.contains("201 frames, every one compared"), "{page}");
}
