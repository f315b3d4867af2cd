//! Texts to paste: surfaces into a model file, mass properties and places into a scene.

use crate::batch::Case;
use crate::error::Result;
use crate::parameter::Target;
use crate::trials::Trials;
use pong_executive::{MassProperties, Vec3};
use pong_model::{Exponent, FrictionLaw, NormalLaw, Surface};

/// A text for each surface, body or Object with a free parameter.
pub(crate) fn texts(trials: &mut Trials, z: &[f64]) -> Result<Vec<String>> {
    let case = Case { values: trials.values(z), starts: Vec::new(), times: vec![0.0] };
    let parameters = trials.batch.parameters().to_vec();
    let bench = trials.batch.first();
    bench.prepare(&case)?;
    let simulation = bench.simulation();
    let world = simulation.world();
    let mut texts: Vec<String> = Vec::new();
    for (parameter, value) in parameters.iter().zip(&case.values) {
        let text = match &parameter.target {
            Target::Surface { model, surface, .. } => {
                let name =
                    world.scene().models().find(|(id, _)| id == model).map(|(_, held)| held.name.clone());
                format!(
                    "// model {}\n{}",
                    name.unwrap_or_default(),
                    surface_text(world.surface(*model, surface)?)
                )
            }
            Target::Body { body, .. } => {
                let Some((_, held)) = simulation.bodies().nth(body.index()) else { continue };
                let Some(mass) = held.mass() else { continue };
                format!("// body {}\n{}", held.name, mass_text(mass))
            }
            Target::Motion { .. } | Target::Spring { .. } | Target::Gravity(_) => {
                format!("// {}\n{value:?} {}", parameter.name, parameter.unit)
            }
        };
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    Ok(texts)
}

/// Shortest text of a number to five digits.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value.is_infinite() { "inf".to_owned() } else { format!("{value}") };
    }
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    let magnitude = rounded.abs();
    if (1e-3..1e6).contains(&magnitude) { format!("{rounded}") } else { format!("{rounded:e}") }
}

fn exponent_text(exponent: Exponent) -> &'static str {
    match exponent {
        Exponent::One => "1",
        Exponent::ThreeHalves => "1.5",
    }
}

/// A surface as in `surfaces` of a model file.
fn surface_text(surface: &Surface) -> String {
    let mut fields = vec![format!("stiffness: {}", number(surface.stiffness))];
    let optional = [("foundation", surface.foundation), ("area", surface.area)];
    fields.extend(optional.iter().filter_map(|(name, value)| Some(format!("{name}: {}", number((*value)?)))));
    match &surface.normal {
        NormalLaw::Linear { damping, ramp } if *ramp == 0.0 => {
            fields.push(format!("normal: Linear(damping: {})", number(*damping)));
        }
        NormalLaw::Linear { damping, ramp } => {
            fields.push(format!("normal: Linear(damping: {}, ramp: {})", number(*damping), number(*ramp)));
        }
        NormalLaw::HuntCrossley { dissipation, exponent } => fields.push(format!(
            "normal: HuntCrossley(dissipation: {}, exponent: {})",
            number(*dissipation),
            exponent_text(*exponent)
        )),
        NormalLaw::PowerLaw { damping, exponent, damping_exponent } => fields.push(format!(
            "normal: PowerLaw(damping: {}, exponent: {}, damping_exponent: {damping_exponent})",
            number(*damping),
            exponent_text(*exponent)
        )),
        NormalLaw::Custom { name, .. } => fields.push(format!("normal: Custom({name:?})")),
        NormalLaw::Inherited => {}
    }
    match &surface.friction {
        FrictionLaw::Bristle { mu, static_excess, stiffness, damping, rolling, spinning } => {
            let values = [
                ("mu", Some(*mu)),
                ("static_excess", Some(*static_excess).filter(|x| *x != 0.0)),
                ("stiffness", *stiffness),
                ("damping", *damping),
                ("rolling", Some(*rolling).filter(|x| *x != 0.0)),
                ("spinning", Some(*spinning).filter(|x| *x != 0.0)),
            ];
            let values =
                values.iter().filter_map(|(name, value)| Some(format!("{name}: {}", number((*value)?))));
            fields.push(format!("friction: Bristle({})", values.collect::<Vec<_>>().join(", ")));
        }
        FrictionLaw::Coulomb { mu, slip_speed } => {
            fields.push(format!(
                "friction: Coulomb(mu: {}, slip_speed: {})",
                number(*mu),
                number(*slip_speed)
            ));
        }
        FrictionLaw::Custom { name, .. } => fields.push(format!("friction: Custom({name:?})")),
        FrictionLaw::None | FrictionLaw::Inherited => {}
    }
    format!("{:?}: ({}),", surface.name, fields.join(", "))
}

/// Mass properties as in a body of a scene.
pub(crate) fn mass_text(mass: &MassProperties) -> String {
    let i = &mass.inertia;
    let off = [("xy", i[(0, 1)]), ("xz", i[(0, 2)]), ("yz", i[(1, 2)])];
    let diagonal = [i[(0, 0)], i[(1, 1)], i[(2, 2)]].map(number);
    let inertia = if off.iter().all(|(_, value)| *value == 0.0) {
        format!("Diagonal({})", diagonal.join(", "))
    } else {
        let [xx, yy, zz] = diagonal;
        let off: Vec<String> =
            off.iter().map(|(name, value)| format!("{name}: {}", number(*value))).collect();
        format!("Full(xx: {xx}, yy: {yy}, zz: {zz}, {})", off.join(", "))
    };
    let mut text = format!("mass: {}, inertia: {inertia},", number(mass.mass));
    if mass.mass_center != Vec3::zeros() {
        let [x, y, z] = <[f64; 3]>::from(mass.mass_center).map(number);
        text += &format!(" mass_center: ({x}, {y}, {z}),");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_five_digits() {
        assert_eq!(number(12345.678), "12346");
        assert_eq!(number(0.000_123_456_78), "1.2346e-4");
        assert_eq!(number(0.21), "0.21");
        assert_eq!(number(f64::INFINITY), "inf");
    }
}
