//! Foundation modulus of a surface, or the area from which it follows.

use super::fields::Fields;
use super::law_values::either_or;
use super::reader::Reader;
use crate::ron_tree::Node;
use crate::surface::{Exponent, NormalLaw, Surface};

/// Reads `foundation` and `area` of a surface whose stiffness and normal law are read.
pub(super) fn foundation(reader: &mut Reader<'_>, fields: &Fields<'_>, path: &str, surface: &mut Surface) {
    either_or(reader, fields, path, "foundation", "area");
    if let Some(node) = fields.optional("foundation") {
        surface.foundation = modulus(reader, node, path).filter(|_| is_for(reader, node, path, surface));
    }
    if let Some(node) = fields.optional("area") {
        surface.area = area(reader, node, path, surface).filter(|_| is_for(reader, node, path, surface));
    }
}

fn modulus(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<f64> {
    let value = reader.positive(node, path, "the foundation modulus")?;
    in_range(reader, node, path, value, value)
}

/// Reads an area over which the stiffness makes a modulus in range.
fn area(reader: &mut Reader<'_>, node: &Node, path: &str, surface: &Surface) -> Option<f64> {
    let area = reader.positive(node, path, "the area")?;
    let modulus = if surface.stiffness.is_finite() { surface.stiffness / area } else { 1.0 };
    in_range(reader, node, path, modulus, area)
}

/// Returns `value` if the modulus that it makes is within the range of stiffnesses.
fn in_range(reader: &mut Reader<'_>, node: &Node, path: &str, modulus: f64, value: f64) -> Option<f64> {
    if Surface::can_be_so_stiff(modulus) {
        return Some(value);
    }
    let (least, most) = (Surface::SOFTEST, Surface::STIFFEST);
    let cause = format!("the foundation modulus is {modulus:e} N/m³");
    reader.refuse(node.at, path, "foundation-range", cause, format!("make it {least:e} to {most:e} N/m³"))
}

/// Tests whether a surface may have a foundation: it must have a linear spring that is not rigid.
fn is_for(reader: &mut Reader<'_>, node: &Node, path: &str, surface: &Surface) -> bool {
    let exponent = match &surface.normal {
        _ if surface.stiffness.is_infinite() => None,
        NormalLaw::HuntCrossley { exponent, .. } | NormalLaw::PowerLaw { exponent, .. } => Some(*exponent),
        NormalLaw::Linear { .. } | NormalLaw::Inherited => Some(Exponent::One),
        NormalLaw::Custom { .. } => None,
    };
    let cause = match (exponent, surface.stiffness.is_infinite()) {
        (Some(Exponent::One), _) => return true,
        (Some(Exponent::ThreeHalves), _) => "the force of a foundation is linear, but the exponent is 1.5",
        (None, true) => "a rigid surface does not deform, so it has no foundation",
        (None, false) => "the force of a foundation is linear, but the normal law is a custom one",
    };
    let cure = "remove `foundation` and `area`, or give a finite stiffness and a normal law of exponent 1";
    reader.fault(node.at, path, "foundation-law", cause, cure);
    false
}
