//! Models and their names in the output.

use pong_geometry::Pose;
use pong_model::{Model, printable};
use std::sync::Arc;

/// A model, its name in the output, and the pose of its root.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) model: Arc<Model>,
    pub(super) pose: Pose,
}

/// Names a model; models with the same name get a number.
pub(super) fn name(earlier: &[Named], model: Model, pose: Pose) -> Named {
    // Escaped for display. The engine gets this name too, but does not show it anywhere else.
    let own = printable(&model.name).into_owned();
    let taken = |name: &str| earlier.iter().any(|other| other.name == name);
    let numbered = (2..).map(|number| format!("{own}#{number}"));
    let name = std::iter::once(own.clone()).chain(numbered).find(|name| !taken(name));
    Named { name: name.unwrap_or_default(), model: Arc::new(model), pose }
}
