//! Finite stiffnesses.

use super::reader::Reader;
use crate::ron_tree::Node;
use crate::surface::Surface;

/// Reads a stiffness within the range in which no sum or product of the laws overflows.
pub(super) fn in_range(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    value: f64,
    what: &str,
    otherwise: &str,
) -> Option<f64> {
    if Surface::can_be_so_stiff(value) {
        return Some(value);
    }
    let (least, most) = (Surface::SOFTEST, Surface::STIFFEST);
    let cure = format!("give {least:e} to {most:e} N/m{otherwise}");
    reader.refuse(node.at, path, "stiffness-range", format!("{what} is {value:e}"), cure)
}

/// Reads a finite, positive stiffness within the range of stiffnesses.
pub(super) fn finite_stiffness(reader: &mut Reader<'_>, node: &Node, path: &str, what: &str) -> Option<f64> {
    let value = reader.finite(node, path)?;
    let value = reader.above_zero(node, path, what, value)?;
    in_range(reader, node, path, value, what, "")
}
