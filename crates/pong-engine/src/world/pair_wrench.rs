//! Wrench that one Object or movable group puts on another.

use super::World;
use crate::error::EngineError;
use crate::ids::{InterfaceId, PairId};
use crate::runtime::Runtime;
use crate::seal::Sealed;
use pong_geometry::Wrench;
use std::sync::Arc;

impl World {
    /// Wrench of the last frame on one movable group from its contacts with another group alone, N and N·m:
    /// about the origin of `on`, expressed in its frame, as [`wrench`](Self::wrench). Summed over all groups
    /// `from` that `on` can touch, it gives the wrench of [`wrench`](Self::wrench), to rounding. It is zero
    /// where the two groups do not touch, their pair is off or a filter keeps them apart. It is summed when
    /// it is asked for, so that a frame pays nothing.
    ///
    /// # Errors
    /// As [`wrench`](Self::wrench); [`EngineError::BadValue`] for one and the same group, and for groups
    /// whose Objects are not paired.
    pub fn wrench_from(&self, on: InterfaceId, from: InterfaceId) -> Result<Wrench, EngineError> {
        let (on, from) = (self.scene.body_index(on)?, self.scene.body_index(from)?);
        let results = self.results()?;
        match results.sealed.group_pair_of(on.min(from), on.max(from)) {
            Some(group_pair) => Ok(results.wrench_of_groups(group_pair, on)),
            None => {
                self.require_paired([on, from], |[on, from]| format!("wrench on `{on}` from `{from}`"))?;
                Ok(Wrench::zero())
            }
        }
    }

    /// As [`wrench_from`](Self::wrench_from), expressed along the axes of the common frame.
    ///
    /// # Errors
    /// As [`wrench_from`](Self::wrench_from).
    pub fn wrench_from_common(&self, on: InterfaceId, from: InterfaceId) -> Result<Wrench, EngineError> {
        let wrench = self.wrench_from(on, from)?;
        Ok(self.results()?.along_common_axes(&wrench, self.scene.body_index(on)?))
    }

    /// Wrench of the last frame of a pair of Objects, N and N·m: the sum over all contacts of the pair, on
    /// the Object that was named first in the pair. It is about the origin of `about`, a movable group of
    /// either Object, and expressed in the frame of that group. The Object named second receives the opposite
    /// wrench about the same point. It is zero where the two do not touch or the pair is off. It is summed
    /// when it is asked for, so that a frame pays nothing.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a pair or an Interface of another world, [`EngineError::WrongPhase`]
    /// before the first frame, [`EngineError::BadValue`] for a group of neither Object and for an Object
    /// paired with itself, which has no two sides.
    pub fn pair_wrench(&self, pair: PairId, about: InterfaceId) -> Result<Wrench, EngineError> {
        let (pair, about) = (self.scene.pair_index(pair)?, self.scene.body_index(about)?);
        let objects = self.scene.pairs[pair];
        let refused = |cause: String| {
            let [a, b] = [objects.a, objects.b].map(|object| &self.scene.objects[object].name);
            Err(EngineError::BadValue { what: format!("wrench of the pair (`{a}`, `{b}`)"), cause })
        };
        if objects.a == objects.b {
            let cause = "an Object paired with itself has no two sides; ask for the wrench of one of its movable groups on \
                         another";
            return refused(cause.to_owned());
        }
        if ![objects.a, objects.b].contains(&self.scene.bodies[about].object) {
            let group = self.scene.body_name(about);
            return refused(format!(
                "`{group}` is of neither Object; give a movable group of one of the two as point of reference"
            ));
        }
        Ok(self.results()?.wrench_of_objects(pair, about))
    }

    /// As [`pair_wrench`](Self::pair_wrench), about the same point and expressed along the axes of the common
    /// frame.
    ///
    /// # Errors
    /// As [`pair_wrench`](Self::pair_wrench).
    pub fn pair_wrench_common(&self, pair: PairId, about: InterfaceId) -> Result<Wrench, EngineError> {
        let wrench = self.pair_wrench(pair, about)?;
        Ok(self.results()?.along_common_axes(&wrench, self.scene.body_index(about)?))
    }

    /// Calls `visit` for every pair of movable groups that touches in the last frame, for a pair monitor.
    pub(crate) fn for_each_touching(&self, visit: impl FnMut(u32, f64, Wrench)) {
        self.last_results().for_each_touching(visit);
    }

    /// Number of the last frame, if it is committed.
    pub(crate) fn committed_frame(&self) -> Option<u64> {
        let Runtime { frame, committed, .. } = &self.runtime;
        (frame.computed && frame.number == *committed).then_some(*committed)
    }

    /// Sealed scene.
    pub(crate) fn sealed(&self) -> &Arc<Sealed> {
        &self.runtime.sealed
    }

    /// Returns an error for two movable groups that are the same or whose Objects are not paired. `what`
    /// makes the text that says what was asked for, from the names of the two groups.
    pub(super) fn require_paired(
        &self,
        groups: [usize; 2],
        what: impl FnOnce([String; 2]) -> String,
    ) -> Result<(), EngineError> {
        let scene = &self.scene;
        let [a, b] = groups.map(|body| scene.bodies[body].object);
        let paired = scene.pairs.iter().any(|pair| [(a, b), (b, a)].contains(&(pair.a, pair.b)));
        let cause = if groups[0] == groups[1] {
            "both are the same movable group; name two"
        } else if !paired {
            "their Objects are not paired; name two groups of paired Objects"
        } else {
            return Ok(());
        };
        let what = what(groups.map(|body| scene.body_name(body)));
        Err(EngineError::BadValue { what, cause: cause.to_owned() })
    }
}
