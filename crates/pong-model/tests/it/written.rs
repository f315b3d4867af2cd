//! The writer: reading gives what was written, to the last bit.

use pong_model::Extensions;
use pong_model::authored::{self, Node, Value};
use pong_model::write;
use std::path::{Path, PathBuf};

/// Value without positions, so that two readings can be compared.
fn bare(value: &Value) -> Value {
    let node = |node: &Node| Node::from(bare(&node.value));
    match value {
        Value::Struct(name, fields) => {
            let fields: Vec<_> = fields.iter().map(|f| (f.name.as_ref(), bare(&f.value.value))).collect();
            match name {
                Some(name) => Value::named(name, fields),
                None => Value::fields(fields),
            }
        }
        Value::Tuple(name, items) => Value::Tuple(name.clone(), items.iter().map(node).collect()),
        Value::List(items) => Value::List(items.iter().map(node).collect()),
        Value::Map(entries) => Value::Map(entries.iter().map(|(k, v)| (node(k), node(v))).collect()),
        Value::Rows(rows) => {
            Value::rows(rows.bracketed, (0..rows.len()).map(|index| rows.row(index).iter().copied()))
        }
        other => other.clone(),
    }
}

fn model_files(folder: &Path, all: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            model_files(&path, all);
        } else if path.extension().is_some_and(|ending| ending == "ron") {
            all.push(path);
        }
    }
}

#[test]
fn models_round_trip() {
    let mut files = Vec::new();
    model_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models"), &mut files);
    let (mut models, ext) = (0, Extensions::new());
    for path in files {
        let Ok(read) = authored::load(&path) else { continue };
        let text = write::text(&read.value);
        let again = authored::parse(&text, "written").unwrap_or_else(|errors| panic!("{path:?}: {errors}"));
        assert_eq!(bare(&again.value), bare(&read.value), "{path:?}");
        assert_eq!(write::text(&again.value), text, "{path:?}");
        assert!(text.lines().all(|line| line.chars().count() <= 120), "{path:?}");
        let line = write::line(&read.value);
        let in_line = authored::parse(&line, "line").unwrap_or_else(|errors| panic!("{path:?}: {errors}"));
        assert!(!line.contains('\n') && bare(&in_line.value) == bare(&read.value), "{path:?}");
        let hash = |text: &str| pong_model::parse(text, "m", path.parent(), &ext).map(|model| model.hash);
        assert_eq!(hash(&text).ok(), pong_model::load(&path, &ext).map(|model| model.hash).ok(), "{path:?}");
        models += 1;
    }
    assert!(models > 50, "{models}");
}

#[test]
fn numbers_keep_every_bit() {
    for (value, text) in [
        (1.0, "1.0"),
        (-0.0, "-0.0"),
        (0.0001, "0.0001"),
        (1e16, "1e+16"),
        (-1.5e-7, "-1.5e-07"),
        (1e100, "1e+100"),
        (5e-324, "5e-324"),
        (f64::INFINITY, "inf"),
        (f64::NEG_INFINITY, "-inf"),
    ] {
        assert_eq!(write::decimal(value), text);
        assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
    }
    let mut random = pong_testkit::Random::new(5, 0, 0);
    for _ in 0..10_000 {
        let value = f64::from_bits(random.bits());
        let read = write::decimal(value).parse::<f64>().map(f64::to_bits);
        assert!(value.is_nan() || read == Ok(value.to_bits()), "{value:e}");
    }
}

#[test]
fn texts_and_names_come_back() {
    let names = [
        "a\"b",
        "back\\slash",
        "line\nbreak",
        "µ-Größe",
        "tab\t",
        "\u{200b}",
        "e\u{301}",
        "\u{301}",
        "// no",
        "\0'",
    ];
    let surfaces = names.map(|name| (name, Value::fields([("stiffness", Value::Number(f64::INFINITY))])));
    let point = Value::named("Point", [("name", Value::text("p")), ("position", Value::numbers(&[0.0; 3]))]);
    let root = Value::fields([
        ("name", Value::text("r")),
        ("surface", Value::text("tab\t")),
        ("leaf_size", Value::Number(4.0)),
        ("primitives", Value::list([point])),
    ]);
    let model = Value::model("m", [("surfaces", Value::map(surfaces)), ("root", root)]);
    let text = write::text(&model);
    assert!(text.contains("version: 1,") && text.contains("leaf_size: 4,"), "{text}");
    assert!(text.contains("\"µ-Größe\": (stiffness: inf)") && text.contains("\"\\u{200b}\""), "{text}");
    let read = authored::parse(&text, "m").unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    assert_eq!(bare(&read.value), model);
}

#[test]
fn long_lists_are_filled_and_long_structs_broken() {
    let rows = |bracketed| Value::rows(bracketed, (0..40).map(|i| [f64::from(i), 1.0, 2.0]));
    let mesh = Value::named(
        "TriangleMesh",
        [("name", Value::text("t")), ("vertices", rows(false)), ("triangles", rows(false))],
    );
    let text = write::text(&Value::fields([("primitives", Value::list([mesh]))]));
    assert!(
        text.starts_with("(\n    primitives: [\n        TriangleMesh(\n            name: \"t\",\n"),
        "{text}"
    );
    assert!(text.contains("            vertices: [\n                (0.0, 1.0, 2.0), (1.0,"), "{text}");
    assert!(text.contains("            triangles: [\n                (0, 1, 2), (1, 1, 2),"), "{text}");
}
