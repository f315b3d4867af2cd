//! States in; evaluate, commit, step.

use super::World;
use crate::error::EngineError;
use crate::frame::FrictionPreload;
use crate::ids::{InterfaceId, PairId};
use crate::report::FrameReport;
use crate::scene::State;
use pong_geometry::{Pose, Twist};
use pong_model::LARGEST;

impl World {
    /// Sets the state of one movable group. See [`set_states`](Self::set_states).
    ///
    /// # Errors
    /// As [`set_states`](Self::set_states).
    pub fn set_state(&mut self, interface: InterfaceId, state: &State) -> Result<(), EngineError> {
        self.set_states(&[(interface, *state)])
    }

    /// Sets the states of movable groups, relative to and expressed in the common frame, in m, m/s and rad/s: all of them, or,
    /// if any is refused, none.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world; [`EngineError::BadState`] for a value that is not finite
    /// or beyond [`State::LARGEST`], or a quaternion whose norm is off by more than 1e-3.
    #[inline]
    pub fn set_states(&mut self, states: &[(InterfaceId, State)]) -> Result<(), EngineError> {
        // A host that sets the same states again, for a commit, must not pay for a second evaluation.
        if self.states.set(&self.scene, states)? {
            self.runtime.changed();
        }
        Ok(())
    }

    /// Pose (m) and twist (m/s, rad/s) last set for a movable group, relative to and expressed in the common frame; `None` if
    /// never set.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn state(&self, interface: InterfaceId) -> Result<Option<(Pose, Twist)>, EngineError> {
        Ok(self.state_as_set(interface)?.map(|state| (state.pose(), state.twist())))
    }

    /// The state last set for a movable group, as it was set; `None` if never. [`state`](Self::state) has the
    /// quaternion normalised.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn state_as_set(&self, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        self.states.of(&self.scene, interface)
    }

    /// Computes wrenches from the states and the committed contact state. Changes nothing that a later evaluate
    /// or commit can see.
    ///
    /// # Errors
    /// [`EngineError::UnsetState`] while a movable group of an enabled pair has no state; [`EngineError::NotFinite`] if forces,
    /// moments or energies are beyond what a number holds.
    #[inline]
    pub fn evaluate(&mut self) -> Result<FrameReport, EngineError> {
        self.runtime.evaluate(&self.scene, &self.states)
    }

    /// Whether the last frame belongs to the states presently set: a commit would accept it as it is.
    pub fn is_evaluated(&self) -> bool {
        self.runtime.evaluated
    }

    /// Whether wrenches and contacts are those of the states, pairs and surfaces as they are set now. A commit does not
    /// change that.
    pub fn frame_is_current(&self) -> bool {
        self.runtime.current
    }

    /// Accepts the states presently set, evaluating them first if they are not the ones last evaluated.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); nothing is committed then.
    #[inline]
    pub fn commit(&mut self) -> Result<(), EngineError> {
        self.require_evaluated()?;
        self.runtime.commit(&self.states);
        Ok(())
    }

    /// As [`commit`](Self::commit), for some pairs only: the others keep their last committed state.
    ///
    /// The world remembers the poses of every moment at which pairs were last committed. There is room for as many moments
    /// as there are pairs, but for no more than 255, and for 16,384 poses or 8 moments, whichever is more.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); [`EngineError::UnknownId`] for a pair of another world; [`EngineError::BadValue`] if the
    /// pairs that are not committed were last committed at so many moments that there is no room for another. Nothing is
    /// committed then.
    pub fn commit_pairs(&mut self, pairs: &[PairId]) -> Result<(), EngineError> {
        for pair in pairs {
            self.scene.pair_index(*pair)?;
        }
        self.require_evaluated()?;
        let stamp = self.scene.stamp;
        self.runtime.commit_pairs(&self.states, pairs.iter().filter_map(|pair| pair.index_in(stamp)))
    }

    /// Evaluate and commit, for hosts that call once a frame.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); nothing is committed then.
    #[inline]
    pub fn step(&mut self) -> Result<FrameReport, EngineError> {
        let report = self.evaluate()?;
        self.commit()?;
        Ok(report)
    }

    /// Accepts the states presently set, as [`commit`](Self::commit), and then preloads the bristles between two paired
    /// Objects: a contact that is there when a run begins is not a new one, and its friction needs no way to build up.
    /// For the first frame, and after [`clear_contact_history`](Self::clear_contact_history). Answers how many bristles were
    /// set; contacts without a bristle or without load have none. What the bristles store then, the host has put in.
    /// Allocates.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); [`EngineError::UnknownId`] for a pair of another world, [`EngineError::BadValue`] for a
    /// force that is not finite or too large. Nothing is committed then.
    pub fn preload_friction(
        &mut self,
        pair: PairId,
        preload: &FrictionPreload,
    ) -> Result<usize, EngineError> {
        let index = self.scene.pair_index(pair)?;
        if let FrictionPreload::Holding(force) = preload
            && !force.iter().all(|x| x.abs() <= LARGEST)
        {
            let cause = format!(
                "the force is ({}, {}, {}) N; give numbers up to {LARGEST:e}",
                force.x, force.y, force.z
            );
            return Err(EngineError::BadValue { what: "preload of friction".to_owned(), cause });
        }
        self.commit()?;
        Ok(self.runtime.preload(&self.scene, index, preload))
    }

    fn require_evaluated(&mut self) -> Result<(), EngineError> {
        if !self.runtime.evaluated {
            self.evaluate()?;
        }
        Ok(())
    }
}
