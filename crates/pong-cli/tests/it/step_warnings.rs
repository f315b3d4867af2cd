//! `pong run` warns of a step that is too long for a law, for every law, as `pong advise` does.

use crate::common;
use crate::common::pong;

const SCENE: &str = r#"(format: "pong-scene", version: 1, name: "drop",
    models: { "ball": "ball.ron", "ground": "ground.ron" },
    objects: [
        (name: "ball", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, HEIGHT), linear_velocity: (0, 0, SPEED))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
    pairs: [("ball", "ground")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: STEP, duration: 0.3)"#;

const MODEL: &str = r#"(format: "pong-model", version: 1, name: "NAME",
    surfaces: { "s": (stiffness: STIFFNESS, LAW) },
    root: (name: "NAME", surface: "s", primitives: [PRIMITIVE]))"#;

/// Output of `pong run` and `pong advise` for a ball that falls on ground.
fn told(name: &str, law: &str, (stiffness, height, speed, step): (&str, &str, &str, &str)) -> [String; 2] {
    let model = |name: &str, stiffness: &str, primitive: &str| {
        let model = MODEL.replace("NAME", name).replace("STIFFNESS", stiffness);
        model.replace("LAW", law).replace("PRIMITIVE", primitive)
    };
    let ball = model("ball", stiffness, r#"Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)"#);
    let ground = model("ground", "inf", r#"Plane(name: "floor", normal: (0, 0, 1), offset: 0)"#);
    let scene = SCENE.replace("HEIGHT", height).replace("SPEED", speed).replace("STEP", step);
    let files = [("ball.ron", ball.as_str()), ("ground.ron", ground.as_str()), ("drop.ron", scene.as_str())];
    let folder = common::folder(&format!("step_warnings/{name}"), &files);
    let (_, _, run) = pong(&folder, &["run", "drop.ron", "--quiet"]);
    let (_, advise, _) = pong(&folder, &["advise", "drop.ron"]);
    [run, advise]
}

const GAINS: &str = "`ball/ball` and `ground/ground`: a contact of";
const RUBS: &str = "`ball/ball` and `ground/ground`: friction of";

/// The speed is known from the start: both warn before the first frame, in the same words.
#[test]
fn a_known_speed_is_judged_before_the_first_frame() {
    let hertz = "normal: HuntCrossley(dissipation: 0, exponent: 1.5)";
    let coulomb = "normal: Linear(damping: 100), friction: Coulomb(mu: 0.5, slip_speed: 1e-3)";
    let cases = [
        ("hertz", hertz, ("1e10", "0.12", "-1", "1e-3"), GAINS),
        ("coulomb", coulomb, ("1e5", "0.12", "-1", "1e-3"), RUBS),
    ];
    for (name, law, scene, words) in cases {
        let [run, advise] = told(name, law, scene);
        let warning = |text: &str| {
            let line = text.lines().find(|line| line.starts_with("warning: ") && line.contains(words));
            line.unwrap_or_else(|| panic!("no warning of `{words}` in:\n{text}")).to_owned()
        };
        assert_eq!(warning(&run), warning(&advise), "{name}");
        assert_eq!(run.matches(words).count(), 1, "once only:\n{run}");
    }
}

/// From rest the speed is not known before: the run warns when the contact is too deep, or too hard pressed,
/// for the step.
#[test]
fn a_fall_from_rest_is_judged_when_it_touches() {
    let hertz = "normal: HuntCrossley(dissipation: 0, exponent: 1.5)";
    let coulomb = "normal: Linear(damping: 100), friction: Coulomb(mu: 0.5, slip_speed: 1e-3)";
    for (name, law, stiffness, words) in
        [("hertz_from_rest", hertz, "1e10", GAINS), ("coulomb_from_rest", coulomb, "1e5", RUBS)]
    {
        let [run, _] = told(name, law, (stiffness, "0.15", "0", "1e-3"));
        assert!(run.contains("warning: from t = 0.1") && run.contains(words), "{name}:\n{run}");
        assert_eq!(run.matches(words).count(), 1, "once only:\n{run}");
        let [short, _] = told(&format!("{name}_short"), law, (stiffness, "0.15", "0", "5e-6"));
        assert!(!short.contains("gains energy"), "{name}, with a short step:\n{short}");
    }
}
