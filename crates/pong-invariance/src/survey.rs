//! Surveys of many scenes on all cores, with each kind of disagreement reduced.

use crate::base::Base;
use crate::invariances::{INVARIANCES, Invariance, numbers, scene};
use crate::judge::{Finding, Verdict};
use crate::make;
use crate::reduce;
use crate::scene::Scene;
use crate::text;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Options of a survey.
#[derive(Clone, Debug)]
pub struct Order {
    /// Seed of all scenes.
    pub seed: u64,
    /// Index of the first scene.
    pub first: u64,
    /// Number of scenes.
    pub scenes: u64,
    /// Names of the invariances to check; all if empty.
    pub only: Vec<String>,
    /// Family of the scenes, where an invariance does not generate its own; all if `None`.
    pub family: Option<String>,
    /// Number of threads.
    pub threads: usize,
    /// Number of disagreements per invariance and family that are reduced and kept.
    pub kept: usize,
}

impl Order {
    /// Options of the command that reproduces the scene of an index.
    fn again(&self, name: &str, family: Option<&str>, index: u64) -> String {
        let family = family.map_or(String::new(), |family| format!(" --family {family}"));
        format!("--only {name}{family} --seed {} --first {index} --scenes 1", self.seed)
    }
}

/// Counts of one invariance.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Scenes compared.
    pub compared: u64,
    /// Answers that differ at a true discontinuity.
    pub at_a_jump: u64,
    /// Answers that differ.
    pub differ: u64,
    /// Largest difference, relative to the largest term.
    pub worst: f64,
    /// Differences by family of scene.
    pub families: BTreeMap<&'static str, u64>,
    /// Discontinuities by family of scene.
    pub jumps: BTreeMap<&'static str, u64>,
}

/// Summary of a scene that disagrees.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Listed {
    /// Index of the scene.
    pub index: u64,
    /// Name of the invariance.
    pub name: &'static str,
    /// Family of the scene.
    pub family: &'static str,
    /// First frame that differs.
    pub frame: usize,
    /// Difference relative to the largest term.
    pub relative: f64,
    /// Options of the command that reproduces it.
    pub again: String,
}

/// A reduced disagreement.
#[derive(Clone, Debug)]
pub struct Found {
    /// Name of the invariance.
    pub name: &'static str,
    /// Options of the command that reproduces it.
    pub again: String,
    /// The scene as generated.
    pub whole: Scene,
    /// The smallest scene that still disagrees.
    pub scene: Scene,
    /// The disagreement of the reduced scene.
    pub finding: Finding,
}

/// Results of a survey.
#[derive(Debug, Default)]
pub struct Survey {
    /// Scenes made.
    pub scenes: u64,
    /// Number of scenes that the loader or the engine refused.
    pub refused: u64,
    /// Examples of refusals.
    pub refusals: Vec<String>,
    /// Counts by invariance.
    pub tallies: BTreeMap<&'static str, Tally>,
    /// Some disagreements, reduced.
    pub found: Vec<Found>,
    /// All disagreements, in the order of the scenes.
    pub listed: Vec<Listed>,
}

/// In a survey of all families, a scene of round parts accompanies one in this many scenes; the other scenes
/// keep their numbers.
const ROUND_EVERY: u64 = 2;

/// In a survey of all families, a scene of solids accompanies one in this many scenes.
const VOLUME_EVERY: u64 = 4;

/// In a survey of all families, a scene of moving or declared surfaces accompanies one in this many scenes.
const SURFACE_EVERY: u64 = 8;

/// Scenes that a thread takes at a time.
const PORTION: u64 = 64;

/// Largest accepted share of comparisons within rounding of a true discontinuity: contact points are placed
/// on edges, corners and ties on purpose. A larger share would indicate false discontinuities.
pub const JUMPS_MOST: f64 = 2e-2;

impl Survey {
    /// Runs a survey.
    pub fn run(order: &Order, progress: &(impl Fn(u64) + Sync)) -> Self {
        let asked = |invariance: &&Invariance| {
            order.only.is_empty() || order.only.iter().any(|name| name == invariance.name)
        };
        let asked: Vec<&'static Invariance> = INVARIANCES.iter().filter(asked).collect();
        let next = AtomicU64::new(0);
        let total = Mutex::new(Self::default());
        std::thread::scope(|threads| {
            for _ in 0..order.threads.max(1) {
                threads.spawn(|| {
                    let mut mine = Self::default();
                    loop {
                        let from = next.fetch_add(PORTION, Ordering::Relaxed);
                        if from >= order.scenes {
                            break;
                        }
                        for index in from..order.scenes.min(from + PORTION) {
                            mine.one(order, &asked, order.first + index);
                        }
                        progress(order.scenes.min(from + PORTION));
                    }
                    if let Ok(mut total) = total.lock() {
                        total.add(mine, order.kept);
                    }
                });
            }
        });
        let mut total = total.into_inner().unwrap_or_default();
        total.listed.sort_by(|a, b| (a.index, a.name).cmp(&(b.index, b.name)));
        total
    }

    /// One index: a scene of the requested family, or one of points to ellipsoids, one with round parts, one of
    /// solids, and one of moving or declared surfaces.
    fn one(&mut self, order: &Order, asked: &[&'static Invariance], index: u64) {
        match order.family.as_deref() {
            Some(make::round::ALL) => {
                self.one_of(order, &of_shared_scenes(asked), Some(make::round::family(index)), index);
            }
            Some(make::volumes::ALL) => {
                self.one_of(order, &of_shared_scenes(asked), Some(make::volumes::family(index)), index);
            }
            Some(make::belts::ALL) => {
                self.one_of(order, &of_shared_scenes(asked), Some(make::belts::family(index)), index);
            }
            Some(family) => self.one_of(order, asked, Some(family), index),
            None => {
                self.one_of(order, asked, None, index);
                if index.is_multiple_of(ROUND_EVERY) {
                    let family = make::round::family(index / ROUND_EVERY);
                    self.one_of(order, &of_shared_scenes(asked), Some(family), index);
                }
                if index % VOLUME_EVERY == 1 {
                    let family = make::volumes::family(index / VOLUME_EVERY);
                    self.one_of(order, &of_shared_scenes(asked), Some(family), index);
                }
                if index % SURFACE_EVERY == 3 {
                    let family = make::belts::family(index / SURFACE_EVERY);
                    self.one_of(order, &of_shared_scenes(asked), Some(family), index);
                }
            }
        }
    }

    /// The scene of a family against all twins, and the scenes that invariances generate themselves.
    fn one_of(&mut self, order: &Order, asked: &[&'static Invariance], family: Option<&'_ str>, index: u64) {
        let mut shared = None;
        for invariance in asked.iter().filter(|invariance| index.is_multiple_of(invariance.every)) {
            let mut own = None;
            let base = match invariance.make {
                Some(_) => {
                    self.base(invariance, order.seed, (family, index), &mut own);
                    &mut own
                }
                None => {
                    if shared.is_none() {
                        self.base(invariance, order.seed, (family, index), &mut shared);
                        if shared.is_none() {
                            // A scene refused once is refused by every invariance.
                            return;
                        }
                    }
                    &mut shared
                }
            };
            if let Some(base) = base {
                self.judge(order, invariance, (family, index), base);
            }
        }
    }

    fn base(
        &mut self,
        invariance: &Invariance,
        seed: u64,
        (family, index): (Option<&str>, u64),
        out: &mut Option<Base>,
    ) {
        self.scenes += 1;
        match Base::new(scene(invariance, family, seed, index)) {
            Ok(base) => *out = Some(base),
            Err(refusal) => {
                self.refused += 1;
                if self.refusals.len() < 5 {
                    self.refusals.push(format!("{} {index}: {refusal}", invariance.name));
                }
            }
        }
    }

    fn judge(
        &mut self,
        order: &Order,
        invariance: &'static Invariance,
        (family, index): (Option<&str>, u64),
        base: &mut Base,
    ) {
        let verdict = invariance.judge(base, &mut numbers(invariance, order.seed, index));
        let tally = self.tallies.entry(invariance.name).or_default();
        match verdict {
            Verdict::DoesNotApply => {}
            Verdict::Agrees => tally.compared += 1,
            Verdict::AtAJump(_) => {
                tally.compared += 1;
                tally.at_a_jump += 1;
                *tally.jumps.entry(base.scene.family).or_default() += 1;
            }
            Verdict::Differs(finding) => {
                tally.compared += 1;
                tally.differ += 1;
                tally.worst = tally.worst.max(finding.relative);
                *tally.families.entry(base.scene.family).or_default() += 1;
                self.listed.push(Listed {
                    index,
                    name: invariance.name,
                    family: base.scene.family,
                    frame: finding.frame,
                    relative: finding.relative,
                    again: order.again(invariance.name, family, index),
                });
                let known =
                    |found: &&Found| found.name == invariance.name && found.whole.family == base.scene.family;
                if self.found.iter().filter(known).count() < order.kept {
                    self.found.push(smallest(invariance, order, (family, index), &base.scene, finding));
                }
            }
        }
    }

    fn add(&mut self, other: Self, kept: usize) {
        self.scenes += other.scenes;
        self.refused += other.refused;
        self.refusals.extend(other.refusals);
        self.refusals.truncate(5);
        self.listed.extend(other.listed);
        for (name, tally) in other.tallies {
            let sum = self.tallies.entry(name).or_default();
            sum.compared += tally.compared;
            sum.at_a_jump += tally.at_a_jump;
            sum.differ += tally.differ;
            sum.worst = sum.worst.max(tally.worst);
            for (family, count) in tally.families {
                *sum.families.entry(family).or_default() += count;
            }
            for (family, count) in tally.jumps {
                *sum.jumps.entry(family).or_default() += count;
            }
        }
        for found in other.found {
            let known = |old: &&Found| old.name == found.name && old.whole.family == found.whole.family;
            if self.found.iter().filter(known).count() < kept {
                self.found.push(found);
            }
        }
    }

    /// True if nothing disagrees, and discontinuities are as rare as required.
    pub fn holds(&self) -> bool {
        self.differ() == 0
            && self.refused == 0
            && self.at_jumps() as f64 <= JUMPS_MOST * self.compared() as f64
    }

    /// Disagreements of all invariances.
    pub fn differ(&self) -> u64 {
        self.tallies.values().map(|tally| tally.differ).sum()
    }

    /// Comparisons of all invariances.
    pub fn compared(&self) -> u64 {
        self.tallies.values().map(|tally| tally.compared).sum()
    }

    /// Answers at jumps of all invariances.
    pub fn at_jumps(&self) -> u64 {
        self.tallies.values().map(|tally| tally.at_a_jump).sum()
    }

    /// One line for each disagreement: where it is, how large, and the command that reproduces it.
    pub fn list(&self) -> String {
        let mut text = String::new();
        for Listed { name, family, frame, relative, again, .. } in &self.listed {
            let _ = writeln!(
                text,
                "{name:<16} {family:<10} frame {frame}  {relative:.1e}  pong verify --invariances {again}"
            );
        }
        text
    }

    /// Table of the results.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{:<16} {:>10} {:>8} {:>8} {:>8}  claim\n",
            "invariance", "compared", "at jumps", "differ", "worst"
        );
        for invariance in INVARIANCES {
            let Some(tally) = self.tallies.get(invariance.name) else { continue };
            let Tally { compared, at_a_jump, differ, worst, families, jumps } = tally;
            let bits = if invariance.is_bits { " (bits)" } else { "" };
            let name = invariance.name;
            let says = invariance.says;
            let _ = writeln!(
                text,
                "{name:<16} {compared:>10} {at_a_jump:>8} {differ:>8} {worst:>8.0e}  {says}{bits}"
            );
            for (title, counts) in [("at jumps", jumps), ("differ", families)] {
                if !counts.is_empty() {
                    let _ = writeln!(text, "{:<16} {title}: {counts:?}", "");
                }
            }
        }
        let _ = writeln!(
            text,
            "{} scenes, {} comparisons: {} at jumps of the physics itself, {} disagreements; {} scenes refused",
            self.scenes,
            self.compared(),
            self.at_jumps(),
            self.differ(),
            self.refused
        );
        for refusal in &self.refusals {
            let _ = writeln!(text, "refused: {refusal}");
        }
        text
    }
}

/// Invariances without a scene generator, which round parts and solids are checked against.
fn of_shared_scenes(asked: &[&'static Invariance]) -> Vec<&'static Invariance> {
    asked.iter().filter(|invariance| invariance.make.is_none()).copied().collect()
}

/// Reduces a scene that disagrees.
fn smallest(
    invariance: &'static Invariance,
    order: &Order,
    (family, index): (Option<&str>, u64),
    whole: &Scene,
    finding: Finding,
) -> Found {
    let verdict = |scene: &Scene| {
        let mut base = Base::new(scene.clone()).ok()?;
        match invariance.judge(&mut base, &mut numbers(invariance, order.seed, index)) {
            Verdict::Differs(finding) => Some(finding),
            _ => None,
        }
    };
    // A refusal by the loader is a different failure than a different answer.
    let differs = |scene: &Scene| verdict(scene).is_some_and(|found| found.is_refusal == finding.is_refusal);
    let scene = if invariance.is_general { reduce::reduce(whole, differs) } else { whole.clone() };
    let name = invariance.name;
    let again = order.again(name, family, index);
    let finding = verdict(&scene).unwrap_or(finding);
    Found { name, again, whole: whole.clone(), scene, finding }
}

impl Found {
    /// Text with the reduced scene, its twin and their difference.
    pub fn text(&self) -> String {
        let Self { name, again, whole, scene, finding } = self;
        let mut text = format!(
            "---- {name}, {}: frame {} differs by {:.1e} of the largest term\n{}\n\nthe smallest scene that shows it\n{}",
            whole.family,
            finding.frame,
            finding.relative,
            finding.says,
            text::scene(scene)
        );
        if let Some(twin) = finding.twin.as_ref().filter(|twin| *twin != scene) {
            let _ = write!(text, "\nits twin\n{}", text::scene(twin));
        }
        let _ = writeln!(text, "again, from the scene as it was made: pong verify --invariances {again}\n");
        text
    }
}
