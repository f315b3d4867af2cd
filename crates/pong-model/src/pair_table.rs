//! Entries of the pair tables that apply to two surfaces.

use crate::model::Model;
use crate::surface::{PairOverride, Surface};

/// Entries of the tables of two models that apply to a surface of each, with the models that contain them. Of
/// all entries that name both surfaces, only the most specific ones are returned: those that name most models
/// explicitly.
pub fn pair_entries<'m>(
    (model_a, a): (&'m Model, &Surface),
    (model_b, b): (&'m Model, &Surface),
) -> Vec<(&'m Model, &'m PairOverride)> {
    let models = [model_a, model_b].into_iter().take(if std::ptr::eq(model_a, model_b) { 1 } else { 2 });
    let named = models.flat_map(|model| model.pair_overrides.iter().map(move |entry| (model, entry)));
    let (a, b) = ((model_a.name.as_str(), a.name.as_str()), (model_b.name.as_str(), b.name.as_str()));
    let ranked: Vec<_> =
        named.filter_map(|(model, entry)| Some((entry.names_models(a, b)?, model, entry))).collect();
    let most = ranked.iter().map(|(rank, ..)| *rank).max();
    ranked
        .into_iter()
        .filter(|(rank, ..)| Some(*rank) == most)
        .map(|(_, model, entry)| (model, entry))
        .collect()
}
