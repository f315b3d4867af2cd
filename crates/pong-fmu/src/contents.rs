//! List of the files in the folder `resources/` of an FMU, with lengths and hashes. The hash of this list is
//! the token, which is also in `modelDescription.xml`: description, list and files are accepted only if they
//! belong together.

use pong_model::Fnv;
use serde::{Deserialize, Serialize};
use std::path::{Component, Path};

/// The list's own file.
pub(crate) const CONTENTS_FILE: &str = "contents.ron";
pub(crate) const SCENE_FILE: &str = "scene.ron";
const FORMAT: &str = "pong-fmu";
const VERSION: u32 = 1;

/// The list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Contents {
    format: String,
    version: u32,
    /// Version of Pong that wrote it.
    pong: String,
    /// The bodies whose motion is an input.
    pub inputs: Vec<String>,
    /// Every model file: its name in the scene, and its file in `resources/`.
    pub models: Vec<(String, String)>,
    /// True if outputs include means over a communication step.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub step_means: bool,
    /// Scene, models and meshes.
    files: Vec<Entry>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    path: String,
    bytes: u64,
    hash: String,
}

fn hash(bytes: &[u8]) -> String {
    format!("{:016x}", Fnv::of(bytes))
}

impl Contents {
    pub fn new<'f>(
        inputs: Vec<String>,
        step_means: bool,
        models: Vec<(String, String)>,
        files: impl IntoIterator<Item = (&'f str, &'f [u8])>,
    ) -> Self {
        let entry = |(path, bytes): (&str, &[u8])| Entry {
            path: path.to_owned(),
            bytes: bytes.len() as u64,
            hash: hash(bytes),
        };
        let pong = env!("CARGO_PKG_VERSION").to_owned();
        let files = files.into_iter().map(entry).collect();
        Self { format: FORMAT.to_owned(), version: VERSION, pong, inputs, models, step_means, files }
    }

    /// The list as a file, and its token.
    pub fn write(&self) -> Result<(String, String), String> {
        let text = ron::ser::to_string_pretty(self, ron::ser::PrettyConfig::default())
            .map_err(|error| format!("{CONTENTS_FILE}: {error}"))?;
        let token = hash(text.as_bytes());
        Ok((text, token))
    }

    /// Reads the list of a folder and checks every listed file against it.
    ///
    /// # Errors
    /// Files that are missing or changed, a description that does not belong to this list: all in one text.
    pub fn read(resources: &Path, token: &str) -> Result<Self, String> {
        let cure = "unpack the FMU again, or make it anew with `pong fmu`";
        let path = resources.join(CONTENTS_FILE);
        let text = read_text(resources, CONTENTS_FILE).map_err(|line| format!("{line}; {cure}"))?;
        let contents: Self =
            ron::from_str(&text).map_err(|error| format!("{}: {error}; {cure}", path.display()))?;
        if contents.format != FORMAT || contents.version != VERSION {
            return Err(format!(
                "{}: it is {:?} of version {}, and this library reads {FORMAT:?} of version {VERSION}; {cure}",
                path.display(),
                contents.format,
                contents.version
            ));
        }
        if contents.pong != env!("CARGO_PKG_VERSION") {
            return Err(format!(
                "{}: the FMU was made by Pong {}, and its library is of Pong {}; {cure}",
                path.display(),
                contents.pong,
                env!("CARGO_PKG_VERSION")
            ));
        }
        let own = hash(text.as_bytes());
        if token != own {
            return Err(format!(
                "instantiation token: `{token}` of modelDescription.xml is not that of what lies in {}; {cure}",
                resources.display()
            ));
        }
        contents.check_paths(&path).map_err(|line| format!("{line}; {cure}"))?;
        let changed: Vec<String> = contents.files.iter().filter_map(|entry| entry.fault(resources)).collect();
        if !changed.is_empty() {
            return Err(format!("{}; {cure}", changed.join("; ")));
        }
        Ok(contents)
    }

    /// Refuses paths that lead out of `resources/`, and models that are not among the files, before any file
    /// is opened.
    fn check_paths(&self, list: &Path) -> Result<(), String> {
        let named =
            self.models.iter().map(|(_, file)| file).chain(self.files.iter().map(|entry| &entry.path));
        for file in named {
            let mut parts = Path::new(file).components();
            if file.is_empty() || !parts.all(|part| matches!(part, Component::Normal(_))) {
                return Err(format!(
                    "{}: the file `{file}` leads out of the folder of the FMU",
                    list.display()
                ));
            }
        }
        let lists = |file: &str| self.files.iter().any(|entry| entry.path == file);
        let mut wanted = self.models.iter().map(|(_, file)| file.as_str()).chain([SCENE_FILE]);
        match wanted.find(|file| !lists(file)) {
            Some(file) => Err(format!("{}: `{file}` is not among its files", list.display())),
            None => Ok(()),
        }
    }
}

/// Reads a text file of `resources/`. Links that lead out of it are refused.
///
/// # Errors
/// Thing and cause.
pub(crate) fn read_text(resources: &Path, file: &str) -> Result<String, String> {
    let told = |reason: &dyn std::fmt::Display| {
        format!("{}: cannot be read: {reason}", resources.join(file).display())
    };
    let bytes = read(resources, file).map_err(|reason| told(&reason))?;
    String::from_utf8(bytes).map_err(|_| told(&"it is no UTF-8 text"))
}

fn read(resources: &Path, file: &str) -> std::io::Result<Vec<u8>> {
    pong_model::files::read_below(&resources.join(file), [resources])
}

impl Entry {
    fn fault(&self, resources: &Path) -> Option<String> {
        let path = resources.join(&self.path);
        match read(resources, &self.path) {
            Err(reason) => Some(format!("{}: cannot be read: {reason}", path.display())),
            Ok(bytes) if bytes.len() as u64 == self.bytes && hash(&bytes) == self.hash => None,
            Ok(_) => Some(format!("{}: it has changed since the FMU was made", path.display())),
        }
    }
}
