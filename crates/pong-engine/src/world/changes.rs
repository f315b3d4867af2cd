//! Changes between frames: pairs on and off, surface values, contact history.

use super::World;
use crate::error::EngineError;
use crate::ids::{ModelId, ObjectId, PairId};
use crate::seal;
use pong_model::Surface;

impl World {
    /// Switches a pair on or off. A pair that is off has no contacts, and it has no history when it is
    /// switched on again.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a pair of another world.
    pub fn set_pair_enabled(&mut self, pair: PairId, enabled: bool) -> Result<(), EngineError> {
        let pair = self.scene.pair_index(pair)?;
        if self.states.enabled[pair] != enabled {
            self.states.enabled[pair] = enabled;
            self.runtime.clear_history(&self.scene, |other| other == pair);
        }
        Ok(())
    }

    /// Returns true if a pair is switched on.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a pair of another world.
    pub fn pair_enabled(&self, pair: PairId) -> Result<bool, EngineError> {
        Ok(self.states.enabled[self.scene.pair_index(pair)?])
    }

    /// Drops the contact state of an Object. For use after a teleport, in which the host moves the Object in
    /// one step, or after a reset.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Object of another world.
    pub fn clear_contact_history(&mut self, object: ObjectId) -> Result<(), EngineError> {
        let object = self.scene.object_index(object)?;
        let pairs = &self.scene.pairs;
        self.runtime.clear_history(&self.scene, |pair| pairs[pair].a == object || pairs[pair].b == object);
        Ok(())
    }

    /// Replaces the values of a model's surface (found by its name), for all its Objects. Laws cannot change.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a model of another world, [`EngineError::UnknownName`] if the model has
    /// no surface of this name, [`EngineError::BadValue`] for another law or a value that no surface may
    /// have, [`EngineError::Seal`] if it cannot be combined with a surface that it may meet. The surface is
    /// unchanged then.
    pub fn set_surface(&mut self, model: ModelId, surface: &Surface) -> Result<(), EngineError> {
        let model = self.scene.model_index(model)?;
        let before = self.surfaces.replace(model, surface)?;
        let sealed = &self.runtime.sealed;
        match seal::surface_tables(
            &self.scene,
            &self.surfaces.of_models,
            &sealed.group_pairs,
            &sealed.filters,
        ) {
            Ok(tables) => {
                self.runtime.set_tables(tables);
                Ok(())
            }
            Err(problems) => {
                self.surfaces.put_back(model, before);
                Err(EngineError::Seal { problems })
            }
        }
    }

    /// Surface of a model with its current values.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a model of another world, [`EngineError::UnknownName`] if it has no
    /// such surface.
    pub fn surface(&self, model: ModelId, name: &str) -> Result<&Surface, EngineError> {
        self.surfaces.named(self.scene.model_index(model)?, name)
    }

    /// All surfaces of a model with their current values.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a model of another world.
    pub fn surfaces(&self, model: ModelId) -> Result<&[Surface], EngineError> {
        Ok(&self.surfaces.of_models[self.scene.model_index(model)?])
    }
}
