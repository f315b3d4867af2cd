//! Tangent of the last frame.

use super::World;
use crate::error::EngineError;
use crate::frame::EvaluationInput;
use crate::law::ContactTangent;
use crate::tangent::{self, Missing, PairPotential, PairTangent, Unknown};

/// Name of a tangent in errors.
const TANGENT: &str = "tangent";

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
        known.collect::<Result<_, _>>().map_err(|unknown| self.without_derivative(TANGENT, &unknown))
    }

    /// Incremental potentials of a step of length `step`, s, between every two movable groups that touch in the last
    /// frame, in the order of the groups, as functions of the poses that are set: the poses at the end of the step. Its
    /// start is the last commit. See [`PairPotential`] and docs/theory.md, 7. Allocates.
    ///
    /// A host that finds the end of its step by minimising energies sets poses, evaluates, and adds these energies,
    /// wrenches and second derivatives to those of its own; it commits at the end that it has found.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] unless the last frame is evaluated and not committed yet;
    /// [`EngineError::BadValue`] for a step that is not positive and finite, and if a contact is of two solids, has a law
    /// of the host's or a resistance to rolling or spinning, or has no unique derivative.
    pub fn incremental_potentials(&self, step: f64) -> Result<Vec<PairPotential>, EngineError> {
        self.require_evaluated_frame()?;
        if !(step > 0.0 && step.is_finite()) {
            let cause = format!("it is {step} s; give the length of the step, positive and finite");
            return Err(EngineError::BadValue { what: "step of an incremental potential".to_owned(), cause });
        }
        self.with_frame(|frame| tangent::potentials_of_frame(frame, step))
            .map_err(|unknown| self.without_derivative("incremental potential", &unknown))
    }

    /// Tangent of each pair of groups that touches, or why it has none in closed form, with the index of the pair.
    pub(super) fn known_tangents(&self) -> Vec<(u32, Result<PairTangent, Unknown>)> {
        self.with_frame(tangent::of_frame)
    }

    /// Calls `read` with the last frame and its input.
    fn with_frame<R>(&self, read: impl FnOnce(&tangent::Given<'_>) -> R) -> R {
        let runtime = &self.runtime;
        let given = EvaluationInput {
            scene: &self.scene,
            sealed: &runtime.sealed,
            states: &self.states,
            memory: &runtime.memory,
            clock: runtime.clock,
        };
        let motions = runtime.frame.motions(&runtime.sealed, &runtime.memory.poses);
        let (input, results) = (&runtime.frame.input, &self.last_results());
        read(&tangent::Given { given: &given, motions: &motions, input, results })
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
        let (call, cure) =
            ("get tangents or other derivatives", "evaluate a frame, and ask before it is committed");
        Err(EngineError::WrongPhase { call, cure })
    }

    fn without_derivative(&self, of: &str, unknown: &Unknown) -> EngineError {
        let (a, b) = self.runtime.sealed.bodies_of(unknown.direction);
        let [a, b] = [a, b].map(|body| self.scene.body_name(body));
        let [kind_a, kind_b] = unknown.kinds.map(|kind| kind.name());
        let why = match unknown.why {
            Missing::HostLaw => "has a law of the host's, which gives no derivatives",
            Missing::Solids => "is of two solids, whose derivatives are not known in closed form",
            Missing::Resistance => {
                "resists rolling or spinning, whose derivatives are not known in closed form here"
            }
            Missing::Shapes => {
                "has no unique derivative: both shapes are flat or parallel there, or A is a ray"
            }
        };
        let cure = match of {
            TANGENT => "; ask for complete_tangents, which takes differences there",
            _ => "; filter this contact, or give it a law that has a potential",
        };
        EngineError::BadValue {
            what: format!("{of} of `{a}` and `{b}`"),
            cause: format!("a contact of {kind_a} and {kind_b} {why}{cure}"),
        }
    }
}
