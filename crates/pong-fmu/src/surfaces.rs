//! Factors on the surfaces of a scene, as parameters.

use pong_engine::{EngineError, ModelId, World};
use pong_model::{FrictionLaw, NormalLaw, Surface};

/// Property that a factor scales.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase", suffix = "_scale")]
pub(crate) enum Factor {
    /// Normal stiffness, and with it the stiffness of a bristle given as a share of it.
    Stiffness,
    /// Damping or dissipation of the normal law.
    Damping,
    /// Kinetic friction coefficient μ_k, and with it the static μ_s.
    Friction,
}

impl Factor {
    /// Name and value of the scaled property of a surface; `None` if the surface does not have it.
    fn value(self, surface: &Surface) -> Option<(&'static str, f64)> {
        let found = match (self, &surface.normal, &surface.friction) {
            (Self::Stiffness, ..) => Some(("stiffness, N/m", surface.stiffness)),
            (Self::Damping, NormalLaw::Linear { damping, .. }, _) => Some(("damping, N.s/m", *damping)),
            (Self::Damping, NormalLaw::HuntCrossley { dissipation, .. }, _) => {
                Some(("dissipation, s/m", *dissipation))
            }
            (Self::Damping, NormalLaw::PowerLaw { damping, .. }, _) => {
                Some(("damping, N.s/m^(1+damping_exponent)", *damping))
            }
            (Self::Friction, _, FrictionLaw::Bristle { mu, .. } | FrictionLaw::Coulomb { mu, .. }) => {
                Some(("friction coefficient", *mu))
            }
            _ => None,
        };
        found.filter(|(_, value)| value.is_finite() && *value > 0.0)
    }

    fn apply(self, surface: &mut Surface, scale: f64) {
        match self {
            Self::Stiffness => surface.stiffness *= scale,
            Self::Damping => match &mut surface.normal {
                NormalLaw::Linear { damping: value, .. }
                | NormalLaw::HuntCrossley { dissipation: value, .. }
                | NormalLaw::PowerLaw { damping: value, .. } => {
                    *value *= scale;
                }
                NormalLaw::Custom { .. } | NormalLaw::Inherited => {}
            },
            Self::Friction => match &mut surface.friction {
                FrictionLaw::Bristle { mu, .. } | FrictionLaw::Coulomb { mu, .. } => *mu *= scale,
                FrictionLaw::None | FrictionLaw::Custom { .. } | FrictionLaw::Inherited => {}
            },
        }
    }
}

/// A surface with its possible factors.
#[derive(Clone, Debug)]
pub(crate) struct ScaledSurface {
    model: ModelId,
    /// `model/surface`.
    pub path: String,
    /// Its values in the model.
    nominal: Surface,
    /// Factor, name and value in the model.
    pub factors: Vec<(Factor, &'static str, f64)>,
}

/// All surfaces of a world with a property to scale.
pub(crate) fn scaled_surfaces(world: &World) -> Vec<ScaledSurface> {
    let mut scaled = Vec::new();
    for (id, model) in world.scene().models() {
        for nominal in &model.surfaces {
            let all = [Factor::Stiffness, Factor::Damping, Factor::Friction];
            let factors: Vec<_> = all
                .into_iter()
                .filter_map(|factor| factor.value(nominal).map(|(what, value)| (factor, what, value)))
                .collect();
            if !factors.is_empty() {
                let path = format!("{}/{}", model.name, nominal.name);
                scaled.push(ScaledSurface { model: id, path, nominal: nominal.clone(), factors });
            }
        }
    }
    scaled
}

impl ScaledSurface {
    /// Sets this surface in the world, scaled by its factors.
    ///
    /// # Errors
    /// The engine's, if the surface is not allowed; the present one then stays.
    pub fn set(&self, world: &mut World, scales: &[f64]) -> Result<(), EngineError> {
        let mut surface = self.nominal.clone();
        for ((factor, ..), scale) in self.factors.iter().zip(scales) {
            factor.apply(&mut surface, *scale);
        }
        if world.surface(self.model, &surface.name)? == &surface {
            return Ok(());
        }
        world.set_surface(self.model, &surface)
    }
}
