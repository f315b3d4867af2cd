//! Faults of solids.

use crate::draft::BodyDraft;
use crate::surface::Surface;

/// Reason why a primitive cannot be a solid or part of one.
pub(super) struct Refusal {
    pub(super) primitive: usize,
    pub(super) rule: &'static str,
    pub(super) cause: String,
    pub(super) cure: &'static str,
}

/// Tests whether the primitives of one solid are all in groups of solids and have one surface. Reports those that
/// differ from the first.
pub(super) fn is_uniform(
    draft: &BodyDraft,
    surfaces: &[Surface],
    primitives: &[usize],
    refusals: &mut Vec<Refusal>,
) -> bool {
    let before = refusals.len();
    let first = primitives[0];
    let info = |primitive: usize| &draft.body.primitives[primitive];
    for &primitive in &primitives[1..] {
        if draft.is_solid[primitive] != draft.is_solid[first] {
            let [solid, marked] =
                if draft.is_solid[primitive] { [primitive, first] } else { [first, primitive] };
            let marked = &info(marked).path;
            refusals.push(Refusal {
                primitive: solid,
                rule: "solid-contact",
                cause: format!("it is joined to {marked}, which has `contact: Marked`"),
                cure: "give the groups of both the same `contact`",
            });
        } else if info(primitive).surface != info(first).surface {
            let [own, other] =
                [primitive, first].map(|primitive| &surfaces[info(primitive).surface as usize].name);
            let joined = &info(first).path;
            refusals.push(Refusal {
                primitive,
                rule: "solid-surfaces",
                cause: format!("its surface is \"{own}\", but {joined}, joined to it, has \"{other}\""),
                cure: "give all parts of a solid one surface, or do not join them",
            });
        }
    }
    refusals.len() == before
}
