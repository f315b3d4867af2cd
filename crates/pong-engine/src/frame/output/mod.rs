//! Results of a frame: ordered contacts, wrenches, the host's contact list, wrenches of single pairs, records
//! for the commit, and preloaded bristles.

pub(crate) mod commit;
mod listing;
pub(crate) mod order;
pub(crate) mod ordered;
mod pair_wrench;
pub(crate) mod preload;
pub(crate) mod reduce;
pub(crate) mod results;
