//! Faults of the readers of `pong-model` as findings.

use crate::findings::Finding;
use pong_model::mesh_formats::FormatFault;

/// A fault of a reader, with the line in a text file.
pub(super) fn finding(fault: FormatFault, file: &str) -> Finding {
    let path = if fault.line > 0 { format!("{file}:{}", fault.line) } else { file.to_owned() };
    Finding { path, rule: fault.rule, cause: fault.cause, cure: fault.cure.to_owned() }
}
