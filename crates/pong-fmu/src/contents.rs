//! What the folder `resources/` of an FMU holds, with lengths and hashes. The hash of this list is the token that stands in
//! `modelDescription.xml` too: description, list and files belong together or are refused.

use pong_model::Fnv;
use serde::{Deserialize, Serialize};
use std::path::Path;

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
    /// The bodies whose motion the importer gives.
    pub inputs: Vec<String>,
    /// Every model file as it stands in the scene, and where it is here.
    pub models: Vec<(String, String)>,
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
        Self { format: FORMAT.to_owned(), version: VERSION, pong, inputs, models, files }
    }

    /// The list as a file, and its token.
    pub fn write(&self) -> Result<(String, String), String> {
        let text = ron::ser::to_string_pretty(self, ron::ser::PrettyConfig::default())
            .map_err(|error| format!("{CONTENTS_FILE}: {error}"))?;
        let token = hash(text.as_bytes());
        Ok((text, token))
    }

    /// Reads the list of a folder and holds everything it lists against it.
    ///
    /// # Errors
    /// Files that are missing or changed, a description that is not of this list: all in one text.
    pub fn read(resources: &Path, token: &str) -> Result<Self, String> {
        let cure = "unpack the FMU again, or make it anew with `pong fmu`";
        let path = resources.join(CONTENTS_FILE);
        let text = pong_model::files::read_text(&path)
            .map_err(|reason| format!("{}: cannot be read: {reason}; {cure}", path.display()))?;
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
                "instantiation token: modelDescription.xml has `{token}`, and what lies in {} has `{own}`: the two are not \
                 of one FMU; {cure}",
                resources.display()
            ));
        }
        let changed: Vec<String> = contents.files.iter().filter_map(|entry| entry.fault(resources)).collect();
        if !changed.is_empty() {
            return Err(format!("{}; {cure}", changed.join("; ")));
        }
        Ok(contents)
    }
}

impl Entry {
    fn fault(&self, resources: &Path) -> Option<String> {
        let path = resources.join(&self.path);
        match pong_model::files::read(&path) {
            Err(reason) => Some(format!("{}: cannot be read: {reason}", path.display())),
            Ok(bytes) if bytes.len() as u64 == self.bytes && hash(&bytes) == self.hash => None,
            Ok(_) => Some(format!("{}: it has changed since the FMU was made", path.display())),
        }
    }
}
