//! A world and the harness's knowledge of it.

use super::laws::Behaviour;
use pong::ids::{pong_interface_id, pong_model_id, pong_object_id, pong_pair_id};
use pong::world::pong_world;

/// Ids that a world gave out.
#[derive(Clone, Default)]
pub struct Ids {
    pub models: Vec<pong_model_id>,
    pub objects: Vec<pong_object_id>,
    pub pairs: Vec<pong_pair_id>,
    pub interfaces: Vec<pong_interface_id>,
}

/// A world and its host.
pub struct Host {
    pub world: *mut pong_world,
    pub ids: Ids,
    pub sealed: bool,
    /// True for each Interface whose state is set.
    pub set: Vec<bool>,
    /// Behaviour of this world's laws; its address is their `user` pointer.
    pub behaviour: Box<Behaviour>,
    /// True if a model with laws of the host may be loaded.
    pub own_laws: bool,
    /// True if a frame was computed and has not been invalidated.
    pub has_frame: bool,
    pub contact_capacity: u64,
    pub state_size: usize,
    /// A contact state saved before.
    pub saved: Option<Vec<u8>>,
    pub logging: bool,
    /// True if numbers were set whose sums may overflow.
    pub extreme: bool,
}

impl Host {
    pub fn new(world: *mut pong_world) -> Self {
        Self {
            world,
            ids: Ids::default(),
            sealed: false,
            set: Vec::new(),
            behaviour: Box::new(Behaviour::new(world)),
            own_laws: false,
            has_frame: false,
            contact_capacity: 0,
            state_size: 0,
            saved: None,
            logging: false,
            extreme: false,
        }
    }

    /// True if a frame must succeed.
    pub fn is_ready(&self) -> bool {
        self.sealed && self.set.iter().all(|set| *set) && !self.own_laws
    }
}
