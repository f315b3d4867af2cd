//! Derivatives of the wrenches of the last frame by the numbers of a surface.

use super::World;
use crate::error::EngineError;
use crate::ids::{InterfaceId, ModelId};
use pong_geometry::Wrench;
use pong_model::Surface;

/// Width of a difference relative to the number.
const OF_NUMBER: f64 = 1e-5;

/// Derivatives of the wrenches that two movable groups put on each other, by a number of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSlope {
    /// The two movable groups.
    pub groups: [InterfaceId; 2],
    /// Derivative of the wrench on each group, N and N·m about its origin, along common axes, over the unit of the
    /// number.
    pub wrenches: [Wrench; 2],
}

/// Wrenches of the pairs of groups that touch.
type PairWrenches = Vec<[Wrench; 2]>;

impl World {
    /// Derivatives of the wrenches of the last frame by a number of a surface ([`Surface::numbers`]: `stiffness`,
    /// `normal.damping`, `friction.mu`, …) for every two movable groups that touch, in the order of the groups: one
    /// column of the regressor with which the surface is identified from measured wrenches. The contact state and the
    /// poses are held, so that a bristle of an earlier frame keeps its deflection. Zero for groups without that surface.
    ///
    /// By central differences of 1e-5 of the number (from zero upward if it is zero): two evaluations, for every law and
    /// every kind of contact. The wrenches are polynomials of low degree in most numbers, and smooth but where friction
    /// begins to slip or a force is cut at zero. Surface and frame are those of before. Allocates.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] unless the last frame is evaluated and not committed yet;
    /// [`EngineError::UnknownId`] for a model of another world; [`EngineError::UnknownName`] if it has no such surface, or
    /// the surface does not give the number; otherwise as [`evaluate`](Self::evaluate).
    pub fn surface_slopes(
        &mut self,
        model: ModelId,
        surface: &str,
        number: &str,
    ) -> Result<Vec<SurfaceSlope>, EngineError> {
        self.require_evaluated_frame()?;
        let before = self.surface(model, surface)?.clone();
        let names = || before.numbers().into_iter().map(|(name, _)| name);
        if !names().any(|name| name == number) {
            let known = names().map(str::to_owned).collect();
            let (what, name) = ("number of the surface", number.to_owned());
            return Err(EngineError::UnknownName { what, name, known });
        }
        let slopes = self.slopes_of(model, &before, number);
        self.set_surface(model, &before)?;
        self.evaluate()?;
        let groups = self.touching_bodies().into_iter().map(|(_, bodies)| bodies);
        let stamp = self.scene.stamp;
        let of_groups = groups.map(|bodies| bodies.map(|body| InterfaceId::new(stamp, body)));
        Ok(of_groups.zip(slopes?).map(|(groups, wrenches)| SurfaceSlope { groups, wrenches }).collect())
    }

    fn slopes_of(
        &mut self,
        model: ModelId,
        before: &Surface,
        number: &str,
    ) -> Result<PairWrenches, EngineError> {
        let mut changed = before.clone();
        let value = *changed.number_mut(number).expect("the surface gives the number");
        let pairs = self.touching_bodies();
        let mut at = |value: f64| {
            *changed.number_mut(number).expect("the surface gives the number") = value;
            self.set_surface(model, &changed)?;
            self.evaluate()?;
            Ok::<_, EngineError>(pairs.iter().map(|pair| self.both_wrenches(*pair)).collect::<PairWrenches>())
        };
        if value != 0.0 {
            let width = OF_NUMBER * value.abs();
            let (ahead, behind) = (at(value + width)?, at(value - width)?);
            return Ok(combined(&[(&ahead, 0.5 / width), (&behind, -0.5 / width)]));
        }
        // No number may be negative: a formula of second order on one side.
        let width = width_at_zero(number, before);
        let [here, near, far] = [at(0.0)?, at(width)?, at(2.0 * width)?];
        Ok(combined(&[(&here, -1.5 / width), (&near, 2.0 / width), (&far, -0.5 / width)]))
    }

    /// Pairs of groups that touch in the last frame: index and bodies.
    pub(super) fn touching_bodies(&self) -> Vec<(usize, [usize; 2])> {
        let mut pairs = Vec::new();
        self.for_each_touching(|group_pair, _, _| {
            pairs.push((group_pair as usize, self.runtime.sealed.group_pairs[group_pair as usize].sides()));
        });
        pairs
    }

    /// Wrenches of a pair of groups on each other, about their origins, along common axes.
    pub(super) fn both_wrenches(&self, (group_pair, bodies): (usize, [usize; 2])) -> [Wrench; 2] {
        let results = self.last_results();
        bodies.map(|on| results.along_common_axes(&results.wrench_of_groups(group_pair, on), on))
    }
}

/// Sum of wrenches times factors, pair by pair.
fn combined(terms: &[(&PairWrenches, f64)]) -> PairWrenches {
    let pairs = 0..terms[0].0.len();
    let of = |pair: usize, side: usize| {
        let parts = terms.iter().map(|(wrenches, factor)| (wrenches[pair][side], *factor));
        parts.fold(Wrench::zero(), |sum, (wrench, factor)| Wrench {
            force: sum.force + wrench.force * factor,
            moment: sum.moment + wrench.moment * factor,
        })
    };
    pairs.map(|pair| [0, 1].map(|side| of(pair, side))).collect()
}

/// Width of a difference from zero, in the unit of the number.
fn width_at_zero(number: &str, surface: &Surface) -> f64 {
    /// Length, m, and time, s, that are short for a contact.
    const SHORT: f64 = 1e-6;
    match number {
        "normal.damping" | "friction.damping" if surface.stiffness.is_finite() => SHORT * surface.stiffness,
        _ => SHORT,
    }
}
