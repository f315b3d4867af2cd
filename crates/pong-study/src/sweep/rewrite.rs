//! Models changed for a level: without friction, with other bounding volumes, with other leaves.

use crate::sweep::level::Level;
use pong_model::{Extensions, FrictionLaw, Model};

/// The model changed for a level; an error is a line of cause and cure.
pub(crate) fn model(mut model: Model, level: &Level) -> Result<Model, String> {
    if level.frictionless {
        drop_friction(&mut model);
    }
    if let Some(most) = level.leaf {
        model = model.with_leaves(most, &Extensions::new())?;
    }
    match &level.bounds {
        Some(kind) => model.with_bounds(kind, &Extensions::new()),
        None => Ok(model),
    }
}

/// Removes friction from every surface and from every pair.
fn drop_friction(model: &mut Model) {
    model.surfaces.iter_mut().for_each(|surface| surface.friction = FrictionLaw::None);
    for pair in &mut model.pair_overrides {
        pair.friction = pair.friction.as_ref().map(|_| FrictionLaw::None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_surface_and_no_pair_keeps_its_friction() {
        let text = r#"(format: "pong-model", version: 1, name: "m",
            surfaces: { "s": (stiffness: 1e5, friction: Bristle(mu: 0.5)), "t": (stiffness: 1e6, friction: Bristle(mu: 0.1)) },
            pairs: [(surfaces: ("s", "t"), friction: Bristle(mu: 0.3)), (surfaces: ("s", "s"), stiffness: 2e5)],
            root: (name: "m", surface: "s", primitives: [Point(name: "p", position: (0, 0, 0))]))"#;
        let mut model = pong_model::parse(text, "m.ron", None, &Extensions::new()).unwrap();
        drop_friction(&mut model);
        assert!(model.surfaces.iter().all(|surface| surface.friction == FrictionLaw::None));
        let pairs: Vec<_> = model.pair_overrides.iter().map(|pair| pair.friction.clone()).collect();
        assert_eq!(pairs, [Some(FrictionLaw::None), None]);
    }
}
