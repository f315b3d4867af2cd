//! What a frame hands out: contacts in order, wrenches, the list that a host sees, and bristles preloaded after a commit.

mod listing;
pub(crate) mod order;
pub(crate) mod preload;
pub(crate) mod reduce;
pub(crate) mod remember;
