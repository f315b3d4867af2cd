//! Look-ups of names and ids.

use super::{GroupFilter, Scene, below_root};
use crate::energy::account::WrenchCoupling;
use crate::error::EngineError;
use crate::ids::{InterfaceId, ModelId, ObjectId, PairId};
use pong_geometry::Pose;
use pong_model::{Extensions, Model};
use std::sync::Arc;

impl Scene {
    /// The host's own kinds that this scene knows; models are loaded with them.
    pub fn extensions(&self) -> &Extensions {
        &self.extensions
    }

    /// Names of the registered force laws.
    pub fn law_names(&self) -> impl Iterator<Item = &str> {
        self.laws.names()
    }

    /// Returns true if the energy ledger is kept.
    pub fn keeps_ledger(&self) -> bool {
        self.config.ledger
    }

    /// Use of wrenches by the host, if accounts are kept ([`Config::accounts`](crate::Config::accounts)).
    pub fn wrench_coupling(&self) -> Option<WrenchCoupling> {
        self.config.accounts
    }

    /// All models, in the order in which they were added.
    pub fn models(&self) -> impl ExactSizeIterator<Item = (ModelId, &Arc<Model>)> {
        self.models.iter().enumerate().map(|(index, model)| (ModelId::new(self.stamp, index), model))
    }

    /// All Objects, in the order in which they were created. Their Interfaces are consecutive in the same
    /// order.
    pub fn objects(&self) -> impl ExactSizeIterator<Item = ObjectId> + '_ {
        (0..self.objects.len()).map(|index| ObjectId::new(self.stamp, index))
    }

    /// All pairs with their Objects, in the order in which they were declared.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = (PairId, [ObjectId; 2])> + '_ {
        let object = |index| ObjectId::new(self.stamp, index);
        let pairs = self.pairs.iter().enumerate();
        pairs.map(move |(index, pair)| (PairId::new(self.stamp, index), [object(pair.a), object(pair.b)]))
    }

    /// Filters declared with the builder: two Objects, and the full paths of the groups that never touch.
    /// Filters of models are separate ([`Model::filters`]).
    pub fn filters(&self) -> impl ExactSizeIterator<Item = ([ObjectId; 2], [&str; 2])> + '_ {
        self.filters.iter().map(|GroupFilter { objects, groups: [a, b] }| {
            (objects.map(|index| ObjectId::new(self.stamp, index)), [a.as_str(), b.as_str()])
        })
    }

    /// Full path of a group of an Object, movable or not, given its full path (`root/arm/tip`), its path
    /// below the root (`arm/tip`), or its bare name if only one group has it; an empty name is the root.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Object of another scene, [`EngineError::UnknownName`] for a name
    /// that leads to no group.
    pub fn group_path(&self, object: ObjectId, name: &str) -> Result<&str, EngineError> {
        let object = &self.objects[self.object_index(object)?];
        let model = &self.models[object.model];
        model.group_path(name).ok_or_else(|| EngineError::UnknownName {
            what: "group",
            name: format!("{}/{name}", object.name),
            known: model.groups.clone(),
        })
    }

    /// Object with a given name.
    ///
    /// # Errors
    /// [`EngineError::UnknownName`] if no Object has it.
    pub fn object(&self, name: &str) -> Result<ObjectId, EngineError> {
        match self.objects.iter().position(|object| object.name == name) {
            Some(index) => Ok(ObjectId::new(self.stamp, index)),
            None => Err(EngineError::UnknownName {
                what: "object",
                name: name.to_owned(),
                known: self.objects.iter().map(|object| object.name.clone()).collect(),
            }),
        }
    }

    /// Name of an Object.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn object_name(&self, object: ObjectId) -> Result<&str, EngineError> {
        Ok(&self.objects[self.object_index(object)?].name)
    }

    /// The model that an Object was made from.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn model_of(&self, object: ObjectId) -> Result<&Arc<Model>, EngineError> {
        Ok(&self.models[self.objects[self.object_index(object)?].model])
    }

    /// Id of the model that an Object was made from.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn model_id_of(&self, object: ObjectId) -> Result<ModelId, EngineError> {
        Ok(ModelId::new(self.stamp, self.objects[self.object_index(object)?].model))
    }

    /// The two Objects of a pair, in the order in which they were named.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn objects_of(&self, pair: PairId) -> Result<[ObjectId; 2], EngineError> {
        let pair = &self.pairs[self.pair_index(pair)?];
        Ok([pair.a, pair.b].map(|index| ObjectId::new(self.stamp, index)))
    }

    /// Interface of a movable group, given its path in the model (`root/arm/latch`), its path below the root
    /// (`arm/latch`), or its bare name if only one movable group has it; an empty path is the root.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Object of another scene, [`EngineError::UnknownName`] for a path
    /// that leads to no movable group, and for a bare name that several groups have.
    pub fn interface(&self, object: ObjectId, path: &str) -> Result<InterfaceId, EngineError> {
        let object = &self.objects[self.object_index(object)?];
        let model = &self.models[object.model];
        let bodies = &model.bodies;
        let by_path = bodies.iter().position(|body| body.path == path);
        let below = || bodies.iter().position(|body| below_root(model, body) == path);
        let by_name = || {
            let mut named = bodies.iter().enumerate().filter(|(_, body)| body.name == path);
            named.next().filter(|_| named.next().is_none()).map(|(index, _)| index)
        };
        let found = if path.is_empty() { Some(0) } else { by_path.or_else(below).or_else(by_name) };
        match found {
            Some(body) => Ok(InterfaceId::new(self.stamp, object.first_body + body)),
            None => Err(EngineError::UnknownName {
                what: "movable group",
                name: format!("{}/{path}", object.name),
                known: bodies.iter().map(|body| body.path.clone()).collect(),
            }),
        }
    }

    /// All Interfaces of an Object, the root's first.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn interfaces(&self, object: ObjectId) -> Result<Vec<InterfaceId>, EngineError> {
        let object = &self.objects[self.object_index(object)?];
        let count = self.models[object.model].bodies.len();
        Ok((0..count).map(|body| InterfaceId::new(self.stamp, object.first_body + body)).collect())
    }

    /// Name of a movable group in scenes and logs: the Object's name for the root, `object/path below the
    /// root` for others.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn group_name(&self, interface: InterfaceId) -> Result<String, EngineError> {
        let body = self.body_index(interface)?;
        let object = &self.objects[self.bodies[body].object];
        Ok(match below_root(&self.models[object.model], self.body(body)) {
            "" => object.name.clone(),
            path => format!("{}/{path}", object.name),
        })
    }

    /// `object/path` of a movable group, including the root of its model, as used in messages.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn interface_name(&self, interface: InterfaceId) -> Result<String, EngineError> {
        Ok(self.body_name(self.body_index(interface)?))
    }

    /// Path of an Interface's movable group in its model.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn interface_path(&self, interface: InterfaceId) -> Result<&str, EngineError> {
        Ok(&self.body(self.body_index(interface)?).path)
    }

    /// Path of a primitive, given its index in the movable group's list, as used in contacts.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface that this scene did not give out, or an index beyond the
    /// list.
    pub fn primitive_path(&self, interface: InterfaceId, primitive: u32) -> Result<&str, EngineError> {
        let body = self.body(self.body_index(interface)?);
        let info = body.primitives.get(primitive as usize);
        Ok(&info.ok_or_else(|| unknown("primitive"))?.path)
    }

    /// `object/path` of a primitive, given its index in the movable group's list, as used in messages.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface that this scene did not give out, or an index beyond the
    /// list.
    pub fn primitive_name(&self, interface: InterfaceId, primitive: u32) -> Result<String, EngineError> {
        let object = self.bodies[self.body_index(interface)?].object;
        let path = self.primitive_path(interface, primitive)?;
        Ok(format!("{}/{path}", self.objects[object].name))
    }

    /// Pose at which the model's author placed a movable group, m, in the frame of the root group; identity
    /// for the root.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this scene did not give out.
    pub fn authored_pose(&self, interface: InterfaceId) -> Result<Pose, EngineError> {
        let body = self.body(self.body_index(interface)?);
        Ok(body.initial_pose.unwrap_or_else(Pose::identity))
    }

    pub(crate) fn model_index(&self, id: ModelId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.models.len());
        index.ok_or_else(|| unknown("model"))
    }

    pub(crate) fn object_index(&self, id: ObjectId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.objects.len());
        index.ok_or_else(|| unknown("object"))
    }

    pub(crate) fn pair_index(&self, id: PairId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.pairs.len());
        index.ok_or_else(|| unknown("pair"))
    }

    #[inline]
    pub(crate) fn body_index(&self, id: InterfaceId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.bodies.len());
        index.ok_or_else(|| unknown("interface"))
    }
}

/// Error for an unknown id. Made only when needed, because an error made in advance would have to be dropped
/// on every look-up.
#[cold]
fn unknown(what: &'static str) -> EngineError {
    EngineError::UnknownId { what }
}
