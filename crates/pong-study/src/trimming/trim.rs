//! The whole procedure: read runs, measure distances, remove far primitives, repeat the runs, write files.

pub use super::choice::Gone;
use super::choice::gone;
use super::nearness::{Measure, Nearness, key, testers};
use crate::runs::Counts;
use crate::runs::motions::Motions;
use crate::runs::output::{Output, headed};
use crate::runs::play::Compared;
use crate::runs::run::Run;
use crate::runs::subject::Subject;
use crate::{Result, StudyError};
use pong_engine::World;
use pong_model::{Extensions, Model, trimming};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Suffix of the names of trimmed files, and the text at their head.
const TRIMMED: &str = "trimmed";
const DONE: &str = "What never came near left out by `pong trim`";

/// Settings of trimming.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Primitives that came no nearer than this to any partner are removed, m.
    pub margin: f64,
    /// Number of timings of before and after, in turn.
    pub rounds: u32,
    /// Frames of each run that are timed.
    pub frames: u64,
    /// Part of each run to use, s.
    pub duration_s: Option<f64>,
    /// Output of files.
    pub output: Output,
    /// Extensions for the models, and the folders allowed for their files.
    pub extensions: Extensions,
}

/// Result of trimming.
#[derive(Clone, Debug)]
pub struct Trimmed {
    /// The margin, m.
    pub margin: f64,
    /// The runs, in the order they were given.
    pub runs: Vec<RunTrimmed>,
    /// The models, each once.
    pub models: Vec<ModelTrimmed>,
}

/// A run before and after.
#[derive(Clone, Debug)]
pub struct RunTrimmed {
    /// Its name.
    pub name: String,
    /// Frames, all of them compared.
    pub frames: u64,
    /// The shortest time of each timed frame, before and after, ns.
    pub times_ns: [Vec<u64>; 2],
    /// Counts over these frames, before and after.
    pub counts: [Counts; 2],
    /// Tested pairs of primitives by their kinds, A's first: before and after.
    pub testers: BTreeMap<(String, String), [usize; 2]>,
}

/// A model before and after.
#[derive(Clone, Debug)]
pub struct ModelTrimmed {
    /// Its name.
    pub name: String,
    /// Its file.
    pub file: PathBuf,
    /// Number of its primitives.
    pub primitives: usize,
    /// Removed primitives.
    pub gone: Vec<Gone>,
    /// Bounding volumes before and after.
    pub volumes: [usize; 2],
    /// The file that was written.
    pub written: Option<PathBuf>,
}

/// Called with the purpose of a run, its frames done and in all; its error ends the work.
pub type Watch<'a> = &'a mut dyn FnMut(&str, u64, u64) -> Result<()>;

/// Trims the models of some runs, each a scene file or the folder of a log: primitives that any of them came
/// near stay.
///
/// # Errors
/// A run or a model with a fault, an output file that exists or cannot be written, a run whose wrenches are
/// not the same bits without the removed primitives.
pub fn trim(paths: &[&Path], settings: &Settings, watch: Watch<'_>) -> Result<Trimmed> {
    check(settings)?;
    let mut subjects = Vec::new();
    let mut runs = Vec::new();
    for path in paths {
        runs.push(Run::load(path, settings.duration_s, &settings.extensions, &mut subjects)?);
    }
    settings.output.check(&subjects, TRIMMED)?;
    let mut nearness = Nearness::new();
    let mut before = Vec::new();
    let own = own_models(&subjects)?;
    for run in &runs {
        before.push(measured(run, &own, settings, &mut nearness, watch)?);
    }
    let candidates = subjects.iter().map(|subject| Candidate::new(subject, &nearness, settings.margin));
    let candidates = candidates.collect::<Result<Vec<_>>>()?;
    let made: Vec<Arc<Model>> = candidates.iter().map(|candidate| Arc::clone(&candidate.after)).collect();
    let mut compared = Vec::new();
    for (run, motions) in runs.iter().zip(&before) {
        compared.push(Comparison { run, before: motions, models: [&own, &made] }.finish(settings, watch)?);
    }
    let names = runs.iter().map(|run| run.name.as_str()).collect::<Vec<_>>().join("`, `");
    let models = candidates.iter().map(|candidate| candidate.write(&settings.output, &names));
    Ok(Trimmed { margin: settings.margin, runs: compared, models: models.collect::<Result<_>>()? })
}

fn check(settings: &Settings) -> Result<()> {
    if !(settings.margin >= 0.0 && settings.margin.is_finite()) {
        let line = format!("it is {} m; give a distance of zero or more", settings.margin);
        return Err(StudyError::new("--margin", line));
    }
    if settings.rounds == 0 || settings.frames == 0 {
        return Err(StudyError::new("settings", "nothing is timed; give at least 1 round and 1 frame"));
    }
    Ok(())
}

fn own_models(subjects: &[Subject]) -> Result<Vec<Arc<Model>>> {
    subjects.iter().map(|subject| Ok(subject.make(&subject.shape.authored())?.model)).collect()
}

/// Runs it unchanged; keeps its motions and adds its least distances.
fn measured(
    run: &Run,
    own: &[Arc<Model>],
    settings: &Settings,
    nearness: &mut Nearness,
    watch: Watch<'_>,
) -> Result<Motions> {
    let player = run.player(own)?;
    let refused = |error| run.refused(&error);
    let mut measure = Measure::new(player.world()).map_err(refused)?;
    let mut tick = ticker("measures", run, watch);
    let motions =
        run.gather_with(None, settings.frames, &mut |world: &World| measure.frame(world), &mut tick)?;
    measure.add_to(nearness);
    Ok(motions)
}

fn ticker<'w>(doing: &'w str, run: &'w Run, watch: Watch<'w>) -> impl FnMut(u64) -> Result<()> + use<'w> {
    move |done| match done.is_multiple_of(256) || done == run.frames {
        true => watch(&format!("{doing} {}", run.name), done, run.frames),
        false => Ok(()),
    }
}

/// A model and its trimmed form.
struct Candidate<'s> {
    subject: &'s Subject,
    before: Arc<Model>,
    after: Arc<Model>,
    text: String,
    gone: Vec<Gone>,
}

impl<'s> Candidate<'s> {
    fn new(subject: &'s Subject, nearness: &Nearness, margin: f64) -> Result<Self> {
        let before = subject.make(&subject.shape.authored())?.model;
        let least = nearness.get(&key(&before)).map_or(&[][..], Vec::as_slice);
        let gone = gone(&before, least, margin);
        let paths: BTreeSet<String> = gone.iter().map(|gone| gone.path.clone()).collect();
        let text =
            trimming::without(&subject.text, &paths).map_err(|line| StudyError::file(&subject.file, line))?;
        let folder = subject.file.parent().unwrap_or(Path::new(""));
        let after =
            pong_model::parse(&text, &subject.file.display().to_string(), Some(folder), &subject.extensions)?;
        Ok(Self { subject, before, after: Arc::new(after), text, gone })
    }

    fn write(&self, output: &Output, runs: &str) -> Result<ModelTrimmed> {
        let written = if self.gone.is_empty() {
            None
        } else {
            let expected = |model: &Model| model.hash == self.after.hash;
            let text = headed(&self.text, DONE, runs);
            Some(output.write((self.subject, TRIMMED), &text, &expected)?)
        };
        let volumes = |model: &Model| model.bodies.iter().map(|body| body.tree.nodes.len()).sum();
        Ok(ModelTrimmed {
            name: self.subject.shape.name.clone(),
            file: self.subject.file.clone(),
            primitives: self.before.bodies.iter().map(|body| body.primitives.len()).sum(),
            gone: self.gone.clone(),
            volumes: [volumes(&self.before), volumes(&self.after)],
            written,
        })
    }
}

/// A run with its own models, and with their trimmed forms.
struct Comparison<'r> {
    run: &'r Run,
    before: &'r Motions,
    models: [&'r [Arc<Model>]; 2],
}

impl Comparison<'_> {
    fn finish(&self, settings: &Settings, watch: Watch<'_>) -> Result<RunTrimmed> {
        let run = self.run;
        let after = run.gather_with(
            Some(self.models[1]),
            settings.frames,
            &mut |_| Ok(()),
            &mut ticker("compares", run, watch),
        )?;
        self.compare(&after)?;
        let motions = [self.before, &after];
        let mut players = [run.player(self.models[0])?, run.player(self.models[1])?];
        let refused = |error| run.refused(&error);
        let mut both = BTreeMap::new();
        for (place, player) in players.iter().enumerate() {
            for (kinds, count) in testers(player.world()) {
                both.entry(kinds).or_insert([0; 2])[place] = count;
            }
        }
        let mut counts = [Counts::default(), Counts::default()];
        let mut times_ns = [Vec::new(), Vec::new()];
        for place in 0..2 {
            match players[place].compare(motions[place], 1).map_err(refused)? {
                Compared::Same(counted) => counts[place] = counted,
                Compared::Differs(why) => {
                    let line = format!("played again, {why} differ; the run cannot be timed");
                    return Err(StudyError::new(&run.name, line));
                }
            }
        }
        for _ in 0..settings.rounds {
            for place in 0..2 {
                players[place].time(motions[place], 1, &mut times_ns[place]).map_err(refused)?;
            }
        }
        Ok(RunTrimmed { name: run.name.clone(), frames: run.frames, times_ns, counts, testers: both })
    }

    /// Checks that the wrenches of every frame are the same bits.
    fn compare(&self, after: &Motions) -> Result<()> {
        let (old, new) = (&self.before.answers, &after.answers);
        let differs = |frame: &usize| !new[*frame].has_wrenches_of(&old[*frame]);
        let first = if old.len() == new.len() { (0..old.len()).find(differs) } else { Some(0) };
        let Some(frame) = first else { return Ok(()) };
        let line = format!(
            "without what is to go, the wrenches of frame {frame} are other bits; give a larger --margin, and report it as a \
             fault if no margin helps"
        );
        Err(StudyError::new(&self.run.name, line))
    }
}
