//! Values common to several laws of surfaces.

use super::fields::Fields;
use super::reader::Reader;
use crate::ron_tree::Node;
use crate::surface::Exponent;

pub(super) fn exponent(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<Exponent> {
    let value = reader.number(node, path)?;
    match value {
        1.0 => Some(Exponent::One),
        1.5 => Some(Exponent::ThreeHalves),
        _ => reader.refuse(node.at, path, "exponent", format!("the exponent is {value}"), "it is 1.0 or 1.5"),
    }
}

pub(super) fn restitution(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<f64> {
    let e = reader.number(node, path)?;
    if e > 0.0 && e <= 1.0 {
        return Some(e);
    }
    let cause = format!("the restitution e is {e}");
    reader.refuse(node.at, path, "restitution-range", cause, "it lies above 0 and is at most 1")
}

/// Stiffness for a law with a restitution; a fault if it is rigid.
pub(super) fn not_rigid(reader: &mut Reader<'_>, node: &Node, path: &str, stiffness: f64) -> Option<f64> {
    if stiffness.is_finite() {
        return Some(stiffness);
    }
    let cause = "a rigid surface has no damping that a restitution could set";
    let cure = "give the damping, or the restitution on the softer surface or in `pairs`";
    reader.refuse(node.at, path, "restitution-of-rigid", cause, cure)
}

pub(super) fn either_or(reader: &mut Reader<'_>, fields: &Fields<'_>, path: &str, one: &str, other: &str) {
    if fields.optional(one).is_some() && fields.optional(other).is_some() {
        let cause = format!("`{one}` and `{other}` say the same thing twice");
        reader.fault(fields.at_field(other), path, "either-or", cause, "keep one of them");
    }
}
