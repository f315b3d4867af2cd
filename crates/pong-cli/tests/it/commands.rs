//! The program on the command line: output, files, exit codes.

use crate::common;
use crate::common::pong;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball",
    surfaces: { "soft": (stiffness: 1e5, normal: Linear(damping: 632.4)) },
    root: (name: "ball", surface: "soft", primitives: [
        Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]))"#;
const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground",
    surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [
        Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;
const FRAME: &str = r#"(format: "pong-model", version: 1, name: "frame",
    surfaces: { "soft": (stiffness: 1e5) },
    root: (name: "frame", surface: "soft", groups: [
        (name: "bars", bound: Sphere, primitives: [
            LineSegment(name: "bar", ends: ((0, 0, 0), (1, 0, 0))),
            Point(name: "tip", position: (1, 0, 0)), Point(name: "other", position: (0, 1, 0))]),
        (name: "arm", movable: true, primitives: [
            TriangleMesh(name: "sheet", vertices: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
                triangles: [(0, 1, 2), (0, 2, 3)])])]))"#;
const DROP: &str = r#"(format: "pong-scene", version: 1, name: "drop",
    models: { "ball": "ball.ron", "ground": "ground.ron" },
    objects: [
        (name: "ball", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.1))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
    pairs: [("ball", "ground")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 1e-3, duration: 0.5, record_every: 100, ledger: true)"#;

fn folder(test: &str) -> PathBuf {
    let files = [("ball.ron", BALL), ("ground.ron", GROUND), ("frame.ron", FRAME), ("drop.ron", DROP)];
    common::folder(&format!("commands/{test}"), &files)
}

fn assert_holds(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
}

/// An undamped ball whose wrench is held over each step: the summary and a warning report the energy gained.
#[test]
fn run_tells_of_contacts_that_return_more_than_they_take() {
    let folder = folder("held");
    let scene = DROP
        .replace("RungeKutta4", "ZeroOrderHold(delay_frames: 1)")
        .replace("(0, 0, 0.1))", "(0, 0, 0.101))");
    std::fs::write(folder.join("held.ron"), scene.replace("1e-3", "1e-4")).unwrap();
    std::fs::write(folder.join("ball.ron"), BALL.replace("normal: Linear(damping: 632.4)", "")).unwrap();
    let (code, out, err) = pong(&folder, &["run", "held.ron"]);
    assert_eq!(code, 0, "{err}");
    assert_holds(&out, &["holding contact wrenches over steps made", "hold error J", "ball, ground"]);
    let parts =
        ["warning: `ball` and `ground`: ", "contact episodes gained energy", "k·dt·1.5", "c must exceed"];
    assert_holds(&err, &parts);
}

#[test]
fn run_sums_up_and_ends_with_zero() {
    let (code, out, err) = pong(&folder("run"), &["run", "drop.ron"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let parts = [
        "drop: t = 0.5 s, step 0.001 s, RungeKutta4; 2 bodies, 1 pair of movable groups, at most 1 contact at once",
        // Critically damped, it settles to mg/k without overshoot.
        "0 0 0.0999019",
        "9.81",
        "9.81e-5",
        "Energy drift: ",
        "gained",
        "ball, ground",
        "Time per step: median ",
    ];
    assert_holds(&out, &parts);
    // From rest to rest the ground has returned the impulse of gravity: m·g·t upwards, and the ground
    // received the opposite.
    for (body, expected) in [("ball", 4.905), ("ground", -4.905)] {
        let row = out.lines().rfind(|line| line.split_whitespace().next() == Some(body)).unwrap();
        let impulse: f64 = row.split_whitespace().last().unwrap().parse().unwrap();
        assert!((impulse / expected - 1.0).abs() < 2e-3, "{row}");
    }
}

/// k = 1e5 N/m and c = 632.4 N·s/m on 1 kg: κ + 2γ = 4 at 2.62 ms.
#[test]
fn run_warns_of_a_step_that_no_contact_survives() {
    let folder = folder("long_step");
    for (step, warned) in [("2.5e-3", false), ("2.7e-3", true)] {
        let scene = DROP.replace("RungeKutta4, step: 1e-3", &format!("SemiImplicitEuler, step: {step}"));
        std::fs::write(folder.join("long.ron"), scene).unwrap();
        let (_, _, err) = pong(&folder, &["run", "long.ron", "-q"]);
        assert_eq!(err.contains("longest stable step is 2.620e-3 s"), warned, "{step}: {err}");
    }
}

#[test]
fn run_writes_csv_files_that_can_be_read() {
    let folder = folder("csv");
    let (code, out, _) = pong(&folder, &["run", "drop.ron", "-q", "-o", "made/here"]);
    assert_eq!((code, out.as_str()), (0, ""));
    for (name, lines) in [("states", 13), ("wrenches", 13), ("contacts", 6), ("energies", 7), ("accounts", 6)]
    {
        let text = std::fs::read_to_string(folder.join(format!("made/here/{name}.csv"))).unwrap();
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(rows.len(), lines, "{name}\n{text}");
        assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{name}\n{text}");
        assert_eq!(rows[0][0], "time_s");
        assert_eq!(rows[lines - 1][0].parse::<f64>().unwrap(), 0.5);
    }
    let text = std::fs::read_to_string(folder.join("made/here/contacts.csv")).unwrap();
    let last: Vec<&str> = text.lines().last().unwrap().split(',').collect();
    assert_eq!([last[1], last[3]], ["ball/ball/skin", "ground/ground/floor"]);
    let depth: f64 = last[13].parse().unwrap();
    assert!((depth / 9.81e-5 - 1.0).abs() < 1e-9);
    accounts_close_and_hold_what_the_contacts_store(&folder.join("made/here"));
    let (code, _, _) = pong(&folder, &["run", "drop.ron", "--csv"]);
    assert!(code == 0 && folder.join("drop_out/states.csv").exists());
}

/// The final state is in the files: 500 steps, a record every 300.
#[test]
fn the_last_state_of_a_run_is_in_its_csv_files() {
    let folder = folder("csv_end");
    std::fs::write(folder.join("odd.ron"), DROP.replace("record_every: 100", "record_every: 300")).unwrap();
    assert_eq!(pong(&folder, &["run", "odd.ron", "-q", "-o", "odd"]).0, 0);
    assert_eq!(pong(&folder, &["run", "drop.ron", "-q", "-o", "even"]).0, 0);
    for name in ["states", "wrenches", "contacts", "energies"] {
        let [odd, even] = ["odd", "even"]
            .map(|out| std::fs::read_to_string(folder.join(out).join(format!("{name}.csv"))).unwrap());
        assert_eq!(odd.lines().last(), even.lines().last(), "{name}");
        let at = |text: &str, time: &str| text.lines().filter(|line| line.starts_with(time)).count();
        assert_eq!(at(&odd, "0.5,"), at(&even, "0.5,"), "{name}: once");
        assert!(at(&odd, "0.3,") == at(&even, "0.3,") && at(&odd, "0.4,") == 0, "{name}");
    }
}

/// Gravity as one number, the notation of other tools.
#[test]
fn a_gravity_of_one_number_is_told_how_to_be_three() {
    let folder = folder("gravity");
    for (written, found) in
        [("-9.81", "floating point"), ("10", "integer"), ("(0, -9.81)", "2 elements"), ("\"down\"", "string")]
    {
        std::fs::write(folder.join("wrong.ron"), DROP.replace("(0, 0, -9.81)", written)).unwrap();
        let (code, _, err) = pong(&folder, &["run", "wrong.ron"]);
        assert_eq!(code, 1, "{written}");
        assert_holds(&err, &["wrong.ron:7:", found, "`gravity`", "gravity: (0.0, 0.0, -9.81)"]);
    }
}

/// By default the groups of a model do not meet each other; a scene that pairs the model with itself is
/// refused.
#[test]
fn check_does_not_refuse_what_nobody_pairs() {
    let folder = folder("check_rigid");
    let rigid = r#"(format: "pong-model", version: 1, name: "walls", surfaces: { "rigid": (stiffness: inf) },
        root: (name: "walls", surface: "rigid", groups: [
            (name: "wall", primitives: [Plane(name: "p", normal: (0, 0, 1), offset: 0)]),
            (name: "door", movable: true, primitives: [Sphere(name: "knob", center: (0, 0, 1), radius: 0.1)])]))"#;
    std::fs::write(folder.join("walls.ron"), rigid).unwrap();
    let (code, out, err) = pong(&folder, &["check", "walls.ron", "ball.ron"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert_holds(
        &out,
        &["`walls` cannot be paired with itself:\n  note: surfaces `walls/rigid` and `walls/rigid`: both"],
    );
    std::fs::write(folder.join("floor.ron"), rigid.replace("walls", "floor")).unwrap();
    let (code, out, err) = pong(&folder, &["check", "walls.ron", "floor.ron"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert_holds(
        &out,
        &["`walls` and `floor` cannot be paired:\n  note: surfaces `floor/rigid` and `walls/rigid`: both"],
    );
    std::fs::write(folder.join("broken.ron"), rigid.replace("radius: 0.1", "radius: -0.1")).unwrap();
    let (code, _, err) = pong(&folder, &["check", "walls.ron", "floor.ron", "broken.ron"]);
    assert!(code == 1 && err.ends_with("1 fault\n"), "what is wrong with a model is still a fault: {err}");
    // A scene that pairs it gets an error.
    let scene = DROP
        .replace("\"ground.ron\"", "\"walls.ron\"")
        .replace("[(motion: Fixed)]", "[(motion: Fixed), (group: \"door\", motion: Fixed)]");
    let scene = scene.replace("pairs: [", "pairs: [(\"ground\", \"ground\"), ");
    std::fs::write(folder.join("paired.ron"), scene).unwrap();
    let (code, _, err) = pong(&folder, &["run", "paired.ron"]);
    assert!(
        code == 1 && err.contains("surfaces `walls/rigid` and `walls/rigid`: both surfaces are rigid"),
        "{err}"
    );
}

fn accounts_close_and_hold_what_the_contacts_store(folder: &Path) {
    let last = |name: &str| -> HashMap<String, String> {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        let cells = |line: Option<&str>| line.unwrap().split(',').map(str::to_owned).collect::<Vec<_>>();
        cells(text.lines().next()).into_iter().zip(cells(text.lines().last())).collect()
    };
    /// Relative tolerance: energies are sums over the steps of the run, each with its rounding.
    const SUMS: f64 = 1e-12;
    let (account, energies) = (last("accounts.csv"), last("energies.csv"));
    let sum = |table: &HashMap<String, String>, columns: &[&str]| -> f64 {
        columns.iter().map(|column| table[*column].parse::<f64>().unwrap()).sum()
    };
    let went_in = sum(&account, &["work_in_j", "inserted_j", "hold_error_j"]);
    let came_of_it = sum(&account, &["work_out_j", "stored_j", "damping_loss_j", "friction_loss_j"]);
    assert!(went_in > 0.0 && (came_of_it / went_in - 1.0).abs() < SUMS, "{account:?}");
    let [stored, in_all] = [sum(&account, &["stored_j"]), sum(&energies, &["contacts_j"])];
    assert!(stored > 0.0 && (stored / in_all - 1.0).abs() < SUMS, "{account:?} {energies:?}");
    assert_eq!([&account["a"], &account["b"]], ["ball", "ground"]);
    assert_eq!([&account["in_contact"], &account["episodes"], &account["episodes_gained"]], ["1", "0", "0"]);
}

#[test]
fn run_tells_faults_and_ends_with_one() {
    let folder = folder("run_faults");
    std::fs::write(folder.join("bad.ron"), DROP.replace("mass: 1.0", "mass: -1.0").replace("1e-3,", "0,"))
        .unwrap();
    let (code, out, err) = pong(&folder, &["run", "bad.ron"]);
    assert_eq!((code, out.as_str()), (1, ""));
    assert_holds(
        &err,
        &["bad.ron: step: it is 0 s; ", "bad.ron: objects/ball/bodies[0]: the mass is -1 kg; "],
    );
    std::fs::write(folder.join("blocked"), "a file").unwrap();
    let (code, _, err) = pong(&folder, &["run", "drop.ron", "-o", "blocked"]);
    assert!(code == 1 && err.contains("name another folder with -o"), "{err}");
}

#[test]
fn run_tells_of_a_step_that_is_too_long() {
    let folder = folder("diverged");
    let springs =
        r#"springs: [(first: Ground(), second: On(body: "ball"), stiffness: (1e9, 1e9, 1e9, 0, 0, 0))],"#;
    let text = DROP
        .replace("integrator:", &format!("{springs} integrator:"))
        .replace("duration: 0.5", "duration: 9.0");
    std::fs::write(folder.join("stiff.ron"), text).unwrap();
    let (code, out, err) = pong(&folder, &["run", "stiff.ron", "--csv"]);
    assert_eq!(code, 1, "{out}{err}");
    let told = "stiff.ron: body `ball`: it has 1.374e14 J, more than a hundred times what all forces gave, by the spring of \
                `the ground` and `ball`, at t = 0.001 s; the step is too long for the stiffness and mass at hand: shorten it";
    assert_holds(&err, &[told]);
    assert!(folder.join("stiff_out/states.csv").exists());
}

#[test]
fn check_describes_models_and_their_meetings() {
    let (code, out, err) = pong(&folder("check"), &["check", "frame.ron", "ground.ron"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let parts = [
        "frame: hash ",
        "  frame (Aabb movable)\n    bars (Sphere): 2 Point, 1 LineSegment\n    arm (Aabb movable): 2 Triangle in 1 primitive\n",
        "extent of frame/arm: (0 0 0) … (1 1 0) m",
        "extent of ground: (-inf -inf -inf) … (inf inf inf) m",
        "surface `soft`: k 100000 N/m, linear",
        "`frame/bars/tip` sits on an end of `frame/bars/bar`: their springs add up to 150000 N/m",
        "`frame` with itself: 1 pair of movable groups",
        "warning: models `frame` and `frame` are paired but nothing of one can touch anything of the other (`frame` with itself)",
        "`frame` and `ground`: 2 pairs of movable groups",
        "Point–Plane: 2 pairs of primitives",
        "LineSegment–Plane: 1 pair of primitives",
        "Plane and Triangle have no tester",
        "up to 300000 N/m on one face: all 2 points and 1 segment of frame:frame on a Plane (`rigid`) of ground:ground",
    ];
    assert_holds(&out, &parts);
    let (_, out, _) = pong(&folder("alone"), &["check", "--alone", "frame.ron", "ground.ron"]);
    assert!(!out.contains("`frame` and `ground`"), "{out}");
}

/// Round parts are counted, met and summed like the others; pairs without a tester are reported.
#[test]
fn check_knows_round_parts() {
    let folder = folder("check_round");
    let part = r#"(format: "pong-model", version: 1, name: "cable", surfaces: { "soft": (stiffness: 1e5) },
        root: (name: "cable", surface: "soft", primitives: [
            Capsule(name: "a", ends: ((0, 0, 0), (1, 0, 0)), radius: 0.1),
            Capsule(name: "b", ends: ((1, 0, 0), (2, 0, 0)), radius: 0.1),
            Cylinder(name: "c", ends: ((0, 0, 0), (0, 1, 0)), radius: 0.1),
            Cone(name: "d", ends: ((0, 1, 0), (0, 2, 0)), radii: (0.1, 0)),
            Bore(name: "e", ends: ((0, 0, 1), (0, 0, 2)), radii: (0.2, 0.1)),
        ]))"#;
    std::fs::write(folder.join("cable.ron"), part).unwrap();
    let (code, out, err) = pong(&folder, &["check", "cable.ron", "ground.ron"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let parts = [
        "cable (Aabb movable): 2 Capsule, 1 Cylinder, 1 Cone, 1 Bore",
        "extent of cable: (-0.3 -0.3 -0.1) … (2.1 2 2.1) m",
        "Capsule–Plane: 2 pairs of primitives",
        "Cylinder–Plane: 1 pair of primitives",
        "Cone–Plane: 1 pair of primitives",
        "Bore and Plane have no tester",
        "note: models `cable` and `ground`, Cone on Plane: the tip of a cone has half of the stiffness",
        "up to 400000 N/m on one face: all 2 capsules and 1 cylinder and 1 cone of cable:cable on a Plane (`rigid`)",
    ];
    assert_holds(&out, &parts);
}

/// Boxes without points or edges: no built-in test holds one on the other.
const POST: &str = r#"(format: "pong-model", version: 1, name: "post", surfaces: { "s": (stiffness: 1e5) },
    root: (name: "post", surface: "s", primitives: [Polyhedron(name: "solid",
        vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)],
        faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]])]))"#;

#[test]
fn a_run_in_which_paired_objects_cannot_touch_ends_with_three() {
    let folder = folder("passes_through");
    std::fs::write(folder.join("post.ron"), POST).unwrap();
    let scene = DROP.replace("ground.ron", "post.ron").replace("ball.ron", "post.ron");
    std::fs::write(folder.join("boxes.ron"), &scene).unwrap();
    let (code, out, err) = pong(&folder, &["run", "boxes.ron"]);
    assert_eq!(code, 3, "{err}");
    assert!(out.contains("0 contacts at once"), "{out}");
    let parts = [
        "`ball` and `ground`): they pass through each other; give one of them what the other can touch; Polyhedron can touch \
         Point, LineSegment, Ray, Sphere, Ellipsoid, Capsule",
        "boxes.ron: paired objects passed through each other",
        "write passes_through: [(\"ball\", \"ground\")] in the scene if that is meant",
    ];
    assert_holds(&err, &parts);
    // By intention, in either order of the names.
    let meant = scene.replace("gravity:", "passes_through: [(\"ground\", \"ball\")], gravity:");
    std::fs::write(folder.join("meant.ron"), meant).unwrap();
    let (code, _, err) = pong(&folder, &["run", "meant.ron"]);
    assert_eq!(code, 0, "{err}");
}

const PATCH: &str = r#"(format: "pong-model", version: 1, name: "patch", surfaces: { "rigid": (stiffness: inf) },
    root: (name: "patch", surface: "rigid", primitives: [
        TriangleMesh(name: "sheet", vertices: [(0, -1, 0), (2, -1, 0), (2, 1, 0), (0, 1, 0)], triangles: [(0, 1, 2), (0, 2, 3)]),
        Sphere(name: "one", center: (0, 0, -3), radius: 0.1), Sphere(name: "two", center: (0, 0, -3), radius: 0.1),
        Plane(name: "under", normal: (0, 0, 1), offset: 0)]))"#;

/// A plane and a patch in it push twice, in one model and as two objects; so do two spheres in one place.
#[test]
fn what_is_there_twice_is_told() {
    let folder = folder("twice");
    std::fs::write(folder.join("patch.ron"), PATCH).unwrap();
    let (code, out, _) = pong(&folder, &["check", "--alone", "patch.ron"]);
    assert_eq!(code, 0);
    let parts = [
        "warning: `patch/two` and `patch/one` are the same Sphere in one place: their springs add; leave one out",
        "warning: `patch/sheet` and `patch/under` lie in one plane and overlap: what touches both there is pushed twice",
    ];
    assert_holds(&out, &parts);
    let flush = "objects `patch` and `ground`: `patch/sheet` and `ground/floor` lie in one plane and overlap: what touches both";
    let scene = |pairs: &str, height: &str| {
        let text = DROP
            .replace("\"ground\": \"ground.ron\"", "\"ground\": \"ground.ron\", \"patch\": \"patch.ron\"")
            .replace("pairs: [", &format!("pairs: [{pairs}"))
            .replace("objects: [", &format!(
                "objects: [(name: \"patch\", model: \"patch\", bodies: [(motion: Fixed, position: (0, 0, {height}))]),"
            ));
        std::fs::write(folder.join("scene.ron"), text).unwrap();
        let (code, _, err) = pong(&folder, &["run", "scene.ron"]);
        assert_eq!(code, 0, "{err}");
        err
    };
    assert_holds(&scene("(\"ball\", \"patch\"), ", "0"), &[flush]);
    // Below the ground it is not flush, and a face that the ball does not meet pushes once.
    assert!(!scene("(\"ball\", \"patch\"), ", "-0.01").contains("in one plane"));
    assert!(!scene("", "0").contains("in one plane"));
}

#[test]
fn a_scene_is_no_model_and_a_model_no_scene() {
    let folder = folder("kinds_of_files");
    let (code, out, err) = pong(&folder, &["check", "drop.ron"]);
    assert_eq!((code, out.as_str()), (1, ""));
    assert_holds(
        &err,
        &["drop.ron:1:1: ", "this is a scene, not a model; run it with `pong run`", "1 fault"],
    );
    for command in ["run", "trade", "tune", "fmu", "modes"] {
        let (code, _, err) = pong(&folder, &[command, "ball.ron"]);
        assert_eq!(code, 1, "{command}: {err}");
        assert_holds(&err, &["this is a model, not a scene; check it with `pong check`"]);
    }
}

#[test]
fn check_tells_every_fault_and_ends_with_one() {
    let folder = folder("check_faults");
    std::fs::write(folder.join("bad.ron"), BALL.replace("radius: 0.1", "radius: 0")).unwrap();
    std::fs::write(folder.join("rigid.ron"), BALL.replace("1e5, normal: Linear(damping: 632.4)", "inf"))
        .unwrap();
    let (code, out, err) = pong(&folder, &["check", "bad.ron", "none.ron", "ground.ron", "rigid.ron"]);
    assert_eq!(code, 1);
    assert_holds(&err, &["bad.ron:4:", "[not-positive]", "none.ron:1:1: ", "2 faults"]);
    // Two surfaces that cannot meet are not a fault.
    assert_holds(&out, &["cannot be paired:\n  note: surfaces ", "both surfaces are rigid"]);
}

#[test]
fn wrong_usage_ends_with_two() {
    let folder = folder("usage");
    for arguments in [&[][..], &["check"], &["run"], &["fly"], &["run", "drop.ron", "--fast"]] {
        let (code, _, err) = pong(&folder, arguments);
        assert!(code == 2 && err.contains("Usage"), "{arguments:?}: {code}\n{err}");
    }
    assert_eq!(pong(&folder, &["--help"]).0, 0);
    assert!(pong(&folder, &["--version"]).1.starts_with("pong "));
}

/// `pong check` prints the spring and the damper of each bristle, and for undamped bristles cause and cure.
#[test]
fn check_tells_of_the_damping_of_bristles() {
    let surfaces = r#"
        "by mass": (stiffness: 6e4, normal: Linear(restitution: (e: 0.5, mass: 1.0)), friction: Bristle(mu: 0.3)),
        "by law": (stiffness: 6e4, normal: Linear(damping: 30.0), friction: Bristle(mu: 0.3, stiffness: 1.5e4)),
        "on purpose": (stiffness: 6e4, normal: Linear(damping: 30.0), friction: Bristle(mu: 0.3, damping: 0)),
        "no damper": (stiffness: 6e4, friction: Bristle(mu: 0.3)),
        "no mass": (stiffness: 6e4, normal: HuntCrossley(dissipation: 0.5, exponent: 1), friction: Bristle(mu: 0.3)),
        "slippery": (stiffness: 6e4, friction: Bristle(mu: 0.0)),
        "rigid": (stiffness: inf, friction: Bristle(mu: 0.3))"#;
    let pairs = r#"(surfaces: ("by mass", "stone"), friction: Bristle(mu: 0.1)),
        (surfaces: ("by law", "stone"), normal: HuntCrossley(exponent: 1), friction: Bristle(mu: 0.1)),
        (surfaces: ("on purpose", "stone"), friction: Bristle(mu: 0.1, damping: 0))"#;
    let foot = |name: &str| format!("Point(name: \"{name}\", position: (0, 0, 0), surface: \"{name}\")");
    let feet = ["by mass", "by law", "on purpose"].map(foot).join(", ");
    let feet = format!(
        "(format: \"pong-model\", version: 1, name: \"feet\", surfaces: {{ {surfaces} }}, pairs: [{pairs}],\n\
         root: (name: \"feet\", primitives: [{feet}]))"
    );
    let floor = GROUND.replace("\"rigid\"", "\"stone\"");
    let folder = common::folder("commands/bristles", &[("feet.ron", &feet), ("floor.ron", &floor)]);
    let (code, out, err) = pong(&folder, &["check", "feet.ron", "floor.ron"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let effect = "it throws back along the surface what it has stored";
    let cure = "write Bristle(mu: …, mass: …), or `damping: …`, with 0 if this is meant";
    assert_holds(
        &out,
        &[
            "bristle, μ_k 0.3, μ_s 0.3, k_t 40000 N/m, c_t 400 N·s/m\n",
            "bristle, μ_k 0.3, μ_s 0.3, k_t 15000 N/m, c_t 15 N·s/m from the normal law\n",
            "`on purpose`: k 60000 N/m, linear, c 30 N·s/m, ramp 0 m, bristle, μ_k 0.3, μ_s 0.3, k_t 40000 N/m, c_t 0 N·s/m\n",
            &format!(
                "  note: the bristle of surface `on purpose` is undamped, as `damping: 0` says: {effect}\n"
            ),
            &format!(
                "  note: the bristle of surface `no damper` is undamped, because the normal law has no damping, and no mass is \
                 named: {effect}; {cure}\n"
            ),
            &format!(
                "  note: the bristle of surface `no mass` is undamped, because no mass is named: {effect}; {cure}\n"
            ),
            "`rigid`: k inf N/m, the law of what it meets, bristle, μ_k 0.3, μ_s 0.3\n",
            &format!(
                "  note: the bristle of the pair `on purpose` and `stone` is undamped, as `damping: 0` says: {effect}\n"
            ),
            "  bristle of the pair `by mass` and `stone`: k_t 40000 N/m, c_t 400 N·s/m\n",
            "  bristle of the pair `by law` and `stone`: k_t 40000 N/m, c_t 0 N·s/m\n",
            &format!(
                "  note: the bristle of the pair `by law` and `stone` is undamped, because no mass is named: {effect}; {cure}\n"
            ),
        ],
    );
    assert_eq!(out.matches("note: the bristle").count(), 5, "{out}");
}
