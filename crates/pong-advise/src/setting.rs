//! What the adviser looks at: a sealed world and the masses that are known.

use crate::mass::{GroupMass, StepPlan};
use crate::spring::{ContactSprings, pressed_springs, springs};
use pong_engine::inspect::{GroupPair, Inspection, PushingContact};
use pong_engine::{EngineError, InterfaceId, PairProps, World};
use std::collections::{BTreeMap, BTreeSet};

/// The contacts of one pair of movable groups by the names of their surfaces.
pub(crate) struct Known {
    pub springs: ContactSprings,
    /// `model/surface` of both.
    pub surfaces: [String; 2],
}

/// What the adviser looks at.
pub(crate) struct Setting<'w> {
    pub scene: Inspection<'w>,
    /// Of every movable group, where it is known.
    pub masses: Vec<Option<GroupMass>>,
}

impl<'w> Setting<'w> {
    pub fn new(world: &'w World, masses: &[(InterfaceId, GroupMass)]) -> Result<Self, EngineError> {
        let scene = world.inspect();
        let mut all = vec![None; scene.group_count()];
        for (interface, mass) in masses {
            mass.check(&world.scene().interface_name(*interface)?)?;
            all[interface.index()] = Some(*mass);
        }
        Ok(Self { scene, masses: all })
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
    pub(crate) fn pressed_springs(&self, contact: &PushingContact) -> Option<ContactSprings> {
        let table = self.scene.pairs()[contact.pair].tables[contact.flipped];
        let props = self.scene.surface_values(table, contact.surfaces(&self.scene));
        pressed_springs(props, contact.depth, contact.normal_force).ok()
    }

    /// 1/(1/m₁ + 1/m₂); `None` if neither yields.
    pub fn effective_mass(&self, pair: &GroupPair) -> Option<f64> {
        let inverse = |body: usize| self.masses[body].map_or(0.0, |known| 1.0 / known.mass);
        let sum = inverse(pair.first) + inverse(pair.second);
        (sum > 0.0).then(|| 1.0 / sum)
    }

    /// Values and names of all pairs of surfaces that can meet between two movable groups, each once.
    pub(crate) fn met(&self, pair: &GroupPair) -> Vec<(&'w PairProps, [String; 2])> {
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
