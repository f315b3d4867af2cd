//! Models and what they are called here.

use pong_model::{Model, printable};
use std::sync::Arc;

/// A model and what it is called here.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) model: Arc<Model>,
}

/// Two models of one name are told apart by a number.
pub(super) fn name(earlier: &[Named], model: Model) -> Named {
    // Only shown: the engine is given this name too, which nothing else sees.
    let own = printable(&model.name).into_owned();
    let taken = |name: &str| earlier.iter().any(|other| other.name == name);
    let numbered = (2..).map(|number| format!("{own}#{number}"));
    let name = std::iter::once(own.clone()).chain(numbered).find(|name| !taken(name));
    Named { name: name.unwrap_or_default(), model: Arc::new(model) }
}
