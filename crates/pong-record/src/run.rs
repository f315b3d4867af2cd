//! run.json: description of the tables of a log.

use crate::error::LogError;
use crate::format::{FORMAT, VERSION};
use pong_engine::WrenchCoupling;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Component, Path};

/// Name of the file.
pub(crate) const FILE: &str = "run.json";

/// The contents of run.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// `pong-log`.
    pub format: String,
    /// Version of the format.
    pub version: u64,
    /// Name of the run, as its writer gave it.
    pub name: String,
    /// Program that wrote the log, with its version.
    pub writer: String,
    /// Version of the engine.
    pub engine: String,
    /// Hash of the sealed world.
    #[serde(with = "hex")]
    pub scene_hash: u64,
    /// Step of the integrator, s; `None` if the writer did not know.
    #[serde(default)]
    pub step: Option<f64>,
    /// Commits from one frame of the log to the next; `None` if the writer did not know: see `commits_missed`
    /// of each frame.
    #[serde(default)]
    pub commits_per_frame: Option<u64>,
    /// The integrator; `None` if the writer did not know.
    #[serde(default)]
    pub integrator: Option<String>,
    /// Contact capacity of the world.
    #[serde(default)]
    pub contact_capacity: Option<u64>,
    /// True if the world kept energies.
    #[serde(default)]
    pub ledger: bool,
    /// The host's use of wrenches, if the world kept accounts of them.
    #[serde(default, alias = "accounts", skip_serializing_if = "Option::is_none")]
    pub energy_accounts: Option<RunAccounts>,
    /// Names of the force laws that the host registered.
    #[serde(default)]
    pub laws: Vec<String>,
    /// The models.
    pub models: Vec<RunModel>,
    /// The Objects.
    pub objects: Vec<RunObject>,
    /// The movable groups of all Objects: the columns of states and wrenches.
    pub bodies: Vec<RunBody>,
    /// The pairs of Objects.
    pub pairs: Vec<[usize; 2]>,
    /// Groups that never touch each other, except those given by models.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub filters: Vec<RunFilter>,
    /// The primitives of all bodies.
    pub primitives: Vec<RunPrimitive>,
    /// The tables by name.
    pub tables: BTreeMap<String, RunTable>,
    /// True if the log was closed.
    pub finished: bool,
    /// Frames in the log, once it is closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<u64>,
    /// Frames that were lost because they came faster than they could be written.
    #[serde(default)]
    pub lost: u64,
}

/// The host's use of wrenches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunAccounts(#[serde(with = "Coupling")] pub WrenchCoupling);

/// Coupling in the notation of logs.
#[derive(Serialize, Deserialize)]
#[serde(remote = "WrenchCoupling", rename_all = "snake_case")]
enum Coupling {
    Stages,
    SemiImplicit,
    /// `held` in version 1.
    #[serde(alias = "held")]
    ZeroOrderHold {
        /// `late` in version 1.
        #[serde(alias = "late")]
        delay_frames: u32,
    },
}

/// A model of a log.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunModel {
    /// Name in its file.
    pub name: String,
    /// Its file in the folder of the log.
    pub file: String,
    /// Its hash.
    #[serde(with = "hex")]
    pub hash: u64,
}

/// An Object of a log.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunObject {
    /// Its name.
    pub name: String,
    /// Index of its model.
    pub model: usize,
}

/// A movable group of an Object.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunBody {
    /// `object` for the root group, `object/path below the root` for others.
    pub name: String,
    /// Index of its Object.
    pub object: usize,
    /// Path in its model.
    pub path: String,
    /// Index of the parent group.
    pub parent: Option<usize>,
}

/// Two groups that never touch each other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunFilter {
    /// Indices of their Objects.
    pub objects: [usize; 2],
    /// Full paths of the groups in the models.
    pub groups: [String; 2],
}

/// A primitive of a body.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunPrimitive {
    /// Index of its body.
    pub body: usize,
    /// Path in its model.
    pub path: String,
    /// Its kind, as models spell it.
    pub kind: String,
    /// Name of its surface.
    pub surface: String,
}

/// A table of a log.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunTable {
    /// Its file in the folder of the log.
    pub file: String,
    /// Its rows, once the log is closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
}

impl Run {
    /// Reads and checks run.json in a folder.
    ///
    /// # Errors
    /// A file that cannot be read, is of another version, or refers to something that does not exist.
    pub fn load(folder: &Path) -> Result<Self, LogError> {
        let path = folder.join(FILE);
        let text =
            pong_model::files::read_text(&path).map_err(|reason| LogError::unreadable(&path, &reason))?;
        let damaged = |cause: String| LogError::damaged(&path, cause);
        let head: Head = serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))?;
        if head.format != FORMAT {
            return Err(damaged(format!("its format is {:?}, not {FORMAT:?}", head.format)));
        }
        if !(1..=VERSION).contains(&head.version) {
            return Err(LogError::Version { path, version: head.version });
        }
        let run: Self = serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))?;
        run.check().map_err(damaged)?;
        Ok(run)
    }

    /// `object/path` of a primitive.
    pub fn primitive_name(&self, primitive: usize) -> Option<String> {
        let primitive = self.primitives.get(primitive)?;
        let object = &self.objects[self.bodies[primitive.body].object].name;
        Some(format!("{object}/{}", primitive.path))
    }

    /// The two names of a pair of Objects.
    pub fn pair_names(&self, pair: usize) -> Option<[&str; 2]> {
        self.pairs.get(pair).map(|pair| pair.map(|object| self.objects[object].name.as_str()))
    }

    /// Checks that every index and every file name refers to something inside the log.
    fn check(&self) -> Result<(), String> {
        let refers = |from: &str, index: usize, to: &str, count: usize| {
            let cause = || format!("{from} refers to number {index} of the {to}, of which there are {count}");
            if index < count { Ok(()) } else { Err(cause()) }
        };
        for object in &self.objects {
            refers(&format!("object `{}`", object.name), object.model, "models", self.models.len())?;
        }
        for body in &self.bodies {
            let from = format!("body `{}`", body.name);
            refers(&from, body.object, "objects", self.objects.len())?;
            body.parent.map_or(Ok(()), |parent| refers(&from, parent, "bodies", self.bodies.len()))?;
        }
        for object in self.pairs.iter().flatten() {
            refers("a pair", *object, "objects", self.objects.len())?;
        }
        for object in self.filters.iter().flat_map(|filter| filter.objects) {
            refers("a filter", object, "objects", self.objects.len())?;
        }
        for primitive in &self.primitives {
            let from = format!("primitive `{}`", primitive.path);
            refers(&from, primitive.body, "bodies", self.bodies.len())?;
        }
        let files = self.models.iter().map(|model| &model.file);
        for file in files.chain(self.tables.values().map(|table| &table.file)) {
            is_inside(file).then_some(()).ok_or_else(|| format!("file {file:?} leads out of the folder"))?;
        }
        Ok(())
    }
}

/// True if a path stays below the folder that it starts from.
pub(crate) fn is_inside(file: &str) -> bool {
    let mut parts = Path::new(file).components().peekable();
    parts.peek().is_some() && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// Format and version, which are read first: the rest may be of another version.
#[derive(Deserialize)]
struct Head {
    #[serde(default)]
    format: String,
    #[serde(default)]
    version: u64,
}

/// Serialises hashes as text: JSON has no integers of 64 bits.
mod hex {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub fn serialize<S: Serializer>(hash: &u64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&format!("{hash:#018x}"))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
        let text = String::deserialize(deserializer)?;
        let digits = text.strip_prefix("0x").unwrap_or(&text);
        u64::from_str_radix(digits, 16).map_err(|_| D::Error::custom(format!("{text:?} is no hash")))
    }
}
