//! Contacts that a frame left out: why, and what would have kept them.

use pong_engine::{StatusBits, World};
use std::fmt;

/// A frame that left contacts out. One is greater than another if it advises a larger capacity. As text it is the cause, without
/// the cure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LeftOut {
    /// The contact capacity to ask for instead of the world's.
    pub advised: usize,
    /// Whether contacts of one ball could not be shared exactly; else there were more contacts than the capacity.
    pub by_sharing: bool,
}

impl LeftOut {
    /// The last frame of a world; `None` if it left nothing out.
    pub fn of(world: &World) -> Option<Self> {
        let report = world.report();
        let advised = report.advised_capacity(world.contact_capacity())?;
        Some(Self { advised, by_sharing: !report.status.contains(StatusBits::CONTACT_LIMIT) })
    }

    /// What to add to the cure: how many places of a ball share is not known before they can be shared.
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
