//! Surface values, changed between frames.

use crate::failure::{Failure, Outcome};
use crate::guard::{get, setting_up, with_world};
use crate::handle::pong_world;
use crate::ids::pong_model_id;
use crate::names::text_at;
use crate::pointers::{Out, one, text};
use crate::status::pong_status;
use pong_model::{Exponent, FrictionLaw, NormalLaw, Surface};
use std::ffi::c_char;

/// Kind of a normal force law: PONG_NORMAL_...
pub type pong_normal_kind = i32;

/// F = k d + c d', with a ramp: d is the depth, k the stiffness, c the damping.
pub const PONG_NORMAL_LINEAR: pong_normal_kind = 0;
/// F = k d (1 + chi d').
pub const PONG_NORMAL_HUNT_CROSSLEY: pong_normal_kind = 1;
/// F = k d^(3/2) (1 + chi d').
pub const PONG_NORMAL_HUNT_CROSSLEY_HERTZ: pong_normal_kind = 2;
/// A law given by callback; its parameters stay as the model gives them.
pub const PONG_NORMAL_CUSTOM: pong_normal_kind = 3;
/// Law of the surface it meets, for a rigid surface that names none. It stays rigid.
pub const PONG_NORMAL_INHERITED: pong_normal_kind = 4;
/// F = k d + c d^q d', with the q of the model file.
pub const PONG_NORMAL_POWER_LAW: pong_normal_kind = 5;
/// F = k d^(3/2) + c d^q d', with the q of the model file.
pub const PONG_NORMAL_POWER_LAW_HERTZ: pong_normal_kind = 6;

/// Kind of a friction law: PONG_FRICTION_...
pub type pong_friction_kind = i32;

/// No friction.
pub const PONG_FRICTION_NONE: pong_friction_kind = 0;
/// Bristle with reset.
pub const PONG_FRICTION_BRISTLE: pong_friction_kind = 1;
/// Regularised Coulomb friction.
pub const PONG_FRICTION_COULOMB: pong_friction_kind = 2;
/// A law given by callback; its parameters stay as the model gives them.
pub const PONG_FRICTION_CUSTOM: pong_friction_kind = 3;
/// Law of the surface it meets, for a rigid surface that names none. It stays rigid.
pub const PONG_FRICTION_INHERITED: pong_friction_kind = 4;

/// The values of a surface. Get them, change some, set them: laws may not change. Values that the surface's
/// laws do not use are 0 when got and ignored when set. No value but a rigid stiffness is beyond 1e100.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct pong_surface_values {
    /// Normal law of the surface: PONG_NORMAL_...
    pub normal_law: pong_normal_kind,
    /// Friction law of the surface: PONG_FRICTION_...
    pub friction_law: pong_friction_kind,
    /// Normal stiffness, N/m (N/m^1.5 with PONG_NORMAL_..._HERTZ), 1e-100 to 1e100; infinite means rigid.
    pub stiffness: f64,
    /// Linear, power law: damping, N s/m (N s/m^(1+q) with the power law).
    pub damping: f64,
    /// Linear: depth over which the damping sets in, m; 0 means at once.
    pub ramp: f64,
    /// Hunt-Crossley: chi, s/m.
    pub dissipation: f64,
    /// Bristle, Coulomb: kinetic friction coefficient.
    pub friction: f64,
    /// Bristle: a, so that the static coefficient is (1 + a) times the kinetic one.
    pub friction_static_excess: f64,
    /// Bristle: tangential stiffness, N/m, 1e-100 to 1e100; 0 takes two thirds of the normal stiffness.
    pub friction_stiffness: f64,
    /// Bristle: tangential damping, N s/m. When read, it is the damping that acts, also where the model
    /// leaves it to the normal law; once set, it no longer follows that law.
    pub friction_damping: f64,
    /// Coulomb: slip speed at which the full force is reached, m/s.
    pub friction_slip_speed: f64,
}

/// Values of a surface that pong_surface_values does not have. Get them, change some, set them.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct pong_surface_more {
    /// Foundation modulus of solids, N/m^3: the pressure for each metre of depth; 0 for none.
    pub foundation: f64,
    /// Area to which the stiffness belongs, m^2; 0 for none.
    pub area: f64,
    /// Bristle: rolling resistance, m: the moment of a rolling contact over its normal force. Ignored by other laws.
    pub rolling: f64,
    /// Bristle: spinning resistance, m, likewise.
    pub spinning: f64,
}

/// Number of surfaces of a model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_surface_count(
    world: *const pong_world,
    model: pong_model_id,
    count: *mut usize,
) -> pong_status {
    get(world, (count, "count"), |inner| Ok(inner.names.model(model)?.surfaces.len()))
}

/// Returns the name of a surface of a model; `index` counts from 0. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_surface_name(
    world: *const pong_world,
    model: pong_model_id,
    index: usize,
    name: *mut *const c_char,
) -> pong_status {
    get(world, (name, "name"), |inner| text_at("surface", &inner.names.model(model)?.surfaces, index))
}

/// Copies the present values of a surface, named as in the model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_surface(
    world: *const pong_world,
    model: pong_model_id,
    surface: *const c_char,
    values: *mut pong_surface_values,
) -> pong_status {
    copy_surface(world, model, surface, values)
}

/// Sets the values of a surface for all Objects of a model, from the next evaluation on, before or after
/// sealing. Allocates: between frames, not in them. PONG_STATUS_BAD_VALUE: another law than the surface has, or
/// a value outside its range.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_surface(
    world: *mut pong_world,
    model: pong_model_id,
    surface: *const c_char,
    values: *const pong_surface_values,
) -> pong_status {
    setting_up(world, |inner| {
        let (name, values) = (text(surface, "surface")?, one(values, "values")?);
        let old = inner.phase.surface(model.id(), name)?;
        let new = values.applied_to(old)?;
        inner.phase.set_surface(model.id(), &new)?;
        inner.log_event(|log| log.surface_set(model.id(), &new));
        Ok(())
    })
}

/// Copies the present further values of a surface, named as in the model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_surface_more(
    world: *const pong_world,
    model: pong_model_id,
    surface: *const c_char,
    values: *mut pong_surface_more,
) -> pong_status {
    copy_surface(world, model, surface, values)
}

/// Sets the further values of a surface for all Objects of a model, as pong_set_surface() sets the others.
/// PONG_STATUS_BAD_VALUE: a value outside its range.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_surface_more(
    world: *mut pong_world,
    model: pong_model_id,
    surface: *const c_char,
    values: *const pong_surface_more,
) -> pong_status {
    setting_up(world, |inner| {
        let (name, values) = (text(surface, "surface")?, one(values, "values")?);
        let new = values.applied_to(inner.phase.surface(model.id(), name)?);
        inner.phase.set_surface(model.id(), &new)?;
        inner.log_event(|log| log.surface_set(model.id(), &new));
        Ok(())
    })
}

/// Copies the present values of a surface in one of the forms that C has for them.
unsafe fn copy_surface<T: for<'s> From<&'s Surface>>(
    world: *const pong_world,
    model: pong_model_id,
    surface: *const c_char,
    values: *mut T,
) -> pong_status {
    with_world(world, |inner| {
        let (name, out) = (text(surface, "surface")?, Out::new(values, "values")?);
        out.set(inner.phase.surface(model.id(), name)?.into());
        Ok(())
    })
}

impl From<&Surface> for pong_surface_more {
    fn from(surface: &Surface) -> Self {
        let (rolling, spinning) = match surface.friction {
            FrictionLaw::Bristle { rolling, spinning, .. } => (rolling, spinning),
            _ => (0.0, 0.0),
        };
        let [foundation, area] = [surface.foundation, surface.area].map(|value| value.unwrap_or(0.0));
        Self { foundation, area, rolling, spinning }
    }
}

impl pong_surface_more {
    /// The old surface with these values.
    fn applied_to(&self, old: &Surface) -> Surface {
        let given = |value: f64| (value != 0.0).then_some(value);
        let mut new = Surface { foundation: given(self.foundation), area: given(self.area), ..old.clone() };
        if let FrictionLaw::Bristle { rolling, spinning, .. } = &mut new.friction {
            (*rolling, *spinning) = (self.rolling, self.spinning);
        }
        new
    }
}

impl From<&Surface> for pong_surface_values {
    fn from(surface: &Surface) -> Self {
        let mut values = Self {
            normal_law: normal_number(&surface.normal),
            friction_law: friction_number(&surface.friction),
            stiffness: surface.stiffness,
            ..Self::default()
        };
        match surface.normal {
            NormalLaw::Linear { damping, ramp } => (values.damping, values.ramp) = (damping, ramp),
            NormalLaw::HuntCrossley { dissipation, .. } => values.dissipation = dissipation,
            NormalLaw::PowerLaw { damping, .. } => values.damping = damping,
            NormalLaw::Custom { .. } | NormalLaw::Inherited => {}
        }
        match surface.friction {
            FrictionLaw::Bristle { mu, static_excess, stiffness, .. } => {
                values.friction = mu;
                values.friction_static_excess = static_excess;
                values.friction_stiffness = stiffness.unwrap_or(0.0);
                values.friction_damping = surface.bristle().map_or(0.0, |(_, c_t)| c_t);
            }
            FrictionLaw::Coulomb { mu, slip_speed } => {
                (values.friction, values.friction_slip_speed) = (mu, slip_speed);
            }
            FrictionLaw::None | FrictionLaw::Custom { .. } | FrictionLaw::Inherited => {}
        }
        values
    }
}

impl pong_surface_values {
    /// The old surface with these values and its own laws.
    fn applied_to(&self, old: &Surface) -> Outcome<Surface> {
        if (self.normal_law, self.friction_law)
            != (normal_number(&old.normal), friction_number(&old.friction))
        {
            let message = format!(
                "surface `{}`: values may change between frames, laws may not; get the surface and change its numbers",
                old.name
            );
            return Err(Failure::new(pong_status::BadValue, message));
        }
        let mut new = Surface { stiffness: self.stiffness, ..old.clone() };
        match &mut new.normal {
            NormalLaw::Linear { damping, ramp } => (*damping, *ramp) = (self.damping, self.ramp),
            NormalLaw::HuntCrossley { dissipation, .. } => *dissipation = self.dissipation,
            NormalLaw::PowerLaw { damping, .. } => *damping = self.damping,
            NormalLaw::Custom { .. } | NormalLaw::Inherited => {}
        }
        match &mut new.friction {
            FrictionLaw::Bristle { mu, static_excess, stiffness, damping, .. } => {
                (*mu, *static_excess) = (self.friction, self.friction_static_excess);
                *stiffness = (self.friction_stiffness != 0.0).then_some(self.friction_stiffness);
                *damping = Some(self.friction_damping);
            }
            FrictionLaw::Coulomb { mu, slip_speed } => {
                (*mu, *slip_speed) = (self.friction, self.friction_slip_speed);
            }
            FrictionLaw::None | FrictionLaw::Custom { .. } | FrictionLaw::Inherited => {}
        }
        Ok(new)
    }
}

fn normal_number(law: &NormalLaw) -> i32 {
    match law {
        NormalLaw::Linear { .. } => PONG_NORMAL_LINEAR,
        NormalLaw::HuntCrossley { exponent: Exponent::One, .. } => PONG_NORMAL_HUNT_CROSSLEY,
        NormalLaw::HuntCrossley { exponent: Exponent::ThreeHalves, .. } => PONG_NORMAL_HUNT_CROSSLEY_HERTZ,
        NormalLaw::PowerLaw { exponent: Exponent::One, .. } => PONG_NORMAL_POWER_LAW,
        NormalLaw::PowerLaw { exponent: Exponent::ThreeHalves, .. } => PONG_NORMAL_POWER_LAW_HERTZ,
        NormalLaw::Custom { .. } => PONG_NORMAL_CUSTOM,
        NormalLaw::Inherited => PONG_NORMAL_INHERITED,
    }
}

fn friction_number(law: &FrictionLaw) -> i32 {
    match law {
        FrictionLaw::None => PONG_FRICTION_NONE,
        FrictionLaw::Bristle { .. } => PONG_FRICTION_BRISTLE,
        FrictionLaw::Coulomb { .. } => PONG_FRICTION_COULOMB,
        FrictionLaw::Custom { .. } => PONG_FRICTION_CUSTOM,
        FrictionLaw::Inherited => PONG_FRICTION_INHERITED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The damping of a power law can be set; its exponents are the law's, and another law is refused.
    #[test]
    fn values_of_a_power_law() {
        for (exponent, number) in
            [(Exponent::One, PONG_NORMAL_POWER_LAW), (Exponent::ThreeHalves, PONG_NORMAL_POWER_LAW_HERTZ)]
        {
            let law = |damping| NormalLaw::PowerLaw { damping, exponent, damping_exponent: 0.6 };
            let with = |normal| Surface {
                name: "s".to_owned(),
                stiffness: 1e6,
                foundation: None,
                area: None,
                normal,
                friction: FrictionLaw::None,
            };
            let old = with(law(70.0));
            let values = pong_surface_values::from(&old);
            assert_eq!((values.normal_law, values.damping), (number, 70.0));
            let Ok(new) = (pong_surface_values { damping: 90.0, ..values }).applied_to(&old) else {
                panic!("refused")
            };
            assert_eq!(new, with(law(90.0)));
            let linear = pong_surface_values { normal_law: PONG_NORMAL_LINEAR, ..values };
            assert!(linear.applied_to(&old).is_err());
        }
    }
}
