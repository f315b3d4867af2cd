//! Ids by value: an index, and the stamp of the world that gave it out. Zero is no valid id.

/// Number of a world within this process, to recognise ids of other worlds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct WorldStamp(u32);

impl WorldStamp {
    /// A stamp that no other world of this process has (until it wraps after 2³²).
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

            /// Index in the world that gave the id out; `None` for another world.
            pub(crate) fn index_in(self, world: WorldStamp) -> Option<usize> {
                let index1 = self.0 & 0xffff_ffff;
                (self.0 >> 32 == u64::from(world.0) && index1 > 0).then(|| index1 as usize - 1)
            }

            /// Index among the ids of its kind in its world, in order of creation.
            pub fn index(self) -> usize {
                (self.0 & 0xffff_ffff).saturating_sub(1) as usize
            }

            /// The id as a number, for foreign interfaces; never zero for a valid id.
            pub fn to_bits(self) -> u64 {
                self.0
            }

            /// The id with this number. An invalid number is refused on use.
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
