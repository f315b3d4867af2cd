//! Model files: RON text → validated, flat, immutable [`Model`].

#![forbid(unsafe_code)]

pub mod model;
pub mod surface;

pub use model::{Body, Item, Model, Node, PrimitiveInfo, Tree};
pub use surface::{Exponent, FrictionLaw, NormalLaw, PairOverride, Surface};
