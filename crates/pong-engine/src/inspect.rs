//! Read access to a sealed world for tools beside the engine: pairs of movable groups, combined surface
//! values, and pushing contacts of the last frame. The step adviser (crate `pong-advise`) uses it.
//!
//! Movable groups are given by the index of their [`InterfaceId`](crate::InterfaceId), tables of combined
//! surface values by the indices in a [`GroupPair`].

use crate::error::EngineError;
use crate::law::PairProps;
use crate::runtime::Runtime;
use crate::scene::Scene;
pub use crate::seal::GroupPair;
use crate::seal::{Partner, can_be_tested, values_of};
use pong_geometry::{Pose, Transform, Vec3};
use pong_model::{Filters, MovableGroup, PrimitiveInfo};

/// View of a sealed world; see [`World::inspect`](crate::World::inspect).
#[derive(Clone, Copy)]
pub struct Inspection<'w> {
    scene: &'w Scene,
    runtime: &'w Runtime,
}

/// A contact of the last frame that pushes, in B's frame.
#[derive(Clone, Copy, Debug)]
pub struct PushingContact<'w> {
    /// Index of its pair in [`Inspection::pairs`].
    pub pair: usize,
    /// 0 if A is the first movable group of the pair, 1 if it is the second.
    pub flipped: usize,
    /// Index of movable group A.
    pub group_a: usize,
    /// Index of movable group B.
    pub group_b: usize,
    /// Primitive of A: index into its movable group's list.
    pub primitive_a: u32,
    /// Primitive of B.
    pub primitive_b: u32,
    /// Combined values of the two surfaces; per unit area for solids.
    pub props: &'w PairProps,
    /// Active share of the contact's spring, 0…1; half of it at each end of a line segment. For a cell of two
    /// solids, its effective area, m².
    pub weight: f64,
    /// `true` for a cell of two solids.
    pub is_of_solids: bool,
    /// Depth, m.
    pub depth: f64,
    /// Normal force, N.
    pub normal_force: f64,
    /// Unit normal from B to A, in B's frame.
    pub normal_b: Vec3,
    /// Contact point, where the force acts, m, in B's frame.
    pub point_b: Vec3,
    /// Transform from A's group frame to B's.
    pub x_ba: Transform,
}

/// A solid that can touch another one or a plane.
#[derive(Clone, Debug)]
pub struct SolidMeeting<'w> {
    /// Movable group A and its solid (index into its [`solids`](MovableGroup::solids)).
    pub a: (usize, Option<usize>),
    /// Movable group B and its solid; no solid for a plane.
    pub b: (usize, Option<usize>),
    /// Combined values of the two surfaces per unit area: K in N/m³ in place of k.
    pub props: &'w PairProps,
    /// `model/surface` of both.
    pub surfaces: [String; 2],
}

impl<'w> Inspection<'w> {
    pub(crate) fn new(scene: &'w Scene, runtime: &'w Runtime) -> Self {
        Self { scene, runtime }
    }

    /// Number of movable groups of the world.
    pub fn group_count(&self) -> usize {
        self.scene.bodies.len()
    }

    /// `object/path` of a movable group.
    pub fn group_name(&self, group: usize) -> String {
        self.scene.body_name(group)
    }

    /// Model data of a movable group.
    pub fn body(&self, group: usize) -> &'w MovableGroup {
        self.scene.body(group)
    }

    /// Pairs of movable groups that are tested.
    pub fn pairs(&self) -> &'w [GroupPair] {
        &self.runtime.sealed.group_pairs
    }

    /// Returns true if two primitives have a tester, the first as A, and no filter keeps them apart.
    pub fn can_be_tested(&self, a: (usize, &PrimitiveInfo), b: (usize, &PrimitiveInfo)) -> bool {
        let filters = self.filters(a.0, b.0);
        if filters.is_some_and(|filters| filters.keep_apart(&a.1.path, &b.1.path)) {
            return false;
        }
        can_be_tested(&self.scene.extensions, (self.body(a.0), a.1), (self.body(b.0), b.1))
    }

    /// Returns true if solids of a pair of movable groups can touch solids or planes of each other.
    pub fn has_solid_meetings(&self, pair: &GroupPair) -> bool {
        let plans = &self.runtime.sealed.plans;
        pair.plans.iter().any(|plan| plans.get(*plan as usize).is_some_and(|plan| !plan.solids.is_empty()))
    }

    /// Solids of a pair of movable groups that can touch solids or planes of each other.
    pub fn solid_meetings(&self, pair: &GroupPair) -> Vec<SolidMeeting<'w>> {
        let Self { scene, runtime: Runtime { sealed, tables, .. } } = *self;
        let mut meetings = Vec::new();
        for (flipped, [a, b]) in
            [[pair.first, pair.second], [pair.second, pair.first]].into_iter().enumerate()
        {
            let Some(plan) = sealed.plans.get(pair.plans[flipped] as usize) else { continue };
            let [in_a, in_b] = [a, b].map(|group| scene.group_of_model(group).1);
            let table = pair.tables[flipped];
            for met in &plan.solids {
                let props = &tables[table].foundations[&(in_a, met.a, in_b, met.b)];
                let (solid_b, surface_b) = match met.b {
                    Partner::Solid(index) => {
                        (Some(index as usize), scene.body(b).solids[index as usize].surface)
                    }
                    Partner::Plane(index) => (None, scene.body(b).primitives[index as usize].surface),
                };
                let surface_a = scene.body(a).solids[met.a as usize].surface;
                let surfaces = self.surface_names(table, (surface_a, surface_b));
                let a = (a, Some(met.a as usize));
                meetings.push(SolidMeeting { a, b: (b, solid_b), props, surfaces });
            }
        }
        meetings
    }

    /// Numbers that two pairs of movable groups have in common if the same models meet with the same filters.
    pub fn plans_of(&self, pair: &GroupPair) -> [u32; 2] {
        pair.plans
    }

    /// Indices of the filters between two movable groups that contain a primitive of the first. They are
    /// equal for primitives that are kept apart from the same primitives of the other group.
    pub fn filters_that_hold(&self, (group, info): (usize, &PrimitiveInfo), other: usize) -> Vec<usize> {
        self.filters(group, other).map_or_else(Vec::new, |filters| filters.that_hold(0, &info.path))
    }

    fn filters(&self, a: usize, b: usize) -> Option<&'w Filters> {
        let [a, b] = [a, b].map(|group| self.scene.bodies[group].object);
        self.runtime.sealed.filters.between(a, b)
    }

    /// Combined values of two surfaces that can meet, from the table of their direction
    /// ([`GroupPair::tables`]) by their indices in the two models.
    pub fn surface_values(&self, table: usize, (a, b): (u32, u32)) -> &'w PairProps {
        self.runtime.tables[table].props(a, b)
    }

    /// `model/surface` of two surfaces of a table.
    pub fn surface_names(&self, table: usize, (a, b): (u32, u32)) -> [String; 2] {
        let table = &self.runtime.tables[table];
        let full = |model: usize, surface: u32| {
            let model = &self.scene.models[model];
            format!("{}/{}", model.name, model.surfaces[surface as usize].name)
        };
        [full(table.model_a, a), full(table.model_b, b)]
    }

    /// Contacts of the last frame that push, in summation order; not those that carry the friction of solids.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] before the first frame.
    pub fn pushing(&self) -> Result<impl Iterator<Item = PushingContact<'w>> + use<'w>, EngineError> {
        let Self { scene, runtime: Runtime { sealed, frame, tables, .. } } = *self;
        if !frame.computed {
            let cure = "evaluate or step a frame first";
            return Err(EngineError::WrongPhase { call: "ask what pushes", cure });
        }
        let springs = frame.contacts().pushing().filter(|contact| contact.found.weight > 0.0);
        Ok(springs.map(move |contact| {
            let key = &contact.found.key;
            let (pair, flipped) = (key.group_pair as usize, key.flipped as usize);
            let (group_a, group_b) = sealed.bodies_of(key.direction());
            PushingContact {
                pair,
                flipped,
                group_a,
                group_b,
                primitive_a: key.primitive_a,
                primitive_b: contact.found.primitive_b,
                props: values_of(scene, sealed, tables, &contact.found),
                weight: contact.found.full_weight(),
                is_of_solids: key.is_of_solids(),
                depth: contact.found.depth,
                normal_force: contact.normal_force,
                normal_b: contact.found.normal_b,
                point_b: contact.point_b,
                x_ba: Pose::relative(&frame.poses[group_a], &frame.poses[group_b]).transform(),
            }
        }))
    }
}

impl PushingContact<'_> {
    /// Surface indices of A and B in their models.
    pub fn surfaces(&self, scene: &Inspection<'_>) -> (u32, u32) {
        let surface = |group: usize, primitive: u32| scene.body(group).primitives[primitive as usize].surface;
        (surface(self.group_a, self.primitive_a), surface(self.group_b, self.primitive_b))
    }
}
