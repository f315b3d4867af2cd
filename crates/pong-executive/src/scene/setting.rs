//! Models, objects and pairs of a scene, as a world.

use super::document::{BodyEntry, Document};
use super::error::{At, Faults};
use super::variation::Variation;
use pong_engine::{Config, EngineError, InterfaceId, Laws, ObjectId, SealReport, World, WorldBuilder};
use pong_model::{Extensions, Model};
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(crate) struct Setting<'a> {
    pub document: &'a Document,
    pub world: WorldBuilder,
    /// One entry for each object of the file; `None` where it could not be made, with the fault noted.
    pub objects: Vec<Option<ObjectId>>,
    /// Model of each object that could be made.
    pub models: Vec<Option<Arc<Model>>>,
    /// The file of each model of the world, in the world's order.
    pub model_files: Vec<PathBuf>,
    pub warnings: Vec<String>,
}

/// Results of a setting other than the world.
pub(crate) struct Made {
    /// One entry for each object of the file; `None` where it could not be made.
    pub objects: Vec<Option<ObjectId>>,
    /// The file of each model of the world, in the world's order.
    pub model_files: Vec<PathBuf>,
    pub warnings: Vec<String>,
}

/// A model under the name that the scene gives it; `None` if its file has a fault.
type Named<'a> = (&'a str, Option<Arc<Model>>);

impl<'a> Setting<'a> {
    pub fn new(
        document: &'a Document,
        (folder, extensions): (&Path, &Extensions),
        variation: &Variation<'_>,
        faults: &mut Faults<'_>,
    ) -> Self {
        let config = Config {
            contact_capacity: document.contact_capacity,
            ledger: document.ledger,
            workers: variation.workers.clone(),
            accounts: document.integrator.wrench_coupling().filter(|_| document.ledger),
            moving_surfaces: document
                .objects
                .iter()
                .flat_map(|object| &object.bodies)
                .any(BodyEntry::has_moving_surface),
        };
        let mut setting = Self {
            document,
            world: WorldBuilder::with_extensions(config, extensions.clone(), Laws::default()),
            objects: Vec::new(),
            models: Vec::new(),
            model_files: Vec::new(),
            warnings: Vec::new(),
        };
        let named = load_models(document, folder, extensions, variation, faults);
        setting.warnings =
            named.iter().flat_map(|(_, model)| model.iter().flat_map(|m| m.warnings.clone())).collect();
        setting.create_objects(&named, faults);
        let files = setting.world.scene().models().map(|(_, added)| {
            let name = named.iter().find(|(_, model)| model.as_ref().is_some_and(|m| Arc::ptr_eq(m, added)));
            let file = name.and_then(|(name, _)| document.models.iter().find(|(other, _)| other == name));
            folder.join(file.map_or("", |(_, file)| file))
        });
        setting.model_files = files.collect();
        setting
    }

    fn create_objects(&mut self, named: &[Named<'_>], faults: &mut Faults<'_>) {
        let mut ids = vec![None; named.len()];
        for entry in &self.document.objects {
            let thing = format!("objects/{}", entry.name);
            if entry.name.is_empty() || entry.name.contains('/') {
                let cause = format!("the name {:?} cannot be told from a path", entry.name);
                faults.note(&thing, cause, "give a name without `/`");
            }
            let found = named.iter().position(|(name, _)| *name == entry.model);
            if found.is_none() {
                let known: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
                let cause = format!("there is no model `{}`", entry.model);
                faults.note(&thing, cause, format!("list it in `models`; known: {}", known.join(", ")));
            }
            let model = found.and_then(|index| named[index].1.clone().map(|model| (index, model)));
            let made = model.as_ref().and_then(|(index, model)| {
                let id = *ids[*index].get_or_insert_with(|| self.world.add_model(Arc::clone(model)));
                let made = self.world.create_object(id, &entry.name);
                made.map_err(|error| faults.note_line(&thing, &error.to_string())).ok()
            });
            self.objects.push(made);
            self.models.push(model.map(|(_, model)| model));
        }
    }

    /// The Interface named by `object` or `object/path`; notes a fault if there is none.
    pub fn interface(&self, name: &str, at: &mut At<'_, '_>) -> Option<InterfaceId> {
        let (object, path) = name.split_once('/').unwrap_or((name, ""));
        let Some(index) = self.document.objects.iter().position(|entry| entry.name == object) else {
            let known: Vec<&str> = self.document.objects.iter().map(|entry| entry.name.as_str()).collect();
            let cure = format!("write `object` or `object/path of the group`; known: {}", known.join(", "));
            at.note(format!("there is no object `{object}`"), cure);
            return None;
        };
        // The fault of an object that could not be made is noted already.
        let id = self.objects[index]?;
        let found = self.world.scene().interface(id, path);
        found.map_err(|error| at.note_line(&error.to_string())).ok()
    }

    pub fn pair(&mut self, faults: &mut Faults<'_>) {
        for (a, b) in self.document.pairs() {
            let thing = format!("pairs/({a}, {b})");
            let objects = &self.document.objects;
            let find = |name: &str| objects.iter().position(|entry| entry.name == name);
            for name in [a, b].into_iter().filter(|name| find(name).is_none()) {
                faults.note(&thing, format!("there is no object `{name}`"), "pair names from `objects`");
            }
            let made = |name| find(name).and_then(|index: usize| self.objects[index]);
            if let (Some(a), Some(b)) = (made(a), made(b))
                && let Err(error) = self.world.pair(a, b)
            {
                faults.note_line(&thing, &error.to_string());
            }
        }
    }

    /// Checks that `passes_through` names pairs of the scene.
    pub fn check_passes_through(&self, faults: &mut Faults<'_>) {
        for named in &self.document.passes_through {
            if !self.document.pairs().iter().any(|pair| is_same_pair(pair, named)) {
                let cause = "`pairs` has no such entry";
                let cure = "name two objects as an entry of `pairs` does, or leave it out";
                faults.note(format!("passes_through/({}, {})", named.0, named.1), cause, cure);
            }
        }
    }

    /// Excludes contacts between the groups of `filters`.
    pub fn filter(&mut self, faults: &mut Faults<'_>) {
        for (a, b) in &self.document.filters {
            let thing = format!("filters/({a}, {b})");
            let mut side = |name: &str| {
                let (object, path) = name.split_once('/').unwrap_or((name, ""));
                let found = self.document.objects.iter().position(|entry| entry.name == object);
                if found.is_none() {
                    let known: Vec<&str> =
                        self.document.objects.iter().map(|entry| entry.name.as_str()).collect();
                    let cure = format!("write `object/path of the group`; known: {}", known.join(", "));
                    faults.note(&thing, format!("there is no object `{object}`"), cure);
                }
                // The fault of an object that could not be made is noted already.
                found.and_then(|index| self.objects[index]).map(|object| (object, path.to_owned()))
            };
            if let (Some((a, path_a)), Some((b, path_b))) = (side(a), side(b))
                && let Err(error) = self.world.filter(a, &path_a, b, &path_b)
            {
                faults.note_line(&thing, &error.to_string());
            }
        }
    }

    /// Seals the world; returns it with the rest of the setting.
    pub fn seal(self, faults: &mut Faults<'_>) -> (Option<(World, SealReport)>, Made) {
        let Self { world, objects, model_files, warnings, .. } = self;
        let sealed = world.seal().map_err(EngineError::from).map_err(|error| match error {
            EngineError::Seal { problems } => {
                problems.iter().for_each(|problem| faults.note_line("pairs", problem));
            }
            error => faults.note_line("pairs", &error.to_string()),
        });
        (sealed.ok(), Made { objects, model_files, warnings })
    }
}

/// True if two entries name the same two objects, in either order.
pub(super) fn is_same_pair(one: &(String, String), other: &(String, String)) -> bool {
    one == other || (&one.0, &one.1) == (&other.1, &other.0)
}

fn load_models<'a>(
    document: &'a Document,
    folder: &Path,
    extensions: &Extensions,
    variation: &Variation<'_>,
    faults: &mut Faults<'_>,
) -> Vec<Named<'a>> {
    let mut named: Vec<Named<'a>> = Vec::new();
    for (name, file) in &document.models {
        let thing = format!("models/{name}");
        if named.iter().any(|(earlier, _)| earlier == name) {
            faults.note(&thing, "the name is given twice", "keep one of them or rename one");
            continue;
        }
        let file = folder.join(file);
        if let Some(model) = variation.instead.and_then(|instead| instead(&file)) {
            named.push((name, Some(model)));
            continue;
        }
        let model = match pong_model::load(&file, extensions) {
            Ok(model) => Some(model),
            Err(errors) => {
                errors.0.iter().for_each(|error| faults.note(&thing, error.to_string(), ""));
                None
            }
        };
        let model = model.and_then(|model| match variation.rewrite {
            None => Some(model),
            Some(rewrite) => rewrite(model).map_err(|line| faults.note_line(&thing, &line)).ok(),
        });
        named.push((name, model.map(Arc::new)));
    }
    named
}
