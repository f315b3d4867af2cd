//! Ids by value.

use pong_engine::{InterfaceId, ModelId, ObjectId, PairId};

macro_rules! id_conversions {
    ($name:ident = $engine:ident) => {
        impl $name {
            pub(crate) fn id(self) -> $engine {
                $engine::from_bits(self.bits)
            }
        }

        impl From<$engine> for $name {
            fn from(id: $engine) -> Self {
                Self { bits: id.to_bits() }
            }
        }
    };
}

/// A model of a world; zero is none. Ids are plain numbers: copy, compare and store them freely. An id of
/// another world, or of a destroyed one, is recognised and refused.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct pong_model_id {
    /// Set by the library.
    pub bits: u64,
}

/// An Object: an instance of a model; zero is none.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct pong_object_id {
    /// Set by the library.
    pub bits: u64,
}

/// Two Objects that are tested against each other; zero is none.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct pong_pair_id {
    /// Set by the library.
    pub bits: u64,
}

/// An Interface: state in and wrench out of one movable group of one Object; zero is none.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct pong_interface_id {
    /// Set by the library.
    pub bits: u64,
}

id_conversions!(pong_model_id = ModelId);
id_conversions!(pong_object_id = ObjectId);
id_conversions!(pong_pair_id = PairId);
id_conversions!(pong_interface_id = InterfaceId);
