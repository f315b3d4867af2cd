//! Distance of two movable groups.

use crate::guard::get;
use crate::handle::pong_world;
use crate::ids::pong_interface_id;
use crate::status::pong_status;
use pong_engine::{EngineError, GroupDistance};

/// Primitive number that names no primitive.
pub const PONG_NO_PRIMITIVE: u32 = u32::MAX;

/// Distance of two movable groups a and b, with their nearest primitives, that of a first.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_distance {
    /// Smallest distance of two primitives that have a contact test with each other, m: 0 if such overlap, infinite if there
    /// are none.
    pub distance: f64,
    /// Nearest points, m, in the common frame. If primitives overlap, some points near; zero if the distance is infinite.
    pub points: [[f64; 3]; 2],
    /// The primitives: indices within the movable groups, see pong_primitive_path(). PONG_NO_PRIMITIVE if the distance is
    /// infinite.
    pub primitives: [u32; 2],
    /// Elements within the primitives: a mesh's triangles, from 0; 0 for all other kinds.
    pub elements: [u32; 2],
}

/// Distance of two movable groups at the states set last; no frame is needed. Primitives count that have a contact test with one
/// of the other group and that no filter keeps apart; a pair that is off has a distance too. Triangles count without their
/// thickness. Computed when it is asked for: a frame pays nothing; allocates nothing. PONG_STATUS_BAD_VALUE: both are the same
/// group, their Objects are not paired, or a bore or a primitive of a host's kind is in the way, which has no convex solid.
/// PONG_STATUS_WRONG_PHASE: the world is not sealed. PONG_STATUS_UNSET_STATE: the state of one was never set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_distance(
    world: *const pong_world,
    a: pong_interface_id,
    b: pong_interface_id,
    distance: *mut pong_distance,
) -> pong_status {
    get(world, (distance, "distance"), |inner| {
        let cure = "seal the world first";
        let too_early = EngineError::WrongPhase { call: "get a distance", cure };
        let world = inner.phase.sealed().ok_or(too_early)?;
        Ok((&world.distance(a.id(), b.id())?).into())
    })
}

impl From<&GroupDistance> for pong_distance {
    fn from(found: &GroupDistance) -> Self {
        let Some(nearest) = &found.nearest else {
            return Self {
                distance: found.distance,
                points: [[0.0; 3]; 2],
                primitives: [PONG_NO_PRIMITIVE; 2],
                elements: [0; 2],
            };
        };
        Self {
            distance: found.distance,
            points: [0, 1].map(|side| nearest[side].point.into()),
            primitives: [0, 1].map(|side| nearest[side].primitive),
            elements: [0, 1].map(|side| nearest[side].element),
        }
    }
}
