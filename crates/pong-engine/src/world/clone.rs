//! Clones of a world.

use super::World;
use crate::error::EngineError;
use crate::law::registry::Laws;
use crate::scene::Scene;
use crate::seal;
use crate::seal::SurfaceTable;
use std::sync::Arc;

impl World {
    /// Clones this world: the same sealed scene and ids, with the current states, pairs, surface values and
    /// contact state. Afterwards both worlds are independent; given the same calls, they give bit-identical
    /// results.
    ///
    /// Both share everything that does not change: models, laws and the results of the seal. The clone has
    /// its own memory for frames, and its own workers, as many as the configuration asks for
    /// ([`worker_starts`](Self::worker_starts)). It has no wrenches and contacts before its first frame.
    ///
    /// # Errors
    /// [`EngineError::OutOfMemory`] if the system does not have the memory for the frames,
    /// [`EngineError::Workers`] if the workers cannot be started. This world is unchanged.
    pub fn try_clone(&self) -> Result<Self, EngineError> {
        self.clone_of(Arc::clone(&self.scene), Arc::clone(&self.runtime.tables))
    }

    /// Clones this world with other instances of the registered laws under the same names, for laws that
    /// store data of their world; otherwise as [`try_clone`](Self::try_clone).
    ///
    /// # Errors
    /// As [`try_clone`](Self::try_clone); [`EngineError::BadValue`] for laws with other names or another
    /// number of state values per contact.
    pub fn try_clone_with_laws(&self, laws: Laws) -> Result<Self, EngineError> {
        let refused = |cause: &str| {
            Err(EngineError::BadValue { what: "laws of a clone".to_owned(), cause: cause.to_owned() })
        };
        if !self.scene.laws.names().eq(laws.names()) {
            return refused(
                "they have other names than those of the world; give one for each of the same name",
            );
        }
        let scene = Scene { laws, ..Scene::clone(&self.scene) };
        let sealed = &self.runtime.sealed;
        let of_models = &self.surfaces.of_models;
        let tables = seal::surface_tables(&scene, of_models, &sealed.group_pairs, &sealed.filters)
            .map_err(|problems| EngineError::Seal { problems })?;
        if seal::law_state_len(&tables) != sealed.law_state_len {
            return refused(
                "they remember another count of numbers of a contact; give laws of the same kinds",
            );
        }
        self.clone_of(Arc::new(scene), Arc::new(tables))
    }

    fn clone_of(&self, scene: Arc<Scene>, tables: Arc<Vec<SurfaceTable>>) -> Result<Self, EngineError> {
        seal::require_memory_of_clone(&scene, &self.runtime.sealed)?;
        let runtime = self.runtime.start_clone(&scene, tables)?;
        Ok(Self { scene, surfaces: self.surfaces.clone(), states: self.states.clone(), runtime })
    }
}
