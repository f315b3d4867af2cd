//! Tangent of the last frame.

use super::World;
use crate::error::EngineError;
use crate::frame::EvaluationInput;
use crate::law::ContactTangent;
use crate::tangent::{self, Missing, PairTangent, Unknown};

impl World {
    /// Derivatives of the wrenches of the last frame between every two movable groups that touch, with respect to
    /// their poses and twists, in the order of the groups. They are those of what [`evaluate`](Self::evaluate)
    /// returns for the committed contact state, with the contacts and pushing features that it found: turning
    /// normals, moving places, weights, sticking and slipping bristles and their limits included. The matrices
    /// are not symmetric where friction or damping acts. See [`PairTangent`] and docs/theory.md, 7.
    ///
    /// Computed when it is asked for: a frame pays nothing. Allocates.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] unless the last frame is evaluated and not committed yet;
    /// [`EngineError::BadValue`] if a contact has a law of the host's, which gives no derivatives, or is one whose
    /// derivatives are not known in closed form: then
    /// [`complete_tangents`](Self::complete_tangents) gives them by differences.
    pub fn tangents(&self) -> Result<Vec<PairTangent>, EngineError> {
        self.require_evaluated_frame()?;
        let known = self.known_tangents().into_iter().map(|(_, tangent)| tangent);
        known.collect::<Result<_, _>>().map_err(|unknown| self.without_tangent(&unknown))
    }

    /// Tangent of each pair of groups that touches, or why it has none in closed form, with the index of the pair.
    pub(super) fn known_tangents(&self) -> Vec<(u32, Result<PairTangent, Unknown>)> {
        let runtime = &self.runtime;
        let given = EvaluationInput {
            scene: &self.scene,
            sealed: &runtime.sealed,
            states: &self.states,
            memory: &runtime.memory,
            clock: runtime.clock,
        };
        let motions = runtime.frame.motions(&runtime.sealed, &runtime.memory.poses);
        tangent::of_frame(&given, &motions, &runtime.frame.input, &self.last_results())
    }

    /// Stiffness and damping that act in each contact of the last frame, in the order of
    /// [`contacts_iter`](Self::contacts_iter). `None` for a law of the host's, for solids, whose friction acts in
    /// contacts of its own, and for the forces that resist rolling and spinning.
    pub fn contact_tangents(&self) -> impl Iterator<Item = Option<ContactTangent>> + '_ {
        self.last_results().list_contact_tangents(&self.runtime.tables)
    }

    /// Returns an error unless the last frame is evaluated and not committed yet.
    pub(super) fn require_evaluated_frame(&self) -> Result<(), EngineError> {
        if self.runtime.evaluated {
            return Ok(());
        }
        let (call, cure) = ("get a tangent", "evaluate a frame, and ask before it is committed");
        Err(EngineError::WrongPhase { call, cure })
    }

    fn without_tangent(&self, unknown: &Unknown) -> EngineError {
        let (a, b) = self.runtime.sealed.bodies_of(unknown.direction);
        let [a, b] = [a, b].map(|body| self.scene.body_name(body));
        let [kind_a, kind_b] = unknown.kinds.map(|kind| kind.name());
        let why = match unknown.why {
            Missing::HostLaw => "has a law of the host's, which gives no derivatives",
            Missing::Solids => "is of two solids, whose derivatives are not known in closed form",
            Missing::Resistance => {
                "resists rolling on a surface that moves along itself; its derivatives are not known in closed form"
            }
            Missing::Shapes => {
                "has no unique derivative: both shapes are flat or parallel there, or A is a ray"
            }
        };
        EngineError::BadValue {
            what: format!("tangent of `{a}` and `{b}`"),
            cause: format!(
                "a contact of {kind_a} and {kind_b} {why}; ask for complete_tangents, which takes differences there"
            ),
        }
    }
}
