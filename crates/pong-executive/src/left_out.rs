//! Contacts left out of a frame: why, and the remedy.

use pong_engine::{StatusBits, World};
use std::fmt;

/// A frame that left contacts out, ordered by the capacity that it advises. As text it is the cause, without
/// the cure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LeftOut {
    /// The contact capacity to ask for instead of the world's.
    pub advised: usize,
    /// True if contacts of one ball could not be shared exactly; false if there were more contacts than the
    /// capacity.
    pub by_sharing: bool,
}

impl LeftOut {
    /// Contacts left out of the last frame of a world; `None` if there are none.
    pub fn of(world: &World) -> Option<Self> {
        let report = world.report();
        let advised = report.advised_capacity(world.contact_capacity())?;
        Some(Self { advised, by_sharing: !report.status.contains(StatusBits::CONTACT_LIMIT) })
    }

    /// Addition to the cure: the number of contacts that a ball shares is known only when there is room for
    /// them.
    pub fn again(&self) -> &'static str {
        if self.by_sharing { ", and twice that if this comes back" } else { "" }
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.by_sharing {
            "a ball touched one surface in more places than could be shared exactly, and the shallowest were left out"
        } else {
            "there were more contacts in a frame than the world keeps, and the shallowest were left out"
        })
    }
}
