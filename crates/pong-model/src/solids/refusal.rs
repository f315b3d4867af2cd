//! Faults of solids.

/// Reason why a primitive cannot be a solid or part of one.
pub(super) struct Refusal {
    pub(super) primitive: usize,
    pub(super) rule: &'static str,
    pub(super) cause: String,
    pub(super) cure: &'static str,
}
