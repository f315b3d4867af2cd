//! What keeps authored faces from being a convex piece.

/// What is wrong with a polyhedron.
#[derive(Debug)]
pub(crate) struct Problem {
    /// The authored face, if it lies with one.
    pub(crate) face: Option<usize>,
    pub(crate) rule: &'static str,
    pub(crate) cause: String,
    pub(crate) cure: &'static str,
}

impl Problem {
    pub(super) fn new(face: Option<usize>, rule: &'static str, cause: String, cure: &'static str) -> Self {
        Self { face, rule, cause, cure }
    }
}
