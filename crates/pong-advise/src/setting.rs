//! Input of the adviser: a sealed world and the known masses.

use crate::mass::{GroupMass, Joints, SpringRates, StepPlan};
use crate::mobility::Mobility;
use crate::places::{Compliance, Compliances, compliances, yield_at_ends};
use crate::spring::{ContactSprings, Spring, pressed_springs, springs};
use pong_engine::inspect::{GroupPair, Inspection, PushingContact};
use pong_engine::{EngineError, FrictionProps, InterfaceId, PairProps, World};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::PrimitiveInfo;
use std::collections::{BTreeMap, BTreeSet};

/// Cause and cure of an unbounded lever.
const UNBOUNDED: &str = "a plane of a group that yields has levers of any length, and they are left out; give it a face of \
                         a polyhedron or a patch of triangles instead";

/// A compliance (1/kg) below which a body counts as fixed: joints may leave a body no freedom.
pub(crate) const STIFF: f64 = 1e-100;

/// Two surfaces that can meet.
pub(crate) struct Met<'w> {
    pub props: &'w PairProps,
    /// `model/surface` of both.
    pub surfaces: [String; 2],
    pub compliance: Compliance,
}

/// The contacts of one pair of movable groups with the names of their surfaces.
pub(crate) struct Known {
    pub springs: ContactSprings,
    /// `model/surface` of both.
    pub surfaces: [String; 2],
    /// Least effective masses at any point where they can touch, kg: along the normal, and along the surface.
    pub least_masses: [f64; 2],
    /// Area of solids that lie flat on each other, m²; `None` for other contacts.
    pub area: Option<f64>,
}

/// Input of the adviser.
pub(crate) struct Setting<'w> {
    pub scene: Inspection<'w>,
    /// Mass of every movable group, where it is known.
    pub masses: Vec<Option<GroupMass>>,
    /// Mobility of every movable group that yields and whose mass is known.
    pub mobilities: Vec<Option<Mobility>>,
    /// Compliance of every movable group, by kind and surface of its primitives.
    compliances: Vec<Compliances>,
}

impl<'w> Setting<'w> {
    pub fn new(world: &'w World, masses: &[(InterfaceId, GroupMass)]) -> Result<Self, EngineError> {
        let scene = world.inspect();
        let mut all = vec![None; scene.group_count()];
        for (interface, mass) in masses {
            mass.check(&world.scene().interface_name(*interface)?)?;
            all[interface.index()] = Some(*mass);
        }
        let mobilities: Vec<_> = all.iter().map(|known| known.as_ref().and_then(Mobility::new)).collect();
        let of = |(body, mobility): (usize, &Option<Mobility>)| {
            mobility
                .as_ref()
                .map_or_else(Compliances::new, |mobility| compliances(scene.body(body), mobility))
        };
        let compliances = mobilities.iter().enumerate().map(of).collect();
        Ok(Self { scene, masses: all, mobilities, compliances })
    }

    /// The least effective mass of a pair, kg, for a largest compliance (1/kg): at most the mass in line with
    /// both mass centres, unless joints make it larger.
    fn least_mass(&self, pair: &GroupPair, mass: f64, most: f64) -> f64 {
        let inverse = 1.0 / most.max(STIFF);
        let joined = [pair.first, pair.second].iter().any(|body| self.joints(*body).is_some());
        if joined { inverse } else { inverse.min(mass) }
    }

    fn joints(&self, body: usize) -> Option<&Joints> {
        self.masses[body].as_ref()?.joints.as_ref()
    }

    /// Rates of the host's springs on a group and on all groups that share joints with it.
    pub(crate) fn springs_on(&self, body: usize) -> SpringRates {
        let mut sum = SpringRates::default();
        for rates in self.mechanism_of(body).iter().filter_map(|other| Some(self.masses[*other]?.springs)) {
            sum.stiffness += rates.stiffness;
            sum.damping += rates.damping;
        }
        sum
    }

    /// True if two groups belong to one mechanism.
    pub fn share_joints(&self, a: usize, b: usize) -> bool {
        let number = |body: usize| self.joints(body).map(|joints| joints.mechanism);
        number(a).is_some() && number(a) == number(b)
    }

    /// The groups that share joints with one, including itself.
    pub fn mechanism_of(&self, body: usize) -> Vec<usize> {
        let shared = (0..self.masses.len()).filter(|other| *other == body || self.share_joints(body, *other));
        shared.collect()
    }

    /// The contacts that a pair of movable groups can make, and the reasons why some are not known.
    pub(crate) fn known(
        &self,
        pair: &GroupPair,
        mass: f64,
        plan: &StepPlan,
    ) -> (Vec<Known>, Vec<&'static str>) {
        let (mut known, mut causes) = (Vec::new(), Vec::new());
        for Met { props, surfaces, compliance } in self.met(pair) {
            match springs(props, mass, plan.closing_speed) {
                Ok(springs) => {
                    let least_masses =
                        [compliance.normal, compliance.along].map(|most| self.least_mass(pair, mass, most));
                    known.push(Known { springs, surfaces, least_masses, area: None });
                    causes.extend(compliance.is_unbounded.then_some(UNBOUNDED));
                }
                Err(cause) => causes.push(cause),
            }
        }
        (known, causes)
    }

    /// The springs of a contact at its depth and normal force; `None` for laws of the host's.
    pub(crate) fn pressed_springs(&self, contact: &PushingContact<'_>) -> Option<ContactSprings> {
        let mut springs = pressed_springs(contact.props, contact.depth, contact.normal_force).ok()?;
        // The bristle of a patch of solids has the numbers of the pair, which are per unit area, times its area.
        if let (true, FrictionProps::Bristle { .. }) = (contact.is_of_solids, &contact.props.friction) {
            springs.friction = springs.friction.map(|spring| Spring {
                stiffness: spring.stiffness * contact.weight,
                damping: spring.damping * contact.weight,
            });
        }
        Some(springs)
    }

    /// Effective mass 1/(1/m₁ + 1/m₂), kg; `None` if neither yields.
    pub fn effective_mass(&self, pair: &GroupPair) -> Option<f64> {
        let inverse = |body: usize| self.masses[body].map_or(0.0, |known| 1.0 / known.mass);
        let sum = inverse(pair.first) + inverse(pair.second);
        (sum > 0.0).then(|| 1.0 / sum)
    }

    /// All pairs of surfaces that can meet between two movable groups, each once.
    pub(crate) fn met(&self, pair: &GroupPair) -> Vec<Met<'w>> {
        let mut met: BTreeMap<_, (&PairProps, Compliance)> = BTreeMap::new();
        for (table, (a, b)) in pair.tables.iter().zip([(pair.first, pair.second), (pair.second, pair.first)])
        {
            for (surfaces, (props, compliance)) in self.met_in_direction(*table, a, b) {
                let entry = met.entry((*table, surfaces)).or_insert((props, compliance));
                entry.1 = entry.1.or_larger(compliance);
            }
        }
        let named = met.into_iter().map(|((table, surfaces), (props, compliance))| Met {
            props,
            surfaces: self.scene.surface_names(table, surfaces),
            compliance,
        });
        named.collect()
    }

    fn met_in_direction(
        &self,
        table: usize,
        a: usize,
        b: usize,
    ) -> BTreeMap<(u32, u32), (&'w PairProps, Compliance)> {
        let (body_a, body_b) = (self.scene.body(a), self.scene.body(b));
        let mut met = BTreeMap::new();
        let [in_a, in_b] = [(body_a, a, b), (body_b, b, a)].map(|(body, group, other)| {
            let mut seen = BTreeSet::new();
            let new = body.primitives.iter().filter(move |info| {
                // All kinds registered by the host share one number, so each primitive counts.
                info.kind == PrimitiveKind::Custom
                    || seen.insert((
                        info.kind,
                        info.surface,
                        self.scene.filters_that_hold((group, info), other),
                    ))
            });
            new.collect::<Vec<_>>()
        });
        for info_a in in_a {
            for info_b in &in_b {
                if self.scene.can_be_tested((a, info_a), (b, info_b)) {
                    let surfaces = (info_a.surface, info_b.surface);
                    let compliance = self.compliance((a, info_a), (b, info_b));
                    let props = self.scene.surface_values(table, surfaces);
                    let entry = met.entry(surfaces).or_insert((props, compliance));
                    entry.1 = entry.1.or_larger(compliance);
                }
            }
        }
        met
    }

    /// Compliance of two bodies that touch anywhere: the sum of both; twice that if a push on one moves the
    /// other, and along the normal for two capsules, whose two ends may each have a whole spring.
    fn compliance(
        &self,
        (a, info_a): (usize, &PrimitiveInfo),
        (b, info_b): (usize, &PrimitiveInfo),
    ) -> Compliance {
        let of = |body: usize, info: &PrimitiveInfo| {
            self.compliances[body].get(&(info.kind, info.surface)).copied().unwrap_or_default()
        };
        let mut both = of(a, info_a).plus(of(b, info_b));
        if yield_at_ends(info_a.kind, info_b.kind) {
            both.normal *= 2.0;
        }
        if self.share_joints(a, b) { both.plus(both) } else { both }
    }
}
