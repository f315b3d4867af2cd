//! run.json from a sealed world.

use super::options::RecordOptions;
use crate::format::{FORMAT, VERSION};
use crate::run::{Run, RunAccounts, RunBody, RunFilter, RunModel, RunObject, RunPrimitive, RunTable};
use crate::table::{ContactRow, EnergyRow, FrameRow, Row, StateRow, WrenchRow};
use pong_engine::{EngineError, ObjectId, World};

/// The contents of run.json at the start of a log. `models` are the files of the models in the folder of the
/// log.
pub(crate) fn describe(
    world: &World,
    models: Vec<RunModel>,
    options: &RecordOptions,
) -> Result<Run, EngineError> {
    let mut objects = Vec::new();
    let (mut bodies, mut primitives) = (Vec::new(), Vec::new());
    for object in world.scene().objects() {
        let name = world.scene().object_name(object)?;
        let model = world.scene().model_of(object)?;
        let first = bodies.len();
        for (body, interface) in model.bodies.iter().zip(world.scene().interfaces(object)?) {
            primitives.extend(body.primitives.iter().map(|primitive| RunPrimitive {
                body: bodies.len(),
                path: primitive.path.clone(),
                kind: format!("{:?}", primitive.kind),
                surface: model.surfaces[primitive.surface as usize].name.clone(),
            }));
            bodies.push(RunBody {
                name: world.scene().group_name(interface)?,
                object: object.index(),
                path: body.path.clone(),
                parent: body.parent.map(|parent| first + parent as usize),
            });
        }
        objects.push(RunObject { name: name.to_owned(), model: world.scene().model_id_of(object)?.index() });
    }
    let names = [FrameRow::TABLE, StateRow::TABLE, WrenchRow::TABLE, ContactRow::TABLE];
    let names = names.into_iter().chain(options.energies.then_some(EnergyRow::TABLE));
    Ok(Run {
        format: FORMAT.to_owned(),
        version: VERSION,
        name: options.name.clone(),
        writer: options.writer.clone(),
        engine: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: world.scene_hash(),
        step: options.step,
        commits_per_frame: options.commits_per_frame,
        integrator: options.integrator.clone(),
        contact_capacity: Some(world.contact_capacity() as u64),
        ledger: world.scene().keeps_ledger(),
        energy_accounts: world.scene().wrench_coupling().map(RunAccounts),
        laws: world.scene().law_names().map(str::to_owned).collect(),
        models,
        objects,
        bodies,
        pairs: world.scene().pairs().map(|(_, pair)| pair.map(|object| object.index())).collect(),
        filters: filters(world),
        primitives,
        tables: names.map(|name| (name.to_owned(), RunTable { file: file(name), rows: None })).collect(),
        finished: false,
        frames: None,
        lost: 0,
    })
}

fn filters(world: &World) -> Vec<RunFilter> {
    let filter = |(objects, groups): ([ObjectId; 2], [&str; 2])| RunFilter {
        objects: objects.map(|object| object.index()),
        groups: groups.map(str::to_owned),
    };
    world.scene().filters().map(filter).collect()
}

/// The file of a table.
pub(super) fn file(table: &str) -> String {
    format!("{table}.npy")
}
