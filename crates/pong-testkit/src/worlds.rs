//! Worlds of a few Objects.

use pong_engine::{Config, InterfaceId, SealReport, World, WorldBuilder};
use pong_model::Extensions;
use std::sync::Arc;

/// A sealed world of Objects `o0`, `o1`, …, of which the first is paired with each of the others; with the
/// seal report and the root of each Object.
pub fn paired_with_first(config: Config, models: &[&str]) -> (World, SealReport, Vec<InterfaceId>) {
    let mut builder = WorldBuilder::new(config);
    let mut objects = Vec::new();
    for (i, text) in models.iter().enumerate() {
        let model = pong_model::parse(text, "test.ron", None, &Extensions::new());
        let model = builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}\n{text}"))));
        objects.push(builder.create_object(model, &format!("o{i}")).expect("the names differ"));
    }
    for other in &objects[1..] {
        builder.pair(objects[0], *other).expect("two Objects");
    }
    let roots = |object: &_| builder.scene().interface(*object, "").expect("every Object has a root");
    let roots = objects.iter().map(roots).collect();
    let (world, report) = builder.seal().unwrap_or_else(|error| panic!("{error}"));
    (world, report, roots)
}
