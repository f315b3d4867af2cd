//! `pong advise` on the command line.

use crate::common;
use std::path::{Path, PathBuf};

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground",
    surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [
        Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;

fn folder(test: &str, surface: &str, integrator: &str, step: f64) -> PathBuf {
    let point = format!(
        r#"(format: "pong-model", version: 1, name: "point", surfaces: {{ {surface} }},
            root: (name: "point", surface: "advised", primitives: [Point(name: "tip", position: (0, 0, 0))]))"#
    );
    let scene = format!(
        r#"(format: "pong-scene", version: 1, name: "drop", models: {{ "point": "point.ron", "ground": "ground.ron" }},
            objects: [
                (name: "point", model: "point", bodies: [(motion: Free, mass: 4.0, inertia: Diagonal(1, 1, 1),
                    position: (0, 0, 0.001), linear_velocity: (0, 0, -0.5))]),
                (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
            pairs: [("point", "ground")], integrator: {integrator}, step: {step:?}, duration: 1)"#
    );
    let files = [("point.ron", point.as_str()), ("ground.ron", GROUND), ("scene.ron", scene.as_str())];
    common::folder(&format!("advise/{test}"), &files)
}

fn pong(folder: &Path, arguments: &str) -> (i32, String, String) {
    common::pong(folder, &arguments.split(' ').collect::<Vec<_>>())
}

/// The number after a word at the start of a line.
fn value(text: &str, name: &str) -> f64 {
    let line = text.lines().find_map(|line| line.trim().strip_prefix(name));
    let line = line.unwrap_or_else(|| panic!("no `{name}` in:\n{text}"));
    line.split_whitespace().next().unwrap().parse().unwrap()
}

/// A lossless contact: k = m·(v/δ)² = 4 kg·(0.5 m/s / 1 mm)² = 1 MN/m.
#[test]
fn an_elastic_wish_has_the_stiffness_that_stores_its_energy() {
    let here = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let wish = "advise --mass 4 --coupling stages --speed 0.5 --depth 0.001 --restitution 1";
    let (code, out, err) = pong(here, wish);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!((value(&out, "stiffness") / 1e6 - 1.0).abs() < 1e-6, "{out}");
    assert_eq!(value(&out, "damping"), 0.0);
    // Two bodies of 8 kg are 4 kg at the contact; two contacts carry half each.
    let (_, both, _) = pong(here, &format!("{} --mass 8 --contacts 2", wish.replace("--mass 4", "--mass 8")));
    assert!(both.starts_with("Effective mass 4 kg") && both.contains("(stiffness: 500000.0,"), "{both}");
}

/// The printed line is a surface; with it the scene bounces as desired, has no warning at the advised step,
/// and has one at three times it.
#[test]
fn the_advised_surface_does_in_a_scene_what_was_wished() {
    let wish = "advise --mass 4 --coupling step --speed 0.5 --depth 0.001 --restitution 0.4";
    let (_, out, _) = pong(Path::new(env!("CARGO_TARGET_TMPDIR")), wish);
    let surface = out.lines().find(|line| line.contains("\"advised\"")).unwrap().trim();
    let step = value(&out, "accurate to");
    let here = folder("advised_surface", surface, "SemiImplicitEuler", step * 0.9999);
    let (code, out, err) = pong(&here, "advise scene.ron");
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("closing at 0.5 m/s (the scene's start)") && !out.contains("warning"), "{out}");
    assert!(
        out.contains("one contact that carries the whole mass") && out.contains("`--contacts n`"),
        "{out}"
    );
    let (_, out, err) = pong(&here, "run scene.ron --csv");
    assert_eq!(err, "", "{out}");
    let states = std::fs::read_to_string(here.join("scene_out/states.csv")).unwrap();
    let (head, last) = (states.lines().next().unwrap(), states.lines().rfind(|line| line.contains("point")));
    let column = head.split(',').position(|name| name.starts_with("vz")).unwrap_or_else(|| panic!("{head}"));
    let rebound: f64 = last.unwrap().split(',').nth(column).unwrap().parse().unwrap();
    assert!((rebound / 0.2 - 1.0).abs() < 0.02, "{rebound}");
    let three = format!("advise scene.ron --step {:?}", 3.0 * step);
    let (_, out, _) = pong(&here, &three);
    assert!(
        out.contains("warning: `point/point` and `ground/ground`: a bounce on one contact is off by"),
        "{out}"
    );
}

/// Held over a frame, k·T/2 < c: 1e4 N/m and 5 N·s/m are stable to 1 ms, and this is reported as the first
/// failure.
#[test]
fn what_goes_wrong_first_is_told() {
    let surface = r#""advised": (stiffness: 1e4, normal: Linear(damping: 5))"#;
    let here = folder("first_wrong", surface, "ZeroOrderHold(substeps: 1, delay_frames: 0)", 2e-3);
    let (_, out, _) = pong(&here, "advise scene.ron");
    let row = out.lines().find(|line| line.contains("·") && line.contains("10000")).unwrap();
    assert!(row.contains("0.001"), "{out}");
    assert!(out.contains("First to go wrong: contact between `point/point` and `ground/ground`"), "{out}");
    assert!(
        out.contains("gains energy at a step of 2.000e-3 s; the longest stable step is 1.000e-3 s"),
        "{out}"
    );
    // The surfaces of a single model are judged against a rigid partner, with the same answer.
    let (_, out, _) = pong(&here, "advise point.ron --mass 4 --rate 500");
    assert!(out.contains("advised · rigid") && out.contains("0.001"), "{out}");
}

/// Two feet of k: ω² = 2k/m. With 4 kg and 1e6 N/m a single one is stable to 4 ms with semi-implicit Euler,
/// both together to 2.83 ms: beyond that there is a note, not a warning, and `--acting` reports the contacts.
#[test]
fn what_may_go_wrong_is_a_note() {
    let here = folder("notes", r#""advised": (stiffness: 1e6)"#, "SemiImplicitEuler", 3e-3);
    let point = std::fs::read_to_string(here.join("point.ron")).unwrap();
    let one = r#"Point(name: "tip", position: (0, 0, 0))"#;
    // Coincident, so that inertia has no influence; the second may be above the first.
    let two = |height: f64| format!(r#"{one}, Point(name: "other", position: (0, 0, {height}))"#);
    let scene = std::fs::read_to_string(here.join("scene.ron")).unwrap();
    let weighty = scene.replace("integrator:", "gravity: (0, 0, -9.81), integrator:");
    std::fs::write(here.join("scene.ron"), weighty.replace("duration: 1", "duration: 0.3")).unwrap();
    for (height, together) in [(0.0, "the stiffest, 2 at"), (1.0, "the stiffest, 1 at")] {
        std::fs::write(here.join("point.ron"), point.replace(one, &two(height))).unwrap();
        let (_, out, _) = pong(&here, "advise scene.ron");
        let (_, summary, err) = pong(&here, "run scene.ron --acting");
        assert!(summary.contains("Contacts that acted together: at most"), "{summary}");
        assert!(summary.contains(together), "{summary}");
        if height == 0.0 {
            let note = "note: `point/point`: up to 2 contacts can act on it at once, together as stiff as 2.000e6 N/m";
            assert!(out.contains(note) && out.contains("up to 2.828e-3 s is surely stable"), "{out}");
            let (_, careless, _) = pong(&here, "advise scene.ron --depth-within 1e4 --rebound-within 1e4");
            let before = "Before that, 2 contacts together on `point/point` may gain energy";
            assert!(careless.contains(before), "{careless}");
            assert!(err.contains(note) && !err.contains("warning: `point"), "{err}");
            assert!(summary.contains("the step is 0.003 s, and they may have gained energy"), "{summary}");
        } else {
            assert!(summary.contains("surely stable to 0.004 s; the step is shorter"), "{summary}");
        }
        let (_, _, err) = pong(&here, "run scene.ron --quiet");
        assert!(!err.contains("note:"), "{err}");
    }
}

/// c_t = 2·√(k_t·m_t): for a rolling ball m_t = 2/7·m, for n contacts each an nth of it. With it nothing
/// rings.
#[test]
fn damping_of_friction_follows_from_the_mass_along_the_surface() {
    let bristle = r#""advised": (stiffness: 1.5e6, friction: Bristle(mu: 0.3))"#;
    let here = folder("friction", bristle, "RungeKutta4", 1e-4);
    let (mass, k) = (2.0 / 7.0, 1e6_f64);
    for contacts in [1.0, 4.0] {
        let arguments = format!(
            "advise point.ron --mass 1 --friction-mass {mass} --step 1e-4 --coupling stages --contacts {contacts}"
        );
        let (code, out, err) = pong(&here, &arguments);
        assert_eq!(code, 0, "{err}");
        let row = out
            .lines()
            .find(|line| line.contains("advised · rigid") && line.contains("1000000"))
            .unwrap_or_default();
        let cells: Vec<&str> = row.split_whitespace().collect();
        let got: Vec<f64> = cells[3..].iter().map(|cell| cell.parse().unwrap()).collect();
        let each: f64 = mass / contacts;
        let rings = (k / each).sqrt() / std::f64::consts::TAU;
        let expected = [each, k, 0.0, rings, 2.0 * (k * each).sqrt()];
        for (got, expected) in got.iter().zip(expected) {
            assert!((got - expected).abs() <= 1e-5 * expected, "{got} {expected}\n{out}");
        }
        let damping = got[4];
        let damped = bristle.replace("mu: 0.3", &format!("mu: 0.3, damping: {:?}", damping * 1.001));
        let (_, out, _) = pong(&folder("friction_damped", &damped, "RungeKutta4", 1e-4), &arguments);
        let row = out.lines().find(|line| line.contains("advised · rigid") && line.contains("1000000"));
        assert_eq!(row.unwrap().split_whitespace().nth(6), Some("-"), "{out}");
    }
    let (code, _, err) = pong(&here, "advise point.ron --mass 1 --friction-mass 0 --step 1e-4");
    assert!(code == 1 && err.contains("--friction-mass: it is 0 kg"), "{err}");
}

#[test]
fn wrong_wishes_are_refused() {
    let here = folder("wrong_wishes", r#""advised": (stiffness: 1e4)"#, "RungeKutta4", 1e-3);
    for (arguments, told) in [
        ("advise --mass 0 --speed 1 --depth 1 --restitution 1", "--mass: it is 0 kg"),
        ("advise --mass 1 --depth 1 --restitution 1", "--speed:"),
        ("advise --mass 1 --speed 1 --depth 1 --restitution 2", "restitution: it is 2"),
        ("advise scene.ron --mass 1", "--mass: a scene has masses of its own"),
        ("advise scene.ron --rate=-5", "the step is -0.2 s"),
        ("advise point.ron --rate 100", "--mass: 0 are given"),
        ("advise none.ron --mass 1 --rate 100", "none.ron"),
    ] {
        let (code, out, err) = pong(&here, arguments);
        assert!(code != 0 && out.is_empty() && err.contains(told), "{arguments}: {out}{err}");
    }
}

/// A delay counts for every held wrench, named or not, and is refused for others: ignoring it would give the
/// optimistic answer.
#[test]
fn a_delay_counts_wherever_the_wrench_is_held() {
    let surface = "\"advised\": (stiffness: 1e6, normal: Linear(damping: 100))";
    let wish = "advise --mass 4 --rate 1000 --speed 0.1 --depth 0.002 --restitution 0.3";
    let held = folder("late", surface, "SemiImplicitEuler", 1e-4);
    let told = |arguments: &str| {
        let (code, told, error) = pong(&held, arguments);
        assert_eq!(code, 0, "{arguments}: {error}");
        told
    };
    assert_eq!(told(&format!("{wish} --late 2")), told(&format!("{wish} --coupling held --late 2")));
    assert_ne!(told(&format!("{wish} --late 2")), told(wish));
    assert_eq!(told(&format!("{wish} --late 0")), told(wish));
    let scene = folder("late_scene", surface, "ZeroOrderHold(delay_frames: 2)", 1e-4);
    let of_scene = |arguments: &str| pong(&scene, arguments).1;
    assert_eq!(of_scene("advise scene.ron"), of_scene("advise scene.ron --late 2"));
    assert_ne!(of_scene("advise scene.ron"), of_scene("advise scene.ron --late 5"));
    for arguments in [format!("{wish} --coupling stages --late 1"), "advise scene.ron --late 1".to_owned()] {
        let (code, _, error) = pong(&held, &arguments);
        assert!(
            code != 0 && error.contains("--late") && error.contains("--coupling held"),
            "{arguments}: {error}"
        );
    }
}
