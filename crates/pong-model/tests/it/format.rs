//! Every example of docs/model_format.md loads.

use pong_geometry::Vec3;
use pong_geometry::primitive::CustomPrimitive;
use pong_model::Extensions;
use std::path::Path;
use std::sync::Arc;

const DOCUMENT: &str = include_str!("../../../../docs/model_format.md");

/// Examples with their kind and the line at which they begin.
fn examples() -> Vec<(usize, String, String)> {
    let mut examples = Vec::new();
    let mut lines = DOCUMENT.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        if let Some(kind) = line.strip_prefix("```ron") {
            let body: Vec<_> =
                lines.by_ref().map(|(_, line)| line).take_while(|line| *line != "```").collect();
            examples.push((number + 1, kind.trim().to_owned(), body.join("\n")));
        }
    }
    examples
}

fn whole(kind: &str, example: &str) -> String {
    let surfaces = "\"steel\": (stiffness: 1e6), \"rubber\": (stiffness: 1e5),";
    let point = "Point(name: \"p\", position: (0, 0, 0))";
    let model = |surfaces: &str, pairs: &str, contents: &str| {
        format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ {surfaces} }}, pairs: [ {pairs} ],\n\
             root: (name: \"root\", surface: \"steel\", {contents}))"
        )
    };
    match kind {
        "" => example.to_owned(),
        // An example may define the usual names itself.
        "surfaces" if example.contains("\"steel\"") => model(example, "", &format!("primitives: [{point}]")),
        "surfaces" => {
            model(&format!("\"steel\": (stiffness: 1e6), {example}"), "", &format!("primitives: [{point}]"))
        }
        "pairs" => model(surfaces, example, &format!("primitives: [{point}]")),
        "groups" => model(surfaces, "", &format!("groups: [{example}]")),
        "primitives" => model(surfaces, "", &format!("primitives: [{example}]")),
        other => panic!("what is `ron {other}`?"),
    }
}

#[derive(Debug)]
struct Torus;

impl CustomPrimitive for Torus {
    fn kind_name(&self) -> &str {
        "torus"
    }
    fn support(&self, _: &Vec3) -> f64 {
        1.1
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

fn write_meshes(folder: &Path) {
    std::fs::create_dir_all(folder).expect("a folder");
    let stl = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 5 0 9\nvertex 6 0 9\nvertex 5 1 9\nendloop\nendfacet\nendsolid t\n";
    std::fs::write(folder.join("terrain.stl"), stl).expect("a file");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::write(folder.join("block.obj"), obj).expect("a file");
}

#[test]
fn every_example_loads_without_a_warning() {
    let folder = std::env::temp_dir().join(format!("pong_format_{}", std::process::id()));
    write_meshes(&folder);
    let mut ext = Extensions::new();
    ext.add_primitive("torus", Arc::new(|_| Ok(Arc::new(Torus) as Arc<dyn CustomPrimitive>)));
    let examples = examples();
    assert!(examples.len() >= 12, "{}", examples.len());
    for (line, kind, example) in examples {
        match pong_model::parse(&whole(&kind, &format!("{example}\n")), "example", Some(&folder), &ext) {
            Ok(model) => assert!(model.warnings.is_empty(), "line {line}: {:?}", model.warnings),
            Err(errors) => panic!("docs/model_format.md, example at line {line}:\n{errors}"),
        }
    }
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}
