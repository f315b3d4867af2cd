//! Named parameters of a scene, by the addresses of campaigns (docs/campaigns.md).
//!
//! | file | is |
//! |---|---|
//! | `address.rs` | a name resolved to a number of a built scene |
//! | `surface.rs` | numbers of a surface |
//! | `original.rs` | values of the scene as built; all values of a case set together |

mod address;
mod original;

pub use address::Parameter;
pub(crate) use address::Target;
pub(crate) use original::Original;
