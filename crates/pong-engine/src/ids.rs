//! Ids by value: an index, and the stamp of the world that gave it out. Zero is no id.

/// Number of a world within this process; ids of another world are told by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct WorldStamp(u32);

impl WorldStamp {
    /// A stamp that no other world of this process has (until 2³² of them were made).
    pub(crate) fn fresh() -> Self {
        use std::sync::atomic::{AtomicU32, Ordering};
        static NEXT: AtomicU32 = AtomicU32::new(1);
        Self(NEXT.fetch_add(1, Ordering::Relaxed).max(1))
    }
}

macro_rules! id_type {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(u64);

        impl $name {
            pub(crate) fn new(world: WorldStamp, index: usize) -> Self {
                Self(u64::from(world.0) << 32 | (index as u64 + 1))
            }

            /// The index in the world that gave the id out; `None` if that was another world.
            pub(crate) fn index_in(self, world: WorldStamp) -> Option<usize> {
                let index1 = self.0 & 0xffff_ffff;
                (self.0 >> 32 == u64::from(world.0) && index1 > 0).then(|| index1 as usize - 1)
            }

            /// Its place among the ids of its kind in its world, counted from 0 in the order in which they were made.
            pub fn index(self) -> usize {
                (self.0 & 0xffff_ffff).saturating_sub(1) as usize
            }

            /// The id as a number, for foreign interfaces; never zero for an id that a world gave out.
            pub fn to_bits(self) -> u64 {
                self.0
            }

            /// The id from its number. A number that no world gave out is refused when it is used.
            pub fn from_bits(bits: u64) -> Self {
                Self(bits)
            }
        }
    };
}

id_type!(
    /// A model added to a world.
    ModelId
);
id_type!(
    /// An Object: an instance of a model.
    ObjectId
);
id_type!(
    /// Two Objects that are tested against each other.
    PairId
);
id_type!(
    /// An Interface: the state in and wrench out of one movable group of one Object.
    InterfaceId
);
