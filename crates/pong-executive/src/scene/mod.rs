//! Scene files: models, initial states, loads, integrator (docs/scene_format.md).

mod bodies;
mod document;
mod effects;
mod error;
mod flush;
mod notation;
mod poses;
mod setting;
mod variation;

pub use error::{SceneError, SceneErrors};
pub use variation::Variation;

use crate::body::BodyId;
use crate::integrate::Integrator;
use crate::simulation::Simulation;
use document::Document;
use error::Faults;
use pong_engine::{FrictionPreload, ObjectId, PairId, SealReport, World};
use pong_model::Extensions;
use std::path::{Path, PathBuf};

/// A scene file as read: its notation is valid; [`build`](Self::build) checks the rest.
#[derive(Clone, Debug)]
pub struct Scene {
    file: String,
    folder: PathBuf,
    document: Document,
    extensions: Extensions,
}

/// A scene ready to run.
pub struct BuiltScene {
    /// Name as given in the file.
    pub name: String,
    /// Bodies, loads, world.
    pub simulation: Simulation,
    /// The objects in the order of the file.
    pub objects: Vec<SceneObject>,
    /// The file of each model of the world, in the world's order.
    pub model_files: Vec<PathBuf>,
    /// Report of sealing the world.
    pub seal: SealReport,
    /// Pairs of objects without any possible contact, except those named in `passes_through`.
    pub passing_through: Vec<[String; 2]>,
    /// Warnings for the authors of the models.
    pub warnings: Vec<String>,
    /// Number of steps in the duration.
    pub steps: u64,
    /// Steps from one record to the next.
    pub record_every: u64,
    /// True if energies are kept.
    pub ledger: bool,
    /// Preloads set in the initial contacts; to be set again if the initial state is changed.
    pub preload: Vec<(PairId, FrictionPreload)>,
}

/// An object of a scene.
#[derive(Clone, Debug)]
pub struct SceneObject {
    /// Name as given in the file.
    pub name: String,
    /// Its id in the world.
    pub object: ObjectId,
    /// Its bodies, in the order of the model's movable groups.
    pub bodies: Vec<BodyId>,
}

impl Scene {
    /// Reads a scene file; models are looked for beside it.
    ///
    /// # Errors
    /// A file that cannot be read, and every fault of its text, with line and column.
    pub fn load(path: &Path) -> Result<Self, SceneErrors> {
        let file = path.display().to_string();
        let folder = path.parent().unwrap_or(Path::new(""));
        match pong_model::files::read_text(path) {
            Ok(text) => Self::parse(&text, &file, folder),
            Err(reason) => {
                let mut faults = Faults::new(&file);
                faults.note("scene", reason.to_string(), "name a scene file that can be read");
                faults.unless_any(None)
            }
        }
    }

    /// Reads a scene from text. Errors call it `file`; models are looked for in `folder`.
    ///
    /// # Errors
    /// Every fault of the text, with line and column.
    pub fn parse(text: &str, file: &str, folder: &Path) -> Result<Self, SceneErrors> {
        let options =
            ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
        match options.from_str(text) {
            Ok(document) => Ok(Self {
                file: file.to_owned(),
                folder: folder.to_owned(),
                document,
                extensions: Extensions::new(),
            }),
            Err(error) => Err(SceneErrors(vec![notation::fault(text, file, &error)])),
        }
    }

    /// Returns this scene with models that may use these kinds, and read files from the folders that they
    /// allow.
    #[must_use]
    pub fn with_extensions(self, extensions: Extensions) -> Self {
        Self { extensions, ..self }
    }

    /// Kinds and folders that its models may use in addition.
    pub fn extensions(&self) -> &Extensions {
        &self.extensions
    }

    /// Name as given in the file.
    pub fn name(&self) -> &str {
        &self.document.name
    }

    /// The step, s.
    pub fn step(&self) -> f64 {
        self.document.step
    }

    /// The duration, s.
    pub fn duration(&self) -> f64 {
        self.document.duration
    }

    /// The integrator.
    pub fn integrator(&self) -> Integrator {
        self.document.integrator
    }

    /// Names of the alternatives, in the order of the file.
    pub fn alternatives(&self) -> impl Iterator<Item = &str> {
        self.document.alternatives.iter().map(|alternative| alternative.name.as_str())
    }

    /// The models: name and file of each as written in the scene, without those of alternatives.
    pub fn models(&self) -> impl ExactSizeIterator<Item = (&str, &str)> {
        self.document.models.iter().map(|(name, file)| (name.as_str(), file.as_str()))
    }

    /// Every model file that the scene names, including those of its alternatives, in the order of the file.
    pub fn model_files(&self) -> Vec<PathBuf> {
        let alternatives = self.document.alternatives.iter().flat_map(|alternative| &alternative.models);
        let files = self.document.models.iter().chain(alternatives);
        files.map(|(_, file)| self.folder.join(file)).collect()
    }

    /// Loads the models and sets everything up.
    ///
    /// # Errors
    /// Models that cannot be loaded, names that do not exist, and values out of range: all of them at once.
    pub fn build(&self) -> Result<BuiltScene, SceneErrors> {
        self.build_varied(&Variation::default())
    }

    /// As [`build`](Self::build), with changes to the scene.
    ///
    /// # Errors
    /// As [`build`](Self::build); also a variation that names what the scene does not have.
    pub fn build_varied(&self, variation: &Variation<'_>) -> Result<BuiltScene, SceneErrors> {
        let mut faults = Faults::new(&self.file);
        let document = &variation.document(&self.document, &mut faults);
        check_head(document, &mut faults);
        variation::check_alternatives(document, &mut faults);
        let place = (self.folder.as_path(), &self.extensions);
        let mut setting = setting::Setting::new(document, place, variation, &mut faults);
        let bodies = bodies::bodies(&setting, &mut faults);
        let loads = effects::loads(&setting, &bodies, &mut faults);
        let springs = effects::springs(&setting, &bodies, &mut faults);
        setting.pair(&mut faults);
        setting.filter(&mut faults);
        setting.check_passes_through(&mut faults);
        let flush = flush::warnings(&setting, &bodies);
        let (sealed, mut made) = setting.seal(&mut faults);
        let Some((world, seal)) = sealed.filter(|_| faults.list.is_empty()) else {
            return faults.unless_any(None);
        };
        let simulation = assemble(document, world, bodies, loads, springs);
        let mut simulation = simulation.map_err(|error| faults.note_line("scene", &error.to_string())).ok();
        let preload = match &mut simulation {
            Some(simulation) => effects::preload(document, simulation, &mut made.warnings, &mut faults),
            None => Vec::new(),
        };
        let built = simulation.map(|simulation| BuiltScene {
            name: document.name.clone(),
            objects: scene_objects(document, &made.objects, &simulation),
            simulation,
            model_files: made.model_files,
            passing_through: passing_through(document, &seal),
            seal,
            warnings: made.warnings.into_iter().chain(flush).chain(left_out_pairs(document)).collect(),
            steps: libm::round(document.duration / document.step) as u64,
            record_every: document.record_every,
            ledger: document.ledger,
            preload,
        });
        faults.unless_any(built)
    }
}

fn assemble(
    document: &Document,
    world: World,
    bodies: Vec<crate::RigidBody>,
    loads: Vec<crate::Load>,
    springs: Vec<crate::Spring>,
) -> Result<Simulation, crate::ExecutiveError> {
    let mut simulation = Simulation::new(world, document.integrator, document.step)?;
    simulation.set_gravity(document.gravity.into());
    for body in bodies {
        simulation.add_body(body)?;
    }
    for load in loads {
        simulation.add_load(load)?;
    }
    for spring in springs {
        simulation.add_spring(spring)?;
    }
    Ok(simulation)
}

fn left_out_pairs(document: &Document) -> Option<String> {
    let warning = "the scene has no `pairs`: nothing in it can touch; list who may touch whom, pairs: [(\"a\", \"b\")], or write \
                   pairs: [] if nothing is meant to";
    document.leaves_out_pairs().then(|| warning.to_owned())
}

fn passing_through(document: &Document, seal: &SealReport) -> Vec<[String; 2]> {
    let on_purpose = |[a, b]: &[String; 2]| {
        let pair = (a.clone(), b.clone());
        document.passes_through.iter().any(|named| setting::is_same_pair(named, &pair))
    };
    seal.untouchable_pairs.iter().filter(|pair| !on_purpose(pair)).cloned().collect()
}

fn scene_objects(
    document: &Document,
    objects: &[Option<ObjectId>],
    simulation: &Simulation,
) -> Vec<SceneObject> {
    let entries = document.objects.iter().zip(objects);
    let made = entries.filter_map(|(entry, object)| object.map(|object| (entry, object)));
    made.map(|(entry, object)| {
        let interfaces = simulation.world().scene().interfaces(object).unwrap_or_default();
        let body_of = |interface| {
            simulation.bodies().find(|(_, body)| body.interface == Some(interface)).map(|(id, _)| id)
        };
        let bodies = interfaces.into_iter().filter_map(body_of).collect();
        SceneObject { name: entry.name.clone(), object, bodies }
    })
    .collect()
}

/// Upper limit of steps: beyond it a run takes years, so the value is a typing error.
const STEPS_MAX: f64 = 1e12;

fn check_head(document: &Document, faults: &mut Faults<'_>) {
    if document.format != "pong-scene" {
        faults.note("format", format!("it is {:?}", document.format), "write format: \"pong-scene\"");
    }
    if document.version != 1 {
        faults.note("version", format!("it is {}", document.version), "this program reads version: 1");
    }
    if !(document.step > 0.0 && document.step.is_finite()) {
        faults.note("step", format!("it is {} s", document.step), "give a finite time above zero");
    }
    if !(document.duration >= 0.0 && document.duration.is_finite()) {
        faults.note("duration", format!("it is {} s", document.duration), "give a finite time from zero up");
    }
    let steps = document.duration / document.step;
    if document.step > 0.0 && document.duration.is_finite() && steps > STEPS_MAX {
        faults.note(
            "duration",
            format!("{:?} s are {steps:.0e} steps of {:?} s", document.duration, document.step),
            format!("give at most {STEPS_MAX:e} steps"),
        );
    }
    if document.record_every == 0 {
        faults.note("record_every", "it is 0", "give the number of steps between records, at least 1");
    }
    if let Integrator::ZeroOrderHold { substeps: 0, .. } = document.integrator {
        faults.note("integrator", "0 substeps leave nothing to integrate", "give at least one substep");
    }
    if let Integrator::LongFrame { substeps_max, delay_frames } = document.integrator
        && (substeps_max == 0 || delay_frames > pong_slow::Settings::DELAY_FRAMES_MAX)
    {
        let most = pong_slow::Settings::DELAY_FRAMES_MAX;
        let cause = format!("{substeps_max} substeps and {delay_frames} delay frames cannot be followed");
        faults.note("integrator", cause, format!("give at least 1 substep and at most {most} delay frames"));
    }
    faults.at("gravity").finite("gravity", &document.gravity);
}
