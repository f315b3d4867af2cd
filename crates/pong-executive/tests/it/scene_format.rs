//! Every example of docs/scene_format.md is read and run, and its statements about names of bodies hold.

use pong_executive::Integrator;
use pong_executive::scene::{BuiltScene, Scene, Variation};
use std::path::{Path, PathBuf};

const DOCUMENT: &str = include_str!("../../../../docs/scene_format.md");

/// Code blocks of the document: the text after `ron` in the fence, and the block.
fn blocks() -> Vec<(&'static str, &'static str)> {
    let mut blocks = Vec::new();
    for (index, part) in DOCUMENT.split("\n```").enumerate() {
        if index % 2 == 1 {
            let (head, text) = part.split_once('\n').unwrap();
            blocks.push((head.strip_prefix("ron ").unwrap_or_else(|| panic!("fence `{head}`")), text));
        }
    }
    blocks
}

fn model_folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).unwrap();
    for (head, text) in blocks() {
        if let Some(name) = head.strip_prefix("model ") {
            std::fs::write(folder.join(format!("{name}.ron")), text).unwrap();
        }
    }
    folder
}

fn build(text: &str, folder: &Path) -> BuiltScene {
    let scene = Scene::parse(text, "example.ron", folder).unwrap_or_else(|e| panic!("{e}\n{text}"));
    scene.build().unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A scene with the objects that loads and springs name, and a placeholder for one example.
fn around(objects: &str, section: &str, integrator: &str) -> String {
    let models = r#""ball": "ball.ron", "ground": "ground.ron", "gripper": "gripper.ron""#;
    format!(
        "(format: \"pong-scene\", version: 1, name: \"example\", models: {{ {models} }}, objects: [{objects}], \
         {section} {integrator} step: 1e-4, duration: 1e-2)"
    )
}

const RUNGE_KUTTA: &str = "integrator: RungeKutta4,";

#[test]
fn every_example_builds_and_runs() {
    let folder = model_folder("every_example");
    let find = |kind: &'static str| {
        blocks().into_iter().filter(move |(head, _)| *head == kind).map(|(_, text)| text)
    };
    let objects: Vec<&str> = find("objects").collect();
    let with_bodies = objects[0].to_owned() + objects[1];
    let mut scenes: Vec<String> = objects.iter().map(|text| around(text, "", RUNGE_KUTTA)).collect();
    for section in ["loads", "springs", "alternatives"] {
        let sections = find(section).map(|text| format!("{section}: [{text}],"));
        scenes.extend(sections.map(|text| around(&with_bodies, &text, RUNGE_KUTTA)));
    }
    scenes.extend(find("field").map(|text| around(&with_bodies, "", text)));
    assert_eq!(scenes.len(), 10, "3 of objects, loads, springs, alternatives, 4 integrators");
    for text in &scenes {
        let mut built = build(text, &folder);
        built.simulation.run_for(2e-3).unwrap_or_else(|e| panic!("{e}\n{text}"));
    }
}

/// The scene of the section on preloads: both balls begin with the intended friction. The sliding one has
/// μ·k·δ, 3 N, from the start; the held one stands still where without a preload it would swing.
#[test]
fn preloaded_friction_is_there_at_the_start() {
    let folder = model_folder("preloaded");
    let text = blocks().into_iter().filter(|(head, _)| *head == "scene").nth(1).unwrap().1;
    let forces = |built: &mut BuiltScene| {
        built.simulation.commit_initial_states().unwrap();
        let contacts: Vec<_> = built.simulation.world().contacts_iter().collect();
        assert_eq!(contacts.len(), 2);
        contacts.into_iter().map(|contact| contact.friction_force).collect::<Vec<_>>()
    };
    let mut built = build(text, &folder);
    let [sliding, held] = forces(&mut built)[..] else { unreachable!() };
    assert!((sliding.x + 3.0).abs() < 1e-9 && sliding.y.abs() < 1e-9, "{sliding}");
    assert!((held.x - 1.0).abs() < 1e-12 && held.y.abs() < 1e-12, "{held}");
    let begin = text.find("preload: [").unwrap();
    let end = begin + text[begin..].find("],").unwrap() + 2;
    let without = format!("{}{}", &text[..begin], &text[end..]);
    // The sliding one has the damping of its bristle from the start, the one at rest none.
    let [damped, free] = forces(&mut build(&without, &folder))[..] else { unreachable!() };
    assert!(damped.x < 0.0 && damped.norm() <= 3.0 + 1e-9 && free.norm() < 1e-12, "{damped} {free}");
    // Faults of a preload are reported.
    let turned = text.replace("(pair: (\"held\", \"ground\")", "(pair: (\"ground\", \"held\")");
    let told = Scene::parse(&turned, "turned.ron", &folder).unwrap().build().err().unwrap().to_string();
    assert!(told.contains("preload/(ground, held): `pairs` has these two the other way round"), "{told}");
    let apart = build(&text.replace("(0.0, 1.0, 0.0999)", "(0.0, 1.0, 0.2)"), &folder);
    assert!(apart.warnings.iter().any(|warning| warning.contains("preload/(held, ground): no bristle")));
}

/// An alternative's models replace the scene's, and a variation overrides the file.
#[test]
fn a_scene_is_built_with_something_else_than_it_says() {
    let folder = model_folder("varied");
    let find = |kind: &str| blocks().into_iter().find(|(head, _)| *head == kind).unwrap().1;
    let section = format!("alternatives: [{}],", find("alternatives"));
    let whole = find("scene").replacen("pairs:", &format!("{section} pairs:"), 1);
    let scene = Scene::parse(&whole, "example.ron", &folder).unwrap();
    assert_eq!(scene.alternatives().collect::<Vec<_>>(), ["point"]);
    assert_eq!(scene.model_files().len(), 3);
    let rename = |mut model: pong_model::Model| {
        model.name.push_str(" again");
        Ok(model)
    };
    let variation = Variation {
        integrator: Some(Integrator::SemiImplicitEuler),
        step: Some(3e-4),
        alternative: Some("point"),
        rewrite: Some(&rename),
        ..Variation::default()
    };
    let built = scene.build_varied(&variation).unwrap();
    let names: Vec<&str> =
        built.simulation.world().scene().models().map(|(_, model)| model.name.as_str()).collect();
    assert_eq!(names, ["tip again", "ground again"]);
    assert_eq!(built.simulation.integrator(), Integrator::SemiImplicitEuler);
    assert_eq!((built.simulation.step_length(), built.steps), (3e-4, 1000));
    let plain = scene.build().unwrap();
    let ball = plain.simulation.world().scene().models().next().unwrap().1.name.clone();
    assert_eq!((ball.as_str(), plain.simulation.step_length()), ("ball", 1e-4));
    // A ready model replaces its file, which need not exist.
    let at_hand = plain.simulation.world().scene().models().next().unwrap().1.clone();
    let instead = |file: &Path| file.ends_with("ball.ron").then(|| at_hand.clone());
    let variation = Variation { instead: Some(&instead), ..Variation::default() };
    let built = scene.build_varied(&variation).unwrap();
    let first = built.simulation.world().scene().models().next().unwrap().1.clone();
    assert!(std::sync::Arc::ptr_eq(&first, &at_hand));
    let unknown = scene.build_varied(&Variation { alternative: Some("line"), ..Variation::default() });
    let told = unknown.err().unwrap().to_string();
    assert!(told.contains("there is no alternative `line`") && told.contains("point"), "{told}");
}

#[test]
fn the_whole_file_does_what_its_comment_says() {
    let folder = model_folder("whole_file");
    let (_, text) = blocks().into_iter().find(|(head, _)| *head == "scene").unwrap();
    let mut built = build(text, &folder);
    assert_eq!((built.name.as_str(), built.steps, built.record_every), ("drop", 3000, 10));
    let ball = built.objects[0].bodies[0];
    assert_eq!(built.simulation.bodies().len(), 2);
    let touch = (2.0_f64 * 0.1 / 9.81).sqrt();
    let mut first_touch = None;
    let mut watch = |simulation: &pong_executive::Simulation| {
        if simulation.world().contact_count() > 0 && first_touch.is_none() {
            first_touch = Some(simulation.time());
        }
    };
    built.simulation.observe(built.steps, 1, &mut watch).unwrap();
    assert!((first_touch.unwrap() - touch).abs() < 2e-4, "{first_touch:?} against {touch}");
    assert!(built.simulation.pose(ball).position.z > 0.1);
}

#[test]
fn groups_start_where_their_author_put_them() {
    let folder = model_folder("authored");
    let (_, text) = blocks().into_iter().find(|(head, _)| *head == "objects").unwrap();
    // The root is the reference of the others under each of its names.
    for root in ["(motion: Fixed,", "(group: \"gripper\", motion: Fixed,"] {
        let text = text.replacen("(motion: Fixed,", root, 1);
        let built = build(&around(&text, "", RUNGE_KUTTA), &folder);
        let bodies = &built.objects[0].bodies;
        assert_eq!(bodies.len(), 3);
        let place = |index: usize| built.simulation.pose(bodies[index]).position;
        assert_eq!(place(0).z, 1.0, "{root}");
        assert_eq!([place(1).x, place(1).z], [0.05, 1.0], "{root}");
        assert_eq!([place(2).x, place(2).z], [-0.05, 1.0], "{root}");
    }
}

/// A movable group may be written by its bare name, by its path below the root and by its whole path. Its
/// body has one name, the same as in logs.
#[test]
fn a_body_has_one_name_however_the_scene_writes_its_group() {
    let folder = pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), "one_name");
    let hand = r#"(format: "pong-model", version: 1, name: "hand", surfaces: { "s": (stiffness: 1e5) },
        root: (name: "palm", surface: "s", groups: [(name: "finger", movable: true, groups: [
            (name: "tip", movable: true, primitives: [Point(name: "p", position: (0, 0, 0))])])]))"#;
    std::fs::write(folder.join("hand.ron"), hand).unwrap();
    for group in ["tip", "finger/tip", "palm/finger/tip"] {
        let text = format!(
            r#"(format: "pong-scene", version: 1, name: "s", models: {{ "hand": "hand.ron" }},
                objects: [(name: "left", model: "hand", bodies: [(motion: Fixed), (group: "finger", motion: Fixed),
                    (group: "{group}", motion: Fixed)])],
                pairs: [], integrator: RungeKutta4, step: 1e-3, duration: 1.0)"#
        );
        let scene = Scene::parse(&text, "s.ron", &folder).unwrap_or_else(|errors| panic!("{errors}"));
        let built = scene.build().unwrap_or_else(|errors| panic!("{errors}"));
        let names: Vec<&str> = built.simulation.bodies().map(|(_, body)| body.name.as_str()).collect();
        assert_eq!(names, ["left", "left/finger", "left/finger/tip"], "{group}");
    }
}
