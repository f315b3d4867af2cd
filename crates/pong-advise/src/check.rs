//! Every pair of movable groups against the host's step: single contacts, and all that can act on one group at once.

use crate::asking::{Known, of_group};
use crate::bounce::{Accuracy, BounceError, bounce_error, resolved_step};
use crate::coupling::{longest_stable_step, surely_stable_step};
use crate::mass::{GroupMass, StepPlan};
use crate::spring::{ContactSprings, Spring, pressed_springs, springs};
use crate::together::{Load, pair_load};
use crate::warn::{StepNote, StepWarning, notes, warnings};
use pong_engine::WrenchCoupling;
use pong_engine::inspect::{GroupPair, Inspection, PushingContact};
use pong_engine::{EngineError, InterfaceId, PairProps, World};
use std::collections::{BTreeMap, BTreeSet};

/// What the adviser looks at.
pub(crate) struct Setting<'w> {
    pub scene: Inspection<'w>,
    /// Of every movable group, where it is known.
    pub masses: Vec<Option<GroupMass>>,
}

/// One spring on one mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringLimit {
    /// The spring and damper of a whole contact.
    pub spring: Spring,
    /// The longest step at which it is stable, s; 0 if no step is.
    pub stable_step: f64,
}

/// How well the host's step follows a bounce.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BounceLimit {
    /// ω = √(k/m), rad/s.
    pub frequency: f64,
    /// The ratio c/(2mω), less what the lag of the coupling takes; below zero the contact gives more than it takes.
    pub damping_ratio: f64,
    /// How far a bounce may be from its closed form at the host's step.
    pub error: BounceError,
}

/// Single contacts between two movable groups.
#[derive(Clone, Debug, PartialEq)]
pub struct PairLimits {
    /// `object/path` of the two.
    pub groups: [String; 2],
    /// Effective mass at a contact that is not off the mass centres, kg.
    pub mass: f64,
    /// The normal spring that bears the least step.
    pub normal: SpringLimit,
    /// The friction spring that bears the least step, if there is friction.
    pub friction: Option<SpringLimit>,
    /// `model/surface` of the two that make the normal spring, and of those that make the friction spring.
    pub surfaces: [[String; 2]; 2],
    /// The bounce that is followed worst; `None` if no accuracy is asked, or for laws without a closed form.
    pub bounce: Option<BounceLimit>,
}

/// All contacts that can act on one movable group at once (`together.rs` says which).
#[derive(Clone, Debug, PartialEq)]
pub struct GroupLimits {
    /// `object/path`.
    pub group: String,
    /// Its mass, kg.
    pub mass: f64,
    /// Primitives that can be in contact at once, at most.
    pub contacts: usize,
    /// Of the stiffest mode: the stiffness and damping that a contact in line with the mass centre would need for it.
    pub spring: Spring,
    /// The least damping over stiffness of any spring among them, s.
    pub least_damped: f64,
    /// The longest step at which every mode is surely stable, s; 0 if there is none.
    pub stable_step: f64,
}

/// What the adviser found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Pairs of movable groups, one of which at least yields.
    pub pairs: Vec<PairLimits>,
    /// Movable groups that yield and can be touched.
    pub groups: Vec<GroupLimits>,
    /// What could not be judged, and why.
    pub not_judged: Vec<String>,
    /// What goes wrong at the step, those of instability first.
    pub warnings: Vec<StepWarning>,
    /// What may go wrong at the step, and need not.
    pub notes: Vec<StepNote>,
}

impl StepReport {
    /// The least of the stable steps of single contacts, s; infinite if there are none.
    pub fn stable_step(&self) -> f64 {
        let friction = self.pairs.iter().filter_map(|pair| pair.friction);
        let all = self.pairs.iter().map(|pair| pair.normal).chain(friction);
        all.map(|limit| limit.stable_step).fold(f64::INFINITY, f64::min)
    }

    /// The step at which the scene is surely stable, whatever touches at once, s; infinite if nothing can.
    pub fn surely_stable_step(&self) -> f64 {
        self.groups.iter().map(|group| group.stable_step).fold(self.stable_step(), f64::min)
    }
}

/// What a step can hold in a sealed world, by the masses that are known. Of a movable group that is named twice the later mass
/// counts.
///
/// # Errors
/// A world that is not sealed, or values that no plan or group can have.
pub fn step_report(
    world: &World,
    plan: &StepPlan,
    masses: &[(InterfaceId, GroupMass)],
) -> Result<StepReport, EngineError> {
    plan.check()?;
    Ok(Setting::new(world, masses)?.report(plan))
}

impl<'w> Setting<'w> {
    pub fn new(world: &'w World, masses: &[(InterfaceId, GroupMass)]) -> Result<Self, EngineError> {
        let scene = world.inspect()?;
        let mut all = vec![None; scene.group_count()];
        for (interface, mass) in masses {
            mass.check(&world.interface_name(*interface)?)?;
            all[interface.index()] = Some(*mass);
        }
        Ok(Self { scene, masses: all })
    }

    fn report(&self, plan: &StepPlan) -> StepReport {
        let mut report = StepReport::default();
        let mut untold = BTreeSet::new();
        let mut loads: BTreeMap<usize, (Load, f64)> = BTreeMap::new();
        for pair in self.scene.pairs() {
            let names = [pair.first, pair.second].map(|body| self.scene.group_name(body));
            if self.met(pair).is_empty() {
                continue;
            }
            let unknown = [pair.first, pair.second].map(|body| self.masses[body].is_none());
            if unknown != [false, false] {
                untold.extend(
                    names.into_iter().zip(unknown).filter(|(_, unknown)| *unknown).map(|(name, _)| name),
                );
                continue;
            }
            let Some(mass) = self.effective_mass(pair) else { continue };
            let (known, causes) = self.known(pair, mass, plan);
            let not_judged = causes.iter().map(|cause| format!("`{}` and `{}`: {cause}", names[0], names[1]));
            report.not_judged.extend(not_judged);
            report.pairs.extend(pair_limits(names, mass, &known, plan));
            let ratio = known.iter().map(|known| known.springs.least_damped()).fold(f64::INFINITY, f64::min);
            let load = pair_load(self, pair, mass, plan, &[]);
            for body in [pair.first, pair.second] {
                let (sum, least) = loads.entry(body).or_insert((Load::default(), f64::INFINITY));
                (*sum, *least) = (sum.plus(load), least.min(ratio));
            }
        }
        let limits =
            loads.iter().filter_map(|(&body, (load, ratio))| self.group_limits(body, load, *ratio, plan));
        report.groups = limits.collect();
        report.not_judged.dedup();
        report.not_judged.extend(untold.iter().map(|name| format!("`{name}`: no mass is given")));
        report.warnings = warnings(&report, plan);
        let asks = |group: &str| {
            let body = loads.keys().find(|body| self.scene.group_name(**body) == group)?;
            of_group(self, *body, plan)
        };
        report.notes = notes(&report, plan, asks).into_iter().collect();
        report
    }

    /// The contacts that a pair of movable groups can make, and why some are not known.
    pub(crate) fn known(
        &self,
        pair: &GroupPair,
        mass: f64,
        plan: &StepPlan,
    ) -> (Vec<Known>, Vec<&'static str>) {
        let (mut known, mut causes) = (Vec::new(), Vec::new());
        for (props, surfaces) in self.met(pair) {
            match springs(props, mass, plan.closing_speed) {
                Ok(springs) => known.push(Known { springs, surfaces }),
                Err(cause) => causes.push(cause),
            }
        }
        (known, causes)
    }

    /// The springs of a contact that pushes, as deep and as hard pressed as it is; `None` for laws of the host's.
    pub(crate) fn pressed_springs(&self, contact: &PushingContact<'_>) -> Option<ContactSprings> {
        let table = self.scene.pairs()[contact.pair].tables[contact.flipped];
        let props = self.scene.surface_values(table, contact.surfaces(&self.scene));
        pressed_springs(props, contact.depth, contact.normal_force).ok()
    }

    /// `None` for what does not yield or cannot be touched.
    fn group_limits(&self, body: usize, load: &Load, ratio: f64, plan: &StepPlan) -> Option<GroupLimits> {
        let mass = self.masses[body].map(|known| known.mass).filter(|mass| mass.is_finite())?;
        let (stiffness, damping) = (load.stiffness_rate, load.damping_rate);
        (load.contacts > 0).then(|| GroupLimits {
            group: self.scene.group_name(body),
            mass,
            contacts: load.contacts,
            spring: Spring { stiffness: stiffness * mass, damping: damping * mass },
            least_damped: ratio,
            stable_step: surely_stable_step(plan.coupling, stiffness, damping, ratio),
        })
    }

    /// 1/(1/m₁ + 1/m₂); `None` if neither yields.
    pub fn effective_mass(&self, pair: &GroupPair) -> Option<f64> {
        let inverse = |body: usize| self.masses[body].map_or(0.0, |known| 1.0 / known.mass);
        let sum = inverse(pair.first) + inverse(pair.second);
        (sum > 0.0).then(|| 1.0 / sum)
    }

    /// Values and names of all pairs of surfaces that can meet between two movable groups, each once.
    fn met(&self, pair: &GroupPair) -> Vec<(&'w PairProps, [String; 2])> {
        let mut met = BTreeMap::new();
        for (table, (a, b)) in pair.tables.iter().zip([(pair.first, pair.second), (pair.second, pair.first)])
        {
            for (surfaces, props) in self.met_in_direction(*table, a, b) {
                met.insert((*table, surfaces), props);
            }
        }
        met.into_iter()
            .map(|((table, surfaces), props)| (props, self.scene.surface_names(table, surfaces)))
            .collect()
    }

    fn met_in_direction(&self, table: usize, a: usize, b: usize) -> BTreeMap<(u32, u32), &'w PairProps> {
        let (body_a, body_b) = (self.scene.body(a), self.scene.body(b));
        let mut met = BTreeMap::new();
        let [in_a, in_b] = [body_a, body_b].map(|body| {
            let mut seen = BTreeSet::new();
            let new = body.primitives.iter().filter(move |info| {
                // Kinds of the host's share one number; each is looked at.
                info.kind == pong_geometry::primitive::PrimitiveKind::Custom
                    || seen.insert((info.kind, info.surface))
            });
            new.collect::<Vec<_>>()
        });
        for info_a in in_a {
            for info_b in &in_b {
                if self.scene.can_be_tested((a, info_a), (b, info_b)) {
                    let surfaces = (info_a.surface, info_b.surface);
                    met.insert(surfaces, self.scene.surface_values(table, surfaces));
                }
            }
        }
        met
    }
}

/// What a step can hold of one contact with these values on an effective mass (kg); `groups` is what the two are
/// called.
///
/// # Errors
/// Why it cannot be judged.
pub fn judge_contact(
    groups: [String; 2],
    props: &PairProps,
    mass: f64,
    plan: &StepPlan,
) -> Result<PairLimits, &'static str> {
    let known = [Known { springs: springs(props, mass, plan.closing_speed)?, surfaces: groups.clone() }];
    Ok(pair_limits(groups, mass, &known, plan).expect("one contact is known"))
}

pub(crate) fn pair_limits(
    groups: [String; 2],
    mass: f64,
    known: &[Known],
    plan: &StepPlan,
) -> Option<PairLimits> {
    let limit = |spring: Spring| {
        let (k, c) = (spring.stiffness, spring.damping);
        SpringLimit { spring, stable_step: longest_stable_step(plan.coupling, k, c, mass) }
    };
    let (normal, surfaces) =
        least(known.iter().map(|known| (limit(known.springs.normal), &known.surfaces)).collect())?;
    let with_friction =
        known.iter().filter_map(|known| Some((limit(known.springs.friction?), &known.surfaces)));
    let friction = least(with_friction.collect());
    let surfaces = [surfaces, friction.map_or(surfaces, |(_, surfaces)| surfaces)].map(Clone::clone);
    let friction = friction.map(|(limit, _)| limit);
    let known: Vec<_> = known.iter().map(|known| known.springs).collect();
    let by_formula = known.iter().filter(|made| made.bounces_by_formula);
    let bounces = by_formula.filter_map(|made| bounce_limit(made.normal, mass, plan));
    let bounce = bounces.max_by(|x, y| x.error.rebound.total_cmp(&y.error.rebound));
    Some(PairLimits { groups, mass, normal, friction, surfaces, bounce })
}

/// The spring that bears the least step; of two that are equally bad the stiffer.
fn least(limits: Vec<(SpringLimit, &[String; 2])>) -> Option<(SpringLimit, &[String; 2])> {
    limits.into_iter().min_by(|(x, _), (y, _)| {
        let by_step = x.stable_step.total_cmp(&y.stable_step);
        by_step.then(y.spring.stiffness.total_cmp(&x.spring.stiffness))
    })
}

/// Beyond this damping ratio (restitution 0.01) hardly anything bounces.
const ZETA_MAX: f64 = 5.0;

/// Steps of ω·dt below this follow every bounce.
const SURELY_FINE: f64 = 1e-4;

fn bounce_limit(spring: Spring, mass: f64, plan: &StepPlan) -> Option<BounceLimit> {
    plan.accuracy?;
    let frequency = (spring.stiffness / mass).sqrt();
    let omega_step = frequency * plan.step;
    let damping_ratio = 0.5 * (spring.damping / (mass * frequency) - omega_step * plan.coupling.lag());
    if damping_ratio > ZETA_MAX {
        return None;
    }
    let error = if damping_ratio < 0.0 {
        // A negative damping: the rebound is exp(π|ζ|), and so is the energy's root (V28).
        let gain = libm::expm1(-std::f64::consts::PI * damping_ratio);
        BounceError { depth: gain, rebound: gain }
    } else if omega_step < SURELY_FINE {
        BounceError { depth: 0.0, rebound: 0.0 }
    } else {
        bounce_error(plan.coupling, damping_ratio, omega_step)
    };
    Some(BounceLimit { frequency, damping_ratio, error })
}

impl BounceLimit {
    /// The longest step that keeps to an accuracy, s.
    pub fn accurate_step(&self, coupling: WrenchCoupling, accuracy: &Accuracy) -> f64 {
        resolved_step(coupling, self.damping_ratio.max(0.0), accuracy) / self.frequency
    }
}
