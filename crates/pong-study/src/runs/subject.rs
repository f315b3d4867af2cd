//! A model to be tuned: its text, and the settings of its groups.

use crate::{Result, StudyError};
use pong_model::Model;
use pong_model::grouping::{self, Bound, Group, Regrouped};
use pong_model::{Extensions, Fnv};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bounding volume of one group, and the size of its leaves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Setting {
    pub bound: Bound,
    pub leaf_size: Option<usize>,
}

/// A setting for every group of a model, in the order of its file.
pub(crate) type Grouping = Vec<Setting>;

/// The groups of a model, with the data that a search needs.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    /// Name of the model.
    pub name: String,
    pub groups: Vec<Group>,
    /// Number of elements directly in each group.
    pub elements: Vec<usize>,
}

/// A model file.
pub(crate) struct Subject {
    pub file: PathBuf,
    /// True if it is the copy in a log's folder.
    pub in_log: bool,
    pub text: String,
    pub hash: u64,
    pub shape: Shape,
    pub extensions: Extensions,
}

/// A model made for a grouping.
pub(crate) struct Made {
    pub model: Arc<Model>,
    /// Hash of its trees: models with equal trees have the same cost.
    pub trees: u64,
}

impl Shape {
    /// The settings in the file itself.
    pub fn authored(&self) -> Grouping {
        let setting = |group: &Group| Setting { bound: group.bound.clone(), leaf_size: group.leaf_size };
        self.groups.iter().map(setting).collect()
    }

    /// Child groups of a group.
    pub fn below(&self, group: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.groups.len()).filter(move |other| self.groups[*other].above == Some(group))
    }

    /// Number of elements in the leaf of a group: its own, and those of groups below without a volume.
    pub fn leaf(&self, grouping: &Grouping, group: usize) -> usize {
        if grouping[group].bound == Bound::Above {
            return 0;
        }
        self.gathered(grouping, group)
    }

    fn gathered(&self, grouping: &Grouping, group: usize) -> usize {
        let below = self.below(group).filter(|below| grouping[*below].bound == Bound::Above);
        self.elements[group] + below.map(|below| self.gathered(grouping, below)).sum::<usize>()
    }
}

impl Subject {
    /// Reads a model file.
    pub fn load(file: &Path, in_log: bool, extensions: &Extensions) -> Result<Self> {
        let text = pong_model::files::read_text(file).map_err(|reason| {
            StudyError::file(file, format!("{reason}; name a run whose models can be read"))
        })?;
        let model = pong_model::load(file, extensions)?;
        let groups = grouping::groups(&text).map_err(|line| StudyError::file(file, line))?;
        let elements = elements(&model, &groups);
        let shape = Shape { name: model.name.clone(), groups, elements };
        let extensions = extensions.clone();
        Ok(Self { file: file.to_owned(), in_log, text, hash: model.hash, shape, extensions })
    }

    /// The text of the file with the settings of a grouping.
    pub fn text(&self, grouping: &Grouping) -> Result<String> {
        let changes: Vec<Regrouped> = self
            .shape
            .groups
            .iter()
            .zip(grouping)
            .map(|(group, setting)| Regrouped {
                path: group.path.clone(),
                bound: setting.bound.clone(),
                leaf_size: setting.leaf_size,
            })
            .collect();
        grouping::regrouped(&self.text, &changes).map_err(|line| StudyError::file(&self.file, line))
    }

    /// The model with a grouping, read from its text as a file would be.
    pub fn make(&self, grouping: &Grouping) -> Result<Made> {
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let text = self.text(grouping)?;
        let model =
            pong_model::parse(&text, &self.file.display().to_string(), Some(folder), &self.extensions)?;
        if model.hash != self.hash {
            let line = "its meshes were changed meanwhile; run it again and leave them as they are";
            return Err(StudyError::file(&self.file, line));
        }
        Ok(Made { trees: hash_of_trees(&model), model: Arc::new(model) })
    }
}

/// Number of elements directly in each group.
fn elements(model: &Model, groups: &[Group]) -> Vec<usize> {
    let mut counts = vec![0; groups.len()];
    for primitive in model.bodies.iter().flat_map(|body| &body.primitives) {
        let above = primitive.path.rsplit_once('/').map_or("", |(above, _)| above);
        if let Some(group) = groups.iter().position(|group| group.path == above) {
            counts[group] += primitive.elements.len();
        }
    }
    counts
}

/// A hash of all bounding trees of a model.
pub(crate) fn hash_of_trees(model: &Model) -> u64 {
    let mut hash = Fnv::default();
    for body in &model.bodies {
        for node in &body.tree.nodes {
            hash.text(&format!("{:?} {:?} {:?}", node.volume, node.children, node.items));
        }
        for item in &body.tree.items {
            hash.word(u64::from(item.primitive) << 32 | u64::from(item.element));
        }
    }
    hash.value()
}
