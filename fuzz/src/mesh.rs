//! The mesh readers: that of the importer and, for OBJ and STL, that of the model loader.

use crate::input::Input;
use crate::{count, exercise, files, text};
use pong_import::{DefaultSurface, Options};
use pong_model::Extensions;
use std::path::Path;

/// Imports a file with this extension; the model is loaded and used.
pub fn import(data: &[u8], ending: &str) {
    count::input();
    let file = files::write(&format!("mesh.{ending}"), data);
    let surface = DefaultSurface { name: "steel".to_owned(), stiffness: 1e6, damping: 250.0, mu: 0.2 };
    let options = Options { surface: Some(surface), ..Options::default() };
    let output = file.with_extension("ron");
    match pong_import::import(&file, &output, &options, &mut |_| ()) {
        Ok(_) => {
            count::accepted();
            text::accepted(data);
            // A model that needs a law or a kind of the host is written but cannot be loaded here.
            if let Ok(model) = pong_model::load(&output, &Extensions::new()) {
                exercise::run(model, &mut Input::new(data));
            }
        }
        Err(findings) => assert!(!findings.faults.is_empty(), "refused without a fault"),
    }
}

/// Loads a file with this extension as the mesh of a model: as a surface, as a solid, and as a polyhedron.
pub fn load(data: &[u8], ending: &str) {
    let name = format!("mesh.{ending}");
    let file = files::write(&name, data);
    for (kind, contact) in [("TriangleMesh", "Marked"), ("TriangleMesh", "Solid"), ("Polyhedron", "Solid")] {
        let text = format!(
            r#"(format: "pong-model", version: 1, name: "m", surfaces: {{"s": (stiffness: 1e5)}},
            root: (name: "m", surface: "s", contact: {contact}, primitives: [{kind}(name: "mesh", file: "{name}", scale: 0.5)]))"#
        );
        let folder = file.parent().unwrap_or(Path::new(""));
        if let Ok(model) = pong_model::parse(&text, "fuzz.ron", Some(folder), &Extensions::new()) {
            count::accepted();
            exercise::run(model, &mut Input::new(data));
        }
    }
}
