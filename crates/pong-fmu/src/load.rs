//! From the folder `resources/` to a unit that can run. No other file is read.

use crate::contents::{self, Contents, SCENE_FILE};
use crate::unit::{Inputs, Unit};
use pong_executive::scene::{Scene, Variation};
use pong_model::{Extensions, Model};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Loads the contents of an FMU, if they are unchanged.
///
/// # Errors
/// Files that are missing, changed, or of another FMU: thing, cause and cure.
pub(crate) fn load(resources: &Path, token: &str) -> Result<Unit, String> {
    let contents = Contents::read(resources, token)?;
    let unpack = |line: String| format!("{line}; unpack the FMU again");
    let mut models: Vec<(PathBuf, Arc<Model>)> = Vec::new();
    for (in_scene, file) in &contents.models {
        let path = resources.join(file);
        let text = contents::read_text(resources, file).map_err(unpack)?;
        let model = pong_model::parse(&text, &path.display().to_string(), path.parent(), &Extensions::new());
        let model = model.map_err(|errors| errors.to_string())?;
        models.push((PathBuf::from(in_scene), Arc::new(model)));
    }
    let path = resources.join(SCENE_FILE);
    let text = contents::read_text(resources, SCENE_FILE).map_err(unpack)?;
    // With an empty folder the scene names its models as the list does.
    let scene = Scene::parse(&text, &path.display().to_string(), Path::new(""));
    let scene = scene.map_err(|errors| errors.to_string())?;
    let of_file = |file: &Path| {
        models.iter().find(|(in_scene, _)| in_scene == file).map(|(_, model)| Arc::clone(model))
    };
    let variation = Variation { instead: Some(&of_file), ..Variation::default() };
    let built = scene.build_varied(&variation).map_err(|errors| errors.to_string())?;
    let mut unit = Unit::new(built, &Inputs::Named(contents.inputs), contents.step_means)?;
    unit.token = token.to_owned();
    Ok(unit)
}

/// The folder of a URI in the forms of FMI 2.0: `file:///path`, `file:/path` or `file://localhost/path`.
///
/// # Errors
/// Another kind of address.
pub(crate) fn folder_of_uri(uri: &str) -> Result<PathBuf, String> {
    let refused = || {
        format!(
            "fmuResourceLocation `{uri}`: it is no local file; give a URI such as file:///tmp/fmu/resources"
        )
    };
    let rest = uri.strip_prefix("file:").ok_or_else(refused)?;
    let path = match rest.strip_prefix("//") {
        Some(rest) => rest.strip_prefix("localhost").unwrap_or(rest),
        None => rest,
    };
    if !path.starts_with('/') {
        return Err(refused());
    }
    // `/C:/folder` of Windows.
    let path = if cfg!(windows) { &path[1..] } else { path };
    let mut bytes = Vec::new();
    let mut left = path.as_bytes();
    while let [first, rest @ ..] = left {
        (bytes, left) = match (first, rest) {
            (b'%', [high, low, rest @ ..]) => {
                let digit = |c: &u8| char::from(*c).to_digit(16);
                let (high, low) = digit(high).zip(digit(low)).ok_or_else(refused)?;
                bytes.push((16 * high + low) as u8);
                (bytes, rest)
            }
            (b'%', _) => return Err(refused()),
            (byte, rest) => {
                bytes.push(*byte);
                (bytes, rest)
            }
        };
    }
    String::from_utf8(bytes).map(PathBuf::from).map_err(|_| refused())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_are_paths() {
        for uri in ["file:///tmp/a%20b/r", "file:/tmp/a%20b/r", "file://localhost/tmp/a b/r"] {
            let path = if cfg!(windows) { "tmp/a b/r" } else { "/tmp/a b/r" };
            assert_eq!(folder_of_uri(uri).unwrap(), Path::new(path), "{uri}");
        }
        for uri in
            ["http://x/r", "/tmp/r", "file://host/r", "file:///tmp/%4", "file:///tmp/%zz", "file:///%ff", ""]
        {
            assert!(folder_of_uri(uri).is_err(), "{uri}");
        }
    }
}
