//! Rebuilding the world of a log.

use super::options::ReplayOptions;
use crate::error::LogError;
use crate::event::Event;
use crate::read::Log;
use pong_engine::{Config, ModelId, Scene, World, WorldBuilder};
use pong_model::Model;
use std::sync::Arc;

/// The sealed world and the ids of its models.
pub(super) fn world(log: &Log, options: &ReplayOptions<'_>) -> Result<(World, Vec<ModelId>), LogError> {
    let run = log.run();
    let config = Config {
        contact_capacity: run.contact_capacity.map(|capacity| capacity as usize),
        ledger: run.ledger,
        workers: options.workers.clone(),
        accounts: run.energy_accounts.map(|accounts| accounts.0),
        moving_surfaces: log.events().iter().any(|event| matches!(event.event, Event::SurfaceMotion { .. })),
    };
    let mut builder = WorldBuilder::with_extensions(config, options.extensions.clone(), options.laws.clone());
    if let Some(law) =
        run.laws.iter().find(|law| !builder.scene().law_names().any(|known| known == law.as_str()))
    {
        let cause = format!("force law `{law}` was the host's own and is not in the log");
        return Err(LogError::refused(
            cause,
            "replay it in a program that registers the law (pong_record::replay)",
        ));
    }
    let mut models = Vec::new();
    for (index, model) in run.models.iter().enumerate() {
        if let Some(at_hand) = options.instead.and_then(|instead| instead(index)) {
            models.push(builder.add_model(at_hand));
            continue;
        }
        let loaded = load_model(builder.scene(), log, index, &model.name, model.hash)?;
        let wanted = match options.rewrite {
            None => Ok(loaded),
            Some(rewrite) => rewrite(index, loaded),
        };
        let wanted = wanted.map_err(|line| {
            let (cause, cure) = line.split_once("; ").unwrap_or((&line, "leave the model as it is"));
            LogError::Model { name: model.name.clone(), cause: cause.to_owned(), cure: cure.to_owned() }
        })?;
        models.push(builder.add_model(Arc::new(wanted)));
    }
    let mut objects = Vec::new();
    for object in &run.objects {
        objects.push(builder.create_object(models[object.model], &object.name)?);
    }
    for [a, b] in &run.pairs {
        builder.pair(objects[*a], objects[*b])?;
    }
    for filter in &run.filters {
        let ([a, b], [group_a, group_b]) = (filter.objects, &filter.groups);
        builder.filter(objects[a], group_a, objects[b], group_b)?;
    }
    let (world, _) = builder.seal()?;
    check(&world, log, options)?;
    Ok((world, models))
}

fn load_model(scene: &Scene, log: &Log, index: usize, name: &str, hash: u64) -> Result<Model, LogError> {
    let path = log.model_path(index).unwrap_or_default();
    let fails =
        |cause: String, cure: &str| LogError::Model { name: name.to_owned(), cause, cure: cure.to_owned() };
    let model = pong_model::load(&path, scene.extensions()).map_err(|errors| {
        fails(
            errors.to_string(),
            "use another copy of the log; kinds of the host's own need a program that knows them",
        )
    })?;
    if model.hash != hash {
        let cause = format!("{} has hash {:#018x}, the log says {hash:#018x}", path.display(), model.hash);
        return Err(fails(cause, "put the file back that the log was written with"));
    }
    Ok(model)
}

fn check(world: &World, log: &Log, options: &ReplayOptions<'_>) -> Result<(), LogError> {
    let (run, hash) = (log.run(), world.scene_hash());
    let mut columns = 0;
    for object in world.scene().objects() {
        columns += world.scene().interfaces(object)?.len();
    }
    if columns != run.bodies.len() {
        let cause = format!("it has {} bodies, its models have {columns}", run.bodies.len());
        return Err(LogError::damaged(&log.folder().join(crate::run::FILE), cause));
    }
    if hash != run.scene_hash && options.tolerance.is_none() {
        let cause = format!(
            "the world built from it has hash {hash:#018x}, its own had {:#018x} (engine {}, this is {})",
            run.scene_hash,
            run.engine,
            env!("CARGO_PKG_VERSION")
        );
        return Err(LogError::refused(cause, "use the version that wrote it, or compare with a tolerance"));
    }
    Ok(())
}
