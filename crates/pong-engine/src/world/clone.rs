//! Another world of the same sealed scene.

use super::World;
use crate::error::EngineError;
use crate::law::registry::Laws;
use crate::scene::Scene;
use crate::seal;
use crate::sealed::SurfaceTable;
use std::sync::Arc;

impl World {
    /// Another world of the same sealed scene, as it stands: with the states, pairs, values of surfaces and contact state that
    /// this one has now, and the same ids. From here on both are independent; given the same calls, they give the same bits.
    ///
    /// Both share what nothing changes: models, laws and what the seal has found. The clone has memory of its own for frames,
    /// and workers of its own, as many as the configuration asks for ([`worker_starts`](Self::worker_starts)). It has computed
    /// no frame yet: there are no wrenches and contacts before its first one.
    ///
    /// # Errors
    /// [`EngineError::OutOfMemory`] if the system has not the memory that frames take, [`EngineError::Workers`] if the workers
    /// cannot be started. This world is as it was.
    pub fn try_clone(&self) -> Result<Self, EngineError> {
        self.clone_of(Arc::clone(&self.scene), Arc::clone(&self.runtime.tables))
    }

    /// As [`try_clone`](Self::try_clone), with other instances of the registered laws under the same names: for laws that keep
    /// something of their world.
    ///
    /// # Errors
    /// As [`try_clone`](Self::try_clone); [`EngineError::BadValue`] for laws of other names, or that remember another count of
    /// numbers of a contact.
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
