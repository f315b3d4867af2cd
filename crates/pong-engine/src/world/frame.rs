//! States in; evaluate, commit, step.

use super::World;
use crate::error::EngineError;
use crate::frame::FrictionPreload;
use crate::ids::{InterfaceId, PairId};
use crate::report::FrameReport;
use crate::scene::{State, SurfaceMotion};
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

    /// Sets the states of movable groups, relative to and expressed in the common frame, in m, m/s and rad/s:
    /// all of them or, if any is refused, none.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world; [`EngineError::BadState`] for a value
    /// that is not finite or beyond [`State::LARGEST`], or a quaternion whose norm is off by more than 1e-3.
    #[inline]
    pub fn set_states(&mut self, states: &[(InterfaceId, State)]) -> Result<(), EngineError> {
        // States that do not differ leave the frame valid, so a host that sets them again for a commit does
        // not pay for a second evaluation.
        if self.states.set(&self.scene, states)? {
            self.runtime.changed();
        }
        Ok(())
    }

    /// Sets the motion of the surface of one movable group along itself. See
    /// [`set_surface_motions`](Self::set_surface_motions).
    ///
    /// # Errors
    /// As [`set_surface_motions`](Self::set_surface_motions).
    pub fn set_surface_motion(
        &mut self,
        interface: InterfaceId,
        motion: &SurfaceMotion,
    ) -> Result<(), EngineError> {
        self.set_surface_motions(&[(interface, *motion)])
    }

    /// Sets the motions of the surfaces of movable groups along themselves, in m, m/s, rad and rad/s in the frame
    /// of each group: all of them or, if any is refused, none. They last until they are set again; before the first
    /// call no surface moves. A host sets them as it sets states, for every evaluation for which they differ: the
    /// travels are to the velocities what poses are to twists. Surfaces move in worlds that were sealed with
    /// [`Config::moving_surfaces`](crate::Config::moving_surfaces).
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world; [`EngineError::BadState`] for a number that
    /// is not finite or beyond [`State::LARGEST`]; [`EngineError::BadValue`] in a world whose surfaces may not
    /// move.
    pub fn set_surface_motions(
        &mut self,
        motions: &[(InterfaceId, SurfaceMotion)],
    ) -> Result<(), EngineError> {
        if self.states.set_surfaces(&self.scene, motions)? {
            self.runtime.changed();
        }
        Ok(())
    }

    /// Returns true if surfaces may move along themselves
    /// ([`Config::moving_surfaces`](crate::Config::moving_surfaces)).
    pub fn surfaces_may_move(&self) -> bool {
        self.scene.config.moving_surfaces
    }

    /// Motion of the surface of a movable group along itself, as it was set last; at rest if never set.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn surface_motion(&self, interface: InterfaceId) -> Result<&SurfaceMotion, EngineError> {
        self.states.surface_of(&self.scene, interface)
    }

    /// Pose (m) and twist (m/s, rad/s) last set for a movable group, relative to and expressed in the common
    /// frame; `None` if never set.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn state(&self, interface: InterfaceId) -> Result<Option<(Pose, Twist)>, EngineError> {
        Ok(self.state_as_set(interface)?.map(|state| (state.pose(), state.twist())))
    }

    /// State last set for a movable group, as it was set; `None` if never set. [`state`](Self::state) has the
    /// quaternion normalised.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn state_as_set(&self, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        self.states.of(&self.scene, interface)
    }

    /// Computes wrenches from the states and the committed contact state. Has no effect on later calls of
    /// evaluate or commit.
    ///
    /// # Errors
    /// [`EngineError::UnsetState`] if a movable group of an enabled pair has no state;
    /// [`EngineError::NotFinite`] if forces, moments or energies overflow.
    #[inline]
    pub fn evaluate(&mut self) -> Result<FrameReport, EngineError> {
        self.runtime.evaluate(&self.scene, &self.states)
    }

    /// Returns true if the last frame was computed from the current states and is not committed yet, so that
    /// a commit accepts it as it is.
    pub fn is_evaluated(&self) -> bool {
        self.runtime.evaluated
    }

    /// Returns true if wrenches and contacts belong to the current states, pairs and surfaces. A commit does
    /// not change that.
    pub fn frame_is_current(&self) -> bool {
        self.runtime.current
    }

    /// Commits the current states; evaluates them first, unless they were evaluated last.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); nothing is committed then.
    #[inline]
    pub fn commit(&mut self) -> Result<(), EngineError> {
        self.require_evaluated()?;
        self.runtime.commit(&self.states);
        Ok(())
    }

    /// Commits some pairs only; the others keep their last committed state. Otherwise as
    /// [`commit`](Self::commit).
    ///
    /// The world stores the poses of every epoch, that is, of every commit at which some pair was last
    /// committed. There is room for one epoch per pair, but for at most 255 epochs, and for at most 16,384
    /// poses or 8 epochs, whichever is more.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); [`EngineError::UnknownId`] for a pair of another world;
    /// [`EngineError::BadValue`] if the pairs that are not committed use all epochs. Nothing is committed
    /// then.
    pub fn commit_pairs(&mut self, pairs: &[PairId]) -> Result<(), EngineError> {
        for pair in pairs {
            self.scene.pair_index(*pair)?;
        }
        self.require_evaluated()?;
        let stamp = self.scene.stamp;
        self.runtime.commit_pairs(&self.states, pairs.iter().filter_map(|pair| pair.index_in(stamp)))
    }

    /// Evaluates and commits, for hosts that call once per frame.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); nothing is committed then.
    #[inline]
    pub fn step(&mut self) -> Result<FrameReport, EngineError> {
        let report = self.evaluate()?;
        self.commit()?;
        Ok(report)
    }

    /// Commits the current states as [`commit`](Self::commit) does, and then preloads the bristles between
    /// two paired Objects, so that their friction needs no displacement to build up. For contacts that exist
    /// at the start of a run: for the first frame, and after
    /// [`clear_contact_history`](Self::clear_contact_history).
    ///
    /// Returns the number of bristles set. Contacts without a bristle or without normal force are left as
    /// they are. The energy stored in the bristles counts as inserted by the host. Allocates.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); [`EngineError::UnknownId`] for a pair of another world,
    /// [`EngineError::BadValue`] for a force that is not finite or too large. Nothing is committed then.
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
