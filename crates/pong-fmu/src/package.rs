//! Makes an FMU: scene, models and meshes, the shared library, the description and licences in one file.

use crate::contents::{CONTENTS_FILE, Contents, SCENE_FILE};
use crate::description::{self, describe};
use crate::library;
use crate::names::identifier;
use crate::unit::{Inputs, Unit};
use crate::version::Fmi;
use crate::zip::Zip;
use pong_executive::scene::Scene;
use pong_model::Extensions;
use pong_model::grouping::mesh_files;
use std::path::{Component, Path};

/// Options of an FMU.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Bodies whose motion is an input, as the scene names them.
    pub inputs: Vec<String>,
    /// True if the motion of every body that is not fixed is an input: the FMU then only computes contact.
    pub all_inputs: bool,
    /// True if outputs include mean contact wrenches over a communication step.
    pub step_means: bool,
    /// Extensions and allowed folders of the models.
    pub extensions: Extensions,
}

/// A complete FMU.
#[derive(Clone, Debug)]
pub struct Package {
    /// The contents of the file.
    pub bytes: Vec<u8>,
    /// Name of the scene.
    pub name: String,
    /// Counts of inputs, outputs, parameters and continuous states.
    pub counts: [usize; 4],
    /// Bodies whose motion is an input.
    pub inputs: Vec<String>,
    /// Warnings for the author of scene and models.
    pub warnings: Vec<String>,
}

const LICENSE: &str = include_str!("../../../LICENSE");
const THIRD_PARTY: &str = include_str!("../../../THIRD_PARTY_LICENSES.md");

/// Makes an FMU of a scene with a [shared library](crate::LIBRARY_FILE).
///
/// # Errors
/// Every fault of scene, models or library, a line for each: thing, cause and cure.
pub fn package(path: &Path, library: &[u8], fmi: Fmi, options: &Options) -> Result<Package, String> {
    let platform = library::check(library).map_err(|line| format!("shared library: {line}"))?;
    let text = pong_model::files::read_text(path)
        .map_err(|reason| format!("{}: cannot be read: {reason}; name a scene file", path.display()))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let scene =
        Scene::parse(&text, &path.display().to_string(), folder).map_err(|errors| errors.to_string())?;
    let scene = scene.with_extensions(options.extensions.clone());
    let built = scene.build().map_err(|errors| errors.to_string())?;
    let inputs = match options.all_inputs {
        true => Inputs::All,
        false => Inputs::Named(options.inputs.clone()),
    };
    let unit = Unit::new(built, &inputs, options.step_means)
        .map_err(|line| format!("{}: {line}", path.display()))?;

    let mut files = vec![(SCENE_FILE.to_owned(), text.into_bytes())];
    let mut models: Vec<(String, String)> = Vec::new();
    for (_, file) in scene.models() {
        if models.iter().all(|(in_scene, _)| in_scene != file) {
            let place = add_model(&folder.join(file), models.len(), &mut files)?;
            models.push((file.to_owned(), place));
        }
    }
    let listed = files.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice()));
    let (contents, token) = Contents::new(unit.input_bodies(), options.step_means, models, listed).write()?;
    files.push((CONTENTS_FILE.to_owned(), contents.into_bytes()));

    let identifier = identifier(&unit.name);
    let description = describe(&unit, fmi, &identifier, &token);
    let mut zip = Zip::default();
    zip.add("modelDescription.xml", description.as_bytes(), false)?;
    let place = match fmi {
        Fmi::V2 => platform.fmi2,
        Fmi::V3 => platform.fmi3,
    };
    zip.add(&format!("binaries/{place}/{identifier}.{}", platform.ending), library, true)?;
    for (path, bytes) in &files {
        zip.add(&format!("resources/{path}"), bytes, false)?;
    }
    zip.add("documentation/index.html", description::page(&unit).as_bytes(), false)?;
    zip.add("documentation/licenses/license.txt", LICENSE.as_bytes(), false)?;
    zip.add("documentation/licenses/third_party.md", THIRD_PARTY.as_bytes(), false)?;
    let counts = description::counts(&unit);
    let inputs = unit.input_bodies();
    Ok(Package { bytes: zip.finish()?, name: unit.name, counts, inputs, warnings: unit.warnings })
}

/// Adds a model and the meshes that it names, in a folder of their own; returns the path of the model.
fn add_model(path: &Path, number: usize, files: &mut Vec<(String, Vec<u8>)>) -> Result<String, String> {
    let unreadable = |path: &Path, reason: std::io::Error| {
        format!("{}: cannot be read: {reason}; name a file that can be read", path.display())
    };
    let text = pong_model::files::read_text(path).map_err(|reason| unreadable(path, reason))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let place = format!("models/{number}/{name}");
    let meshes = mesh_files(&text).map_err(|line| format!("{}: {line}", path.display()))?;
    files.push((place.clone(), text.into_bytes()));
    for mesh in meshes {
        let inside = Path::new(&mesh).components().all(|part| matches!(part, Component::Normal(_)));
        if !inside || mesh == name {
            return Err(format!(
                "{}: it names the mesh `{mesh}`, which lies outside its folder, where an FMU has no place; move the mesh \
                 beside the model or below it",
                path.display()
            ));
        }
        let file = path.parent().unwrap_or(Path::new("")).join(&mesh);
        let bytes = pong_model::files::read(&file).map_err(|reason| unreadable(&file, reason))?;
        files.push((format!("models/{number}/{mesh}"), bytes));
    }
    Ok(place)
}
