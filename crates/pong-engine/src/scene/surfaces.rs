//! Current values of surfaces.

use crate::error::EngineError;
use pong_model::{Exponent, FrictionLaw, LARGEST, Model, NormalLaw, Surface};

/// Current surfaces of every model; the host may change their values at any time.
#[derive(Clone, Default)]
pub(crate) struct Surfaces {
    /// Surfaces per model, in the model's order.
    pub of_models: Vec<Vec<Surface>>,
}

impl Surfaces {
    /// Adds the surfaces of a new model.
    pub fn add(&mut self, model: &Model) {
        self.of_models.push(model.surfaces.clone());
    }

    /// Surface of a model, by name.
    pub fn named(&self, model: usize, name: &str) -> Result<&Surface, EngineError> {
        Ok(&self.of_models[model][self.place(model, name)?])
    }

    /// Replaces the surface of the same name; returns the old one. Laws cannot change.
    pub fn replace(&mut self, model: usize, surface: &Surface) -> Result<Surface, EngineError> {
        let place = self.place(model, &surface.name)?;
        let known = &mut self.of_models[model][place];
        check_change(known, surface)?;
        Ok(std::mem::replace(known, surface.clone()))
    }

    /// Restores the surface that [`replace`](Self::replace) returned.
    pub fn put_back(&mut self, model: usize, before: Surface) {
        let known = self.of_models[model].iter_mut().find(|surface| surface.name == before.name);
        if let Some(known) = known {
            *known = before;
        }
    }

    fn place(&self, model: usize, name: &str) -> Result<usize, EngineError> {
        let surfaces = &self.of_models[model];
        surfaces.iter().position(|surface| surface.name == name).ok_or_else(|| EngineError::UnknownName {
            what: "surface",
            name: name.to_owned(),
            known: surfaces.iter().map(|surface| surface.name.clone()).collect(),
        })
    }
}

/// Returns the reason why a surface cannot have its foundation or area, as the loader of models judges them.
fn foundation_fault(surface: &Surface) -> Option<String> {
    let modulus = match (surface.foundation, surface.area) {
        (None, None) => return None,
        (Some(_), Some(_)) => return Some("give `foundation` or `area`, not both".to_owned()),
        (Some(modulus), None) => modulus,
        (None, Some(area)) if area > 0.0 => surface.stiffness / area,
        (None, Some(_)) => return Some("the area must be positive".to_owned()),
    };
    let is_linear = match &surface.normal {
        NormalLaw::HuntCrossley { exponent, .. } | NormalLaw::PowerLaw { exponent, .. } => {
            *exponent == Exponent::One
        }
        NormalLaw::Linear { .. } | NormalLaw::Inherited => true,
        NormalLaw::Custom { .. } => false,
    };
    if surface.stiffness.is_infinite() || !is_linear {
        let cause =
            "a foundation needs a finite stiffness and a normal law of exponent 1; leave it and the area out";
        return Some(cause.to_owned());
    }
    let (least, most) = (Surface::SOFTEST, Surface::STIFFEST);
    let fits = modulus > 0.0 && Surface::can_be_so_stiff(modulus);
    (!fits).then(|| format!("the foundation modulus is {modulus:e} N/m³; make it {least:e} to {most:e} N/m³"))
}

/// Returns an error for a change of law, and for values that no surface may have.
fn check_change(old: &Surface, new: &Surface) -> Result<(), EngineError> {
    let bad = |cause: &str| {
        Err(EngineError::BadValue { what: format!("surface `{}`", new.name), cause: cause.to_owned() })
    };
    let same_normal = match (&old.normal, &new.normal) {
        (NormalLaw::Linear { .. }, NormalLaw::Linear { .. }) => true,
        (NormalLaw::HuntCrossley { exponent: a, .. }, NormalLaw::HuntCrossley { exponent: b, .. }) => a == b,
        (
            NormalLaw::PowerLaw { exponent: a, damping_exponent: q_a, .. },
            NormalLaw::PowerLaw { exponent: b, damping_exponent: q_b, .. },
        ) => a == b && q_a == q_b,
        (NormalLaw::Custom { name: a, .. }, NormalLaw::Custom { name: b, .. }) => a == b,
        (NormalLaw::Inherited, NormalLaw::Inherited) => true,
        _ => false,
    };
    let same_friction = match (&old.friction, &new.friction) {
        (FrictionLaw::None, FrictionLaw::None)
        | (FrictionLaw::Inherited, FrictionLaw::Inherited)
        | (FrictionLaw::Bristle { .. }, FrictionLaw::Bristle { .. })
        | (FrictionLaw::Coulomb { .. }, FrictionLaw::Coulomb { .. }) => true,
        (FrictionLaw::Custom { name: a, .. }, FrictionLaw::Custom { name: b, .. }) => a == b,
        _ => false,
    };
    if !same_normal || !same_friction {
        return bad("values may change between frames, laws may not; keep the law and change its numbers");
    }
    if new.inherits() && new.stiffness.is_finite() {
        return bad(
            "it is rigid and takes a law from what it meets, so it stays rigid; name the laws in the model",
        );
    }
    if new.stiffness.is_nan() || new.stiffness <= 0.0 {
        return bad("the stiffness must be positive (infinite means rigid)");
    }
    let bristle = match &new.friction {
        FrictionLaw::Bristle { stiffness, .. } => *stiffness,
        _ => None,
    };
    let springs =
        [Some(new.stiffness).filter(|k| k.is_finite()), bristle.filter(|k| k.is_finite() && *k > 0.0)];
    if springs.into_iter().flatten().any(|k| !Surface::can_be_so_stiff(k)) {
        let (least, most) = (Surface::SOFTEST, Surface::STIFFEST);
        return bad(&format!(
            "stiffnesses must lie within {least:e} and {most:e} N/m, beyond which forces are no numbers"
        ));
    }
    if (new.foundation, new.area) != (old.foundation, old.area)
        && let Some(cause) = foundation_fault(new)
    {
        return bad(&cause);
    }
    let numbers: &[f64] = match &new.normal {
        NormalLaw::Linear { damping, ramp } => &[*damping, *ramp],
        NormalLaw::HuntCrossley { dissipation, .. } => &[*dissipation],
        NormalLaw::PowerLaw { damping, .. } => &[*damping],
        NormalLaw::Custom { parameters, .. } => parameters,
        NormalLaw::Inherited => &[],
    };
    let custom = matches!(new.normal, NormalLaw::Custom { .. });
    if numbers.iter().any(|x| !x.is_finite() || (!custom && !(0.0..=LARGEST).contains(x))) {
        return bad(&format!("damping values must lie within 0 and {LARGEST:e}"));
    }
    let rough: &[f64] = match &new.friction {
        FrictionLaw::None | FrictionLaw::Inherited => &[],
        FrictionLaw::Bristle { mu, static_excess, stiffness, rolling, spinning, .. } => {
            let c_t = new.bristle().map_or(0.0, |(_, c_t)| c_t);
            &[*mu, *static_excess, stiffness.unwrap_or(0.0), c_t, *rolling, *spinning]
        }
        FrictionLaw::Coulomb { mu, slip_speed } if *slip_speed > 0.0 => &[*mu, *slip_speed],
        FrictionLaw::Coulomb { .. } => return bad("the slip speed must be positive"),
        FrictionLaw::Custom { .. } => &[],
    };
    if rough.iter().any(|x| !(0.0..=LARGEST).contains(x)) {
        return bad(&format!("friction values must lie within 0 and {LARGEST:e}"));
    }
    Ok(())
}
