//! What several tests need.

use pong_engine::{Config, World};

/// A sealed world in which nothing can touch.
pub fn empty_world() -> World {
    let mut world = World::new(Config::default());
    world.seal().unwrap();
    world
}
