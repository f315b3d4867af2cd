//! Errors name the file, the cause and the cure, and change nothing.

use pong::{Config, EngineError, Error, Load, WorldBuilder};

const NO_RADIUS: &str = r#"(
    format: "pong-model", version: 1, name: "ball",
    surfaces: { "rubber": (stiffness: 2e4) },
    root: (name: "ball", surface: "rubber", primitives: [Sphere(name: "shell", center: (0, 0, 0), radius: 0)]),
)"#;

#[test]
fn a_faulty_file_is_named_with_line_and_nothing_is_added() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("faulty");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("ball.ron");
    std::fs::write(&file, NO_RADIUS).unwrap();
    let mut builder = WorldBuilder::new(Config::default());
    let refused = builder.load(&file).unwrap_err();
    let text = refused.to_string();
    assert!(text.starts_with(&format!("{}:4:", file.display())), "{text}");
    assert!(matches!(&refused, Error::Model(faults) if faults.0.len() == 1));
    assert_eq!(builder.scene().models().len(), 0);
}

#[test]
fn a_missing_file_is_named_with_a_cure() {
    let text = WorldBuilder::new(Config::default()).load("nowhere/ball.ron").unwrap_err().to_string();
    assert!(text.starts_with("nowhere/ball.ron:") && text.contains("name a model file"), "{text}");
}

#[test]
fn refusals_of_the_engine_and_of_a_seal_are_one_type() {
    let mut builder = WorldBuilder::new(Config { contact_capacity: Some(0), ..Config::default() });
    let model = builder.load_text(&NO_RADIUS.replace("radius: 0", "radius: 1"), "ball").unwrap();
    let refused = builder.create_object(model, "a/b").map_err(Error::from).unwrap_err();
    assert!(matches!(refused, Error::Engine(EngineError::BadValue { .. })));
    let refused = builder.seal().map(drop).map_err(Error::from).unwrap_err();
    assert!(matches!(refused, Error::Engine(EngineError::Seal { .. })));
}
